#include "rigid/welds.h"

#include "rigid/deck_nodes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

double power_or_two(double value)
{
    return value > 0 ? value : 2;
}

double end_of(double time)
{
    return time == 0 || time >= 1e20 ? forever : time;
}

const CoordinateSystem& axes_of(const Model& model, const Record& record)
{
    const Id id = record.integer("CID");
    const auto found = std::find_if(model.coordinate_systems.begin(), model.coordinate_systems.end(),
                                    [&](const CoordinateSystem& system) { return system.id == id; });
    if (found == model.coordinate_systems.end())
        throw DeckError(record.where, fmt::format("*{}, field CID: {} is no coordinate system, and the axes "
                                                  "of the weld are needed (local y runs along it)",
                                                  record.keyword, id));
    return *found;
}

/// Nodes behind the plane through the middle of all of them; where all lie in it, the first one alone.
std::vector<Index> nodes_behind(const Weld& weld, const Model& model)
{
    const auto height = [&](std::size_t i) {
        return dot(model.nodes.position[weld.nodes[i]] - model.nodes.position[weld.nodes[0]],
                   weld.plane.normal);
    };
    double lowest = 0, highest = 0, size = 0;
    for (std::size_t i = 0; i < weld.nodes.size(); ++i) {
        lowest = std::min(lowest, height(i));
        highest = std::max(highest, height(i));
        size =
            std::max(size, norm(model.nodes.position[weld.nodes[i]] - model.nodes.position[weld.nodes[0]]));
    }
    if (highest - lowest <= 1e-6 * size) return {0};
    std::vector<Index> behind;
    for (std::size_t i = 0; i < weld.nodes.size(); ++i)
        if (height(i) < 0.5 * (lowest + highest)) behind.push_back(static_cast<Index>(i));
    return behind;
}

/// The plane of a butt weld stands across local x, its width is D. That of a fillet weld is its throat, of
/// the width A, whose normal is turned by ALPHA about local y, from z to x. Axes turn with the body, whose
/// own are the global ones at the start.
WeldPlane plane_of(const Model& model, const Record& record)
{
    const auto& [x, y, z] = axes_of(model, record).axes;
    const bool butt = record.keyword == "CONSTRAINED_GENERALIZED_WELD_BUTT";
    const double angle = butt ? 0.5 * std::numbers::pi : record.real("ALPHA") * std::numbers::pi / 180;
    const char* width = butt ? "D" : "A";
    WeldPlane plane;
    plane.normal = std::cos(angle) * z + std::sin(angle) * x;
    plane.along = y;
    plane.across = cross(y, plane.normal);
    plane.factor = record.real("BETA");
    plane.strength = record.real("SIGY");
    plane.area = record.real("L") * record.real(width);
    if (!(plane.area > 0))
        throw DeckError(record.where,
                        fmt::format("*{}: length L = {} and width {} = {} have to be positive",
                                    record.keyword, record.real("L"), width, record.real(width)));
    return plane;
}

/// Whether the stresses in the plane of a butt or fillet weld break it.
/// added  what the body adds to the forces of each of its nodes [force]
bool plane_fails(Weld& weld, const std::vector<Vec3>& added, const Matrix3& orientation)
{
    const WeldPlane& plane = weld.plane;
    Vec3 force{};
    for (Index node : plane.of_side) force += added[node];
    const double pull = std::max(0.0, dot(force, orientation * plane.normal));
    const double across = dot(force, orientation * plane.across);
    const double along = dot(force, orientation * plane.along);
    weld.normal_force = pull;
    weld.shear_force = std::hypot(across, along);
    const double stress = std::sqrt(pull * pull + 3 * weld.shear_force * weld.shear_force) / plane.area;
    return plane.strength > 0 && plane.factor * stress >= plane.strength;
}

} // namespace

std::vector<Weld> read_welds(const Model& model)
{
    std::vector<Weld> welds;
    const DeckNodes nodes(model);
    const auto keep = [&](Weld weld, const Record& record) {
        weld.id = record.integer("WID");
        if (weld.id == 0) weld.id = static_cast<Id>(welds.size()) + 1;
        weld.where = record.where;
        if (weld.nodes.size() < 2)
            throw DeckError(record.where, fmt::format("*{}: a weld needs two nodes", record.keyword));
        if (record.keyword.ends_with("_BUTT") || record.keyword.ends_with("_FILLET")) {
            weld.plane = plane_of(model, record);
            weld.plane.of_side = nodes_behind(weld, model);
        } else {
            weld.normal_strength = record.real("SN");
            weld.shear_strength = record.real("SS");
            weld.normal_power = power_or_two(record.real("N"));
            weld.shear_power = power_or_two(record.real("M"));
        }
        welds.push_back(std::move(weld));
    };
    for_each_record(model, "CONSTRAINED_SPOTWELD", [&](const Record& record) {
        Weld weld;
        for (const char* field : {"N1", "N2"})
            weld.nodes.push_back(nodes.find(record.integer(field), record, record.where.line));
        weld.end = end_of(record.real("TF", forever));
        keep(std::move(weld), record);
    });
    for (const std::string_view kind : {"SPOT", "BUTT", "FILLET"}) {
        for_each_record(model, fmt::format("CONSTRAINED_GENERALIZED_WELD_{}", kind),
                        [&](const Record& record) {
                            Weld weld;
                            weld.nodes = nodes_of_set(model, record, "NSID", record.integer("NSID"));
                            weld.end = end_of(record.real("TFAIL", forever));
                            keep(std::move(weld), record);
                        });
    }
    return welds;
}

bool weld_fails(Weld& weld, const RigidBody& body, const State& state, const Clock& clock)
{
    if (clock.time >= weld.end) return true;
    std::vector<Vec3> added(body.nodes.size()); // what the body adds to the forces of its nodes
    for (std::size_t i = 0; i < body.nodes.size(); ++i)
        added[i] = body.node_mass[i] * body.acceleration_of_node[i] - state.force[body.nodes[i]];
    if (weld.plane.area > 0) return plane_fails(weld, added, body.shown_orientation);
    const auto place = [&](std::size_t i) { return body.shown_orientation * body.arm[i]; };
    const Vec3 normal = unit(place(body.nodes.size() - 1) - place(0));
    weld.normal_force = weld.shear_force = 0;
    // The largest of each kind counts.
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
        // The first node is pulled along the normal under tension, the last one against it.
        const double pull = (i == 0 ? 1 : -1) * dot(added[i], normal);
        const Vec3 shear = added[i] - dot(added[i], normal) * normal;
        weld.normal_force = std::max(weld.normal_force, pull);
        weld.shear_force = std::max(weld.shear_force, norm(shear));
    }
    double use = 0;
    if (weld.normal_strength > 0)
        use += std::pow(weld.normal_force / weld.normal_strength, weld.normal_power);
    if (weld.shear_strength > 0) use += std::pow(weld.shear_force / weld.shear_strength, weld.shear_power);
    return use >= 1;
}

} // namespace plash

#include "rigid/welds.h"

#include "rigid/deck_nodes.h"

#include <cmath>
#include <fmt/format.h>

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

} // namespace

std::vector<Weld> read_welds(const Model& model)
{
    std::vector<Weld> welds;
    const DeckNodes nodes(model);
    const auto keep = [&](Weld weld, const Record& record) {
        weld.id = record.integer("WID");
        if (weld.id == 0) weld.id = static_cast<Id>(welds.size()) + 1;
        weld.where = record.where;
        weld.normal_strength = record.real("SN");
        weld.shear_strength = record.real("SS");
        weld.normal_power = power_or_two(record.real("N"));
        weld.shear_power = power_or_two(record.real("M"));
        if (weld.nodes.size() < 2)
            throw DeckError(record.where, fmt::format("*{}: a weld needs two nodes", record.keyword));
        welds.push_back(std::move(weld));
    };
    for (const std::string_view keyword : {"CONSTRAINED_SPOTWELD"}) {
        for_each_record(model, keyword, [&](const Record& record) {
            Weld weld;
            for (const char* field : {"N1", "N2"})
                weld.nodes.push_back(nodes.find(record.integer(field), record, record.where.line));
            weld.end = end_of(record.real("TF", forever));
            keep(std::move(weld), record);
        });
    }
    for_each_record(model, "CONSTRAINED_GENERALIZED_WELD_SPOT", [&](const Record& record) {
        Weld weld;
        weld.nodes = nodes_of_set(model, record, "NSID", record.integer("NSID"));
        weld.end = end_of(record.real("TFAIL", forever));
        keep(std::move(weld), record);
    });
    return welds;
}

bool weld_fails(Weld& weld, const RigidBody& body, const State& state, const Clock& clock)
{
    if (clock.time >= weld.end) return true;
    const auto place = [&](std::size_t i) { return body.shown_orientation * body.arm[i]; };
    const Vec3 normal = unit(place(body.nodes.size() - 1) - place(0));
    weld.normal_force = weld.shear_force = 0;
    // Each node: what the body adds to its own forces; the largest of each kind counts.
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
        const Vec3 added = body.node_mass[i] * body.acceleration_of_node[i] - state.force[body.nodes[i]];
        // The first node is pulled along the normal under tension, the last one against it.
        const double pull = (i == 0 ? 1 : -1) * dot(added, normal);
        const Vec3 shear = added - dot(added, normal) * normal;
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

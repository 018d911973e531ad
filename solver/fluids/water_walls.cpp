#include "solver/fluids/water_walls.h"

#include "ale/fluid_settings.h"
#include "contact/solid_faces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr FreedomMask translations = 7;
constexpr char wall_axis_names[] = "xyz";

/// The axis that a direction lies along; -1: none.
int axis_along(const Vec3& direction)
{
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(std::abs(direction.*vector_component[axis]) - norm(direction)) < 1e-9 * norm(direction))
            return axis;
    return -1;
}

class WallFinder {
public:
    WallFinder(const Model& model, const Water& water) : model_(model), water_(water)
    {
        tolerance_ = 1e-4 * water.smallest_size;
    }

    void add_held_faces()
    {
        std::vector<FreedomMask> held(model_.nodes.size());
        for (const FixedNodes& fixed : model_.fixed_nodes) {
            if (fixed.system != none || fixed.local || fixed.birth > 0 || fixed.death < forever) continue;
            for (Index node : fixed.nodes) held[node] |= fixed.freedoms & translations;
        }
        for (const SolidFace& face : solid_faces(model_)) {
            if (!water_.is_water[brick_part(model_, face.solid)]) continue;
            if (face.neighbour != none && water_.is_water[brick_part(model_, face.neighbour)]) continue;
            const Vec3 &a = model_.nodes.position[face.nodes[0]], &b = model_.nodes.position[face.nodes[1]],
                       &c = model_.nodes.position[face.nodes[2]];
            const Vec3 normal = cross(b - a, c - a);
            FreedomMask common = translations;
            for (Index node : face.nodes) common &= held[node];
            if (common == 0) continue;
            const int axis = axis_along(normal);
            if (axis < 0) {
                if (common == translations)
                    throw DeckError({}, fmt::format("the water has a held face across no global axis at node "
                                                    "{}; only walls across the axes can be translated",
                                                    model_.nodes.id[face.nodes[0]]));
                continue;
            }
            if (!(common >> axis & 1)) continue;
            add({axis, a.*vector_component[axis], normal.*vector_component[axis] < 0, common,
                 "held faces of the water"});
        }
    }

    void add_mesh_sides()
    {
        const FluidSettings settings = fluid_settings_of(model_);
        if (settings.boundary == FluidSettings::Boundary::open) return;
        Vec3 low{}, high{};
        bool first = true;
        for (std::size_t i = 0; i < model_.solids.size(); ++i) {
            if (!water_.is_water[model_.solids.part[i]]) continue;
            for (Index node : model_.solids.nodes[i]) {
                for (const auto component : vector_component) {
                    const double at = model_.nodes.position[node].*component;
                    low.*component = first ? at : std::min(low.*component, at);
                    high.*component = first ? at : std::max(high.*component, at);
                }
                first = false;
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            const bool stick = settings.boundary == FluidSettings::Boundary::stick;
            const FreedomMask mask = stick ? translations : 1u << axis;
            add({axis, low.*vector_component[axis], true, mask, "*CONTROL_ALE EBC"});
            add({axis, high.*vector_component[axis], false, mask, "*CONTROL_ALE EBC"});
        }
    }

    void add_symmetry_planes()
    {
        for (const Record& record : model_.others) {
            if (record.keyword == "BOUNDARY_SPH_PERIODIC" || record.keyword == "PLASH_SPH_MOVING_PERIODIC")
                throw DeckError(record.where, fmt::format("*{} has no counterpart in other forms of water",
                                                          record.keyword));
            if (record.keyword != "BOUNDARY_SPH_SYMMETRY_PLANE") continue;
            const Vec3 tail{record.real("VTX"), record.real("VTY"), record.real("VTZ")};
            const Vec3 normal = Vec3{record.real("VHX"), record.real("VHY"), record.real("VHZ")} - tail;
            add_plane(tail, normal, 0, record.where, "*" + record.keyword);
        }
    }

    void add_rigid_walls(bool only_possible)
    {
        for (const RigidWall& wall : model_.rigid_walls) {
            if (!acts_on_water(wall, water_)) continue;
            const bool still = wall.shape == RigidWall::Shape::plane && wall.motion_curve == none &&
                               wall.mass == 0 && wall.birth == 0 && wall.death == forever;
            if (only_possible && (!still || wall.friction > 0 || axis_along(wall.normal) < 0)) continue;
            const std::string name = fmt::format("rigid wall {}", wall.id);
            if (!still)
                throw DeckError(wall.where,
                                fmt::format("{} acts on the water; only endless planes that stand "
                                            "still for the whole run can become a side of an "
                                            "Eulerian mesh",
                                            name));
            if (wall.friction > 0 && wall.friction < 1)
                throw DeckError(wall.where,
                                fmt::format("{} acts on the water with friction {:g}; on the side of an "
                                            "Eulerian mesh fluid slips (0) or sticks (1 or more)",
                                            name, wall.friction));
            add_plane(wall.tail, wall.normal, wall.friction >= 1 ? translations : 0, wall.where, name);
        }
    }

    std::vector<WaterWall> take() { return std::move(walls_); }

private:
    const Model& model_;
    const Water& water_;
    double tolerance_;
    std::vector<WaterWall> walls_;

    void add_plane(const Vec3& point, const Vec3& normal, FreedomMask held, Location where,
                   const std::string& origin)
    {
        const int axis = axis_along(normal);
        if (axis < 0)
            throw DeckError(where,
                            fmt::format("{} is oblique to the global axes; there it has no counterpart "
                                        "in other forms of water",
                                        origin));
        const auto component = vector_component[axis];
        const double at = point.*component, middle = 0.5 * (water_.low.*component + water_.high.*component);
        add({axis, at, middle > at, held | 1u << axis, origin});
    }

    /// Faces of one plane are one wall; it holds what all of them hold.
    void add(WaterWall wall)
    {
        for (WaterWall& known : walls_) {
            if (known.axis != wall.axis || known.water_above != wall.water_above ||
                std::abs(known.at - wall.at) > tolerance_)
                continue;
            known.held &= wall.held;
            if (known.origin.find(wall.origin) == std::string::npos) known.origin += " and " + wall.origin;
            return;
        }
        const auto component = vector_component[wall.axis];
        const double room =
            wall.water_above ? water_.low.*component - wall.at : wall.at - water_.high.*component;
        if (room < -tolerance_)
            throw DeckError({}, fmt::format("{}: the wall {} = {:g} lies within the water, which has no "
                                            "counterpart in other forms of water",
                                            wall.origin, wall_axis_names[wall.axis], wall.at));
        walls_.push_back(std::move(wall));
    }
};

} // namespace

bool acts_on_water(const RigidWall& wall, const Water& water)
{
    return wall.all_nodes || std::any_of(wall.nodes.begin(), wall.nodes.end(),
                                         [&](Index node) { return water.has_node[node]; });
}

std::vector<WaterWall> walls_of(const Model& model, const Water& water, RigidWalls rigid_walls)
{
    WallFinder finder(model, water);
    if (water.solids || water.mesh) finder.add_held_faces();
    if (water.mesh) finder.add_mesh_sides();
    if (water.particles) finder.add_symmetry_planes();
    if (rigid_walls != RigidWalls::none) finder.add_rigid_walls(rigid_walls == RigidWalls::possible);
    return finder.take();
}

} // namespace plash

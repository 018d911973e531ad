// *BOUNDARY_SPC and *BOUNDARY_PRESCRIBED_MOTION.

#include "parser/reading.h"

#include <fmt/format.h>

#include <cmath>

namespace plash {
namespace {

/// LS-DYNA's way of saying "never": 1e20, 1e28 or nothing.
double death_time(const Record& record, std::string_view field)
{
    const double time = record.real(field, forever);
    return time == 0 || time >= 1e20 ? forever : time;
}

/// Nodes that NID or NSID names.
std::vector<Index> nodes_of(const Record& record, Reading& reading)
{
    if (record.peek("NSID")) {
        const Index set = reading.find(record, "NSID", Kind::node_set);
        return set == none ? std::vector<Index>{} : reading.model.node_sets[set].nodes;
    }
    const Index node = reading.find(record, "NID", Kind::node);
    return node == none ? std::vector<Index>{} : std::vector<Index>{node};
}

/// Whether a system that stands has the global axes, in which freedoms are simpler to hold.
bool is_global(const CoordinateSystem& system)
{
    return system.nodes[0] == none && system.axes[0].x > 1 - 1e-12 && system.axes[1].y > 1 - 1e-12;
}

/// Three unit axes of which the first is a normal.
std::array<Vec3, 3> axes_of_normal(const Vec3& normal)
{
    const Vec3 x = unit(normal);
    const Vec3 y = unit(cross(std::abs(x.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, x));
    return {x, y, cross(x, y)};
}

void read_fixed_nodes(const Record& record, const Block&, Reading& reading)
{
    constexpr std::string_view freedoms[] = {"DOFX", "DOFY", "DOFZ", "DOFRX", "DOFRY", "DOFRZ"};
    FixedNodes fixed;
    fixed.where = record.where;
    fixed.nodes = nodes_of(record, reading);
    for (int i = 0; i < 6; ++i)
        if (record.integer(freedoms[i]) != 0) fixed.freedoms |= 1u << i;
    fixed.birth = record.real("BIRTH");
    fixed.death = death_time(record, "DEATH");
    fixed.system = reading.find(record, "CID", Kind::coordinate);
    if (fixed.system != none && is_global(reading.model.coordinate_systems[fixed.system]))
        fixed.system = none;
    if (fixed.freedoms == 0) reading.warning(record, "", "fixes nothing: all its freedoms are zero");
    if (!fixed.nodes.empty() && fixed.freedoms) reading.model.fixed_nodes.push_back(std::move(fixed));
}

/// Nodes stay in a plane (COPT = 0) or on a line (1) through their places.
void read_sliding_plane(const Record& record, const Block& block, Reading& reading)
{
    FixedNodes fixed;
    fixed.where = record.where;
    fixed.nodes = nodes_of(record, reading);
    fixed.local = true;
    const Vec3 normal =
        reading.motion_of(block).direction({record.real("VX"), record.real("VY"), record.real("VZ")});
    if (norm(normal) == 0) reading.error(record, "VX", "the vector (VX, VY, VZ) has no length");
    fixed.axes = axes_of_normal(normal);
    fixed.freedoms = record.integer("COPT") == 0 ? 1u : 6u;
    if (!fixed.nodes.empty()) reading.model.fixed_nodes.push_back(std::move(fixed));
}

/// Nodes of some parts within TOL of a plane do not leave it, nor turn about axes in it.
void read_symmetry_plane(const Record& record, const Block& block, Reading& reading)
{
    const Affine motion = reading.motion_of(block);
    const Vec3 point = motion.point({record.real("X"), record.real("Y"), record.real("Z")});
    const Vec3 normal = unit(motion.direction({record.real("VX"), record.real("VY"), record.real("VZ")}));
    if (norm(normal) < 0.5) reading.error(record, "VX", "the normal (VX, VY, VZ) has no length");
    std::vector<Index> parts;
    if (record.peek("PSID")) {
        const Index set = reading.find(record, "PSID", Kind::part_set);
        if (set != none) parts = reading.model.part_sets[set].parts;
    } else if (const Index part = reading.find(record, "PID", Kind::part); part != none) {
        parts = {part};
    }
    FixedNodes fixed;
    fixed.where = record.where;
    const double tolerance = record.real("TOL");
    for (Index node : nodes_of_parts(reading.model, parts)) {
        if (std::abs(dot(reading.model.nodes.position[node] - point, normal)) <= tolerance)
            fixed.nodes.push_back(node);
    }
    fixed.local = true;
    fixed.axes = axes_of_normal(normal);
    fixed.freedoms = 1u | 16u | 32u;
    if (fixed.nodes.empty())
        reading.warning(record, "TOL", "no node of its parts lies on the symmetry plane");
    else
        reading.model.fixed_nodes.push_back(std::move(fixed));
}

void read_non_reflecting(const Record& record, const Block&, Reading& reading)
{
    NonReflectingBoundary boundary;
    boundary.where = record.where;
    const Index set = reading.find(record, "SSID", Kind::segment_set);
    if (set == none) return;
    boundary.segments = reading.model.segment_sets[set].segments;
    boundary.dilatational = record.real("AD") == 0;
    boundary.shear = record.real("AS") == 0;
    reading.model.non_reflecting_boundaries.push_back(std::move(boundary));
}

/// DOF 1..3 along, 5..7 about x, y, z; 4 along, 8 about VID; -4, -8: other components are held too.
bool direction_of(const Record& record, PrescribedMotion& motion, Reading& reading)
{
    const Id freedom = record.integer("DOF");
    const Id magnitude = std::abs(freedom);
    motion.rotation = magnitude >= 5 && magnitude <= 8;
    motion.only_component = freedom > 0;
    constexpr Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (magnitude >= 1 && magnitude <= 7 && magnitude != 4) {
        motion.direction = axes[(magnitude - 1) % 4];
        motion.only_component = true;
        return true;
    }
    if (magnitude == 4 || magnitude == 8) {
        const Index vector = reading.find(record, "VID", Kind::vector);
        if (vector == none) {
            reading.error(record, "VID", fmt::format("DOF = {} needs a vector (VID)", freedom));
            return false;
        }
        const NamedVector& named = reading.model.vectors[vector];
        motion.direction = unit(named.head - named.tail);
        if (norm(motion.direction) > 0.5) return true;
        reading.error(record, "VID", fmt::format("vector {} has no length", named.id));
        return false;
    }
    if (magnitude >= 9 && magnitude <= 11 && motion.rigid_part == none) {
        // About an axis parallel to x, y or z through (OFFSET1, OFFSET2) in the plane across it.
        const int axis = static_cast<int>(magnitude - 9);
        motion.direction = axes[axis];
        motion.orbit = true;
        double* place[] = {&motion.center.x, &motion.center.y, &motion.center.z};
        const int first[] = {1, 2, 0}, second[] = {2, 0, 1}; // (y, z), (z, x), (x, y)
        *place[first[axis]] = record.real("OFFSET1");
        *place[second[axis]] = record.real("OFFSET2");
        return true;
    }
    reading.error(
        record, "DOF",
        fmt::format("{} is not supported; 1 to 8, -4 and -8 are, and for nodes 9 to 11 and -9 to -11",
                    freedom));
    return false;
}

/// VAD = 4: the body of the card keeps a distance from a lead body. False after an error.
bool read_relative_motion(const Record& record, PrescribedMotion& motion, Reading& reading)
{
    if (motion.rigid_part == none || motion.local) {
        reading.error(record, "VAD", "4 (displacement from another rigid body) is for _RIGID alone");
        return false;
    }
    motion.lead = reading.find_body(record.integer("LRB"));
    if (motion.lead == none) return false;
    if (motion.lead == motion.rigid_part) {
        reading.error(record, "LRB", fmt::format("{} is the driven body itself", record.integer("LRB")));
        return false;
    }
    motion.line = {reading.find(record, "NODE1", Kind::node), reading.find(record, "NODE2", Kind::node)};
    if ((motion.line[0] == none) != (motion.line[1] == none) ||
        (motion.line[0] != none && motion.line[0] == motion.line[1])) {
        reading.error(record, "NODE2", "a direction needs two different nodes, NODE1 and NODE2, or none");
        return false;
    }
    return true;
}

void read_prescribed_motion(const Record& record, const Block&, Reading& reading)
{
    PrescribedMotion motion;
    motion.where = record.where;
    if (record.peek("PID")) {
        motion.rigid_part = reading.find_body(record.integer("PID"));
        motion.local = record.keyword.ends_with("_LOCAL");
        if (motion.rigid_part == none) return;
    } else {
        motion.nodes = nodes_of(record, reading);
    }
    const Id kind = record.integer("VAD");
    if (kind < 0 || kind > 4) {
        reading.error(
            record, "VAD",
            fmt::format("{} is not supported; 0 velocity, 1 acceleration, 2 displacement, 3 velocity "
                        "as a function of displacement, 4 displacement from another rigid body",
                        kind));
        return;
    }
    if (!(kind == 4 ? read_relative_motion(record, motion, reading) : direction_of(record, motion, reading)))
        return;
    motion.kind = static_cast<PrescribedMotion::Kind>(kind);
    motion.curve = reading.find(record, "LCID", Kind::curve);
    if (motion.curve == none && record.integer("LCID") == 0)
        reading.error(record, "LCID", "a prescribed motion needs a curve");
    motion.scale = record.real("SF", 1);
    motion.birth = record.real("BIRTH");
    motion.death = death_time(record, "DEATH");
    reading.model.prescribed_motions.push_back(std::move(motion));
}

constexpr Translator boundary_table[] = {
    {"BOUNDARY_SPC_NODE", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_SPC_SET", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_SPC_NODE_BIRTH_DEATH", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_SPC_SET_BIRTH_DEATH", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_SLIDING_PLANE", Phase::conditions, read_sliding_plane},
    {"BOUNDARY_SPC_SYMMETRY_PLANE", Phase::conditions, read_symmetry_plane},
    {"BOUNDARY_SPC_SYMMETRY_PLANE_SET", Phase::conditions, read_symmetry_plane},
    {"BOUNDARY_NON_REFLECTING", Phase::conditions, read_non_reflecting},
    {"BOUNDARY_PRESCRIBED_MOTION_NODE", Phase::conditions, read_prescribed_motion},
    {"BOUNDARY_PRESCRIBED_MOTION_SET", Phase::conditions, read_prescribed_motion},
    {"BOUNDARY_PRESCRIBED_MOTION_RIGID", Phase::conditions, read_prescribed_motion},
    {"BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL", Phase::conditions, read_prescribed_motion},
};

} // namespace

std::span<const Translator> boundary_keywords()
{
    return boundary_table;
}

} // namespace plash

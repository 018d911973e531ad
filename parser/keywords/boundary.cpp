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

/// Axes of the coordinate system that CID names; the global ones when it names none.
std::array<Vec3, 3> axes_of(const Record& record, Reading& reading)
{
    const Index system = reading.find(record, "CID", Kind::coordinate);
    return system == none ? CoordinateSystem{}.axes : reading.model.coordinate_systems[system].axes;
}

bool are_global(const std::array<Vec3, 3>& axes)
{
    return axes[0].x > 1 - 1e-12 && axes[1].y > 1 - 1e-12;
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
    if (!are_global(axes_of(record, reading)))
        reading.error(record, "CID", "fixities along axes that are not the global ones are not supported");
    if (fixed.freedoms == 0) reading.warning(record, "", "fixes nothing: all its freedoms are zero");
    if (!fixed.nodes.empty() && fixed.freedoms) reading.model.fixed_nodes.push_back(std::move(fixed));
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
    reading.error(record, "DOF", fmt::format("{} is not supported; 1 to 8, -4 and -8 are", freedom));
    return false;
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
    if (!direction_of(record, motion, reading)) return;
    const Id kind = record.integer("VAD");
    if (kind < 0 || kind > 2) {
        reading.error(record, "VAD",
                      fmt::format("{} is not supported; 0 velocity, 1 acceleration, 2 displacement", kind));
        return;
    }
    motion.kind = static_cast<PrescribedMotion::Kind>(kind);
    motion.curve = reading.find(record, "LCID", Kind::curve);
    if (motion.curve == none && record.integer("LCID") == 0)
        reading.error(record, "LCID", "a prescribed motion needs a curve");
    motion.scale = record.real("SF", 1);
    motion.birth = record.real("BIRTH");
    motion.death = death_time(record, "DEATH");
    reading.model.prescribed_motions.push_back(std::move(motion));
}

constexpr Translator keywords[] = {
    {"BOUNDARY_SPC_NODE", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_SPC_SET", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_SPC_NODE_BIRTH_DEATH", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_SPC_SET_BIRTH_DEATH", Phase::conditions, read_fixed_nodes},
    {"BOUNDARY_PRESCRIBED_MOTION_NODE", Phase::conditions, read_prescribed_motion},
    {"BOUNDARY_PRESCRIBED_MOTION_SET", Phase::conditions, read_prescribed_motion},
    {"BOUNDARY_PRESCRIBED_MOTION_RIGID", Phase::conditions, read_prescribed_motion},
    {"BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL", Phase::conditions, read_prescribed_motion},
};

} // namespace

std::span<const Translator> boundary_keywords()
{
    return keywords;
}

} // namespace plash

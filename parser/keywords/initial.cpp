// *INITIAL_VELOCITY family and *INITIAL_AXIAL_FORCE_BEAM.

#include "parser/reading.h"

#include <fmt/format.h>

#include <algorithm>

namespace plash {
namespace {

/// Components along the axes of ICID (or of the include) as a global vector.
Vec3 to_global(const Record& record, const Block& block, Vec3 local, Reading& reading)
{
    const Index system = reading.find(record, "ICID", Kind::coordinate);
    if (system == none) return reading.motion_of(block).direction(local);
    const auto& axes = reading.model.coordinate_systems[system].axes;
    return local.x * axes[0] + local.y * axes[1] + local.z * axes[2];
}

/// Nodes of a set; of the whole model when no set is named.
std::vector<Index> nodes_of_set(const Record& record, std::string_view field, Reading& reading)
{
    if (record.integer(field) == 0) return all_nodes(reading.model);
    const Index set = reading.find(record, field, Kind::node_set);
    return set == none ? std::vector<Index>{} : reading.model.node_sets[set].nodes;
}

void keep(InitialVelocity velocity, Reading& reading)
{
    if (!velocity.nodes.empty()) reading.model.initial_velocities.push_back(std::move(velocity));
}

/// *INITIAL_VELOCITY: all nodes or a set, a box, and a set with a velocity of its own.
void read_velocity(const Record& record, const Block& block, Reading& reading)
{
    InitialVelocity velocity;
    velocity.where = record.where;
    velocity.nodes = nodes_of_set(record, "NSID", reading);
    if (const Index box = reading.find(record, "BOXID", Kind::box); box != none) {
        std::erase_if(velocity.nodes, [&](Index node) {
            return !reading.model.boxes[box].box.holds(reading.model.nodes.position[node]);
        });
    }
    velocity.translation = to_global(record, block, vector_of(record, "VX", "VY", "VZ"), reading);
    velocity.angular_velocity = to_global(record, block, vector_of(record, "VXR", "VYR", "VZR"), reading);
    velocity.set_rotation = true;
    keep(velocity, reading);
    if (record.integer("NSIDEX") == 0) return;
    velocity.nodes = nodes_of_set(record, "NSIDEX", reading);
    velocity.translation = to_global(record, block, vector_of(record, "VXE", "VYE", "VZE"), reading);
    velocity.angular_velocity = to_global(record, block, vector_of(record, "VXRE", "VYRE", "VZRE"), reading);
    keep(velocity, reading);
}

void read_node_velocity(const Record& record, const Block& block, Reading& reading)
{
    InitialVelocity velocity;
    velocity.where = record.where;
    const Index node = reading.find(record, "NID", Kind::node);
    if (node != none) velocity.nodes = {node};
    velocity.translation = to_global(record, block, vector_of(record, "VX", "VY", "VZ"), reading);
    velocity.angular_velocity = to_global(record, block, vector_of(record, "VXR", "VYR", "VZR"), reading);
    velocity.set_rotation = true;
    keep(velocity, reading);
}

/// STYP 1: ID is a part set, 2: a part, 3: a node set; ID 0: everything.
std::vector<Index> generation_nodes(const Record& record, const Block& block, Reading& reading)
{
    const Id type = record.integer("STYP", 1);
    if (record.integer("ID") == 0) return all_nodes(reading.model);
    const Kind kinds[] = {Kind::part_set, Kind::part, Kind::node_set};
    if (type < 1 || type > 3) {
        reading.error(record, "STYP", fmt::format("{} is not one of 1 part set, 2 part, 3 node set", type));
        return {};
    }
    const Index index = reading.look_up(kinds[type - 1], block.number(kinds[type - 1], record.integer("ID")));
    if (index == none) {
        reading.error(record, "ID",
                      fmt::format("there is no {} {}", to_string(kinds[type - 1]), record.integer("ID")));
        return {};
    }
    if (type == 1) return nodes_of_parts(reading.model, reading.model.part_sets[index].parts);
    if (type == 2) return nodes_of_parts(reading.model, {index});
    return reading.model.node_sets[index].nodes;
}

void read_generation(const Record& record, const Block& block, Reading& reading)
{
    InitialVelocity velocity;
    velocity.where = record.where;
    velocity.nodes = generation_nodes(record, block, reading);
    velocity.translation = to_global(record, block, vector_of(record, "VX", "VY", "VZ"), reading);
    velocity.spin = record.real("OMEGA");
    velocity.center = reading.motion_of(block).point(vector_of(record, "XC", "YC", "ZC"));
    velocity.axis = vector_of(record, "NX", "NY", "NZ");
    if (velocity.spin != 0 && norm(velocity.axis) == 0)
        reading.error(record, "NX", "a spin (OMEGA) needs an axis (NX, NY, NZ)");
    if (velocity.axis.x == -999)
        reading.error(record, "NX", "an axis between two nodes (NX = -999) is not supported");
    velocity.axis = unit(reading.motion_of(block).direction(velocity.axis));
    velocity.angular_velocity = velocity.spin * velocity.axis;
    velocity.set_rotation = velocity.spin != 0;
    velocity.over_inertia = record.integer("IRIGID") == 1;
    keep(velocity, reading);
}

void read_rigid_body_velocity(const Record& record, const Block& block, Reading& reading)
{
    RigidBodyVelocity velocity;
    velocity.where = record.where;
    velocity.part = reading.find_body(record.integer("PID"));
    velocity.translation = to_global(record, block, vector_of(record, "VX", "VY", "VZ"), reading);
    velocity.angular_velocity = to_global(record, block, vector_of(record, "VXR", "VYR", "VZR"), reading);
    if (velocity.part != none) reading.model.rigid_body_velocities.push_back(velocity);
}

void read_beam_preload(const Record& record, const Block&, Reading& reading)
{
    BeamPreload preload;
    preload.where = record.where;
    const Index set = reading.find(record, "BSID", Kind::beam_set);
    if (set != none) preload.beams = reading.model.beam_sets[set].elements;
    preload.curve = reading.find(record, "LCID", Kind::curve);
    if (record.integer("LCID") == 0) reading.error(record, "LCID", "a preload needs a curve of its force");
    preload.scale = record.real("SCALE", 1);
    if (preload.scale == 0) preload.scale = 1; // an empty field
    const Id bending = record.integer("KBEND");
    if (bending != 0 && bending != 1) {
        reading.error(record, "KBEND",
                      fmt::format("{} is not supported (0: bending is free under the preload, 1: it is kept)",
                                  bending));
    }
    preload.keeps_bending = bending == 1;
    reading.model.beam_preloads.push_back(std::move(preload));
}

/// Stays a record; its point moves with its include.
void read_detonation(const Record& record, const Block& block, Reading& reading)
{
    Record placed = record;
    const Vec3 point = reading.motion_of(block).point(vector_of(record, "X", "Y", "Z"));
    for (Record::Field& field : placed.fields) {
        if (field.name == "X") field.value = point.x;
        if (field.name == "Y") field.value = point.y;
        if (field.name == "Z") field.value = point.z;
    }
    reading.model.others.push_back(std::move(placed));
}

constexpr Translator initial_table[] = {
    {"INITIAL_AXIAL_FORCE_BEAM", Phase::conditions, read_beam_preload},
    {"INITIAL_DETONATION", Phase::conditions, read_detonation},
    {"INITIAL_VELOCITY", Phase::conditions, read_velocity},
    {"INITIAL_VELOCITY_NODE", Phase::conditions, read_node_velocity},
    {"INITIAL_VELOCITY_GENERATION", Phase::conditions, read_generation},
    {"INITIAL_VELOCITY_RIGID_BODY", Phase::conditions, read_rigid_body_velocity},
};

} // namespace

std::span<const Translator> initial_keywords()
{
    return initial_table;
}

} // namespace plash

#include "ale/fluid_fields.h"

namespace plash {

FluidFields::FluidFields(std::size_t cells, std::size_t nodes, int group_count, bool mixed, bool viscous_flow)
    : groups(group_count)
{
    for (GroupFields& group : groups) {
        group.mass.resize(cells);
        group.energy.resize(cells);
        if (!mixed) continue;
        group.fraction.resize(cells);
        group.share.resize(cells);
        for (auto& side : group.share_of_outflow) side.resize(cells);
    }
    if (group_count > 1) mass_of_groups.resize(cells);
    for (int axis = 0; axis < 3; ++axis) {
        velocity[axis].resize(nodes);
        mean_velocity[axis].resize(nodes);
    }
    pressure.resize(cells);
    pressure_rate.resize(cells);
    node_mass.resize(nodes);
    volume.assign(cells, 1.0); // places beyond the mesh keep a volume, so that nobody divides by zero
    if (viscous_flow) {
        for (auto& component : viscous) component.resize(cells);
    }
}

void FluidFields::serialise(Archive& archive)
{
    for (GroupFields& group : groups) archive(group.mass, group.energy, group.fraction, group.share);
    archive(velocity, pressure, pressure_rate, viscous, node_mass, mean_velocity, volume, mass_of_groups);
}

} // namespace plash

#pragma once

#include "core/archive.h"
#include "math/aligned.h"

#include <array>
#include <cstddef>
#include <vector>

namespace plash {

/// What one group of material (*ALE_MULTI-MATERIAL_GROUP) has in every cell.
struct GroupFields {
    AlignedDoubles mass;   ///< [mass]
    AlignedDoubles energy; ///< internal [energy]
    /// Only in meshes where a cell may hold something else as well:
    AlignedDoubles fraction; ///< share of the cell's volume; above 1 beside dry faces (ale/fluid.h) [-]
    AlignedDoubles share;    ///< share that the group takes of a change of the cell's volume [-]
    /// Share of the group in what leaves a cell through its lower and its upper face of the present sweep
    /// [-]; set where the cell holds an interface.
    std::array<AlignedDoubles, 2> share_of_outflow;
};

/// All arrays of a fluid over the places of the cells and the nodes of its mesh.
struct FluidFields {
    std::vector<GroupFields> groups;
    std::array<AlignedDoubles, 3> velocity; ///< of nodes [velocity]

    /// At t_n, of the cell as a whole: pressure with bulk viscosity [pressure], and its rate of change for
    /// the present motion, -K div v [pressure/time].
    AlignedDoubles pressure, pressure_rate;
    /// Viscous stress xx yy zz xy yz zx [stress]; empty without viscosity.
    std::array<AlignedDoubles, 6> viscous;

    /// Within a step: mass of nodes [mass], their mean velocity over the step, volume of the cells as they
    /// are swept.
    AlignedDoubles node_mass;
    std::array<AlignedDoubles, 3> mean_velocity;
    AlignedDoubles volume;
    /// On a box, volume and mass that pass the lower face of a cell along each axis.
    std::array<AlignedDoubles, 3> volume_flux, mass_flux;

    /// Kinetic energy of nodes that the remap has taken in this step [energy]; empty unless it is to become
    /// heat.
    AlignedDoubles lost_motion;

    /// Mass of all groups; the same array as groups[0].mass when there is but one group.
    AlignedDoubles mass_of_groups;
    const AlignedDoubles& total_mass() const { return groups.size() == 1 ? groups[0].mass : mass_of_groups; }

    /// mixed  a cell may be partly empty or hold several groups
    FluidFields(std::size_t cells, std::size_t nodes, int group_count, bool mixed, bool viscous_flow);

    /// All that a step does not make anew.
    void serialise(Archive& archive);
};

} // namespace plash

#pragma once

#include "ale/box_grid.h"
#include "math/aligned.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plash {

/// What one group of material (*ALE_MULTI-MATERIAL_GROUP) has in every cell.
struct GroupFields {
    AlignedDoubles mass;   ///< [mass]
    AlignedDoubles energy; ///< internal [energy]
    /// Only in boxes where a cell may hold something else as well:
    AlignedDoubles fraction; ///< share of the cell's volume [-]
    AlignedDoubles share;    ///< share that the group takes of a change of the cell's volume [-]
    /// Share of the group in what leaves a cell through its lower and its upper face of the present sweep
    /// [-]; set where the cell holds an interface.
    std::array<AlignedDoubles, 2> share_of_outflow;
};

/// All arrays of a box: cells and nodes in the numbering of BoxGrid. Ghost cells have no mass.
struct BoxFields {
    std::vector<GroupFields> groups;
    std::array<AlignedDoubles, 3> velocity; ///< of nodes [velocity]

    /// At t_n, of the cell as a whole: pressure with bulk viscosity [pressure], and its rate of change for
    /// the present motion, -K div v [pressure/time].
    AlignedDoubles pressure, pressure_rate;
    /// Viscous stress xx yy zz xy yz zx [stress]; empty without viscosity.
    std::array<AlignedDoubles, 6> viscous;

    /// Within a step: mass of nodes [mass], their mean velocity over the step, volume of the cells as they
    /// are swept, and volume and mass that pass the lower face of a cell along each axis.
    AlignedDoubles node_mass;
    std::array<AlignedDoubles, 3> mean_velocity;
    AlignedDoubles volume;
    std::array<AlignedDoubles, 3> volume_flux, mass_flux;

    /// Kinetic energy of nodes that the remap has taken in this step [energy]; empty unless it is to become
    /// heat.
    AlignedDoubles lost_motion;

    /// Mass of all groups; the same array as groups[0].mass when there is but one group.
    AlignedDoubles mass_of_groups;
    const AlignedDoubles& total_mass() const { return groups.size() == 1 ? groups[0].mass : mass_of_groups; }

    /// mixed  a cell may be partly empty or hold several groups
    BoxFields(const BoxGrid& grid, int group_count, bool mixed, bool viscous_flow);
};

/// Gives the innermost ghosts the fractions of the cells beside them.
void mirror_fractions(const BoxGrid& grid, BoxFields& fields);

/// What stands in the neighbourhood of each batch of cells, so that void is skipped and cells that are full
/// of one group are spared the work that interfaces need. One entry a batch of lane_count storage places.
class BoxContents {
public:
    using Mask = std::uint16_t;
    static constexpr Mask empty_space = 0x8000; ///< some cell is not full; the lower bits stand for groups

    BoxContents(const BoxGrid& grid, bool mixed);

    /// Is one group, full cells, all over the box for ever; then the masks are constant.
    bool always_full() const { return !mixed_; }
    /// Looks at all fractions anew. Call after every sweep.
    void update(const BoxGrid& grid, const BoxFields& fields);

    /// Groups and empty space in the batch at a storage place and up to two cells around it.
    Mask near_cells(std::ptrdiff_t place) const { return near_cells_[place / lane_count]; }
    /// The same around the cells that touch the nodes of the batch.
    Mask near_nodes(std::ptrdiff_t place) const { return near_nodes_[place / lane_count]; }
    Mask of_cells(std::ptrdiff_t place) const { return own_[place / lane_count]; }

    /// Full of one and the same group.
    static bool pure(Mask mask) { return (mask & (mask - 1)) == 0 && mask != empty_space && mask != 0; }
    static bool nothing(Mask mask) { return (mask & ~empty_space) == 0; }
    static int only_group(Mask mask) { return __builtin_ctz(mask); }

private:
    bool mixed_;
    std::vector<Mask> own_, near_cells_, near_nodes_, along_rows_;

    void dilate(const BoxGrid& grid);
};

} // namespace plash

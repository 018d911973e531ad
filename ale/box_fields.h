#pragma once

#include "ale/box_grid.h"
#include "ale/fluid_fields.h"

#include <cstdint>
#include <vector>

namespace plash {

/// Arrays of a box: cells and nodes in the numbering of BoxGrid. Ghost cells have no mass.
/// mixed  a cell may be partly empty or hold several groups
FluidFields box_fields(const BoxGrid& grid, int group_count, bool mixed, bool viscous_flow);

/// Gives the innermost ghosts the fractions of the cells beside them.
void mirror_fractions(const BoxGrid& grid, FluidFields& fields);

/// What stands in the neighbourhood of each batch of cells, so that void is skipped and cells that are full
/// of one group are spared the work that interfaces need. One entry a batch of lane_count storage places.
class BoxContents {
public:
    using Mask = std::uint16_t;
    /// Some cell is not just full of one group; the lower bits stand for groups.
    static constexpr Mask empty_space = 0x8000;

    BoxContents(const BoxGrid& grid, bool mixed);

    /// Is one group, full cells, all over the box for ever; then the masks are constant.
    bool always_full() const { return !mixed_; }
    /// Looks at all fractions anew. Call after every sweep.
    void update(const BoxGrid& grid, const FluidFields& fields);

    /// Groups and empty space in the batch at a storage place and up to two cells around it.
    Mask near_cells(std::ptrdiff_t place) const { return near_cells_[place / lane_count]; }
    /// The same around the cells that touch the nodes of the batch.
    Mask near_nodes(std::ptrdiff_t place) const { return near_nodes_[place / lane_count]; }
    Mask of_cells(std::ptrdiff_t place) const { return own_[place / lane_count]; }

    void serialise(Archive& archive) { archive(own_, near_cells_, near_nodes_); }

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

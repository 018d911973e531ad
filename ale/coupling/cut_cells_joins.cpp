#include "ale/coupling/cut_cells.h"

/// Parts of cells that have joined a neighbour.
namespace plash {

namespace {

/// Less of a cell than this is round-off.
constexpr double no_share = 1e-14;

} // namespace

/// Joins a small part to the larger one behind its widest open face.
void CutCells::join(Index number, const BoxCuts& cuts)
{
    double widest = 0;
    std::array<int, 3> to{};
    for (int side = 0; side < 6; ++side) {
        const Cell& cell = cells_[number];
        const std::array<int, 3> index = beyond(cell, side);
        if (!in_box(index)) continue;
        std::array<int, 3> face = cell.index;
        face[side / 2] += side % 2;
        const double open = cuts.face(side / 2, face[0], face[1], face[2]).open;
        if (open <= widest + 1e-9 || cuts.open_share(index[0], index[1], index[2]) <=
                                         cuts.open_share(cell.index[0], cell.index[1], cell.index[2]))
            continue;
        widest = open;
        to = index;
        cells_[number].to_parent = side;
    }
    if (widest == 0) return;
    const Index parent = add_cell(to, cuts_->open_share(to[0], to[1], to[2]));
    cells_[number].parent = parent;
}

/// Cells that the surface has covered in the last step.
void CutCells::find_covered()
{
    covered_.clear();
    for (const Cell& cell : cells_)
        if (cell.parent != none && cell.next == 0) covered_.push_back({cell.index, cell.to_parent});
}

/// What is left in a covered cell, as what others give and take was known only nearly, goes on to the part
/// that it had joined.
void CutCells::join_covered()
{
    for (const Covered& covered : covered_) {
        const auto [i, j, k] = covered.index;
        if (cuts_->open_share(i, j, k) > 0 || filled_share(fluid_.grid.at(i, j, k)) < no_share) continue;
        const Index number = add_cell(covered.index, 0);
        if (cells_[number].parent != none) continue;
        const std::array<int, 3> to = beyond(cells_[number], covered.to_parent);
        const Index parent = add_cell(to, cuts_->open_share(to[0], to[1], to[2]));
        cells_[number].parent = parent;
        cells_[number].to_parent = covered.to_parent;
    }
}

Index CutCells::root(Index cell) const
{
    while (cells_[cell].parent != none) cell = cells_[cell].parent;
    return cell;
}

void CutCells::serialise(Archive& archive)
{
    if (!archive.loading()) find_covered();
    archive(covered_);
}

} // namespace plash

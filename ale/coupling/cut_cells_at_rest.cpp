#include "ale/coupling/cut_cells.h"

#include <algorithm>
#include <cmath>

/// Fluid at rest in the cells that a surface cuts.
namespace plash {

/// Cells that the surface cuts, and those beside them, which it may come to cut.
void CutCells::keep_resting(const BoxCuts& cuts)
{
    std::vector<std::array<int, 3>> near;
    for (const BoxCuts::Cell& cut : cuts.cells()) {
        near.push_back(cut.index);
        for (int side = 0; side < 6; ++side) {
            near.push_back(cut.index);
            near.back()[side / 2] += side % 2 == 0 ? -1 : 1;
        }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::array<int, 3>& index : near) {
        if (!in_box(index)) continue;
        const std::ptrdiff_t place = fluid_.grid.at(index[0], index[1], index[2]);
        const double open = cuts.open_share(index[0], index[1], index[2]);
        if (!(open > 0 && fluid_.fields.total_mass()[place] > 0)) continue;
        Resting cell{index, open, {}};
        for (const GroupFields& own : fluid_.fields.groups)
            cell.fluids.push_back({own.mass[place], own.energy[place], own.fraction[place]});
        resting_.push_back(std::move(cell));
    }
}

void CutCells::fill(std::ptrdiff_t place, int fluid, const Filling& filling)
{
    FluidFields& fields = fluid_.fields;
    GroupFields& own = fields.groups[fluid];
    if (fluid_count() > 1) fields.mass_of_groups[place] += filling.mass - own.mass[place];
    own.mass[place] = filling.mass;
    own.energy[place] = filling.energy;
    own.fraction[place] = std::min(filling.fraction, 1.0);
}

double CutCells::filled_share(std::ptrdiff_t place) const
{
    double sum = 0;
    for (const GroupFields& own : fluid_.fields.groups) sum += own.fraction[place];
    return sum;
}

/// Parts that stand open to fluid and have none, as the deck's filling or a surface that has gone a little
/// way leaves them, are filled as the rest of their group. Returns the largest, as a share of a cell.
double CutCells::fill_slivers(const BoxCuts& cuts)
{
    begin(cuts);
    std::vector<double> room(groups_.size());
    for (const Cell& cell : cells_)
        if (filled_share(cell.place) > 0) room[cell.group] += cell.open * cell.volume;
    double largest = 0;
    for (const Cell& cell : cells_) {
        if (cell.parent == none || !(cell.open > 0 && room[cell.group] > 0) || filled_share(cell.place) > 0)
            continue;
        const double part = cell.open * cell.volume / room[cell.group];
        for (int g = 0; g < fluid_count(); ++g) {
            const Content& own = content(cell.group, g);
            fill(cell.place, g, {part * own.mass, part * own.energy, part * own.volume / cell.volume});
        }
        largest = std::max(largest, cell.open);
        slivers_.push_back(cell.place);
    }
    clear();
    return largest;
}

void CutCells::fill_at_rest(const BoxCuts& cuts)
{
    if (resting_.empty()) keep_resting(cuts);
    for (const std::ptrdiff_t place : slivers_)
        for (int g = 0; g < fluid_count(); ++g) fill(place, g, {0, 0, 0});
    slivers_.clear();
    for (const Resting& cell : resting_) {
        const std::ptrdiff_t place = fluid_.grid.at(cell.index[0], cell.index[1], cell.index[2]);
        const double ratio = cuts.open_share(cell.index[0], cell.index[1], cell.index[2]) / cell.open;
        for (int g = 0; g < fluid_count(); ++g) {
            const Filling& own = cell.fluids[g];
            fill(place, g, {ratio * own.mass, ratio * own.energy, ratio * own.fraction});
        }
    }
    fill_slivers(cuts);
}

double CutCells::fill_wet_parts(const BoxCuts& cuts, const StillLevel& level)
{
    double largest = 0;
    for (const BoxCuts::Cell& cut : cuts.cells()) {
        const auto [i, j, k] = cut.index;
        const std::ptrdiff_t place = fluid_.grid.at(i, j, k);
        const double filled = filled_share(place);
        if (!(filled > 0)) continue;
        const std::size_t number = i + fluid_.grid.cells(0) * (j + std::size_t(fluid_.grid.cells(1)) * k);
        const double wet = cut.open * level.wet_share(fluid_.cell(number)), ratio = wet / filled;
        largest = std::max(largest, std::abs(wet - filled));
        for (int g = 0; g < fluid_count(); ++g) {
            const GroupFields& own = fluid_.fields.groups[g];
            fill(place, g, {ratio * own.mass[place], ratio * own.energy[place], ratio * own.fraction[place]});
        }
    }
    fluid_.contents.update(fluid_.grid, fluid_.fields);
    largest = std::max(largest, fill_slivers(cuts));
    slivers_.clear();   // from now on they are as all others
    held_axes_.clear(); // not known yet
    return largest;
}

} // namespace plash

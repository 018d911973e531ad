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

void CutCells::fill_at_rest(const BoxCuts& cuts)
{
    if (resting_.empty()) keep_resting(cuts);
    for (const Resting& cell : resting_) {
        const std::ptrdiff_t place = fluid_.grid.at(cell.index[0], cell.index[1], cell.index[2]);
        const double ratio = cuts.open_share(cell.index[0], cell.index[1], cell.index[2]) / cell.open;
        for (int g = 0; g < fluid_count(); ++g) {
            const Filling& own = cell.fluids[g];
            fill(place, g, {ratio * own.mass, ratio * own.energy, ratio * own.fraction});
        }
    }
}

double CutCells::fill_wet_parts(const BoxCuts& cuts, const StillLevel& level)
{
    double largest = 0;
    const auto wet_part = [&](const std::array<int, 3>& index, double open) {
        const auto [i, j, k] = index;
        const std::size_t number = i + fluid_.grid.cells(0) * (j + std::size_t(fluid_.grid.cells(1)) * k);
        return open * level.wet_share(fluid_.cell(number));
    };
    for (const BoxCuts::Cell& cut : cuts.cells()) {
        const std::ptrdiff_t place = fluid_.grid.at(cut.index[0], cut.index[1], cut.index[2]);
        const double filled = filled_share(place);
        if (!(filled > 0)) continue;
        const double wet = wet_part(cut.index, cut.open), ratio = wet / filled;
        largest = std::max(largest, std::abs(wet - filled));
        for (int g = 0; g < fluid_count(); ++g) {
            const GroupFields& own = fluid_.fields.groups[g];
            fill(place, g, {ratio * own.mass[place], ratio * own.energy[place], ratio * own.fraction[place]});
        }
    }
    // Slivers behind what the deck has filled stand open to it and are its own.
    fluid_.contents.update(fluid_.grid, fluid_.fields);
    begin(cuts);
    for (const Cell& cell : cells_) {
        if (cell.parent == none || filled_share(cell.place) > 0) continue;
        const double wet = wet_part(cell.index, cell.open);
        double sum = 0;
        for (int g = 0; g < fluid_count(); ++g) sum += content(cell.group, g).volume;
        if (!(sum > 0)) continue;
        largest = std::max(largest, wet);
        for (int g = 0; g < fluid_count(); ++g) {
            const Content& own = content(cell.group, g);
            const double per_volume = own.volume > 0 ? wet * cell.volume / sum : 0;
            fill(cell.place, g,
                 {per_volume * own.mass, per_volume * own.energy, per_volume * own.volume / cell.volume});
        }
    }
    clear();
    held_axes_.clear(); // not known yet
    return largest;
}

} // namespace plash

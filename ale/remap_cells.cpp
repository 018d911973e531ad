#include "ale/cell_flux.h"
#include "ale/remap.h"
#include "ale/sheets.h"

#include <algorithm>
#include <omp.h>

namespace plash {

namespace {

constexpr int ring_length = 5; // rows r - 2 to r + 1 around a face, and the one that is being filled

/// What a sweep needs to know of the cells of one row, for each group.
enum GroupValue { density, energy, mass, inverse_mass, volume, group_values };
enum FluxValue { volume_flux, mass_flux, energy_flux, flux_values };

/// Sweep of one sheet: rows that follow one another along the axis, or, along the first axis, rows for
/// themselves.
template <bool second_order>
class CellSweep {
public:
    CellSweep(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, RemapScratch& scratch,
              int axis)
        : grid_(grid),
          fields_(fields),
          contents_(contents),
          scratch_(scratch),
          axis_(axis),
          groups_(static_cast<int>(fields.groups.size()))
    {}

    /// A row at `place` by itself, along the first axis.
    void along_row(std::ptrdiff_t place)
    {
        const int batches = grid_.cell_batches(), cells = grid_.cells(0);
        if (nothing_in(place, 0, grid_.node_batches()))
            return clear_mass_flux(place, 0, grid_.node_batches());
        fill(0, place, 0, batches);
        for (int value = 0; value < values_in_row(); ++value) {
            double* row = scratch_.row(value);
            row[-2] = row[-1] = row[0];
            row[cells] = row[cells + 1] = row[cells - 1];
        }
        for (int batch = 0; batch < grid_.node_batches(); ++batch) {
            const int i = batch * lane_count;
            const Rows rows{{0, 0, 0, 0}, {i - 2, i - 1, i, i + 1}};
            const double* lower = grid_.cell_weights(0, false);
            const double* upper = grid_.cell_weights(0, true);
            const LineWeights<Lanes> weights{load<Lanes>(lower + i - 1), load<Lanes>(upper + i - 1),
                                             load<Lanes>(lower + i), load<Lanes>(upper + i)};
            face_batch(0, rows, place + i, i, weights, contents_.near_cells(place + i));
        }
        for (int batch = 0; batch < batches; ++batch) {
            const int i = batch * lane_count;
            update_batch(place + i, {0, i}, {0, i + 1});
        }
        empty_ghosts(place, cells, batches * lane_count);
    }

    /// Batches [first, last) of the rows at place, place + stride ... along another axis.
    void across_rows(std::ptrdiff_t place, int first, int last)
    {
        const int rows = grid_.cells(axis_);
        const std::ptrdiff_t stride = grid_.stride(axis_);
        const auto slot = [&](int row) { return std::clamp(row, 0, rows - 1) % ring_length; };
        fill(slot(0), place, first, last);
        const double* lower = grid_.cell_weights(axis_, false);
        const double* upper = grid_.cell_weights(axis_, true);
        for (int row = 0; row <= rows; ++row) {
            if (row + 1 < rows) fill(slot(row + 1), place + (row + 1) * stride, first, last);
            const LineWeights<Lanes> weights{broadcast<Lanes>(lower[row - 1]),
                                             broadcast<Lanes>(upper[row - 1]), broadcast<Lanes>(lower[row]),
                                             broadcast<Lanes>(upper[row])};
            const std::ptrdiff_t beside = place + std::min(row, rows - 1) * stride;
            for (int batch = first; batch < last; ++batch) {
                const int i = batch * lane_count;
                const Rows near{{slot(row - 2), slot(row - 1), slot(row), slot(row + 1)}, {i, i, i, i}};
                face_batch(row % 2, near, place + row * stride + i, i, weights,
                           contents_.near_cells(beside + i));
            }
            if (row == 0) continue;
            for (int batch = first; batch < last; ++batch) {
                const int i = batch * lane_count;
                update_batch(place + (row - 1) * stride + i, {(row - 1) % 2, i}, {row % 2, i});
            }
        }
    }

private:
    /// Where the four cells of a line lie: slot of the ring and place in its rows.
    struct Rows {
        int slot[4];
        int i[4];
    };
    /// Where a flux lies: which of the two flux rows and place in it.
    struct FluxPlace {
        int slot, i;
    };

    const BoxGrid& grid_;
    FluidFields& fields_;
    const BoxContents& contents_;
    RemapScratch& scratch_;
    int axis_, groups_;

    int values_in_row() const { return 1 + group_values * groups_; }
    double* inverse_volume(int slot) { return scratch_.row(slot * values_in_row()); }
    double* cell_row(int slot, int group, GroupValue value)
    {
        return scratch_.row(slot * values_in_row() + 1 + group * group_values + value);
    }
    double* flux_row(int slot, int group, FluxValue value)
    {
        return scratch_.row(ring_length * values_in_row() + (slot * groups_ + group) * flux_values + value);
    }

    bool nothing_in(std::ptrdiff_t place, int first, int last) const
    {
        BoxContents::Mask mask = 0;
        for (int batch = first; batch < last; ++batch)
            mask |= contents_.near_cells(place + batch * lane_count);
        return BoxContents::nothing(mask);
    }

    void clear_mass_flux(std::ptrdiff_t place, int first, int last)
    {
        std::fill_n(&fields_.mass_flux[axis_][place + first * lane_count], (last - first) * lane_count, 0.0);
    }

    /// What flows out at the end of a row must not stay in the ghosts that its last batch holds as well.
    void empty_ghosts(std::ptrdiff_t place, int first, int last)
    {
        for (GroupFields& group : fields_.groups) {
            for (AlignedDoubles* values : {&group.mass, &group.energy, &group.fraction})
                if (!values->empty()) std::fill(&(*values)[place + first], &(*values)[place + last], 0.0);
        }
        if (groups_ > 1)
            std::fill(&fields_.mass_of_groups[place + first], &fields_.mass_of_groups[place + last], 0.0);
    }

    /// Reads a row of cells into a slot of the ring.
    void fill(int slot, std::ptrdiff_t place, int first, int last)
    {
        for (int batch = first; batch < last; ++batch) {
            const int i = batch * lane_count;
            const Lanes cell_volume = load<Lanes>(&fields_.volume[place + i]);
            const Lanes inverse = 1.0 / cell_volume;
            store(inverse_volume(slot) + i, inverse);
            const bool full = contents_.always_full();
            for (int group = 0; group < groups_; ++group) {
                const GroupFields& own = fields_.groups[group];
                const Lanes own_mass = load<Lanes>(&own.mass[place + i]);
                const auto has = own_mass > 0.0;
                const Lanes per_mass = has ? 1.0 / own_mass : Lanes{};
                const Lanes fraction = full ? broadcast<Lanes>(1) : load<Lanes>(&own.fraction[place + i]);
                const Lanes per_volume = full ? inverse : inverse / (has ? fraction : broadcast<Lanes>(1));
                store(cell_row(slot, group, density) + i, own_mass * per_volume);
                store(cell_row(slot, group, energy) + i, load<Lanes>(&own.energy[place + i]) * per_mass);
                store(cell_row(slot, group, mass) + i, own_mass);
                store(cell_row(slot, group, inverse_mass) + i, per_mass);
                store(cell_row(slot, group, volume) + i, fraction * cell_volume);
            }
        }
    }

    Line<Lanes> line(const Rows& rows, int group, GroupValue value)
    {
        const auto at = [&](int cell) {
            return load<Lanes>(cell_row(rows.slot[cell], group, value) + rows.i[cell]);
        };
        return {at(0), at(1), at(2), at(3)};
    }

    void store_flux(int slot, int group, int i, Lanes of_volume, Lanes of_mass, Lanes of_energy)
    {
        store(flux_row(slot, group, volume_flux) + i, of_volume);
        store(flux_row(slot, group, mass_flux) + i, of_mass);
        store(flux_row(slot, group, energy_flux) + i, of_energy);
    }

    /// Fluxes through the lower faces of the cells of a batch, with what stands around them.
    void face_batch(int slot, const Rows& rows, std::ptrdiff_t place, int i,
                    const LineWeights<Lanes>& weights, BoxContents::Mask mask)
    {
        Lanes total{};
        if (BoxContents::pure(mask)) {
            const int only = BoxContents::only_group(mask);
            for (int group = 0; group < groups_; ++group) {
                if (group == only)
                    total = full_face(slot, only, rows, place, i, weights);
                else
                    store_flux(slot, group, i, Lanes{}, Lanes{}, Lanes{});
            }
        } else {
            for (int group = 0; group < groups_; ++group) {
                if (mask & (1u << group))
                    total += partial_face(slot, group, rows, place, i, weights);
                else
                    store_flux(slot, group, i, Lanes{}, Lanes{}, Lanes{});
            }
        }
        store(&fields_.mass_flux[axis_][place], total);
    }

    /// All cells around are full of one group.
    Lanes full_face(int slot, int group, const Rows& rows, std::ptrdiff_t place, int i,
                    const LineWeights<Lanes>& weights)
    {
        const Lanes flux = load<Lanes>(&fields_.volume_flux[axis_][place]);
        const auto upward = flux > 0.0;
        const Lanes below = load<Lanes>(inverse_volume(rows.slot[1]) + rows.i[1]);
        const Lanes above = load<Lanes>(inverse_volume(rows.slot[2]) + rows.i[2]);
        const Lanes part = abs(flux) * (upward ? below : above);
        const Lanes of_mass =
            flux * carried_value<second_order>(line(rows, group, density), upward, part, weights);
        const Line<Lanes> reciprocal = line(rows, group, inverse_mass);
        const Lanes mass_part = abs(of_mass) * (upward ? reciprocal.below : reciprocal.above);
        const Lanes of_energy =
            of_mass * carried_value<second_order>(line(rows, group, energy), upward, mass_part, weights);
        store_flux(slot, group, i, flux, of_mass, of_energy);
        return of_mass;
    }

    /// Some cell around is not full of this group.
    Lanes partial_face(int slot, int group, const Rows& rows, std::ptrdiff_t place, int i,
                       const LineWeights<Lanes>& weights)
    {
        const GroupFields& own = fields_.groups[group];
        const std::ptrdiff_t stride = grid_.stride(axis_);
        const Lanes flux = load<Lanes>(&fields_.volume_flux[axis_][place]);
        const auto upward = flux > 0.0;
        const Lanes fraction =
            upward ? load<Lanes>(&own.fraction[place - stride]) : load<Lanes>(&own.fraction[place]);
        const Lanes cut = upward ? load<Lanes>(&own.share_of_outflow[1][place - stride])
                                 : load<Lanes>(&own.share_of_outflow[0][place]);
        const Line<Lanes> volumes = line(rows, group, volume);
        const GroupLine<Lanes> lines{line(rows, group, density),
                                     line(rows, group, energy),
                                     line(rows, group, mass),
                                     line(rows, group, inverse_mass),
                                     volumes.below,
                                     volumes.above};
        const GroupFlux<Lanes> passing = partial_flux<second_order>(lines, flux, fraction, cut, weights);
        store_flux(slot, group, i, passing.volume, passing.mass, passing.energy);
        return passing.mass;
    }

    void update_batch(std::ptrdiff_t place, FluxPlace low, FluxPlace high)
    {
        const BoxContents::Mask mask = contents_.near_cells(place);
        if (BoxContents::nothing(mask)) return;
        const std::ptrdiff_t stride = grid_.stride(axis_);
        const Lanes before = load<Lanes>(&fields_.volume[place]);
        const Lanes after = before + (load<Lanes>(&fields_.volume_flux[axis_][place]) -
                                      load<Lanes>(&fields_.volume_flux[axis_][place + stride]));
        store(&fields_.volume[place], after);
        const auto gain = [&](int group, FluxValue value) {
            return load<Lanes>(flux_row(low.slot, group, value) + low.i) -
                   load<Lanes>(flux_row(high.slot, group, value) + high.i);
        };
        const bool pure = BoxContents::pure(mask);
        Lanes total{};
        for (int group = 0; group < groups_; ++group) {
            if (!(mask & (1u << group))) continue;
            GroupFields& own = fields_.groups[group];
            const Lanes own_mass = load<Lanes>(&own.mass[place]) + gain(group, mass_flux);
            const Lanes own_energy = load<Lanes>(&own.energy[place]) + gain(group, energy_flux);
            if (pure) {
                store(&own.mass[place], own_mass);
                store(&own.energy[place], own_energy);
                total += own_mass;
                continue;
            }
            const Lanes old_fraction = load<Lanes>(&own.fraction[place]);
            const Lanes own_volume = old_fraction * before + gain(group, volume_flux);
            // Round-off of what should be nothing, or full.
            const auto has = (own_mass > 0.0) & (own_volume > 1e-14 * after);
            const Lanes fraction = own_volume / after;
            store(&own.mass[place], has ? own_mass : Lanes{});
            store(&own.energy[place], has ? own_energy : Lanes{});
            store(&own.fraction[place], has ? settled_fraction(old_fraction, fraction) : Lanes{});
            total += has ? own_mass : Lanes{};
        }
        if (groups_ > 1) store(&fields_.mass_of_groups[place], total);
    }
};

template <bool second_order>
void sweep(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, RemapScratch& scratch,
           int axis)
{
    CellSweep<second_order> cells(grid, fields, contents, scratch, axis);
    if (axis == 0) {
        for_sheets(grid, grid.cells(2), [&](int k) {
            for (int j = 0; j < grid.cells(1); ++j) cells.along_row(grid.at(0, j, k));
        });
    } else if (axis == 1) {
        for_sheets(grid, grid.cells(2),
                   [&](int k) { cells.across_rows(grid.at(0, 0, k), 0, grid.cell_batches()); });
    } else {
        // Sheets of limited length, so that a box of a single row in y still feeds all threads.
        constexpr int length = 16;
        const int pieces = (grid.cell_batches() + length - 1) / length;
        for_sheets(grid, grid.cells(1) * pieces, [&](int sheet) {
            const int first = sheet % pieces * length;
            cells.across_rows(grid.at(0, sheet / pieces, 0), first,
                              std::min(first + length, grid.cell_batches()));
        });
    }
}

} // namespace

RemapScratch::RemapScratch(const BoxGrid& grid, int group_count)
    : row_length_(static_cast<int>(grid.stride(1)) + 2 * lane_count), rows_(omp_get_max_threads())
{
    const int rows = ring_length * (1 + group_values * group_count) + 2 * flux_values * group_count;
    for (AlignedDoubles& row : rows_) row.resize(std::size_t(std::max(rows, 16)) * row_length_ + lane_count);
}

int RemapScratch::thread()
{
    return omp_get_thread_num();
}

void sweep_cells(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, RemapScratch& scratch,
                 int axis, AdvectionOrder order)
{
    if (order == AdvectionOrder::van_leer)
        sweep<true>(grid, fields, contents, scratch, axis);
    else
        sweep<false>(grid, fields, contents, scratch, axis);
}

} // namespace plash

#include "ale/cell_motion.h"
#include "ale/cell_state.h"
#include "ale/sheets.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

/// One row of cells and what the loop over its batches needs.
struct Row {
    const BoxGrid& grid;
    FluidFields& fields;
    std::span<const FluidGroup> groups;
    const LagrangeSettings& settings;
    int j, k;

    double width_y() const { return grid.width(1, j); }
    double width_z() const { return grid.width(2, k); }
};

/// Largest rate so far, and where, lane by lane.
struct LaneRates {
    Lanes rate{}, place{};

    void take(Lanes candidate, Lanes where)
    {
        const auto larger = candidate > rate;
        rate = larger ? candidate : rate;
        place = larger ? where : place;
    }
};

/// Sum of the fractions of all groups at a storage place.
Lanes filled_at(const FluidFields& fields, std::ptrdiff_t place)
{
    Lanes sum{};
    for (const GroupFields& group : fields.groups) sum += load<Lanes>(&group.fraction[place]);
    return sum;
}

Lanes openness_at(const Row& row, std::ptrdiff_t place)
{
    Lanes below[3], above[3];
    for (int axis = 0; axis < 3; ++axis) {
        below[axis] = filled_at(row.fields, place - row.grid.stride(axis));
        above[axis] = filled_at(row.fields, place + row.grid.stride(axis));
    }
    return openness(filled_at(row.fields, place), below, above);
}

/// Leaves openness in the place of group 0's share for evaluate_row, which changes fractions.
void find_openness(const Row& row, const BoxContents& contents)
{
    for (int batch = 0; batch < row.grid.cell_batches(); ++batch) {
        const std::ptrdiff_t place = row.grid.at(batch * lane_count, row.j, row.k);
        const BoxContents::Mask mask = contents.of_cells(place);
        if (BoxContents::nothing(mask) || BoxContents::pure(mask)) continue;
        store(&row.fields.groups[0].share[place], openness_at(row, place));
    }
}

/// Full cells whose pressure has fallen below what the liquid bears.
bool any_torn(const Row& row, int group, const CellState<Lanes>& state)
{
    return row.settings.void_allowed &&
           any((state.pressure < row.groups[group].tension_limit) & (state.density > 0.0));
}

template <bool Viscous>
LaneRates evaluate_row(const Row& row, const BoxContents& contents, double last_step, bool& torn)
{
    const BoxGrid& grid = row.grid;
    FluidFields& fields = row.fields;
    const LagrangeSettings& settings = row.settings;
    const std::ptrdiff_t sy = grid.stride(1), sz = grid.stride(2);
    const double width_yz = row.width_y() * row.width_z();
    const double inverse_y = 0.25 / row.width_y(), inverse_z = 0.25 / row.width_z();
    const double smallest_yz = std::min(row.width_y(), row.width_z());
    const double viscosity = Viscous ? largest_kinematic_viscosity(row.groups) : 0;
    LaneRates rates;
    for (int batch = 0; batch < grid.cell_batches(); ++batch) {
        const std::ptrdiff_t place = grid.at(batch * lane_count, row.j, row.k);
        if (BoxContents::nothing(contents.near_cells(place))) continue;
        const Lanes width = load<Lanes>(grid.widths(0) + batch * lane_count);
        const Lanes volume = width * width_yz;
        const double* v[3] = {&fields.velocity[0][place], &fields.velocity[1][place],
                              &fields.velocity[2][place]};
        const auto x = face_sums<Lanes>(v[0], 1, sy, sz);
        const auto y = face_sums<Lanes>(v[1], sy, 1, sz);
        const auto z = face_sums<Lanes>(v[2], sz, 1, sy);
        const Lanes inverse_x = 0.25 / width;
        const Lanes rate_x = (x.high - x.low) * inverse_x, rate_y = (y.high - y.low) * inverse_y,
                    rate_z = (z.high - z.low) * inverse_z;
        const Lanes divergence = rate_x + rate_y + rate_z;

        const Lanes closing = max(-divergence, Lanes{}) * last_step;
        const BoxContents::Mask mask = contents.of_cells(place);
        CellState<Lanes> state;
        if (BoxContents::pure(mask)) {
            const int group = BoxContents::only_group(mask);
            state = pure_state(fields, row.groups, place, group, volume);
            if (any_torn(row, group, state)) {
                state = mixed_state(fields, row.groups, settings.void_allowed, place, volume, Lanes{},
                                    closing); // void opens inside the liquid
                torn = true;
            }
        } else {
            state = mixed_state(fields, row.groups, settings.void_allowed, place, volume,
                                load<Lanes>(&fields.groups[0].share[place]), closing);
        }

        const CellStrain<Lanes> strain{
            {rate_x, rate_y, rate_z},
            {width, broadcast<Lanes>(row.width_y()), broadcast<Lanes>(row.width_z())},
            divergence};
        const CellPressure<Lanes> pressure = cell_pressure(state, strain, settings);
        store(&fields.pressure[place], pressure.pressure);
        store(&fields.pressure_rate[place], pressure.rate);

        // Signals and the flow itself cross the cell.
        const Lanes shortest = min(width, broadcast<Lanes>(smallest_yz));
        const auto fastest = [&](const FaceMeans<Lanes>& sums, int axis) {
            const double mesh = 4 * settings.mesh_velocity[axis]; // faces sum four nodes
            return max(abs(sums.low - mesh), abs(sums.high - mesh));
        };
        const Lanes crossing =
            max(max(fastest(x, 0) * inverse_x, fastest(y, 1) * inverse_y), fastest(z, 2) * inverse_z);
        Lanes rate = pressure.signal / shortest + crossing;
        if (Viscous) {
            const Lanes diffusion =
                16.0 * (inverse_x * inverse_x + inverse_y * inverse_y + inverse_z * inverse_z);
            rate += 2.0 * viscosity * diffusion;
            const auto xy = face_sums<Lanes>(v[0], sy, 1, sz), xz = face_sums<Lanes>(v[0], sz, 1, sy);
            const auto yx = face_sums<Lanes>(v[1], 1, sy, sz), yz = face_sums<Lanes>(v[1], sz, 1, sy);
            const auto zx = face_sums<Lanes>(v[2], 1, sy, sz), zy = face_sums<Lanes>(v[2], sy, 1, sz);
            const Lanes gradient[3][3] = {
                {rate_x, (xy.high - xy.low) * inverse_y, (xz.high - xz.low) * inverse_z},
                {(yx.high - yx.low) * inverse_x, rate_y, (yz.high - yz.low) * inverse_z},
                {(zx.high - zx.low) * inverse_x, (zy.high - zy.low) * inverse_y, rate_z}};
            store_viscous_stress(fields, row.groups, place, gradient);
        }
        Lanes where;
        for (int lane = 0; lane < lane_count; ++lane) where[lane] = static_cast<double>(place + lane);
        rates.take(state.density > 0.0 ? rate : Lanes{}, where);
    }
    return rates;
}

} // namespace

CrossingRate evaluate_state(const BoxGrid& grid, FluidFields& fields, BoxContents& contents,
                            std::span<const FluidGroup> groups, const LagrangeSettings& settings,
                            double last_step)
{
    if (settings.void_allowed) {
        mirror_fractions(grid, fields);
        for_sheets(grid, grid.cells(2), [&](int k) {
            for (int j = 0; j < grid.cells(1); ++j)
                find_openness({grid, fields, groups, settings, j, k}, contents);
        });
    }
    struct SheetResult {
        CrossingRate limit;
        bool torn = false;
    };
    std::vector<SheetResult> results(grid.cells(2));
    for_sheets(grid, grid.cells(2), [&](int k) {
        SheetResult& result = results[k];
        for (int j = 0; j < grid.cells(1); ++j) {
            const Row row{grid, fields, groups, settings, j, k};
            const LaneRates rates = settings.viscous
                                        ? evaluate_row<true>(row, contents, last_step, result.torn)
                                        : evaluate_row<false>(row, contents, last_step, result.torn);
            for (int lane = 0; lane < lane_count; ++lane) {
                if (!(rates.rate[lane] > result.limit.rate)) continue;
                result.limit = {rates.rate[lane], static_cast<std::ptrdiff_t>(rates.place[lane])};
            }
        }
    });
    CrossingRate limit;
    bool torn = false;
    for (const SheetResult& result : results) {
        if (result.limit.rate > limit.rate) limit = result.limit;
        torn = torn || result.torn;
    }
    if (torn) contents.update(grid, fields);
    return limit;
}

} // namespace plash

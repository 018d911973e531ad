#include "ale/outflow_shares.h"
#include "ale/remap.h"
#include "ale/sheets.h"

#include <algorithm>

namespace plash {

namespace {

/// Differences of a fraction across a cell along the three axes of index space, over 27 cells with weights 1,
/// 2, 4 as in Youngs (1984), AWRE report 44/92/35. In index space the plane's normal needs no metric.
Vector3<Lanes> youngs_gradient(const FirstGroups& fraction, std::ptrdiff_t place, const BoxGrid& grid)
{
    const std::ptrdiff_t sy = grid.stride(1), sz = grid.stride(2);
    Vector3<Lanes> gradient;
    // Across each pair of rows: sums weighted 1 2 1 along the row for y and z, plain differences for x.
    for (int dk = -1; dk <= 1; ++dk) {
        for (int dj = -1; dj <= 1; ++dj) {
            const std::ptrdiff_t row = place + dj * sy + dk * sz;
            const Lanes before = fraction.at<Lanes>(row - 1), here = fraction.at<Lanes>(row),
                        after = fraction.at<Lanes>(row + 1);
            const double weight_j = dj == 0 ? 2 : 1, weight_k = dk == 0 ? 2 : 1;
            const Lanes along = before + 2.0 * here + after;
            gradient.x += (weight_j * weight_k) * (after - before);
            if (dj != 0) gradient.y += (dj * weight_k) * along;
            if (dk != 0) gradient.z += (dk * weight_j) * along;
        }
    }
    return gradient;
}

class OutflowShares {
public:
    OutflowShares(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, int axis)
        : grid_(grid), fields_(fields), contents_(contents), axis_(axis)
    {}

    void row(int j, int k)
    {
        for (int batch = 0; batch < grid_.cell_batches(); ++batch) {
            const std::ptrdiff_t place = grid_.at(batch * lane_count, j, k);
            const BoxContents::Mask mask = contents_.of_cells(place);
            if (BoxContents::nothing(mask) || BoxContents::pure(mask)) continue;
            this->batch(place);
        }
    }

private:
    const BoxGrid& grid_;
    FluidFields& fields_;
    const BoxContents& contents_;
    int axis_;

    void batch(std::ptrdiff_t place)
    {
        const Lanes per_volume = 1.0 / load<Lanes>(&fields_.volume[place]);
        const Lanes zero{}, one = broadcast<Lanes>(1);
        const Lanes low = load<Lanes>(&fields_.volume_flux[axis_][place]);
        const Lanes high = load<Lanes>(&fields_.volume_flux[axis_][place + grid_.stride(axis_)]);
        const Lanes lower_part = min(max(-low * per_volume, zero), one);
        const Lanes upper_part = min(max(high * per_volume, zero), one);
        if (!any((lower_part > 0.0) | (upper_part > 0.0))) return;
        share_outflow<Lanes>(fields_, place, axis_, lower_part, upper_part,
                             [&](const FirstGroups& first) { return youngs_gradient(first, place, grid_); });
    }
};

/// What flows in through the boundary is taken as a uniform mixture like the cell inside.
void fill_boundary_shares(const BoxGrid& grid, FluidFields& fields, int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const auto at = [&](int along, int ia, int ib) {
        int index[3];
        index[axis] = along;
        index[a] = ia;
        index[b] = ib;
        return grid.at(index[0], index[1], index[2]);
    };
    const int last = grid.cells(axis);
    for (GroupFields& group : fields.groups) {
        for (int ib = 0; ib < grid.cells(b); ++ib) {
            for (int ia = 0; ia < grid.cells(a); ++ia) {
                group.share_of_outflow[1][at(-1, ia, ib)] = group.fraction[at(0, ia, ib)];
                group.share_of_outflow[0][at(last, ia, ib)] = group.fraction[at(last - 1, ia, ib)];
            }
        }
    }
}

} // namespace

void find_outflow_shares(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents, int axis)
{
    if (contents.always_full()) return;
    mirror_fractions(grid, fields);
    OutflowShares shares(grid, fields, contents, axis);
    for_sheets(grid, grid.cells(2), [&](int k) {
        for (int j = 0; j < grid.cells(1); ++j) shares.row(j, k);
    });
    fill_boundary_shares(grid, fields, axis); // last: batches at the end of a row hold ghosts as well
}

} // namespace plash

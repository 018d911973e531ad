#include "ale/plane_in_cell.h"
#include "ale/remap.h"
#include "ale/sheets.h"

#include <algorithm>

namespace plash {

namespace {

/// Sum of the fractions of the first groups, in the order of the deck: the interface of each group lies where
/// this sum changes, so that several interfaces in one cell nest like the skins of an onion (Youngs 1982).
struct FirstGroups {
    const BoxFields& fields;
    int count;

    Lanes at(std::ptrdiff_t place) const
    {
        Lanes sum = load<Lanes>(&fields.groups[0].fraction[place]);
        for (int g = 1; g < count; ++g) sum += load<Lanes>(&fields.groups[g].fraction[place]);
        return sum;
    }
};

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
            const Lanes before = fraction.at(row - 1), here = fraction.at(row), after = fraction.at(row + 1);
            const double weight_j = dj == 0 ? 2 : 1, weight_k = dk == 0 ? 2 : 1;
            const Lanes along = before + 2.0 * here + after;
            gradient.x += (weight_j * weight_k) * (after - before);
            if (dj != 0) gradient.y += (dj * weight_k) * along;
            if (dk != 0) gradient.z += (dk * weight_j) * along;
        }
    }
    return gradient;
}

/// Share of the first groups in the slabs that leave a batch of cells through the lower and the upper face.
struct SlabShares {
    Lanes lower, upper;
};

SlabShares cut_slabs(const FirstGroups& fraction, std::ptrdiff_t place, const BoxGrid& grid, int axis,
                     Lanes lower_part, Lanes upper_part)
{
    const Vector3<Lanes> gradient = youngs_gradient(fraction, place, grid);
    Vector3<Lanes> normal{abs(gradient.x), abs(gradient.y), abs(gradient.z)};
    const Lanes sum = normal.x + normal.y + normal.z;
    const auto flat = sum < 1e-12; // no direction: any plane is as good
    const Lanes scale = flat ? Lanes{} : 1.0 / sum;
    normal = scale * normal;
    normal.z = flat ? broadcast<Lanes>(1) : normal.z;
    const Lanes inside = min(max(fraction.at(place), Lanes{}), broadcast<Lanes>(1));
    const Lanes distance = plane_distance(normal, inside);
    // Distances count from the corner on the material's side, where the gradient points to.
    const Lanes slope = axis == 0 ? gradient.x : axis == 1 ? gradient.y : gradient.z;
    const auto material_above = slope > 0.0;
    const Lanes zero{}, tiny = broadcast<Lanes>(1e-200);
    const Lanes lower_start = material_above ? 1.0 - lower_part : zero;
    const Lanes upper_start = material_above ? zero : 1.0 - upper_part;
    SlabShares shares;
    shares.lower = share_of_slab(normal, distance, axis, lower_start, max(lower_part, tiny));
    shares.upper = share_of_slab(normal, distance, axis, upper_start, max(upper_part, tiny));
    return shares;
}

class OutflowShares {
public:
    OutflowShares(const BoxGrid& grid, BoxFields& fields, const BoxContents& contents, int axis)
        : grid_(grid),
          fields_(fields),
          contents_(contents),
          axis_(axis),
          groups_(static_cast<int>(fields.groups.size()))
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
    BoxFields& fields_;
    const BoxContents& contents_;
    int axis_, groups_;

    void batch(std::ptrdiff_t place)
    {
        const Lanes per_volume = 1.0 / load<Lanes>(&fields_.volume[place]);
        const Lanes zero{}, one = broadcast<Lanes>(1);
        const Lanes low = load<Lanes>(&fields_.volume_flux[axis_][place]);
        const Lanes high = load<Lanes>(&fields_.volume_flux[axis_][place + grid_.stride(axis_)]);
        const Lanes lower_part = min(max(-low * per_volume, zero), one);
        const Lanes upper_part = min(max(high * per_volume, zero), one);
        if (!any((lower_part > 0.0) | (upper_part > 0.0))) return;
        Lanes lower_before{}, upper_before{};
        for (int group = 0; group < groups_; ++group) {
            const FirstGroups first{fields_, group + 1};
            const Lanes fraction = first.at(place);
            SlabShares shares{fraction, fraction};
            const auto cut = (fraction > 0.0) & (fraction < 1.0);
            if (any(cut)) {
                const SlabShares by_plane = cut_slabs(first, place, grid_, axis_, lower_part, upper_part);
                shares.lower = cut ? by_plane.lower : shares.lower;
                shares.upper = cut ? by_plane.upper : shares.upper;
            }
            // Nested interfaces may touch but not cross.
            shares.lower = max(shares.lower, lower_before);
            shares.upper = max(shares.upper, upper_before);
            store(&fields_.groups[group].share_of_outflow[0][place], shares.lower - lower_before);
            store(&fields_.groups[group].share_of_outflow[1][place], shares.upper - upper_before);
            lower_before = shares.lower;
            upper_before = shares.upper;
        }
        if (groups_ > 1)
            keep_within_stock(place, lower_part, upper_part, 1.0 - lower_before, 1.0 - upper_before);
    }

    /// Planes of several interfaces in one cell need not leave each group what the cell has of it: what a
    /// group cannot deliver, the others deliver in proportion to what they have left.
    void keep_within_stock(std::ptrdiff_t place, Lanes lower_part, Lanes upper_part, Lanes lower_void,
                           Lanes upper_void)
    {
        Lanes stock[most_phases], sum{};
        for (int group = 0; group < groups_; ++group) {
            stock[group] = load<Lanes>(&fields_.groups[group].fraction[place]);
            sum += stock[group];
        }
        stock[groups_] = max(1.0 - sum, Lanes{}); // void
        const Lanes parts[2] = {lower_part, upper_part}, voids[2] = {lower_void, upper_void};
        for (int side = 0; side < 2; ++side) {
            Lanes wanted[most_phases], missing{}, spare{};
            for (int phase = 0; phase <= groups_; ++phase) {
                const Lanes share = phase < groups_
                                        ? load<Lanes>(&fields_.groups[phase].share_of_outflow[side][place])
                                        : max(voids[side], Lanes{});
                wanted[phase] = min(share * parts[side], stock[phase]);
                missing += share * parts[side] - wanted[phase];
                spare += stock[phase] - wanted[phase];
            }
            const Lanes fill = spare > 0.0 ? min(missing / spare, broadcast<Lanes>(1)) : Lanes{};
            const Lanes per_part = parts[side] > 0.0 ? 1.0 / parts[side] : Lanes{};
            for (int phase = 0; phase <= groups_; ++phase) {
                const Lanes out = wanted[phase] + fill * (stock[phase] - wanted[phase]);
                stock[phase] -= out;
                if (phase == groups_) continue;
                store(&fields_.groups[phase].share_of_outflow[side][place], out * per_part);
            }
        }
    }

    static constexpr int most_phases = 17;
};

/// What flows in through the boundary is taken as a uniform mixture like the cell inside.
void fill_boundary_shares(const BoxGrid& grid, BoxFields& fields, int axis)
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

void find_outflow_shares(const BoxGrid& grid, BoxFields& fields, const BoxContents& contents, int axis)
{
    if (contents.always_full()) return;
    mirror_fractions(grid, fields);
    fill_boundary_shares(grid, fields, axis);
    OutflowShares shares(grid, fields, contents, axis);
    for_sheets(grid, grid.cells(2), [&](int k) {
        for (int j = 0; j < grid.cells(1); ++j) shares.row(j, k);
    });
}

} // namespace plash

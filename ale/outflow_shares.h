#pragma once

#include "ale/fluid_fields.h"
#include "ale/plane_in_cell.h"

/// Shares of the groups in what leaves cells that hold an interface, whatever the mesh they belong to.
namespace plash {

/// Values of a batch of cells that follow one another from `place` on, or that stand anywhere.
template <class Lane>
inline Lane values_at(const double* table, std::ptrdiff_t place)
{
    return load<Lane>(table + place);
}

template <class Lane>
inline Lane values_at(const double* table, LaneMask places)
{
    return gather(table, places);
}

template <class Lane>
inline void set_values(double* table, std::ptrdiff_t place, Lane value)
{
    store(table + place, value);
}

inline void set_values(double* table, LaneMask places, Lanes value)
{
    for (int lane = 0; lane < lane_count; ++lane) table[places[lane]] = value[lane];
}

/// Sum of the fractions of the first groups, in the order of the deck: the interface of each group lies where
/// this sum changes, so that several interfaces in one cell nest like the skins of an onion (Youngs 1982).
struct FirstGroups {
    const FluidFields& fields;
    int count;

    template <class Lane, class Place>
    Lane at(Place place) const
    {
        Lane sum = values_at<Lane>(fields.groups[0].fraction.data(), place);
        for (int g = 1; g < count; ++g) sum += values_at<Lane>(fields.groups[g].fraction.data(), place);
        return sum;
    }
};

/// Share of the first groups in the slabs that leave a batch of cells through the lower and the upper face.
template <class Lane>
struct SlabShares {
    Lane lower, upper;
};

/// gradient  differences of the first groups' fraction across the cell along its axes
template <class Lane>
inline SlabShares<Lane> cut_slabs(const Vector3<Lane>& gradient, Lane fraction, int axis, Lane lower_part,
                                  Lane upper_part)
{
    Vector3<Lane> normal{abs(gradient.x), abs(gradient.y), abs(gradient.z)};
    const Lane sum = normal.x + normal.y + normal.z;
    const auto flat = sum < 1e-12; // no direction: any plane is as good
    const Lane scale = flat ? Lane{} : 1.0 / sum;
    normal = scale * normal;
    normal.z = flat ? broadcast<Lane>(1) : normal.z;
    const Lane inside = min(max(fraction, Lane{}), broadcast<Lane>(1));
    const Lane distance = plane_distance(normal, inside);
    // Distances count from the corner on the material's side, where the gradient points to.
    const Lane slope = axis == 0 ? gradient.x : axis == 1 ? gradient.y : gradient.z;
    const auto material_above = slope > 0.0;
    const Lane zero{}, tiny = broadcast<Lane>(1e-200);
    const Lane lower_start = material_above ? 1.0 - lower_part : zero;
    const Lane upper_start = material_above ? zero : 1.0 - upper_part;
    SlabShares<Lane> shares;
    shares.lower = share_of_slab(normal, distance, axis, lower_start, max(lower_part, tiny));
    shares.upper = share_of_slab(normal, distance, axis, upper_start, max(upper_part, tiny));
    return shares;
}

/// Planes of several interfaces in one cell need not leave each group what the cell has of it: what a group
/// cannot deliver, the others deliver in proportion to what they have left.
template <class Lane, class Place>
inline void keep_within_stock(FluidFields& fields, Place place, Lane lower_part, Lane upper_part,
                              Lane lower_void, Lane upper_void)
{
    constexpr int most_phases = 17;
    const int groups = static_cast<int>(fields.groups.size());
    Lane stock[most_phases], sum{};
    for (int group = 0; group < groups; ++group) {
        stock[group] = values_at<Lane>(fields.groups[group].fraction.data(), place);
        sum += stock[group];
    }
    stock[groups] = max(1.0 - sum, Lane{}); // void
    const Lane parts[2] = {lower_part, upper_part}, voids[2] = {lower_void, upper_void};
    for (int side = 0; side < 2; ++side) {
        Lane wanted[most_phases], missing{}, spare{};
        for (int phase = 0; phase <= groups; ++phase) {
            const Lane share =
                phase < groups ? values_at<Lane>(fields.groups[phase].share_of_outflow[side].data(), place)
                               : max(voids[side], Lane{});
            wanted[phase] = min(share * parts[side], stock[phase]);
            missing += share * parts[side] - wanted[phase];
            spare += stock[phase] - wanted[phase];
        }
        const Lane fill = spare > 0.0 ? min(missing / spare, broadcast<Lane>(1)) : Lane{};
        const Lane per_part = parts[side] > 0.0 ? 1.0 / parts[side] : Lane{};
        for (int phase = 0; phase <= groups; ++phase) {
            const Lane out = wanted[phase] + fill * (stock[phase] - wanted[phase]);
            stock[phase] -= out;
            if (phase == groups) continue;
            set_values(fields.groups[phase].share_of_outflow[side].data(), place, out * per_part);
        }
    }
}

/// Finds the shares of all groups in what leaves a batch of cells through the faces across an axis.
/// lower_part, upper_part  shares of the cell that leave it, >= 0
/// place                   of the first cell of the batch, or of each
/// gradient_of             (FirstGroups) -> differences of their fraction across the cell
template <class Lane, class Place, class GradientOf>
inline void share_outflow(FluidFields& fields, Place place, int axis, Lane lower_part, Lane upper_part,
                          GradientOf&& gradient_of)
{
    const int groups = static_cast<int>(fields.groups.size());
    Lane lower_before{}, upper_before{};
    for (int group = 0; group < groups; ++group) {
        const FirstGroups first{fields, group + 1};
        const Lane fraction = first.template at<Lane>(place);
        const Lane inside = min(fraction, broadcast<Lane>(1));
        SlabShares<Lane> shares{inside, inside};
        const auto cut = (fraction > 0.0) & (fraction < 1.0);
        if (any(cut)) {
            const SlabShares<Lane> by_plane =
                cut_slabs<Lane>(gradient_of(first), fraction, axis, lower_part, upper_part);
            shares.lower = cut ? by_plane.lower : shares.lower;
            shares.upper = cut ? by_plane.upper : shares.upper;
        }
        // Nested interfaces may touch but not cross.
        shares.lower = max(shares.lower, lower_before);
        shares.upper = max(shares.upper, upper_before);
        set_values(fields.groups[group].share_of_outflow[0].data(), place, shares.lower - lower_before);
        set_values(fields.groups[group].share_of_outflow[1].data(), place, shares.upper - upper_before);
        lower_before = shares.lower;
        upper_before = shares.upper;
    }
    if (groups > 1)
        keep_within_stock<Lane>(fields, place, lower_part, upper_part, 1.0 - lower_before,
                                1.0 - upper_before);
}

} // namespace plash

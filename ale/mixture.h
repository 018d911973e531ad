#pragma once

#include "ale/fluid_law.h"
#include "math/lanes.h"

#include <span>

/// Several groups, or a group and void, in one cell.
namespace plash {

inline constexpr int most_groups = 15;

/// The groups of a batch of cells. Entry g of each array belongs to group g; what a lane does not hold is
/// zero.
template <class Lane>
struct Mixture {
    Lane fraction[most_groups]; ///< share of the cell's volume [-]
    Lane mass[most_groups];     ///< [mass]
    Lane energy[most_groups];   ///< internal [energy]
    Lane share[most_groups];    ///< out: share of each group in a change of the cell's volume [-]
    Lane pressure;              ///< out: what the cell as a whole does to its nodes [pressure]
    Lane stiffness;             ///< out: its change per volume change of the cell [pressure]
    Lane filled;                ///< out: sum of the fractions
    Lane signal_square;         ///< out: largest square of the speed of sound [velocity^2]
};

namespace mixture_detail {

/// Pressures, and their sums that lead to the common pressure of all groups in a cell.
template <class Lane>
struct Equilibrium {
    Lane pressure[most_groups], stiffness[most_groups];
    Lane common, compliance, signal_square;
};

template <class Lane>
Equilibrium<Lane> weigh(const Mixture<Lane>& mix, std::span<const FluidGroup> groups, Lane volume)
{
    Equilibrium<Lane> result;
    Lane weighted{};
    result.compliance = result.signal_square = Lane{};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto has = (mix.mass[g] > 0.0) & (mix.fraction[g] > 0.0);
        const Lane density =
            has ? mix.mass[g] / (mix.fraction[g] * volume) : broadcast<Lane>(groups[g].reference_density);
        const Lane energy = has ? mix.energy[g] / mix.mass[g] : Lane{};
        const auto state = fluid_state(groups[g], density, energy);
        result.pressure[g] = has ? state.pressure : Lane{};
        result.stiffness[g] = state.stiffness;
        const Lane compliance = has ? mix.fraction[g] / state.stiffness : Lane{};
        weighted += compliance * result.pressure[g];
        result.compliance += compliance;
        result.signal_square = max(result.signal_square, has ? state.stiffness / density : Lane{});
    }
    result.common = result.compliance > 0.0 ? weighted / result.compliance : Lane{};
    return result;
}

/// Newton's steps to the common pressure, at most a third of a group's volume at a time.
template <class Lane>
void equalise(Mixture<Lane>& mix, Equilibrium<Lane>& state, std::span<const FluidGroup> groups, Lane volume)
{
    const Lane most = broadcast<Lane>(0.3);
    for (int round = 0; round < 3; ++round) {
        Lane sum_before{}, sum_after{};
        Lane next[most_groups];
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const Lane wish = (state.pressure[g] - state.common) / state.stiffness[g];
            next[g] = mix.fraction[g] * (1.0 + min(max(wish, -most), most));
            sum_before += mix.fraction[g];
            sum_after += next[g];
        }
        const Lane keep = sum_after > 0.0 ? sum_before / sum_after : Lane{};
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const Lane fraction = next[g] * keep;
            mix.energy[g] -= state.common * (fraction - mix.fraction[g]) * volume;
            mix.fraction[g] = fraction;
        }
        state = weigh(mix, groups, volume);
    }
}

/// Torn: the liquid goes back to the volume that it has without pressure, and leaves the rest void.
template <class Lane>
void tear(Mixture<Lane>& mix, Equilibrium<Lane>& state, std::span<const FluidGroup> groups)
{
    Lane limit = broadcast<Lane>(-1e300);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        limit = mix.mass[g] > 0.0 ? max(limit, broadcast<Lane>(groups[g].tension_limit)) : limit;
    }
    const auto torn = (state.common < limit) & (state.compliance > 0.0);
    if (!any(torn)) return;
    mix.filled = Lane{};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const Lane shrink = state.stiffness[g] / (state.stiffness[g] - state.common);
        mix.fraction[g] = torn ? mix.fraction[g] * shrink : mix.fraction[g];
        mix.filled += mix.fraction[g];
    }
    state.common = torn ? Lane{} : state.common;
}

/// Void that fluid encloses: fluid under pressure expands into it, and what remains closes before the fluid
/// resists. Returns the share of its own part of a change of volume that the fluid takes.
template <class Lane>
Lane fill_enclosed_void(Mixture<Lane>& mix, Equilibrium<Lane>& state, std::size_t count, Lane open,
                        Lane closing)
{
    const Lane room = max(1.0 - mix.filled, Lane{});
    const Lane wish = max(state.common, Lane{}) * state.compliance * (1.0 - open);
    // Groups whose fractions add up to one but for round-off leave no void.
    const auto fills = ((wish >= room) & (room > 0.0)) | (room < 1e-12);
    const Lane gain = min(wish, room);
    const Lane per_compliance = state.compliance > 0.0 ? gain / state.compliance : Lane{};
    for (std::size_t g = 0; g < count; ++g) {
        mix.fraction[g] += per_compliance * (mix.fraction[g] / state.stiffness[g]);
        if (count == 1) mix.fraction[g] = fills ? max(mix.fraction[g], broadcast<Lane>(1)) : mix.fraction[g];
    }
    state.common -= per_compliance;
    mix.filled = fills ? broadcast<Lane>(1) : mix.filled + gain;
    const Lane left = 1.0 - mix.filled;
    const Lane beyond_void = closing > left ? 1.0 - left / closing : Lane{};
    return mix.filled >= 1.0 ? broadcast<Lane>(1) : max(open, beyond_void);
}

} // namespace mixture_detail

/// How far a partly empty cell faces open space: 1 where the void beyond is at least as open as the cell
/// itself, 0 where the void is enclosed by fluid. The fluid beside open space shares the cell's change of
/// volume, so that a free surface carries its own weight; enclosed void gives way first, without resistance,
/// until it has vanished. filled        of the cell below, above  of its neighbours along each axis
template <class Lane>
inline Lane openness(Lane filled, const Lane (&below)[3], const Lane (&above)[3])
{
    Lane weighted{}, weights{};
    for (int axis = 0; axis < 3; ++axis) {
        const Lane weight = abs(above[axis] - below[axis]) + 1e-6;
        weighted += weight * min(above[axis], below[axis]);
        weights += weight;
    }
    const Lane beyond = weighted / weights;
    const Lane ratio = filled > 0.0 ? 2.0 * (1.0 - beyond / filled) : Lane{};
    return min(max(ratio, Lane{}), broadcast<Lane>(1));
}

/// Closes a mixture: brings the groups of a cell to one pressure by exchanging volume at that pressure (their
/// energies together stay as they are), lets fluid under pressure expand into enclosed void, opens void where
/// a liquid is under more tension than it bears, and finds the pressure of the cell and how the groups share
/// a change of its volume. volume   of the cells [volume] open     openness() of partly empty cells closing
/// relative loss of volume that the coming step will bring, >= 0
template <class Lane>
void close_mixture(Mixture<Lane>& mix, std::span<const FluidGroup> groups, Lane volume, bool void_allowed,
                   Lane open, Lane closing)
{
    auto state = mixture_detail::weigh(mix, groups, volume);
    if (groups.size() > 1) mixture_detail::equalise(mix, state, groups, volume);
    mix.filled = Lane{};
    for (std::size_t g = 0; g < groups.size(); ++g) mix.filled += mix.fraction[g];
    Lane taking =
        broadcast<Lane>(1); // share of the change of volume that the filled part takes of its own share
    if (void_allowed) {
        mixture_detail::tear(mix, state, groups);
        taking = mixture_detail::fill_enclosed_void(mix, state, groups.size(), open, closing);
    }
    // A group's share is in proportion to its compliance; void takes what is left.
    const Lane taken = taking * mix.filled;
    const Lane per_compliance = state.compliance > 0.0 ? taken / state.compliance : Lane{};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto has = (mix.mass[g] > 0.0) & (mix.fraction[g] > 0.0);
        mix.share[g] = has ? per_compliance * (mix.fraction[g] / state.stiffness[g]) : Lane{};
    }
    mix.pressure = taken * state.common;
    mix.stiffness = taken * per_compliance;
    mix.signal_square = state.signal_square;
}

} // namespace plash

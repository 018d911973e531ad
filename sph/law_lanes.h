#pragma once

#include "sph/particle_law.h"
#include "sph/rings.h"

#include <algorithm>
#include <cmath>

/// What the laws of particles share: batches of particles at scattered places, density and smoothing length.
namespace plash {

/// value(place) at up to eight places as one lane value; a short batch repeats its last place.
template <class Value>
Lanes gather(std::span<const Index> places, Value&& value)
{
    Lanes lanes;
    for (int l = 0; l < lane_count; ++l) {
        lanes[l] = value(places[std::min<std::size_t>(l, places.size() - 1)]);
    }
    return lanes;
}

/// work(batch of places) -> ParticleVote for all places, lane_count at a time; the shortest vote.
template <class Work>
ParticleVote for_batches(std::span<const Index> places, Work&& work)
{
    ParticleVote vote;
    for (std::size_t first = 0; first < places.size(); first += lane_count) {
        vote.take(work(places.subspan(first, std::min<std::size_t>(lane_count, places.size() - first))));
    }
    return vote;
}

/// Smoothing length that keeps the mass in a kernel, h^d density = const, within its bounds: the solution of
/// dh/dt = h div(v) / d. Newton's iteration from the last value, which is close. Of rings it goes with the
/// root of their area, and div(v) is that in the plane.
/// Where the deck asks for it (DERIV = 1), dh/dt = h div(v)^(1/3) / d, over the step; its result depends on
/// the unit of time.
/// closing  -div(v) [1/time]
inline Lanes smoothing_length(const PartConstants& part, std::span<const Index> places, Lanes compression,
                              Lanes closing, double step, const ParticleArrays& arrays)
{
    const Lanes size = part.smoothing_mass == 0
                           ? broadcast<Lanes>(1.0)
                           : gather(places, [&](Index p) { return part.size_of(arrays.mass(p)); });
    const Lanes reference = part.smoothing * size;
    const auto bounded = [&](Lanes h) {
        return max(part.smallest_smoothing * size, min(part.largest_smoothing * size, h));
    };
    if (part.smoothing_by_cube_root) {
        Lanes h = gather(places, [&](Index p) { return arrays.motion[p].smoothing; });
        for (int l = 0; l < lane_count; ++l) h[l] *= std::exp(-step * std::cbrt(closing[l]) / part.dimension);
        return bounded(h);
    }
    if (are_rings(arrays)) {
        compression *= gather(places, [&](Index p) { return ring_radius(arrays.motion[p]); }) /
                       gather(places, [&](Index p) { return arrays.first_radius[p]; });
    }
    const Lanes kept =
        (part.dimension == 2 ? reference * reference : reference * reference * reference) / compression;
    Lanes h = gather(places, [&](Index p) { return arrays.motion[p].smoothing; });
    for (int i = 0; i < 3; ++i) {
        h = part.dimension == 2 ? 0.5 * (h + kept / h) : (1.0 / 3.0) * (2.0 * h + kept / (h * h));
    }
    return bounded(h);
}

/// Density after a step; `change` is that of the density, or of its logarithm where `logarithmic`. A step may
/// at most multiply or divide it by three: more is no flow but a fault that the step size will show.
inline Lanes advanced_density(bool logarithmic, Lanes density, Lanes change)
{
    const Lanes one = broadcast<Lanes>(1.0);
    const Lanes bounded = max(-one, min(one, logarithmic ? change : change / density));
    if (logarithmic) return density * ((2.0 + bounded) / (2.0 - bounded)); // centred in the step
    return density * max(1.0 + bounded, one * (1.0 / 3.0));
}

/// Pressure of viscosity as solid elements have it, rho l (Q1 l D^2 + Q2 c D) where particles close in with
/// the rate D (IAVIS = 1); zero where viscosity acts by pairs. closing  rate of the logarithm of density
/// [1/time]
inline Lanes bulk_viscosity(const PartConstants& part, std::span<const Index> places, Lanes closing,
                            const ParticleArrays& arrays)
{
    if (part.bulk_length == 0) return Lanes{};
    const auto from = [&](const auto& value) { return gather(places, value); };
    const Lanes length = part.bulk_length * from([&](Index p) { return arrays.motion[p].smoothing; });
    const Lanes sound = from([&](Index p) { return arrays.push[p].sound; });
    const Lanes density = from([&](Index p) { return arrays.density(p); });
    const Lanes rate = max(closing, Lanes{});
    return density * length * rate *
           (part.viscosity.quadratic * length * rate + part.viscosity.linear * sound);
}

/// What it had been before, and keeps what it is now.
inline Lanes exchange_bulk(std::span<const Index> places, Lanes now, ParticleArrays& arrays)
{
    if (arrays.bulk.empty()) return Lanes{};
    const Lanes before = gather(places, [&](Index p) { return arrays.bulk[p]; });
    for (std::size_t l = 0; l < places.size(); ++l) arrays.bulk[places[l]] = now[l];
    return before;
}

/// Density, and what pair loops see of a particle besides its push.
inline void set_records(const PartConstants& part, Index place, double density, double smoothing,
                        double sound, ParticleArrays& arrays)
{
    MotionRecord& motion = arrays.motion[place];
    motion.smoothing = smoothing;
    if (part.volume_weighted) motion.weight = arrays.own_mass[place] / density;
    if (are_rings(arrays)) motion.weight /= ring_radius(motion);
    PushRecord& push = arrays.push[place];
    arrays.set_density(place, density);
    push.sound = sound;
    const double viscosity = part.laminar_viscosity * (part.volume_weighted ? 1 : push.scale * push.scale);
    push.viscosity = part.laminar_by_velocity ? 0 : (part.dimension + 2) * viscosity;
    if (!arrays.laminar.empty()) arrays.laminar[place] = viscosity;
}

/// Push of a stress [stress]: its negative, corrected and scaled; only the pressure where no tensors are
/// kept.
inline void set_push(const PartConstants& part, Index place, const SymmetricTensor<double>& stress,
                     ParticleArrays& arrays)
{
    PushRecord& push = arrays.push[place];
    double scaling = part.volume_weighted ? -1 : -push.scale * push.scale;
    if (are_rings(arrays)) scaling /= arrays.moment[place];
    if (arrays.tension.empty()) {
        push.push = scaling / 3 * trace(stress);
        return;
    }
    const SymmetricTensor<double> s = scaling * stress;
    const SymmetricTensor<double>& b = arrays.correction[place];
    arrays.tension[place] = {
        {s.xx * b.xx + s.xy * b.xy + s.zx * b.zx, s.xx * b.xy + s.xy * b.yy + s.zx * b.yz,
         s.xx * b.zx + s.xy * b.yz + s.zx * b.zz, s.xy * b.xx + s.yy * b.xy + s.yz * b.zx,
         s.xy * b.xy + s.yy * b.yy + s.yz * b.yz, s.xy * b.zx + s.yy * b.yz + s.yz * b.zz,
         s.zx * b.xx + s.yz * b.xy + s.zz * b.zx, s.zx * b.xy + s.yz * b.yy + s.zz * b.yz}};
    push.push = s.zx * b.zx + s.yz * b.yz + s.zz * b.zz;
}

/// What the stable step goes by: the smoothing length, or what a ring allows [length].
inline Lanes size_for_step(std::span<const Index> places, Lanes smoothing, const ParticleArrays& arrays)
{
    if (!are_rings(arrays)) return smoothing;
    return ring_size(gather(places, [&](Index p) { return ring_radius(arrays.motion[p]); }), smoothing);
}

/// Stable step h / (Q + sqrt(Q^2 + c^2)) with Q = Q2 c + Q1 h |div v| in compression, as for LS-DYNA's
/// solids; and for laminar viscosity h^2 / (8 nu) (Morris et al. 1997), by (dimension + 2) / dimension less
/// for central forces, which are so much stiffer against particles that move to and fro. closing  rate of the
/// logarithm of density [1/time]
inline Lanes stable_step(const PartConstants& part, Lanes h, Lanes sound, Lanes closing)
{
    const Lanes damping =
        part.viscosity.linear * sound + part.viscosity.quadratic * h * max(closing, Lanes{});
    const Lanes acoustic = h / (damping + sqrt(damping * damping + sound * sound));
    if (!(part.laminar_viscosity > 0)) return acoustic;
    const double stiffer = part.laminar_by_velocity ? 1 : 1 + 2.0 / part.dimension;
    return min(acoustic, part.density / (8 * stiffer * part.laminar_viscosity) * h * h);
}

} // namespace plash

#pragma once

#include "eos/response.h"
#include "materials/null_fluid.h"
#include "sph/law_lanes.h"

#include <algorithm>
#include <cmath>

namespace plash {

/// *MAT_NULL with an equation of state: no strength but viscosity, and a pressure that tension cuts off.
template <class Eos>
class FluidLaw : public ParticleLaw {
public:
    FluidLaw(const NullFluid& fluid, const Eos& eos) : fluid_(fluid), eos_(eos) {}

    double initial_energy() const override { return eos_.energy; }
    double initial_compression() const override { return 1 / eos_.relative_volume; }

    /// Newton's method from the start of the equation of state.
    double compression_at(double pressure) const override
    {
        double compression = initial_compression();
        for (int round = 0; round < 50; ++round) {
            const PressureResponse<double> response = eos_.evaluate(compression);
            const double slope = response.cold_slope + response.warm_slope * eos_.energy;
            const double change = (pressure - response.pressure(eos_.energy)) / slope;
            if (!(std::abs(change) > 1e-15 * compression)) break; // a slope of zero, too
            compression = std::clamp(compression + change, 0.5 * compression, 2 * compression);
        }
        return compression;
    }

    ParticleVote advance(const PartConstants& part, std::span<const Index> places, double step,
                         ParticleArrays& arrays) const override
    {
        return for_batches(
            places, [&](std::span<const Index> batch) { return advance_batch(part, batch, step, arrays); });
    }

private:
    NullFluid fluid_;
    Eos eos_;

    ParticleVote advance_batch(const PartConstants& part, std::span<const Index> places, double step,
                               ParticleArrays& arrays) const
    {
        const auto from = [&](const auto& array) {
            return gather(places, [&](Index p) { return array[p]; });
        };
        const Lanes rate = from(arrays.rate),
                    before = gather(places, [&](Index p) { return arrays.density(p); });
        const Lanes flowed = advanced_density(part.volume_weighted, before, step * rate);
        // Diffusion changes density without work: pressure does its own on what flow compresses.
        const Lanes volume_change = part.density * (1.0 / flowed - 1.0 / before);
        const Lanes density =
            arrays.diffusion.empty() ? flowed : max(flowed + step * from(arrays.diffusion), 0.5 * flowed);
        const Lanes inverse_density = 1.0 / density;
        const Lanes compression = density * (1 / part.density);
        const Lanes closing = part.volume_weighted ? rate : rate * inverse_density;
        const Lanes bulk = bulk_viscosity(part, places, step > 0 ? closing : Lanes{}, arrays);
        const Lanes bulk_work = -0.5 * (exchange_bulk(places, bulk, arrays) + bulk) * volume_change;
        const PressureStep<Lanes> end =
            advance_pressure(eos_.evaluate(compression), from(arrays.energy), bulk_work,
                             gather(places, [&](Index p) { return arrays.pressure(p); }), volume_change,
                             fluid_.lowest_pressure);
        const Lanes stiffness = eos_.evaluate(compression).stiffness(compression, end.pressure, end.energy);
        const Lanes floor = broadcast<Lanes>(1e-6 * eos_.bulk_modulus);
        const Lanes sound = sqrt(max(stiffness, floor) * (1 / part.density));
        const Lanes h = smoothing_length(part, places, compression, closing, step, arrays);
        const Lanes stable = stable_step(part, size_for_step(places, h, arrays), sound, closing);

        ParticleVote vote;
        for (std::size_t l = 0; l < places.size(); ++l) {
            const Index p = places[l];
            arrays.energy[p] = end.energy[l];
            set_records(part, p, density[l], h[l], sound[l], arrays);
            arrays.set_pressure(p, end.pressure[l]);
            const double normal = -end.pressure[l] - bulk[l];
            set_push(part, p, {normal, normal, normal, 0, 0, 0}, arrays);
            vote.take({stable[l], p});
        }
        return vote;
    }
};

} // namespace plash

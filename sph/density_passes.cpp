#include "sph/pair_passes.h"
#include "sph/rings.h"

#include <algorithm>

namespace plash {

namespace {

/// All pairs of a run. Flattened, so that sums and the opened particle stay in registers over the run.
template <bool diffusive, bool rings, class K>
[[gnu::flatten]] void sum_rates_of_run(const MotionRecord* records, const NeighbourRun& run, int dimension,
                                       double half_step, double* rate, const DensityDiffusion& diffusion,
                                       double* spread, double* moment)
{
    DensityRate<Lanes, K, diffusive, rings> pass(records, run.begin, dimension, half_step, rate, diffusion,
                                                 spread, moment);
    walk_pairs<Lanes>(run, pass);
}

template <bool diffusive, bool rings, class K>
void sum_rates(int dimension, double half_step, const DensityDiffusion& diffusion,
               const std::vector<NeighbourRun>& runs, ParticleArrays& arrays)
{
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
#pragma omp parallel for schedule(dynamic) if (count > 1)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const NeighbourRun& run = runs[i];
        double* rate = arrays.rate.data() + run.begin;
        double* spread = diffusive ? arrays.diffusion.data() + run.begin : nullptr;
        std::fill_n(rate, run.length(), 0.0);
        if constexpr (diffusive) std::fill_n(spread, run.length(), 0.0);
        double* moment = rings ? arrays.moment.data() + run.begin : nullptr;
        if constexpr (rings) std::fill_n(moment, run.length(), 0.0);
        sum_rates_of_run<diffusive, rings, K>(arrays.motion.data(), run, dimension, half_step, rate,
                                              diffusion, spread, moment);
    }
}

} // namespace

void sum_density_rates(Kernel kernel, int dimension, double half_step, const std::vector<NeighbourRun>& runs,
                       ParticleArrays& arrays, const DensityDiffusion& diffusion)
{
    const auto sum = [&]<bool diffusive, class K>(K) {
        const auto of = are_rings(arrays) ? sum_rates<diffusive, true, K> : sum_rates<diffusive, false, K>;
        of(dimension, half_step, diffusion, runs, arrays);
    };
    with_kernel(kernel, [&]<class K>(K k) {
        diffusion.strength > 0 ? sum.template operator()<true>(k) : sum.template operator()<false>(k);
    });
}

} // namespace plash

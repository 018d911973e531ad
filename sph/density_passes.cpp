#include "sph/pair_passes.h"

#include <algorithm>

namespace plash {

namespace {

/// All pairs of a run. Flattened, so that sums and the opened particle stay in registers over the run.
template <bool diffusive, class K>
[[gnu::flatten]] void sum_rates_of_run(const MotionRecord* records, const NeighbourRun& run, int dimension,
                                       double half_step, double* rate, const DensityDiffusion& diffusion,
                                       double* spread)
{
    DensityRate<Lanes, K, diffusive> pass(records, run.begin, dimension, half_step, rate, diffusion, spread);
    walk_pairs<Lanes>(run, pass);
}

template <bool diffusive, class K>
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
        sum_rates_of_run<diffusive, K>(arrays.motion.data(), run, dimension, half_step, rate, diffusion,
                                       spread);
    }
}

} // namespace

void sum_density_rates(Kernel kernel, int dimension, double half_step, const std::vector<NeighbourRun>& runs,
                       ParticleArrays& arrays, const DensityDiffusion& diffusion)
{
    with_kernel(kernel, [&]<class K>(K) {
        if (diffusion.strength > 0) {
            sum_rates<true, K>(dimension, half_step, diffusion, runs, arrays);
        } else {
            sum_rates<false, K>(dimension, half_step, diffusion, runs, arrays);
        }
    });
}

} // namespace plash

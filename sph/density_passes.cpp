#include "sph/density_rate.h"
#include "sph/pair_passes.h"

#include <algorithm>

namespace plash {

void sum_density_rates(Kernel kernel, int dimension, double half_step, const std::vector<NeighbourRun>& runs,
                       ParticleArrays& arrays)
{
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
    with_kernel(kernel, [&]<class K>(K) {
#pragma omp parallel for schedule(dynamic) if (count > 1)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const NeighbourRun& run = runs[i];
            double* rate = arrays.rate.data() + run.begin;
            std::fill_n(rate, run.length(), 0.0);
            DensityRate<Lanes, K> pass(arrays.motion.data(), run.begin, dimension, half_step, rate);
            walk_pairs<Lanes>(run, pass);
        }
    });
}

} // namespace plash

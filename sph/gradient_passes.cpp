#include "sph/pair_passes.h"

#include <algorithm>

namespace plash {

void sum_velocity_gradients(Kernel kernel, int dimension, double half_step,
                            const std::vector<NeighbourRun>& runs, const ParticleArrays& arrays,
                            const std::function<void(const NeighbourRun&, const GradientSums*)>& take)
{
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
    with_kernel(kernel, [&]<class K>(K) {
#pragma omp parallel if (count > 1)
        {
            std::vector<GradientSums> sums(longest_of(runs));
#pragma omp for schedule(dynamic)
            for (std::ptrdiff_t i = 0; i < count; ++i) {
                const NeighbourRun& run = runs[i];
                std::fill_n(sums.begin(), run.length(), GradientSums{});
                VelocityGradient<Lanes, K> pass(arrays.motion.data(), run.begin, dimension, half_step,
                                                sums.data());
                walk_pairs<Lanes>(run, pass);
                take(run, sums.data());
            }
        }
    });
}

} // namespace plash

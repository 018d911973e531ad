#include "sph/pair_passes.h"
#include "sph/rings.h"

#include <algorithm>

namespace plash {

namespace {

template <class K, bool rings>
void sum_gradients(int dimension, double half_step, const std::vector<NeighbourRun>& runs,
                   const ParticleArrays& arrays,
                   const std::function<void(const NeighbourRun&, const GradientSums*)>& take)
{
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
#pragma omp parallel if (count > 1)
    {
        std::vector<GradientSums> sums(longest_of(runs));
#pragma omp for schedule(dynamic)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const NeighbourRun& run = runs[i];
            std::fill_n(sums.begin(), run.length(), GradientSums{});
            VelocityGradient<Lanes, K, rings> pass(arrays.motion.data(), run.begin, dimension, half_step,
                                                   sums.data());
            walk_pairs<Lanes>(run, pass);
            take(run, sums.data());
        }
    }
}

} // namespace

void sum_velocity_gradients(Kernel kernel, int dimension, double half_step,
                            const std::vector<NeighbourRun>& runs, const ParticleArrays& arrays,
                            const std::function<void(const NeighbourRun&, const GradientSums*)>& take)
{
    with_kernel(kernel, [&]<class K>(K) {
        const auto sum = are_rings(arrays) ? sum_gradients<K, true> : sum_gradients<K, false>;
        sum(dimension, half_step, runs, arrays, take);
    });
}

} // namespace plash

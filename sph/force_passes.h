#pragma once

#include "sph/pair_passes.h"

#include <algorithm>

namespace plash {

/// The force loop with scalar or tensor push; each is instantiated in a file of its own.
template <bool tensor>
void sum_forces(Kernel kernel, int dimension, const ArtificialViscosity& viscosity,
                const std::vector<NeighbourRun>& runs, const ParticleArrays& arrays,
                const std::function<void(const NeighbourRun&, const ForceSums*)>& take)
{
    const auto count = static_cast<std::ptrdiff_t>(runs.size());
    const PairRecords records{arrays.motion.data(), arrays.push.data(),
                              tensor ? arrays.tension.data() : nullptr};
    with_kernel(kernel, [&]<class K>(K) {
#pragma omp parallel if (count > 1)
        {
            std::vector<ForceSums> sums(longest_run);
#pragma omp for schedule(dynamic)
            for (std::ptrdiff_t i = 0; i < count; ++i) {
                const NeighbourRun& run = runs[i];
                std::fill_n(sums.begin(), run.length(), ForceSums{});
                PairForce<Lanes, K, tensor> pass(records, run.begin, dimension, viscosity, sums.data());
                walk_pairs<Lanes>(run, pass);
                take(run, sums.data());
            }
        }
    });
}

extern template void sum_forces<false>(Kernel, int, const ArtificialViscosity&,
                                       const std::vector<NeighbourRun>&, const ParticleArrays&,
                                       const std::function<void(const NeighbourRun&, const ForceSums*)>&);
extern template void sum_forces<true>(Kernel, int, const ArtificialViscosity&,
                                      const std::vector<NeighbourRun>&, const ParticleArrays&,
                                      const std::function<void(const NeighbourRun&, const ForceSums*)>&);

} // namespace plash

#pragma once

#include "sph/pair_passes.h"

#include <algorithm>

namespace plash {

/// All pairs of a run. Flattened, so that sums and the opened particle stay in registers over the run.
template <class K, bool tensor, bool rings>
[[gnu::flatten]] void sum_forces_of_run(const PairRecords& records, const NeighbourRun& run, int dimension,
                                        const ArtificialViscosity& viscosity, ForceSums* sums)
{
    PairForce<Lanes, K, tensor, rings> pass(records, run.begin, dimension, viscosity, sums);
    walk_pairs<Lanes>(run, pass);
}

/// The force loop with scalar or tensor push, of particles or rings; each is instantiated in a file of its
/// own.
template <bool tensor, bool rings>
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
            std::vector<ForceSums> sums(longest_of(runs));
#pragma omp for schedule(dynamic)
            for (std::ptrdiff_t i = 0; i < count; ++i) {
                const NeighbourRun& run = runs[i];
                std::fill_n(sums.begin(), run.length(), ForceSums{});
                sum_forces_of_run<K, tensor, rings>(records, run, dimension, viscosity, sums.data());
                take(run, sums.data());
            }
        }
    });
}

using SumForces = void(Kernel, int, const ArtificialViscosity&, const std::vector<NeighbourRun>&,
                       const ParticleArrays&,
                       const std::function<void(const NeighbourRun&, const ForceSums*)>&);

extern template SumForces sum_forces<false, false>;
extern template SumForces sum_forces<true, false>;
extern template SumForces sum_forces<false, true>;
extern template SumForces sum_forces<true, true>;

} // namespace plash

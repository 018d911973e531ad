#include "sph/force_passes.h"

namespace plash {

template void sum_forces<false>(Kernel, int, const ArtificialViscosity&, const std::vector<NeighbourRun>&,
                                const ParticleArrays&,
                                const std::function<void(const NeighbourRun&, const ForceSums*)>&);

void sum_pair_forces(Kernel kernel, int dimension, const ArtificialViscosity& viscosity,
                     const std::vector<NeighbourRun>& runs, const ParticleArrays& arrays,
                     const std::function<void(const NeighbourRun&, const ForceSums*)>& take)
{
    const auto sum = arrays.tension.empty() ? sum_forces<false> : sum_forces<true>;
    sum(kernel, dimension, viscosity, runs, arrays, take);
}

} // namespace plash

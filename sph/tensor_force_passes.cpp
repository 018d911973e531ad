#include "sph/force_passes.h"

namespace plash {

template void sum_forces<true>(Kernel, int, const ArtificialViscosity&, const std::vector<NeighbourRun>&,
                               const ParticleArrays&,
                               const std::function<void(const NeighbourRun&, const ForceSums*)>&);

} // namespace plash

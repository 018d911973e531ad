#include "sph/force_passes.h"

#include "sph/rings.h"

namespace plash {

template SumForces sum_forces<false, false>;

void sum_pair_forces(Kernel kernel, int dimension, const ArtificialViscosity& viscosity,
                     const std::vector<NeighbourRun>& runs, const ParticleArrays& arrays,
                     const std::function<void(const NeighbourRun&, const ForceSums*)>& take)
{
    const bool tensor = !arrays.tension.empty();
    SumForces* const of_rings = tensor ? sum_forces<true, true> : sum_forces<false, true>;
    SumForces* const of_particles = tensor ? sum_forces<true, false> : sum_forces<false, false>;
    (are_rings(arrays) ? of_rings : of_particles)(kernel, dimension, viscosity, runs, arrays, take);
}

} // namespace plash

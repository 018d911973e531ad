#pragma once

#include "sph/kernels.h"
#include "sph/pair_force.h"
#include "sph/particle_arrays.h"
#include "sph/velocity_gradient.h"

#include <functional>
#include <vector>

/// The pair loops of a step over all runs, in lanes, on all threads.
namespace plash {

/// Fills arrays.rate. half_step: half of the step that ends at n [time].
void sum_density_rates(Kernel, int dimension, double half_step, const std::vector<NeighbourRun>&,
                       ParticleArrays&);

/// Calls take(run, sums) once for every run, with the sums of its particles in order.
void sum_velocity_gradients(Kernel, int dimension, double half_step, const std::vector<NeighbourRun>&,
                            const ParticleArrays&,
                            const std::function<void(const NeighbourRun&, const GradientSums*)>& take);

/// Calls take(run, sums) once for every run, with the sums of its particles in order, from arrays.motion and
/// arrays.push, and from arrays.tension if it is there.
void sum_pair_forces(Kernel, int dimension, const ArtificialViscosity&, const std::vector<NeighbourRun>&,
                     const ParticleArrays&,
                     const std::function<void(const NeighbourRun&, const ForceSums*)>& take);

} // namespace plash

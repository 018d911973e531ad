#pragma once

#include "sph/density_rate.h"
#include "sph/kernels.h"
#include "sph/pair_force.h"
#include "sph/particle_arrays.h"
#include "sph/particle_drift.h"
#include "sph/velocity_gradient.h"

#include <functional>
#include <vector>

/// The pair loops of a step over all runs, in lanes, on all threads.
namespace plash {

/// Fills arrays.rate, and arrays.diffusion (which must have its size) if there is any diffusion.
/// half_step: half of the step that ends at n [time].
void sum_density_rates(Kernel, int dimension, double half_step, const std::vector<NeighbourRun>&,
                       ParticleArrays&, const DensityDiffusion& = {});

/// Calls take(run, sums) once for every run, with the sums of its particles in order.
void sum_velocity_gradients(Kernel, int dimension, double half_step, const std::vector<NeighbourRun>&,
                            const ParticleArrays&,
                            const std::function<void(const NeighbourRun&, const GradientSums*)>& take);

/// Calls take(run, sums) once for every run, with the sums of its particles in order, from arrays.motion and
/// arrays.push, and from arrays.tension if it is there.
void sum_pair_forces(Kernel, int dimension, const ArtificialViscosity&, const std::vector<NeighbourRun>&,
                     const ParticleArrays&,
                     const std::function<void(const NeighbourRun&, const ForceSums*)>& take);

/// Calls take(run, sums) once for every run.
void sum_drifts(Kernel, int dimension, bool volume_weighted, const std::vector<NeighbourRun>&,
                const ParticleArrays&,
                const std::function<void(const NeighbourRun&, const DriftSums*)>& take);

/// Monaghan's artificial pressure in tension; only `force`, `viscous_force` (the same) and `heat` are filled.
void sum_tensile_forces(Kernel, int dimension, bool volume_weighted, double strength,
                        const std::vector<NeighbourRun>&, const ParticleArrays&,
                        const std::function<void(const NeighbourRun&, const ForceSums*)>& take);

/// Laminar viscosity along differences of velocity; only `force`, `viscous_force` (the same) and `heat` are
/// filled.
void sum_laminar_forces(Kernel, int dimension, const std::vector<NeighbourRun>&, const ParticleArrays&,
                        const std::function<void(const NeighbourRun&, const ForceSums*)>& take);

/// Density of each particle from the masses and volumes around it, by sorted place.
std::vector<double> filtered_densities(Kernel, int dimension, bool volume_weighted,
                                       const std::vector<NeighbourRun>&, const ParticleArrays&);

} // namespace plash

#pragma once

#include "sph/particle_body.h"

#include <memory>
#include <string_view>
#include <vector>

namespace plash {

/// The particles of a Model as bodies that do not see each other (one, at present); adds their masses to
/// state.mass. Empty without *ELEMENT_SPH. DeckError when a deck asks for what is not there.
std::vector<std::unique_ptr<ParticleBody>> make_particle_bodies(const Model& model, State& state);

/// The law of a part of particles, and what it sets of the part's constants.
struct ParticleLawOfPart {
    std::shared_ptr<const ParticleLaw> law;
    double density = 0;           ///< reference [mass/volume]
    double laminar_viscosity = 0; ///< [stress time]
    double viscosity_by_size = 0; ///< further, over the edge that a particle fills [stress time/length]
};
ParticleLawOfPart particle_law_of(const Model& model, const Part& part);

/// The material records that particles can have, by canonical keyword.
std::vector<std::string_view> particle_material_keywords();

/// *CONTROL_SPH and *BOUNDARY_SPH_...: how particles act on each other.
ParticleOptions particle_options_of(const Model& model);

/// Smoothing length at the start of the particles of a part, which stand at `positions` [length].
double initial_smoothing(const Model& model, Index part, const std::vector<Vec3>& positions);

/// LS-DYNA's measure of the spacing of some particles: the largest of their distances to the nearest one
/// [length].
double particle_spacing(const std::vector<Vec3>& positions);

} // namespace plash

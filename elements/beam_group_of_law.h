#pragma once

#include "elements/beam_group.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace plash {

/// Completes the settings of a group with what its law knows.
template <class Law>
void take_law(const Law& law, BeamSettings& settings)
{
    settings.density = law.density;
    settings.young_modulus = law.young_modulus;
    settings.shear_modulus = law.young_modulus / (2 * (1 + law.poisson_ratio));
    settings.wave_speed = std::sqrt(law.young_modulus / law.density);
    if constexpr (requires { law.failure_strain; }) settings.points_fail = law.failure_strain > 0;
}

/// The group of a part whose material is Law, in the formulation of its section.
template <class Law>
std::unique_ptr<Term> make_beams_of_law(const BeamPart& part, BeamSettings settings, Law law, State& state)
{
    take_law(law, settings);
    switch (settings.section.formulation) {
    case 3:
        return std::make_unique<BeamGroup<Truss, Law>>(part, state, std::move(settings), std::move(law));
    case 2:
        throw DeckError(part.model.parts[part.part].where,
                        fmt::format("*PART {}: resultant beams (ELFORM 2) have *MAT_ELASTIC only; give "
                                    "this material to ELFORM 1",
                                    part.model.parts[part.part].id));
    default:
        return std::make_unique<BeamGroup<IntegratedBeam, Law>>(part, state, std::move(settings),
                                                                std::move(law));
    }
}

} // namespace plash

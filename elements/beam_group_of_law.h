#pragma once

#include "elements/beam_group.h"
#include "elements/eroding_law.h"
#include "materials/parameters.h"

#include <algorithm>
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

/// The group of a part with a law and settings that are complete.
template <class Law>
std::unique_ptr<Term> make_beams_of_settings(const BeamPart& part, BeamSettings settings, Law law,
                                             State& state)
{
    switch (settings.section.formulation) {
    case 3:
        return std::make_unique<BeamGroup<Truss, Law>>(part, state, std::move(settings), std::move(law));
    case 2:
        throw DeckError(part.model.parts[part.part].where,
                        fmt::format("*PART {}: resultant beams (ELFORM 2) have *MAT_ELASTIC only, and no "
                                    "*MAT_ADD_EROSION; give this material to ELFORM 1",
                                    part.model.parts[part.part].id));
    default:
        return std::make_unique<BeamGroup<IntegratedBeam, Law>>(part, state, std::move(settings),
                                                                std::move(law));
    }
}

/// The group of a part whose material is Law, in the formulation of its section.
template <class Law>
std::unique_ptr<Term> make_beams_of_law(const BeamPart& part, BeamSettings settings, Law law, State& state)
{
    take_law(law, settings);
    const Model& model = part.model;
    const auto criteria = erosion_criteria(model, model.materials[model.parts[part.part].material]);
    if (!criteria) return make_beams_of_settings(part, std::move(settings), std::move(law), state);
    const int points =
        settings.section.formulation == 3 ? 1 : static_cast<int>(settings.section.points.size());
    settings.points_to_erode = criteria->failed_points(points);
    settings.failure_time =
        std::min(settings.failure_time, criteria->failure_time.value_or(settings.failure_time));
    return make_beams_of_settings(part, std::move(settings), ErodingLaw<Law>(std::move(law), *criteria),
                                  state);
}

} // namespace plash

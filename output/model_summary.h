#pragma once

#include "core/results.h"
#include "model/model.h"

#include <string>
#include <vector>

namespace plash {

/// What the whole model weighs at the start, mass scaling included.
struct MassSummary {
    double mass = 0;        ///< [mass]
    Vec3 center{};          ///< of mass [length]
    double added_ratio = 0; ///< mass that mass scaling has added over the mass of the deck [-]
    std::vector<ElementResults::PartMotion> parts; ///< by part of the Model
    /// What mass scaling has added, by term of the scene.
    std::vector<std::pair<std::string, double>> added;
};

/// The text of d3hsp: what was read, parts with their masses, the centre of mass, what is driven and loaded,
/// and the elements with the smallest stable steps (at most 100, the smallest first).
std::string format_d3hsp(const Model&, const MassSummary&, std::vector<ElementResults::ElementStep> steps);

/// Writes DIRECTORY/d3hsp in one move. RunError.
void write_d3hsp(const std::string& directory, const Model&, const MassSummary&,
                 std::vector<ElementResults::ElementStep> steps);

} // namespace plash

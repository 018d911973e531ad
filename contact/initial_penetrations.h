#pragma once

#include "contact/touch.h"

#include <string>

namespace plash {

/// A node that lies within the contact thickness of a facet before the first cycle.
struct InitialPenetration {
    Index node = none;  ///< of the mesh
    Index facet = none; ///< of the mesh
    double depth = 0;   ///< [length]
};

/// All of them, deepest first. `search` finds its pairs for them; they count as not looked at afterwards.
std::vector<InitialPenetration> initial_penetrations(const Contact& contact, const ContactMesh& mesh,
                                                     PairSearch& search, const State& state);

/// Lines for people: a summary and the deepest ten.
std::vector<std::string> describe(const std::vector<InitialPenetration>& penetrations, const Contact& contact,
                                  const ContactMesh& mesh, const Model& model);

} // namespace plash

#pragma once

#include "model/record.h"

#include <array>
#include <vector>

namespace plash {

/// *DEFINE_ADAPTIVE_SOLID_TO_SPH: particles of the Model that stand ready in a solid, and take its place once
/// it is deleted.
struct StandIns {
    /// What holds them and the solids beside them together.
    enum class Bond : std::uint8_t {
        none,     ///< ICPL = 0: debris
        at_loss,  ///< ICPL = 1, IOPT = 1: those that have come out of solids are bonded with those that wait
        at_start, ///< ICPL = 1, IOPT = 0: those that wait are neighbours of all particles
    };
    Index solid = none;
    Index first = 0; ///< into Model::particles; as many as `stand_in_weights` has entries
    int per_edge = 1;
    Bond bond = Bond::none;
};

/// Shares of a solid's eight nodes in the places of its stand-ins. A hexahedron has per_edge^3 of them at the
/// middles of equal cells (1, 8, 27), a wedge 1, 6, 18 and a tetrahedron 1, 4, 10 on lattices of the same
/// kind; over all of them every corner has the same share, so that equal masses keep the momentum of the
/// corners' equal ones.
std::vector<std::array<double, 8>> stand_in_weights(const std::array<Index, 8>& nodes, int per_edge);

} // namespace plash

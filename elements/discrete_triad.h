#pragma once

#include "core/state.h"
#include "model/model.h"

#include <array>

namespace plash {

/// How the local axes r, s, t of discrete beams stand and turn (SCOOR, CID, RRCON, SRCON, TRCON of
/// *SECTION_BEAM).
struct TriadRule {
    int scoor = 0;              ///< SCOOR as a whole number
    Index system = none;        ///< CID
    std::array<bool, 3> held{}; ///< the axes do not turn about r, s, t

    int magnitude() const { return scoor < 0 ? -scoor : scoor; }
    /// r follows the line between the nodes.
    bool follows_line() const { return magnitude() == 2 || magnitude() == 12; }
    /// A beam of finite length: shear forces come with the moments that balance them.
    bool balances() const { return magnitude() > 1; }
};

using Triad = std::array<Vec3, 3>;

/// Axes at the start: those of CID, or r along the nodes and s towards the third node (or orientation), or
/// the global ones; r along the nodes where SCOOR asks for it. DeckError.
Triad first_triad(const Model&, Index beam, const TriadRule&);

/// Ends of a beam over a step.
struct TriadEnds {
    Vec3 side{};                      ///< x2 - x1 at n
    Vec3 velocity{};                  ///< v2 - v1
    Vec3 first_spin{}, second_spin{}; ///< of the nodes
};

/// Axes in the middle of the step to n, and at n.
struct TriadStep {
    Triad middle, end;
};

/// Turns the axes with the node or nodes that SCOOR names, or with the nodes of CID.
TriadStep turn_triad(const Triad& before, const TriadRule&, const TriadEnds&, double time_step, const Model&,
                     const State&);

} // namespace plash

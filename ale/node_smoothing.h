#pragma once

namespace plash {

/// How a mesh that goes with its material is smoothed: what part of the way to each of several places a node
/// goes in a step, from where the material has taken it [-]. Of weights that add up to more than one, their
/// mean counts. See ale/hex/hex_smoothing.h.
struct NodeSmoothing {
    double average = 0;       ///< AFAC: simple average
    double volume = 0;        ///< BFAC: volume weighted
    double isoparametric = 0; ///< CFAC
    double equipotential = 0; ///< DFAC
    double back = 0;          ///< EFAC of PRTYPE = 8: to where the node stood at the start; alone

    double sum() const { return average + volume + isoparametric + equipotential + back; }
};

/// When a mesh of PRTYPE = 2 is smoothed, and how: AFAC to DFAC, START, END.
struct MeshSmoothing {
    NodeSmoothing by;
    double start = 0;  ///< [time]
    double end = 1e20; ///< [time]
};

} // namespace plash

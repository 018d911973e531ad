#pragma once

#include "solver/fluids/water.h"

namespace plash {

/// A plane across a global axis that the water does not pass.
struct WaterWall {
    int axis = 0;
    double at = 0;           ///< coordinate of the plane [length]
    bool water_above = true; ///< the water lies towards larger coordinates
    FreedomMask held = 0; ///< translations of the water that the wall holds: its axis, more where it sticks
    std::string origin;   ///< what the deck calls it
};

/// Which rigid walls become walls of the water: all that act on it (DeckError where one cannot), those that
/// can (the others go on as rigid walls), or none.
enum class RigidWalls { all, possible, none };

/// Walls on the sides of the water: outer faces of its solids or mesh whose nodes are held, *CONTROL_ALE EBC,
/// symmetry planes of particles and *RIGIDWALL_PLANAR. DeckError where one is oblique or has no counterpart.
std::vector<WaterWall> walls_of(const Model& model, const Water& water, RigidWalls rigid_walls);

/// A rigid wall acts on some node of the water.
bool acts_on_water(const RigidWall& wall, const Water& water);

} // namespace plash

#pragma once

#include "solver/fluids/fluid_choice.h"

#include <array>
#include <vector>

namespace plash {

/// A piece of water that fills a hexahedron: an element, a cell, or the box that belongs to a particle.
struct WaterPiece {
    Index part = none;
    std::array<Vec3, 8> corners; ///< in the order of *ELEMENT_SOLID [length]
    double size = 0;             ///< cubic root of its volume [length]
};

/// The fluids of a Model with all that is theirs, as its deck has them. Fluids are *MAT_NULL with an equation
/// of state on solids, particles or an Eulerian mesh.
struct Water {
    std::vector<Index> parts;   ///< that hold fluid
    std::vector<bool> is_water; ///< by part of the Model: fluid, or part of an Eulerian mesh
    std::vector<bool> has_node; ///< by node of the Model: of a piece or of an Eulerian mesh
    bool solids = false, particles = false, mesh = false; ///< what the pieces come from
    std::vector<WaterPiece> pieces;
    Vec3 low{}, high{};               ///< box around the pieces [length]
    double smallest_size = 0;         ///< of the pieces; where there are particles, of theirs [length]
    bool lattice = true;              ///< boxes of particles fill the space without gaps
    std::vector<std::string> remarks; ///< what was left away, for the user

    bool is_already(FluidForm form) const;
    double volume() const; ///< [length^3]
};

/// DeckError where the fluid is of a kind that cannot be taken apart.
Water find_water(const Model& model);

/// Corners of a box in the order of *ELEMENT_SOLID.
std::array<Vec3, 8> box_corners(const Vec3& low, const Vec3& high);

/// Point of a hexahedron at local coordinates between 0 and 1.
Vec3 point_in(const std::array<Vec3, 8>& corners, double r, double s, double t);

/// Volume of a hexahedron (Grandy 1997) [length^3].
double volume_of(const std::array<Vec3, 8>& corners);

/// Density of a fluid part [density].
double density_of(const Model& model, Index part);

} // namespace plash

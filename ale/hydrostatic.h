#pragma once

#include "ale/deck_groups.h"
#include "ale/fluid.h"
#include "ale/mesh_block.h"

#include <functional>
#include <optional>

namespace plash {

/// Pressures at rising depths below a free surface, dp/ds = density(p, s) g, by SUNDIALS' CVODE (variable
/// order Adams method; Hindmarsh et al. 2005, ACM Trans. Math. Softw. 31, 363-396), to a relative tolerance
/// of 1e-10. top  pressure at depth zero [pressure]
std::vector<double> pressures_below(double top,
                                    const std::function<double(double pressure, double depth)>& density,
                                    double gravity, const std::vector<double>& depths);

/// Density at which a fluid has a pressure, at a given energy per mass (Newton's method) [density].
double density_at_pressure(const FluidGroup& fluid, double pressure, double energy_per_mass);

/// Where a fluid at rest ends.
struct StillLevel {
    Vec3 down;    ///< unit, along gravity
    Vec3 surface; ///< a point of the free surface [length]

    double depth(const Vec3& point) const { return dot(down, point - surface); }
    /// Share of a cell's height that lies below the free surface.
    double wet_share(const FluidCell& cell) const;
};

/// *INITIAL_HYDROSTATIC_ALE: compresses the fluids of a mesh, which is filled already, so that they rest
/// under gravity: layers of one group each, every one below a node. A cell that the free surface passes has
/// the pressure at half its height, which balances on the mesh if its fraction is the share of its height
/// that is wet: cells with level ends that are no boxes are filled so. Nothing comes back where the deck
/// has none for this mesh.
std::optional<StillLevel> set_hydrostatic_state(Fluid& fluid, const MeshBlock& block,
                                                const DeckGroups& groups, const Model& model);

} // namespace plash

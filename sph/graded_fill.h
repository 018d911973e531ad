#pragma once

#include "math/vector3.h"
#include "model/contact.h"

#include <vector>

namespace plash {

/// Particles that fill a box, fine in one place and coarse elsewhere.
struct GradedFill {
    Box box;             ///< that they fill
    Box fine_box;        ///< where their spacing is `fine`
    double fine = 0;     ///< [length]
    double coarse = 0;   ///< [length]
    double growth = 0.1; ///< of the spacing by the distance from the fine box [-]
    int iterations = 200;

    /// Wanted spacing at a point [length].
    double spacing_at(const Vec3& point) const;
};

struct GradedParticles {
    std::vector<Vec3> position;
    std::vector<double> volume; ///< of each, together that of the box
};

/// Fills the box by weighted Voronoi tessellation (Diehl, Rockefeller, Fryer, Riethmiller & Statler 2012,
/// arXiv:1211.0525): particles push each other away by (R / r)^2 - 1, R being their mean kernel radius, until
/// they stand evenly in the metric of the wanted spacing. They start from a quasi-random sequence, the same
/// in every run. The faces of the box mirror them, so that they stand along them as in a lattice (a box's
/// case of Groenenboom's boundaries of any shape).
///
/// Each push is weighed by h_j / h_i here. Without it the mean push of a graded distribution of density n is
/// in proportion to R^2 grad(n R^2), at rest where n goes with R^-2: kernels summed up to 0.4 instead of 1 at
/// the finest of particles of five to one. With the weight it is at rest at n ~ R^-3, as it must be.
GradedParticles fill_graded(const GradedFill& fill);

/// How evenly the neighbours of each particle stand around it: the largest over the smallest eigenvalue of
/// their inertia tensor, the sum of V W(r) r r^T within twice 1.3 spacings, mirrors at the box's faces
/// included. 1 in a lattice.
std::vector<double> eigenvalue_ratios(const GradedFill& fill, const GradedParticles& particles);

} // namespace plash

#pragma once

#include "solver/static_trials.h"

#include <memory>

namespace plash {

/// Stiffness of the elements of a scene, factorised: the preconditioner of the static start.
///
/// Which nodes share an element is known, so columns of nodes that no row sees together are found by one
/// central difference (Curtis, Powell & Reid 1974, J. Inst. Maths Applics 13, 117-119): 27 nodes at once in a
/// regular mesh of solids, 9 in one of shells, however large it is. What is factorised is
///
///     K + s M,  K = -(M da/du + transpose) / 2,
///
/// with the smallest shift s of a series for which it is positive definite: fluids and drilling rotations
/// have no stiffness, and water that hangs together by its pressures alone a negative one. Contacts, ties and
/// couplings with what is not of the element are left to GMRES; so are rigid bodies and particles, which
/// count with one common stiffness. Where a factorisation would take too long, all nodes do.
class StaticTangent {
public:
    explicit StaticTangent(const StaticTrials& trials);
    ~StaticTangent();
    StaticTangent(const StaticTangent&) = delete;
    StaticTangent& operator=(const StaticTangent&) = delete;

    /// It knows the stiffness of some elements.
    bool of_elements() const { return !colours_.empty(); }

    /// K at displacements [length], by differences over `length`; to be factorised anew.
    void measure(StaticTrials& trials, const double* displacement, double length);

    /// With the first of `least_shift`, four times that ... [1/time^2] for which K + s M is positive
    /// definite.
    void factorise(double least_shift);

    /// Displacements that change accelerations by these: an approximate inverse of da/du.
    void solve(const double* accelerations, double* displacement) const;

    double largest() const { return largest_; } ///< of the diagonal of K over M [1/time^2]
    double shift() const { return shift_; }     ///< s [1/time^2]

private:
    struct Factors;
    std::vector<Freedom> freedoms_;
    std::vector<char> of_element_;           ///< freedom: it belongs to an element and to no rigid body
    std::vector<std::vector<Index>> nearby_; ///< freedom: those with an element in common, itself among them
    std::vector<std::vector<Index>> colours_;
    std::size_t unknowns_;
    std::unique_ptr<Factors> factors_;
    double shift_ = 0, largest_ = 0;

    void find_nearby(const Model& model);
    void paint();
    void set_up_factors();
    template <class Visit>
    void for_entries(Index freedom, int component, Visit&& visit) const;
};

} // namespace plash

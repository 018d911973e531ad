#pragma once

#include "core/clock.h"
#include "rigid/rigid_body.h"

#include <vector>

namespace plash {

/// One scalar condition on the motion of two rigid bodies. Bodies are positions in the list of bodies; `none`
/// is the ground, whose axes are the global ones and whose center is the origin.
///
/// Position conditions hold at n+1:
///   point     axis1 . (place of arm2 - place of arm1) = target
///   distance  |center 2 - center 1| = target
///   angle     axis1 . axis2 = target
/// Rate conditions hold over the step from n to n+1, with directions of mid-step:
///   rate    slide axis1 . (velocity of arm2 past body 1) + turn axis1 . (omega2 - omega1)
///           + turn2 axis2 . (omega2 - omega1) + spin1 axis1 . omega1 + spin2 axis2 . omega2 + run2 axis2 .
///           (velocity of arm2) = target
struct BodyRow {
    enum class Kind { point, distance, angle, rate };
    Kind kind = Kind::point;
    Index first = none, second = none;
    Vec3 arm1{}, arm2{};   ///< in the axes of their bodies, from the centers
    Vec3 axis1{}, axis2{}; ///< unit vectors in the axes of their bodies
    double target = 0;
    double slide = 0, turn = 0, turn2 = 0, spin1 = 0, spin2 = 0, run2 = 0;
    bool active = true;
    bool one_sided = false; ///< the second body alone is pushed; the first goes its own way
    bool dead = false;      ///< one of its bodies is no more (a failed weld)
    double impulse = 0;     ///< of the last step, along the condition: the next step starts from it
};

/// Finds the impulses that make bodies keep their conditions, by Newton's method on the end of the step:
/// SHAKE (Ryckaert, Ciccotti & Berendsen 1977) for the position conditions, so that the constrained leapfrog
/// stays symplectic and joints do not drift, with the matrix J W J^T of the start of the step factored once.
/// Conditions that others imply (a plane linkage has them) are found by their vanishing pivot and left out.
class BodyRows {
public:
    std::vector<BodyRow> rows;

    /// Momenta at the start of a step, before any condition acts: translation and rotation of each body.
    struct Momenta {
        Vec3 linear{}, angular{};
    };

    /// Orders the work: call when all rows are there.
    void prepare(std::size_t body_count);
    bool empty() const { return rows.empty(); }
    const std::vector<bool>& touched() const { return touched_; } ///< by body: some row speaks of it

    /// Changes velocity, angular momentum and angular velocity of the bodies so that the active conditions
    /// hold over the step. Bodies stand at n; their new velocities, without conditions, are there already.
    void satisfy(std::vector<RigidBody>& bodies, const Clock& clock);

    /// Makes the velocities at the start fit all conditions (an inelastic jerk); rows whose target is not a
    /// velocity are left out by the caller through `active`.
    void project_start(std::vector<RigidBody>& bodies);

    /// Force and moment that a row puts on its second body at its center, for a unit impulse.
    Momenta second_direction(std::size_t row) const;

private:
    /// Direction of a row in the velocities of its two bodies.
    struct Gradient {
        Vec3 linear1{}, angular1{}, linear2{}, angular2{};
    };
    struct Pose {
        Vec3 center{};
        Matrix3 orientation = Matrix3::identity();
    };
    std::vector<bool> touched_;
    std::vector<Gradient> gradients_;
    std::vector<Matrix3> linear_mobility_, angular_mobility_;
    std::vector<Pose> start_, middle_, end_;
    std::vector<double> matrix_, error_;
    std::vector<std::size_t> begin_, first_column_;
    std::vector<bool> dropped_;

    static Gradient gradient_of(const BodyRow& row, const Pose& first, const Pose& second);
    static double rate_of(const Gradient& gradient, const BodyRow& row, const std::vector<RigidBody>& bodies);
    Pose pose(Index body, const std::vector<Pose>& poses) const;
    void linearise(const std::vector<RigidBody>& bodies);
    void factor();
    void solve(std::vector<double>& values) const;
    void apply(std::size_t row, double impulse, std::vector<RigidBody>& bodies) const;
    double end_error(const BodyRow& row, const std::vector<RigidBody>& bodies, double step) const;
};

} // namespace plash

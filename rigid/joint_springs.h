#pragma once

#include "core/archive.h"
#include "core/clock.h"
#include "model/model.h"
#include "rigid/rigid_body.h"

namespace plash {

/// *CONSTRAINED_JOINT_STIFFNESS_GENERALIZED and _TRANSLATIONAL: what acts in the freedoms that a joint
/// leaves. Generalized: the Cardan angles phi, theta, psi that turn the axes of the first body into those of
/// the second (about x of the first, the turned y, z of the second; Hallquist 2006, 'Generalized joint
/// stiffness'). Translational: displacement of the second origin along the axes of the first body. In each
/// freedom a force -curve(q) - damping(dq/dt), an elastic-perfectly plastic friction, and elastic stops.
/// Forces are conjugate to the freedoms, so that their work is the sum of force times change of freedom.
class JointSpring {
public:
    JointSpring(const JointStiffness& card, Index first, Index second, const std::vector<RigidBody>& bodies);

    struct Push {
        Vec3 force{}, moment{}; ///< on the second body at its second origin; the first gets the opposite
        Vec3 place{};
    };
    /// Forces at n from the places at n; books the work of the last step.
    Push act(const Model& model, const std::vector<RigidBody>& bodies, const Clock& clock);

    Index first() const { return first_; }
    Index second() const { return second_; }
    const JointStiffness& card() const { return *card_; }
    /// What has gone into the spring: stored, damped or lost in friction [energy].
    double energy() const { return energy_; }
    const std::array<double, 3>& force() const { return force_; }
    const std::array<double, 3>& freedom() const { return freedom_; }

    /// Largest stable step of the springs and stops on their two bodies [time].
    double stable_step(const Model& model, const std::vector<RigidBody>& bodies) const;

    void serialise(Archive& archive) { archive(freedom_, friction_, force_, energy_, started_); }

private:
    const JointStiffness* card_;
    Index first_, second_;
    std::array<Vec3, 3> axes1_, axes2_; ///< in the bodies' axes
    Vec3 arm1_, arm2_;
    // -- what changes
    std::array<double, 3> freedom_{}; ///< [radian] or [length] at the last n
    std::array<double, 3> friction_{};
    std::array<double, 3> force_{}; ///< on the second body, along the freedom
    double energy_ = 0;
    bool started_ = false;

    std::array<double, 3> freedoms_now(const std::vector<RigidBody>& bodies) const;
};

} // namespace plash

#include "rigid/joint_springs.h"

#include "core/prescribed_rate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plash {

JointSpring::JointSpring(const JointStiffness& card, Index first, Index second,
                         const std::vector<RigidBody>& bodies)
    : card_(&card), first_(first), second_(second)
{
    const RigidBody &a = bodies[first], &b = bodies[second];
    for (int i = 0; i < 3; ++i) {
        axes1_[i] = transpose(a.orientation) * card.first_axes[i];
        axes2_[i] = transpose(b.orientation) * card.second_axes[i];
    }
    arm1_ = transpose(a.orientation) * (card.first_origin - a.center);
    arm2_ = transpose(b.orientation) * (card.second_origin - b.center);
}

std::array<double, 3> JointSpring::freedoms_now(const std::vector<RigidBody>& bodies) const
{
    const RigidBody &a = bodies[first_], &b = bodies[second_];
    std::array<double, 3> now{};
    if (card_->translational) {
        const Vec3 apart = (b.center + b.orientation * arm2_) - (a.center + a.orientation * arm1_);
        for (int i = 0; i < 3; ++i) now[i] = dot(apart, a.orientation * axes1_[i]);
        return now;
    }
    const auto q = [&](int i, int j) { return dot(a.orientation * axes1_[i], b.orientation * axes2_[j]); };
    now = {std::atan2(-q(1, 2), q(2, 2)), std::asin(std::clamp(q(0, 2), -1.0, 1.0)),
           std::atan2(-q(0, 1), q(0, 0))};
    if (!started_) return now;
    for (int i : {0, 2}) // several turns count on
        now[i] = freedom_[i] + std::remainder(now[i] - freedom_[i], 2 * std::numbers::pi);
    return now;
}

JointSpring::Push JointSpring::act(const Model& model, const std::vector<RigidBody>& bodies,
                                   const Clock& clock)
{
    const std::array<double, 3> now = freedoms_now(bodies);
    for (int i = 0; i < 3; ++i) {
        const JointStiffness::Freedom& freedom = card_->freedoms[i];
        const double q = now[i], change = started_ ? q - freedom_[i] : 0;
        double force = 0;
        if (freedom.stiffness_curve != none) force -= curve_value(model, freedom.stiffness_curve, q);
        if (freedom.damping_curve != none && clock.last_step > 0)
            force -= curve_value(model, freedom.damping_curve, change / clock.last_step);
        if (freedom.elastic > 0) {
            const double limit = freedom.friction_curve != none
                                     ? std::abs(curve_value(model, freedom.friction_curve, q))
                                     : freedom.friction;
            if (limit > 0) {
                friction_[i] = std::clamp(friction_[i] - freedom.elastic * change, -limit, limit);
                force += friction_[i];
            }
            if (freedom.positive_stop != 0 && q > freedom.positive_stop)
                force -= freedom.elastic * (q - freedom.positive_stop);
            if (freedom.negative_stop != 0 && q < freedom.negative_stop)
                force -= freedom.elastic * (q - freedom.negative_stop);
        }
        energy_ -= 0.5 * (force + force_[i]) * change;
        force_[i] = force;
        freedom_[i] = q;
    }
    started_ = true;

    const RigidBody &a = bodies[first_], &b = bodies[second_];
    Push push;
    push.place = b.center + b.orientation * arm2_;
    if (card_->translational) {
        for (int i = 0; i < 3; ++i) push.force += force_[i] * (a.orientation * axes1_[i]);
        return push;
    }
    // The moment whose products with the three (not orthogonal) axes of rotation are the three forces.
    const Vec3 x = a.orientation * axes1_[0], z = b.orientation * axes2_[2];
    const double s = dot(x, z), inverse = 1 / std::max(1 - s * s, 1e-6);
    push.moment = force_[1] * unit(cross(z, x)) + ((force_[0] - s * force_[2]) * inverse) * x +
                  ((force_[2] - s * force_[0]) * inverse) * z;
    return push;
}

double JointSpring::stable_step(const Model& model, const std::vector<RigidBody>& bodies) const
{
    double stiffest = 0;
    for (const JointStiffness::Freedom& freedom : card_->freedoms) {
        double stiffness = freedom.elastic;
        if (freedom.stiffness_curve != none) {
            const Curve& curve = model.curves[freedom.stiffness_curve].curve;
            for (std::size_t i = 0; i + 1 < curve.abscissa.size(); ++i)
                stiffness = std::max(stiffness, std::abs(curve.ordinate[i + 1] - curve.ordinate[i]) /
                                                    (curve.abscissa[i + 1] - curve.abscissa[i]));
        }
        stiffest = std::max(stiffest, stiffness);
    }
    double mobility = 0;
    for (Index index : {first_, second_}) {
        const RigidBody& body = bodies[index];
        const Matrix3 inverse = rotational_mobility(body, body.orientation);
        const double turning = inverse.row[0].x + inverse.row[1].y + inverse.row[2].z;
        const Vec3 arm = index == first_ ? arm1_ : arm2_;
        mobility += card_->translational ? 1 / body.mass + turning * dot(arm, arm) : turning;
    }
    return stiffest > 0 && mobility > 0 ? 2 / std::sqrt(stiffest * mobility) : 1e300;
}

} // namespace plash

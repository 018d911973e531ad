#include "output/nodal_motion.h"

#include "core/parallel.h"
#include "model/eulerian.h"

namespace plash {

namespace {

/// Quotient a node, zero where the divisor is not positive.
std::vector<Vec3> quotient(const std::vector<Vec3>& dividend, const std::vector<double>& divisor)
{
    std::vector<Vec3> result(dividend.size());
    for_chunks(result.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (divisor[i] > 0) result[i] = (1 / divisor[i]) * dividend[i];
        }
    });
    return result;
}

} // namespace

NodalMotion::NodalMotion(const Snapshot& snapshot, bool rotations)
    : state_(snapshot.state), start_(snapshot.model.nodes.position), span_(snapshot.clock.velocity_step())
{
    ElementResults results;
    results.acceleration = quotient(state_.force, state_.mass);
    if (rotations && state_.rotational()) {
        results.angular_acceleration = quotient(state_.moment, state_.inertia);
    }
    if (has_eulerian_mesh(snapshot.model)) {
        results.material_velocity.resize(state_.size());
        for (std::size_t node = 0; node < state_.size(); ++node)
            results.material_velocity[node] = state_.velocity[node] - span_ * results.acceleration[node];
    }
    snapshot.collect(results);
    acceleration_ = std::move(results.acceleration);
    material_velocity_ = std::move(results.material_velocity);
    angular_acceleration_ = std::move(results.angular_acceleration);
}

Vec3 global_velocity(const Snapshot& snapshot, const NodalMotion& motion, const ElementResults& results)
{
    const std::vector<double>& mass = snapshot.state.mass;
    double total_mass = 0;
    Vec3 momentum{};
    for (std::size_t node = 0; node < mass.size(); ++node) {
        if (mass[node] <= 0) continue;
        total_mass += mass[node];
        momentum += mass[node] * motion.velocity(static_cast<Index>(node));
    }
    total_mass += results.rigid_mass;
    momentum += results.rigid_momentum;
    for (const ElementResults::PartMotion& own : results.part_motion) {
        if (!own.outside_state) continue;
        total_mass += own.mass;
        momentum += Vec3{own.momentum[0], own.momentum[1], own.momentum[2]};
    }
    return total_mass > 0 ? (1 / total_mass) * momentum : Vec3{};
}

} // namespace plash

#include "conditions/damping.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"
#include "math/matrix3.h"

namespace plash {

namespace {

/// Nodes of the elements, particles and masses of some parts; all nodes when there are none.
std::vector<bool> damped_nodes(const Model& model, const std::vector<Index>& parts)
{
    std::vector<bool> damped(model.nodes.size(), parts.empty());
    if (parts.empty()) return damped;
    std::vector<bool> wanted(model.parts.size());
    for (Index part : parts) wanted[part] = true;
    for_each_topology(model, [&](const auto& elements) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (!wanted[elements.part[i]]) continue;
            for (Index node : elements.nodes[i]) {
                if (node != none) damped[node] = true;
            }
        }
    });
    for (std::size_t i = 0; i < model.particles.size(); ++i) {
        if (wanted[model.particles.part[i]]) damped[model.particles.node[i]] = true;
    }
    return damped;
}

/// Motion of a rigid part as its nodes have it: mean velocity, and the spin that fits the rest best.
struct RigidMotion {
    Vec3 center{}, velocity{}, spin{};

    Vec3 at(const Vec3& place) const { return velocity + cross(spin, place - center); }
};

RigidMotion motion_of(const std::vector<Index>& nodes, const State& state)
{
    RigidMotion motion;
    if (nodes.empty()) return motion;
    const double share = 1.0 / static_cast<double>(nodes.size());
    for (Index node : nodes) {
        motion.center += share * state.position[node];
        motion.velocity += share * state.velocity[node];
    }
    Matrix3 inertia{};
    Vec3 momentum{};
    for (Index node : nodes) {
        const Vec3 arm = state.position[node] - motion.center;
        const Matrix3 outer = dyad(arm, arm);
        for (int axis = 0; axis < 3; ++axis)
            inertia.row[axis] += dot(arm, arm) * Matrix3::identity().row[axis] - outer.row[axis];
        momentum += cross(arm, state.velocity[node] - motion.velocity);
    }
    const double size = inertia.row[0].x + inertia.row[1].y + inertia.row[2].z;
    if (determinant(inertia) > 1e-9 * size * size * size) motion.spin = inverse(inertia) * momentum;
    return motion;
}

} // namespace

Damping::Damping(const Model& model, const State& state) : model_(model)
{
    for (const NodeDamping& damping : model.dampings) {
        const std::vector<bool> damped = damped_nodes(model, damping.parts);
        const std::size_t begin = nodes_.size();
        for (std::size_t node = 0; node < damped.size(); ++node) {
            const double inertia = state.rotational() ? state.inertia[node] : 0;
            if (!damped[node] || state.mass[node] + inertia == 0) continue;
            nodes_.push_back({static_cast<Index>(node), state.mass[node], inertia});
        }
        groups_.push_back({&damping, begin, nodes_.size()});
    }
    last_.resize(nodes_.size());
}

/// Adds the damping force and moment of one node, and returns them.
Damping::Wrench Damping::damp(const NodeDamping& damping, double rate, const Node& damped, const Clock& clock,
                              State& state, const Vec3& reference, const Vec3& reference_spin) const
{
    const double span = clock.velocity_step();
    const auto add = [&](Vec3& force, const Vec3& velocity, const Vec3& frame, double moving_mass,
                         double own_mass, const double* scale) {
        Vec3 whole{};
        for (int axis = 0; axis < 3; ++axis) {
            const double d = rate * scale[axis];
            const double v = velocity.*vector_component[axis] - frame.*vector_component[axis];
            if (d == 0) continue;
            double added = -d * own_mass * v;
            if (moving_mass > 0) {
                // v+ = [(1 - d h / 2) v + h f / m] / (1 + d h / 2), all relative to the frame
                const double kick = span * (force.*vector_component[axis]) / moving_mass;
                const double next = ((1 - 0.5 * d * span) * v + kick) / (1 + 0.5 * d * span);
                added = moving_mass * (next - v) / span - force.*vector_component[axis];
            }
            force.*vector_component[axis] += added;
            whole.*vector_component[axis] = added;
        }
        return whole;
    };
    const Index node = damped.node;
    Wrench added;
    added.force = add(state.force[node], state.velocity[node], reference, state.mass[node], damped.mass,
                      damping.scale.data());
    if (state.rotational()) {
        added.moment = add(state.moment[node], state.angular_velocity[node], reference_spin,
                           state.inertia[node], damped.inertia, damping.scale.data() + 3);
    }
    return added;
}

void Damping::constrain(const Clock& clock, State& state)
{
    for (const Group& group : groups_) {
        const NodeDamping& damping = *group.damping;
        const bool active = clock.time >= damping.birth && clock.time <= damping.death;
        const double rate = active ? damping.rate * load_value(model_, damping.curve, clock, clock.time) : 0;
        const bool relative = !damping.reference_nodes.empty();
        const RigidMotion frame = relative ? motion_of(damping.reference_nodes, state) : RigidMotion{};
        const double power = sum_chunks(group.end - group.begin, [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t i = group.begin + begin; i < group.begin + end; ++i) {
                const Index node = nodes_[i].node;
                const Vec3 reference = relative ? frame.at(state.position[node]) : Vec3{};
                const Wrench now = damp(damping, rate, nodes_[i], clock, state, reference, frame.spin);
                sum += dot(now.force + last_[i].force, state.velocity[node]);
                if (state.rotational())
                    sum += dot(now.moment + last_[i].moment, state.angular_velocity[node]);
                last_[i] = now;
            }
            return sum;
        });
        work_ += 0.5 * clock.last_step * power;
    }
}

} // namespace plash

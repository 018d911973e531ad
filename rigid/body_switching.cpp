// Bodies that begin and end while the run goes on: welds that fail, and parts that are switched.

#include "rigid/rigid_bodies.h"

#include <utility>

namespace plash {

namespace {

double kinetic_energy_of_nodes(const RigidBody& body, const State& state)
{
    double energy = 0;
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
        const Index node = body.nodes[i];
        energy += 0.5 * body.node_mass[i] * dot(state.velocity[node], state.velocity[node]);
        if (!state.rotational()) continue;
        const Vec3& spin = state.angular_velocity[node];
        energy += 0.5 * body.node_inertia[i] * dot(spin, spin);
    }
    return energy;
}

double kinetic_energy_of(const RigidBody& body)
{
    return 0.5 * body.mass * dot(body.velocity, body.velocity) +
           0.5 * dot(body.angular_velocity, body.angular_momentum);
}

} // namespace

/// The nodes get their masses back and go on with the velocities that the body gave them.
void RigidBodies::release(Index number, State& state)
{
    RigidBody& body = bodies_[number];
    for (BodyRow& row : rows_.rows)
        if (row.first == number || row.second == number) row.dead = true;
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
        state.mass[body.nodes[i]] = body.node_mass[i];
        if (state.rotational()) state.inertia[body.nodes[i]] = body.node_inertia[i];
    }
    body.released = true;
}

/// The nodes become a body with their momentum and angular momentum; what they move past one another is lost.
void RigidBodies::engage(Index number, State& state)
{
    RigidBody& body = bodies_[number];
    std::vector<double> mass, inertia;
    for (Index node : body.nodes) {
        mass.push_back(std::exchange(state.mass[node], 0.0));
        if (state.rotational()) inertia.push_back(std::exchange(state.inertia[node], 0.0));
    }
    const Vec3 first_center = body.first_center;
    const std::vector<Index> nodes = std::move(body.nodes);
    body = rigid_body_of(none, nodes, mass, inertia, state, {});
    body.first_center = first_center;
    body.node_mass = std::move(mass);
    body.node_inertia = std::move(inertia);
    body.acceleration_of_node.resize(nodes.size());
}

/// Kinetic energy at n is the product of the velocities before and after: that of the nodes still had the
/// forces' power on it over half a step, which a body's has not but for its own motion.
void RigidBodies::take_last_work(const Clock& clock, const State& state)
{
    for (Index number : begun_) {
        const RigidBody& body = bodies_[number];
        double power = 0;
        for (Index node : body.nodes) {
            const Vec3 arm = state.position[node] - body.center;
            const Vec3 rigid = body.velocity + cross(body.angular_velocity, arm);
            power += dot(state.force[node], state.velocity[node] - rigid);
            if (state.rotational())
                power += dot(state.moment[node], state.angular_velocity[node] - body.angular_velocity);
        }
        switched_energy_ -= 0.5 * clock.last_step * power;
    }
    begun_.clear();
}

/// Switches act at the end of a step, so that elements have forces and ask for a step of theirs before nodes
/// move by themselves. What kinetic energy a switch takes or adds is booked as external work.
void RigidBodies::after_motion(const Clock& clock, State& state)
{
    if (switches_.empty()) return;
    for (const PartSwitch* one : switches_.act(clock.time + clock.step)) {
        for (Index body : one->release) {
            if (bodies_[body].released) continue;
            release(body, state);
            switches_.wake(body);
            switched_energy_ +=
                kinetic_energy_of_nodes(bodies_[body], state) - kinetic_energy_of(bodies_[body]);
        }
        for (Index body : one->engage) {
            if (!bodies_[body].released) continue;
            engage(body, state);
            begun_.push_back(body);
            switched_energy_ +=
                kinetic_energy_of(bodies_[body]) - kinetic_energy_of_nodes(bodies_[body], state);
        }
    }
}

} // namespace plash

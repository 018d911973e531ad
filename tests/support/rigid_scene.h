#pragma once

#include "rigid/rigid_bodies.h"

#include <cmath>
#include <memory>

namespace plash::testing {

/// A few rigid bodies with joints and a gravity, stepped like the explicit loop does it.
class RigidScene {
public:
    Model model;
    State state;
    Vec3 gravity{};
    Clock clock;

    /// A node at a place; returns its index.
    Index node(const Vec3& place)
    {
        state.position.push_back(place);
        state.velocity.push_back({});
        state.force.push_back({});
        state.mass.push_back(0);
        model.nodes.id.push_back(static_cast<Id>(state.position.size()));
        model.nodes.position.push_back(place);
        return static_cast<Index>(state.position.size()) - 1;
    }

    /// A body with these nodes and mass properties; returns its position.
    Index body(const MassProperties& properties, std::vector<Index> nodes, FreedomMask held = 0)
    {
        model.parts.emplace_back();
        model.parts.back().id = static_cast<Id>(model.parts.size());
        nodes.push_back(node(properties.center)); // so that gravity has something to act on
        state.mass[nodes.back()] = properties.mass;
        std::vector<double> mass(nodes.size(), 0.0);
        mass.back() = properties.mass;
        BodyFixity fixity;
        fixity.freedoms = held;
        RigidBody made = rigid_body_of(static_cast<Index>(bodies_.size()), nodes, mass, {}, state, fixity);
        give_properties(made, properties, state);
        bodies_.push_back(std::move(made));
        return static_cast<Index>(bodies_.size()) - 1;
    }
    RigidBody& draft(Index body) { return bodies_[body]; }

    void joint(Joint::Type type, std::array<Index, 6> nodes, double parameter = 0)
    {
        Joint joint;
        joint.id = static_cast<Id>(model.joints.size()) + 1;
        joint.type = type;
        joint.nodes = nodes;
        joint.parameter = parameter;
        model.joints.push_back(joint);
    }

    /// A motor whose velocity is constant.
    void motor(Joint::Type type, std::array<Index, 6> nodes, double rate)
    {
        model.curves.push_back({1, "", {}, Curve{{0, 1e9}, {rate, rate}}});
        joint(type, nodes);
        model.joints.back().curve = static_cast<Index>(model.curves.size()) - 1;
    }

    void start(double step)
    {
        std::vector<double> gravity_mass = state.mass;
        gravity_mass_ = gravity_mass;
        RigidSetup setup;
        for (std::size_t i = 0; i < bodies_.size(); ++i) setup.of_number.push_back(static_cast<Index>(i));
        setup.bodies = std::move(bodies_);
        bodies = std::make_unique<RigidBodies>(model, std::move(setup), state);
        clock.step = step;
    }

    /// Forces at n, then the bodies move on to n+1. Afterwards `energy` is that of n.
    void step()
    {
        double potential = 0;
        for (std::size_t i = 0; i < state.size(); ++i) {
            state.force[i] = gravity_mass_[i] * gravity;
            potential -= gravity_mass_[i] * dot(gravity, state.position[i]);
        }
        bodies->constrain(clock, state);
        EnergyLedger ledger;
        ledger.open_cycle(model.parts.size());
        bodies->report(ledger);
        kinetic = ledger.kinetic;
        work = ledger.external_work;
        energy = ledger.kinetic + potential;
        for (std::size_t i = 0; i < state.size(); ++i) state.position[i] += clock.step * state.velocity[i];
        clock.time += clock.step;
        clock.last_step = clock.step;
        ++clock.cycle;
    }

    /// Force and moment of a joint at the n of the last step.
    ElementResults::JointForce joint_force(std::size_t number) const
    {
        ElementResults results;
        results.rigid_motions_wanted = true;
        bodies->collect(state, results);
        return results.joints[number];
    }

    std::unique_ptr<RigidBodies> bodies;
    double energy = 0, kinetic = 0, work = 0;

private:
    std::vector<RigidBody> bodies_;
    std::vector<double> gravity_mass_;
};

inline Matrix3 diagonal(double x, double y, double z)
{
    return {{{x, 0, 0}, {0, y, 0}, {0, 0, z}}};
}

} // namespace plash::testing

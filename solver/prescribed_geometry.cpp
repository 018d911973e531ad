#include "solver/prescribed_geometry.h"

#include "core/run_error.h"
#include "rigid/rigid_bodies.h"
#include "solver/cycle.h"
#include "solver/first_velocities.h"
#include "solver/step_control.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Bodies carry their nodes and have no stresses: a way of their own for some nodes cannot be followed.
void refuse_rigid_nodes(const Scene& scene, const std::vector<NodeDisplacement>& geometry)
{
    std::vector<bool> moves(scene.state.size());
    for (const NodeDisplacement& node : geometry)
        moves[node.node] = dot(node.translation, node.translation) > 0;
    for (const auto& term : scene.terms) {
        const auto* rigid = dynamic_cast<const RigidBodies*>(term.get());
        if (!rigid) continue;
        for (const RigidBody& body : rigid->bodies())
            for (const Index node : body.nodes)
                if (moves[node])
                    throw RunError(fmt::format("prescribed geometry (IDRFLG = 2): node {} belongs to a rigid "
                                               "body, which is not supported",
                                               scene.model.nodes.id[node]));
    }
}

} // namespace

RelaxationOutcome move_to_geometry(Scene& scene, const std::vector<NodeDisplacement>& geometry,
                                   std::vector<std::unique_ptr<Recorder>>& recorders,
                                   std::vector<double>& term_seconds)
{
    refuse_rigid_nodes(scene, geometry);
    const RelaxationControls& control = scene.model.controls.relaxation;
    StepControl step_control(scene.model, value_or(control.step_scale, scene.model.controls.time.step_scale));
    FirstVelocities first(scene);
    State& state = scene.state;
    Clock clock;
    clock.relaxing = true;
    for (long cycle = 0; cycle < control.geometry_cycles; ++cycle) {
        sum_forces(scene, clock, step_control, term_seconds);
        constrain_forces(scene, clock, term_seconds);
        std::fill(state.velocity.begin(), state.velocity.end(), Vec3{});
        std::fill(state.angular_velocity.begin(), state.angular_velocity.end(), Vec3{});
        const double rate = 1 / (static_cast<double>(control.geometry_cycles) * clock.step);
        for (const NodeDisplacement& node : geometry) {
            state.velocity[node.node] = rate * node.translation;
            if (state.rotational()) state.angular_velocity[node.node] = rate * node.rotation;
        }
        close_ledger(scene, 0);
        move_nodes(scene, clock, term_seconds);
    }
    for (const NodeDisplacement& node : geometry) // to the last bit
        state.position[node.node] = scene.model.nodes.position[node.node] + node.translation;
    sum_forces(scene, clock, step_control, term_seconds);
    constrain_forces(scene, clock, term_seconds); // bodies leave a phase after this
    close_ledger(scene, 0);
    RelaxationLook look;
    look.last = true;
    const Snapshot snapshot{scene.model, clock, state, scene.ledger, scene.terms, step_control.owner(), 0};
    for (auto& recorder : recorders) recorder->write_relaxation(snapshot, look);
    RelaxationOutcome outcome;
    outcome.ran = outcome.geometry = outcome.converged = true;
    outcome.cycles = clock.cycle;
    outcome.time = clock.time;
    first.restore();
    return outcome;
}

} // namespace plash

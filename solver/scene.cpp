#include "solver/scene.h"

#include "conditions/fixities.h"
#include "conditions/initial_velocity.h"
#include "conditions/loads.h"
#include "conditions/prescribed_motion.h"
#include "contact/contacts.h"
#include "contact/planar_wall.h"
#include "elements/beam_groups.h"
#include "elements/discrete_springs.h"
#include "elements/shell_groups.h"
#include "elements/solid_groups.h"
#include "rigid/rigid_bodies.h"
#include "solver/rigid_parts.h"
#include "sph/particle_bodies.h"

#include <cmath>
#include <numeric>

namespace plash {

namespace {

/// Loads, fixities, driven nodes and walls, in the order in which they act on the forces.
void add_conditions(Scene& scene)
{
    const Model& model = scene.model;
    State& state = scene.state;
    if (!model.nodal_loads.empty()) scene.terms.push_back(std::make_unique<NodalLoads>(model));
    if (!model.body_loads.empty()) scene.terms.push_back(std::make_unique<BodyLoads>(model, state));
    for (const PlanarWall& wall : model.planar_walls) {
        scene.terms.push_back(std::make_unique<PlanarWallTerm>(wall, model, state));
    }
    auto motions = std::make_unique<PrescribedMotions>(model, state);
    motions->start(state);
    if (!motions->empty()) scene.terms.push_back(std::move(motions));
    auto fixities = std::make_unique<Fixities>(model);
    fixities->stop_at_start(state);
    if (!fixities->empty()) scene.terms.push_back(std::move(fixities));
}

/// *CONTROL_TIMESTEP DT2MS: the step that the deck wants, bought with mass. Negative: only where it is
/// needed.
void scale_masses(Scene& scene)
{
    const double wanted = scene.model.controls.time.mass_scaled_step;
    if (wanted == 0) return;
    const double mass = std::accumulate(scene.state.mass.begin(), scene.state.mass.end(), 0.0);
    double added = 0;
    for (auto& term : scene.terms) added += term->scale_mass(std::abs(wanted), wanted < 0, scene.state);
    scene.added_mass_ratio = mass > 0 ? added / mass : 0;
}

} // namespace

Scene make_scene(const Model& model)
{
    Scene scene{model, {}, {}, {}, 0};
    State& state = scene.state;
    state.position = model.nodes.position;
    state.velocity.resize(state.size());
    state.force.resize(state.size());
    state.mass.resize(state.size());
    for (auto& group : make_shell_groups(model, state)) scene.terms.push_back(std::move(group));
    for (auto& group : make_solid_groups(model, state)) scene.terms.push_back(std::move(group));
    for (auto& group : make_beam_groups(model, state)) scene.terms.push_back(std::move(group));
    if (auto springs = make_springs(model, state)) scene.terms.push_back(std::move(springs));
    for (auto& body : make_particle_bodies(model, state)) scene.terms.push_back(std::move(body));
    for (auto& contact : make_contacts(model)) scene.terms.push_back(std::move(contact));
    add_rigid_masses(model, state);
    for (std::size_t i = 0; i < model.masses.size(); ++i)
        state.mass[model.masses.node[i]] += model.masses.mass[i];
    scale_masses(scene);
    apply_initial_velocities(model, state);
    add_conditions(scene);
    std::vector<RigidBody> bodies = make_rigid_bodies(model, state);
    if (!bodies.empty())
        scene.terms.push_back(std::make_unique<RigidBodies>(model, std::move(bodies), state));
    return scene;
}

} // namespace plash

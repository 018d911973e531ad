#include "solver/scene.h"

#include "conditions/body_loads.h"
#include "conditions/damping.h"
#include "conditions/fixities.h"
#include "conditions/initial_velocity.h"
#include "conditions/loads.h"
#include "conditions/non_reflecting.h"
#include "conditions/prescribed_motion.h"
#include "conditions/pressure_loads.h"
#include "contact/contacts.h"
#include "contact/rigid_wall.h"
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
    if (!model.pressure_loads.empty()) scene.terms.push_back(std::make_unique<PressureLoads>(model));
    if (!model.body_loads.empty()) scene.terms.push_back(std::make_unique<BodyLoads>(model, state));
    if (!model.dampings.empty()) scene.terms.push_back(std::make_unique<Damping>(model, state));
    if (!model.non_reflecting_boundaries.empty())
        scene.terms.push_back(std::make_unique<NonReflecting>(model, state));
    for (const RigidWall& wall : model.rigid_walls) {
        scene.terms.push_back(std::make_unique<RigidWallTerm>(wall, model, state));
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
    for (auto& term : scene.terms) {
        const double more = term->scale_mass(std::abs(wanted), wanted < 0, scene.state);
        if (more != 0) scene.masses.added.emplace_back(term->name(), more);
        added += more;
    }
    scene.added_mass_ratio = scene.masses.added_ratio = mass > 0 ? added / mass : 0;
}

/// Mass and centre of mass of all nodes, before rigid bodies take the masses of theirs.
void weigh(Scene& scene)
{
    MassSummary& masses = scene.masses;
    Vec3 first_moment{};
    for (std::size_t node = 0; node < scene.state.size(); ++node) {
        masses.mass += scene.state.mass[node];
        first_moment += scene.state.mass[node] * scene.state.position[node];
    }
    if (masses.mass > 0) masses.center = (1 / masses.mass) * first_moment;
}

} // namespace

Scene make_scene(const Model& model)
{
    Scene scene{model, {}, {}, {}, 0, {}};
    State& state = scene.state;
    state.position = model.nodes.position;
    state.velocity.resize(state.size());
    state.force.resize(state.size());
    state.mass.resize(state.size());
    for (auto& group : make_shell_groups(model, state)) scene.terms.push_back(std::move(group));
    for (auto& group : make_solid_groups(model, state)) scene.terms.push_back(std::move(group));
    for (auto& body : make_particle_bodies(model, state)) scene.terms.push_back(std::move(body));
    for (auto& contact : make_contacts(model)) scene.terms.push_back(std::move(contact));
    add_rigid_masses(model, state);
    for (std::size_t i = 0; i < model.masses.size(); ++i)
        state.mass[model.masses.node[i]] += model.masses.mass[i];
    scale_masses(scene);
    weigh(scene);
    apply_initial_velocities(model, state);
    add_conditions(scene);
    std::vector<RigidBody> bodies = make_rigid_bodies(model, state);
    if (!bodies.empty())
        scene.terms.push_back(std::make_unique<RigidBodies>(model, std::move(bodies), state));
    return scene;
}

} // namespace plash

#include "solver/scene.h"

#include "ale/coupling/fluid_coupling.h"
#include "ale/fluid_term.h"
#include "ale/tracers.h"
#include "conditions/airbags.h"
#include "conditions/blast_loads.h"
#include "conditions/body_loads.h"
#include "conditions/damping.h"
#include "conditions/fixities.h"
#include "conditions/initial_velocity.h"
#include "conditions/loads.h"
#include "conditions/nodal_forces.h"
#include "conditions/non_reflecting.h"
#include "conditions/prescribed_motion.h"
#include "conditions/pressure_loads.h"
#include "conditions/relaxation.h"
#include "contact/contacts.h"
#include "contact/rigid_wall.h"
#include "contact/tied_nodes.h"
#include "elements/beam_groups.h"
#include "elements/cohesive_solids.h"
#include "elements/discrete_springs.h"
#include "elements/selective_mass.h"
#include "elements/shell_groups.h"
#include "elements/solid_groups.h"
#include "elements/stiffness_damping.h"
#include "elements/thick_shell_groups.h"
#include "model/eulerian.h"
#include "rigid/interpolation.h"
#include "rigid/linear_constraints.h"
#include "rigid/rigid_bodies.h"
#include "solver/mass_scaling.h"
#include "solver/nodal_inertias.h"
#include "solver/rigid_parts.h"
#include "solver/switch_watches.h"
#include "sph/particle_bodies.h"
#include "sph/particle_coupling.h"

#include <algorithm>

namespace plash {

namespace {

/// Loads, fixities, driven nodes and walls, in the order in which they act on the forces.
void add_conditions(Scene& scene, SelectiveMasses selective_masses)
{
    const Model& model = scene.model;
    State& state = scene.state;
    if (!model.nodal_force_groups.empty()) scene.terms.push_back(std::make_unique<NodalForces>(model));
    if (!model.nodal_loads.empty()) scene.terms.push_back(std::make_unique<NodalLoads>(model));
    if (!model.pressure_loads.empty()) scene.terms.push_back(std::make_unique<PressureLoads>(model));
    if (!model.blast_loads.empty()) scene.terms.push_back(std::make_unique<BlastLoads>(model, state));
    if (!model.airbags.empty()) scene.terms.push_back(std::make_unique<Airbags>(model, state));
    if (!model.body_loads.empty()) scene.terms.push_back(std::make_unique<BodyLoads>(model, state));
    if (!model.dampings.empty()) scene.terms.push_back(std::make_unique<Damping>(model, state));
    if (model.controls.relaxation.active()) scene.terms.push_back(std::make_unique<Relaxation>(model, state));
    if (!model.non_reflecting_boundaries.empty())
        scene.terms.push_back(std::make_unique<NonReflecting>(model, state));
    if (!selective_masses.elements.empty()) // before all that sets velocities
        scene.terms.push_back(std::make_unique<SelectiveMass>(std::move(selective_masses)));
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

/// Selective mass scaling, where the deck has it, gets to know the whole scene.
void start_selective_mass(Scene& scene)
{
    std::vector<const Term*> terms;
    SelectiveMass* selective = nullptr;
    for (const auto& term : scene.terms) {
        if (auto* found = dynamic_cast<SelectiveMass*>(term.get())) selective = found;
        terms.push_back(term.get());
    }
    if (!selective) return;
    selective->start(std::move(terms), scene.state);
    scene.masses.added_ratio += selective->ordinary_mass() / scene.masses.mass;
    scene.added_mass_ratio = scene.masses.added_ratio;
}

/// Fluids in Eulerian meshes and what couples them with structures.
void add_eulerian_fluids(Scene& scene)
{
    std::vector<EulerianFluid*> fluids;
    for (auto& fluid : make_eulerian_fluids(scene.model)) {
        fluids.push_back(fluid.get());
        scene.terms.push_back(std::move(fluid));
    }
    for (auto& coupling : make_fluid_couplings(scene.model, fluids, scene.state))
        scene.terms.push_back(std::move(coupling));
    if (auto tracers = make_tracers(scene.model, fluids)) scene.terms.push_back(std::move(tracers));
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

/// Joints, loads and drives of bodies: without bodies they are errors of the deck.
bool asks_for_rigid_bodies(const Model& model)
{
    const auto& motions = model.prescribed_motions;
    return !model.joints.empty() || !model.rigid_body_loads.empty() ||
           std::any_of(motions.begin(), motions.end(),
                       [](const PrescribedMotion& motion) { return motion.rigid_part != none; });
}

} // namespace

Scene make_scene(const Model& model)
{
    const RelaxationControls& relaxation = model.controls.relaxation;
    if (relaxation.active() && !asks_for_statics(model) && has_eulerian_mesh(model)) {
        throw DeckError(relaxation.where, "dynamic relaxation is not supported beside an Eulerian mesh; "
                                          "IDRFLG = 5 solves for the equilibrium there");
    }
    Scene scene{model, {}, {}, {}, 0, {}};
    State& state = scene.state;
    state.position = model.nodes.position;
    state.velocity.resize(state.size());
    state.force.resize(state.size());
    state.mass.resize(state.size());
    for (auto& group : make_shell_groups(model, state)) scene.terms.push_back(std::move(group));
    std::vector<const Term*> solids;
    for (auto& group : make_solid_groups(model, state)) {
        solids.push_back(group.get());
        scene.terms.push_back(std::move(group));
    }
    for (auto& group : make_stiffness_damping(model, state)) scene.terms.push_back(std::move(group));
    for (auto& group : make_thick_shell_groups(model, state)) scene.terms.push_back(std::move(group));
    std::vector<const Term*> elements; // that know plastic strains
    for (const auto& term : scene.terms) elements.push_back(term.get());
    for (auto& group : make_beam_groups(model, state)) scene.terms.push_back(std::move(group));
    for (auto& group : make_cohesive_solids(model, state)) scene.terms.push_back(std::move(group));
    if (auto springs = make_springs(model, state)) scene.terms.push_back(std::move(springs));
    for (auto& body : make_particle_bodies(model, state)) {
        body->watch_solids(solids);
        scene.terms.push_back(std::move(body));
    }
    for (auto& coupling : make_particle_couplings(model, state)) scene.terms.push_back(std::move(coupling));
    add_eulerian_fluids(scene);
    for (auto& contact : make_contacts(model)) scene.terms.push_back(std::move(contact));
    add_rigid_masses(model, state);
    for (std::size_t i = 0; i < model.masses.size(); ++i)
        state.mass[model.masses.node[i]] += model.masses.mass[i];
    add_nodal_inertias(model, state);
    SelectiveMasses selective_masses = scale_masses(scene);
    weigh(scene);
    auto tied = std::make_shared<TiedNodes>(model, state);
    if (!tied->empty()) scene.terms.push_back(std::make_unique<TiedForces>(tied));
    apply_initial_velocities(model, state);
    auto [interpolated_forces, interpolated_motion] = make_interpolations(model, state);
    if (interpolated_forces) scene.terms.push_back(std::move(interpolated_forces));
    RigidSetup bodies = make_rigid_bodies(model, state); // sees the velocities before fixities stop nodes
    add_inertia_bodies(model, state, bodies);
    add_conditions(scene, std::move(selective_masses));
    bodies.switches = PartSwitches::read(model, state, bodies.bodies);
    watch_forces(bodies.switches, model, scene.terms);
    if (!bodies.bodies.empty() || asks_for_rigid_bodies(model))
        scene.terms.push_back(std::make_unique<RigidBodies>(model, std::move(bodies), state));
    if (const auto* last =
            scene.terms.empty() ? nullptr : dynamic_cast<RigidBodies*>(scene.terms.back().get()))
        if (!last->switches().empty()) scene.switching = last;
    if (!tied->empty())
        scene.terms.push_back(std::make_unique<TiedMotion>(tied)); // after all that moves corners
    if (auto constraints = make_linear_constraints(model, state, std::move(elements)))
        scene.terms.push_back(std::move(constraints));
    if (interpolated_motion) scene.terms.push_back(std::move(interpolated_motion));
    start_selective_mass(scene);
    return scene;
}

} // namespace plash

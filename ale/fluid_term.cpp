#include "ale/fluid_term.h"

#include "ale/absorbing_nodes.h"
#include "ale/hex/hex_fluid.h"
#include "ale/initial_state.h"
#include "core/prescribed_rate.h"
#include "core/run_error.h"
#include "model/eulerian.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

LagrangeSettings lagrange_settings_of(const Model& model, const DeckGroups& groups)
{
    LagrangeSettings settings;
    const ElementControls& control = model.controls.elements;
    settings.quadratic_viscosity = value_or(control.quadratic_viscosity, 1.5);
    settings.linear_viscosity = value_or(control.linear_viscosity, 0.06);
    settings.void_allowed = groups.void_allowed;
    for (const DeckGroup& group : groups.groups)
        settings.viscous = settings.viscous || group.law.viscosity > 0;
    return settings;
}

std::unique_ptr<Fluid> make_fluid(const Model& model, const MeshBlock& block, const DeckGroups& groups)
{
    const LagrangeSettings settings = lagrange_settings_of(model, groups);
    if (block.is_box()) return std::make_unique<BoxFluid>(BoxGrid(block.planes), groups.fluids(), settings);
    std::vector<Vec3> position;
    position.reserve(block.nodes.size());
    for (Index node : block.nodes) position.push_back(model.nodes.position[node]);
    try {
        return std::make_unique<HexFluid>(make_hex_mesh(std::move(position), block.corners), groups.fluids(),
                                          settings);
    } catch (const HexDefect& defect) {
        const Index solid = block.solids[defect.cell];
        const Part& part = model.parts[model.solids.part[solid]];
        throw DeckError(part.where, fmt::format("*ELEMENT_SOLID {} of the Eulerian part {} '{}': {}",
                                                model.solids.id[solid], part.id, part.title, defect.why));
    }
}

} // namespace

EulerianFluid::EulerianFluid(const Model& model, MeshBlock block, DeckGroups groups,
                             const FluidSettings& settings)
    : model_(model),
      block_(std::move(block)),
      groups_(std::move(groups)),
      fluid_(make_fluid(model, block_, groups_)),
      boundary_(mesh_boundary_of(*fluid_, block_, settings, model)),
      motion_(mesh_motion_of(model, block_, groups_)),
      smoothing_(mesh_smoothing_of(model, block_, settings)),
      outside_pressure_curve_(settings.outside_pressure_curve)
{
    fluid_->order = settings.order;
    if (settings.smooth > 0) fluid_->keep_smooth_slopes(settings.smooth);
    fluid_->open_sides = boundary_.open;
    fluid_->slipping = boundary_.slipping;
    fluid_->close_curved_walls();
    fluid_->outside_pressure = settings.outside_pressure;
    fill_initial_state(*fluid_, block_, groups_, model);
    still_ = set_hydrostatic_state(*fluid_, block_, groups_, model);
    if (settings.conserve_total_energy) fluid_->conserve_total_energy();
    find_ambient_cells();
    find_loaded_nodes();
    find_frame_loads();
    refuse_walls();
    if (motion_.follows()) {
        std::vector<Index> kept;
        for (const HeldNode& node : boundary_.held) kept.push_back(static_cast<Index>(node.place));
        hexahedra().prepare_to_follow(kept);
    }
}

HexFluid& EulerianFluid::hexahedra()
{
    return dynamic_cast<HexFluid&>(*fluid_);
}

void EulerianFluid::refuse_walls() const
{
    if (!motion_.deforms()) return;
    const Location& where = model_.parts[model_.solids.part[block_.solids.front()]].where;
    if (!motion_.only_follows() && !(boundary_.held.empty() && boundary_.slipping.empty()))
        throw DeckError(where,
                        "an Eulerian mesh that turns or is stretched has nodes that are held (EBC, "
                        "*BOUNDARY_SPC, *BOUNDARY_PRESCRIBED_MOTION); there its sides can be open only");
    if (!boundary_.slipping.empty())
        throw DeckError(where,
                        "an Eulerian mesh that goes with its material has walls across no axis along which "
                        "fluid slips (EBC = 2); there walls can be across the axes only");
}

/// ELFORM 7, or AET: cells that stand for a reservoir and keep the state in which they start.
void EulerianFluid::find_ambient_cells()
{
    std::vector<bool> ambient(model_.parts.size());
    for (std::size_t index = 0; index < model_.parts.size(); ++index) {
        if (!is_eulerian(model_, static_cast<Index>(index))) continue;
        const Record& section = model_.sections[model_.parts[index].section];
        const Id type = section.integer("AET");
        if (type != 0 && type != 3 && type != 4)
            throw DeckError(section.where,
                            fmt::format("*{} {}, field AET: {} is not supported; there are 0 none, 3 and 4 "
                                        "(fluid in and out at the pressure of the start)",
                                        section.keyword, section.id, type));
        ambient[index] = type != 0 || section.integer("ELFORM") == 7;
    }
    std::vector<std::ptrdiff_t> places;
    for (std::size_t number = 0; number < block_.solids.size(); ++number)
        if (ambient[model_.solids.part[block_.solids[number]]]) places.push_back(fluid_->cell(number).place);
    fluid_->keep_ambient(std::move(places));
}

/// Loads of the deck on nodes of the mesh act on the fluid there.
void EulerianFluid::find_loaded_nodes()
{
    std::vector<bool> loaded(model_.nodes.size());
    const Location* where = nullptr;
    for (const PressureLoad& load : model_.pressure_loads) {
        for (const auto& segment : load.segments)
            for (Index node : segment) loaded[node] = true;
        where = &load.where;
    }
    for (const NodalLoad& load : model_.nodal_loads) {
        for (Index node : load.nodes) loaded[node] = true;
        where = &load.where;
    }
    for (std::size_t number = 0; number < block_.nodes.size(); ++number)
        if (loaded[block_.nodes[number]]) loaded_nodes_.push_back(number);
    if (!loaded_nodes_.empty() && motion_.moves())
        throw DeckError(*where, "a load acts on nodes of an Eulerian mesh that moves; there it has no work");
}

void EulerianFluid::take_loads(const State& state)
{
    fluid_->loads.clear();
    for (const std::size_t number : loaded_nodes_) {
        const Index node = block_.nodes[number];
        const Vec3& force = state.force[node];
        // Nodes that are a structure's as well carry its loads.
        if (state.mass[node] > 0 || (force.x == 0 && force.y == 0 && force.z == 0)) continue;
        fluid_->loads.push_back({fluid_->node_place(number), {force.x, force.y, force.z}});
    }
}

std::vector<std::string> EulerianFluid::notices(const State&) const
{
    std::vector<std::string> notices;
    if (!block_.is_box())
        notices.push_back(fmt::format(
            "an Eulerian mesh of {} cells is taken as general hexahedra, which is slower than a box: {}",
            block_.solids.size(), block_.why_no_box));
    if (smoothing_.by.sum() > 0 && !motion_.smooths())
        notices.push_back("AFAC to DFAC of *CONTROL_ALE or *SECTION_SOLID_ALE: an Eulerian mesh that no "
                          "*ALE_REFERENCE_SYSTEM_GROUP of "
                          "PRTYPE 2 names is not smoothed; it stands still or is carried as a whole");
    if (motion_.idle_back)
        notices.push_back("EFAC of *ALE_REFERENCE_SYSTEM_GROUP has no effect: it is for PRTYPE 8 alone");
    if (motion_.idle_centre)
        notices.push_back(
            "ICOORD of *ALE_REFERENCE_SYSTEM_GROUP has no effect: with PRTYPE 9 alone is there a "
            "centre of stretching");
    return notices;
}

void EulerianFluid::serialise(Archive& archive)
{
    fluid_->serialise(archive);
    archive(started_, boundary_.held, reference_before_, reference_rule_);
    if (archive.loading()) fluid_->held = boundary_.held;
}

void EulerianFluid::start(State& state)
{
    for (std::size_t number = 0; number < block_.nodes.size(); ++number) {
        Vec3& velocity = state.velocity[block_.nodes[number]];
        const std::ptrdiff_t place = fluid_->node_place(number);
        const double parts[3] = {velocity.x, velocity.y, velocity.z};
        for (int axis = 0; axis < 3; ++axis) fluid_->fields.velocity[axis][place] += parts[axis];
        velocity = {};
    }
    boundary_.follow(model_, 0, 0);
    fluid_->held = boundary_.held;
    fluid_->start();
    fluid_->absorbing = absorbing_nodes_of(*fluid_, block_, model_);
    if (!fluid_->absorbing.empty() && motion_.moves())
        throw DeckError(
            model_.non_reflecting_boundaries.front().where,
            "*BOUNDARY_NON_REFLECTING lies on an Eulerian mesh that moves; there it has no place");
    started_ = true;
}

void EulerianFluid::add_forces(const Clock& clock, State& state)
{
    if (!started_) start(state);
    if (clock.relaxing) clear_outside();
    if (motion_.moves() && !clock.relaxing) move_mesh(clock, state);
}

/// Places of the nodes that the mesh follows now.
std::vector<Vec3> EulerianFluid::reference_nodes(const State& state, double time) const
{
    std::vector<Vec3> places;
    for (const Index node : motion_.rules[motion_.rule_number(time)].nodes)
        places.push_back(state.position[node]);
    return places;
}

/// The loop carries the nodes of a mesh that translates, and the grid follows in after_motion. Those of a
/// mesh that deforms stay where they are until then.
void EulerianFluid::move_mesh(const Clock& clock, State& state)
{
    if (motion_.deforms()) {
        const std::size_t rule = motion_.rule_number(clock.time);
        if (reference_before_.empty() || rule != reference_rule_)
            reference_before_ = reference_nodes(state, clock.time);
        reference_rule_ = rule;
        for (Index node : block_.nodes) state.velocity[node] = {};
        return;
    }
    const std::array<double, 3> velocity = motion_.velocity(model_, *fluid_, state.velocity, clock.time);
    fluid_->lagrange.mesh_velocity = velocity;
    for (Index node : block_.nodes) state.velocity[node] = {velocity[0], velocity[1], velocity[2]};
}

/// Puts the nodes of the State where the nodes that they follow have gone in this step, and lets the fluid
/// know.
void EulerianFluid::deform_mesh(const Clock& clock, State& state)
{
    if (motion_.rules[motion_.rule_number(clock.time)].follows()) return follow_material(clock.time);
    // Nodes of bodies may still be put straight after this: what they go then comes with the next step.
    std::vector<Vec3> reference = reference_nodes(state, clock.time);
    const AffineStep way = affine_step(motion_, model_, clock.time, clock.step, reference_before_, reference,
                                       motion_.velocity(model_, *fluid_, state.velocity, clock.time));
    reference_before_ = std::move(reference);
    std::vector<Vec3> next;
    next.reserve(block_.nodes.size());
    for (Index node : block_.nodes) {
        state.position[node] = way(state.position[node]);
        next.push_back(state.position[node]);
    }
    fluid_->move_nodes(std::move(next), clock.step);
}

/// Where nodes go shows only when their velocities are known; the State's follow after that.
void EulerianFluid::follow_material(double time)
{
    NodeSmoothing smoothing;
    const MeshMotion::Kind kind = motion_.rules[motion_.rule_number(time)].kind;
    if (kind == MeshMotion::Kind::delayed) smoothing.back = motion_.back;
    if (kind == MeshMotion::Kind::smoothed && time >= smoothing_.start && time <= smoothing_.end)
        smoothing = smoothing_.by;
    hexahedra().follow_material(smoothing);
}

void EulerianFluid::advance(const Clock& clock)
{
    // The velocity step of the first cycle is half a step, but what holds a fluid at rest acts as long as its
    // pressure does.
    const bool held_at_rest = still_ && clock.last_step == 0;
    try {
        fluid_->advance(clock.step, held_at_rest ? clock.step : clock.velocity_step());
    } catch (const HexDefect& defect) {
        const Index solid = block_.solids[defect.cell];
        throw RunError(fmt::format(
            "cell {} (part {}) of an Eulerian mesh that moves has been lost at time {:g}: {}",
            model_.solids.id[solid], model_.parts[model_.solids.part[solid]].id, clock.time, defect.why));
    }
}

/// Loads of the frame that speak of everything, of the mesh's parts or of some of its nodes.
void EulerianFluid::find_frame_loads()
{
    std::vector<bool> own_nodes;
    for (const BodyLoad& load : model_.body_loads) {
        const auto own = [&](Index part) {
            return is_eulerian(model_, part) || groups_.group_of_part(part) != none;
        };
        bool acts = load.parts.empty() && load.nodes.empty();
        acts = acts || std::any_of(load.parts.begin(), load.parts.end(), own);
        if (!acts && !load.nodes.empty()) {
            own_nodes.resize(model_.nodes.size());
            for (Index node : block_.nodes) own_nodes[node] = true;
            acts = std::any_of(load.nodes.begin(), load.nodes.end(),
                               [&](Index node) { return own_nodes[node]; });
        }
        if (acts) frame_loads_.push_back(&load);
    }
}

std::array<double, 3> EulerianFluid::gravity(double time) const
{
    Vec3 sum{};
    for (const BodyLoad* load : frame_loads_)
        sum += (load->scale * curve_value(model_, load->curve, time)) * load->direction;
    return {-sum.x, -sum.y, -sum.z};
}

EulerianFluid::Unrest EulerianFluid::first_unrest(const State& state)
{
    fluid_->gravity = gravity(0);
    const Fluid::Unrest unrest = fluid_->unrest();
    return {unrest.acceleration, state.position[block_.nodes[unrest.node]]};
}

void EulerianFluid::clear_outside()
{
    fluid_->outside_forces.clear();
    fluid_->dry_faces.clear();
}

void EulerianFluid::after_motion(const Clock& clock, State& state)
{
    if (clock.relaxing) return;
    if (!boundary_.driven.empty()) {
        boundary_.follow(model_, clock.time, clock.step);
        fluid_->held = boundary_.held;
    }
    if (!loaded_nodes_.empty()) take_loads(state);
    fluid_->gravity = gravity(clock.time + 0.5 * clock.step);
    if (outside_pressure_curve_ != none)
        fluid_->outside_pressure =
            curve_value(model_, outside_pressure_curve_, clock.time + 0.5 * clock.step);
    if (motion_.deforms()) deform_mesh(clock, state);
    if (follow_structures) follow_structures(state);
    advance(clock);
    if (motion_.follows() && motion_.rules[motion_.rule_number(clock.time)].follows()) {
        const std::vector<Vec3>& places = hexahedra().mesh.position;
        for (std::size_t number = 0; number < block_.nodes.size(); ++number)
            state.position[block_.nodes[number]] = places[number];
    }
    std::array<double, 3> distance = fluid_->lagrange.mesh_velocity;
    for (double& along : distance) along *= clock.step;
    fluid_->shift(distance);
    clear_outside();
}

StepVote EulerianFluid::stable_step() const
{
    StepVote vote;
    vote.step = fluid_->stable_step();
    vote.kind = "solid";
    const std::ptrdiff_t number = fluid_->limiting_cell();
    if (number < 0) return vote;
    const Index solid = block_.solids[number];
    vote.element = model_.solids.id[solid];
    vote.part = model_.parts[model_.solids.part[solid]].id;
    return vote;
}

void EulerianFluid::report(EnergyLedger& ledger) const
{
    const FluidEnergies& energies = fluid_->energies();
    ledger.kinetic += energies.kinetic;
    for (const DeckGroup& group : groups_.groups) {
        if (group.fluid == none || energies.group_internal.empty()) continue;
        ledger.add_part(part_of_group(group), energies.group_internal[group.fluid], 0);
    }
    ledger.advection_loss += energies.advection_loss;
    ledger.sliding -= energies.coupling_work; // the structures' share is booked by the couplings
    ledger.external_work += energies.outside_work - energies.outflow;
}

std::vector<std::unique_ptr<EulerianFluid>> make_eulerian_fluids(const Model& model)
{
    std::vector<std::unique_ptr<EulerianFluid>> fluids;
    if (!has_eulerian_mesh(model)) return fluids;
    const DeckGroups groups = deck_groups_of(model);
    const FluidSettings settings = fluid_settings_of(model);
    const auto why_no_box = [&](const std::vector<Index>& solids) {
        MeshBlock block;
        block.solids = solids;
        const MeshMotion motion = mesh_motion_of(model, block, groups);
        return std::string(motion.follows()   ? "it goes with its material"
                           : motion.deforms() ? "it turns or is stretched"
                                              : "");
    };
    for (MeshBlock& block : find_mesh_blocks(model, why_no_box))
        fluids.push_back(std::make_unique<EulerianFluid>(model, std::move(block), groups, settings));
    return fluids;
}

} // namespace plash

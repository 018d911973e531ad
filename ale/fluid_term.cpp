#include "ale/fluid_term.h"

#include "ale/hydrostatic.h"
#include "ale/initial_state.h"
#include "core/prescribed_rate.h"
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

template <class Visit>
void for_cells(const BoxGrid& grid, Visit&& visit)
{
    for (int k = 0; k < grid.cells(2); ++k)
        for (int j = 0; j < grid.cells(1); ++j)
            for (int i = 0; i < grid.cells(0); ++i) visit(i, j, k);
}

template <class Visit>
void for_nodes(const BoxGrid& grid, Visit&& visit)
{
    for (int k = 0; k <= grid.cells(2); ++k)
        for (int j = 0; j <= grid.cells(1); ++j)
            for (int i = 0; i <= grid.cells(0); ++i) visit(i, j, k);
}

} // namespace

EulerianFluid::EulerianFluid(const Model& model, MeshBlock block, DeckGroups groups,
                             const FluidSettings& settings)
    : model_(model),
      block_(std::move(block)),
      groups_(std::move(groups)),
      fluid_(BoxGrid(block_.planes), groups_.fluids(), lagrange_settings_of(model, groups_)),
      boundary_(mesh_boundary_of(fluid_.grid, block_, settings, model)),
      motion_(mesh_motion_of(model, block_))
{
    fluid_.order = settings.order;
    fluid_.open_sides = boundary_.open;
    fluid_.outside_pressure = settings.outside_pressure;
    fill_initial_state(fluid_, block_, groups_, model);
    set_hydrostatic_state(fluid_, block_, groups_, model);
    if (settings.conserve_total_energy) fluid_.conserve_total_energy();
}

void EulerianFluid::start(State& state)
{
    for_nodes(fluid_.grid, [&](int i, int j, int k) {
        Vec3& velocity = state.velocity[block_.nodes[block_.node(i, j, k)]];
        const std::ptrdiff_t place = fluid_.grid.at(i, j, k);
        const double parts[3] = {velocity.x, velocity.y, velocity.z};
        for (int axis = 0; axis < 3; ++axis) fluid_.fields.velocity[axis][place] += parts[axis];
        velocity = {};
    });
    boundary_.follow(model_, 0, 0);
    fluid_.held = boundary_.held;
    fluid_.start();
    started_ = true;
}

void EulerianFluid::add_forces(const Clock& clock, State& state)
{
    if (!started_) start(state);
    if (motion_.kind != MeshMotion::Kind::none) move_mesh(clock, state);
}

/// The loop carries the nodes; the grid follows in after_motion.
void EulerianFluid::move_mesh(const Clock& clock, State& state)
{
    const std::array<double, 3> velocity = motion_.velocity(model_, fluid_, clock.time);
    fluid_.lagrange.mesh_velocity = velocity;
    for (Index node : block_.nodes) state.velocity[node] = {velocity[0], velocity[1], velocity[2]};
}

std::array<double, 3> EulerianFluid::gravity(double time) const
{
    Vec3 sum{};
    for (const BodyLoad& load : model_.body_loads) {
        const auto own = [&](Index part) {
            return is_eulerian(model_, part) || groups_.group_of_part(part) != none;
        };
        if (!load.parts.empty() && std::none_of(load.parts.begin(), load.parts.end(), own)) continue;
        sum += (load.scale * curve_value(model_, load.curve, time)) * load.direction;
    }
    return {-sum.x, -sum.y, -sum.z};
}

void EulerianFluid::after_motion(const Clock& clock, State&)
{
    if (!boundary_.driven.empty()) {
        boundary_.follow(model_, clock.time, clock.step);
        fluid_.held = boundary_.held;
    }
    fluid_.gravity = gravity(clock.time + 0.5 * clock.step);
    fluid_.advance(clock.step, clock.velocity_step());
    for (int axis = 0; axis < 3; ++axis)
        if (const double speed = fluid_.lagrange.mesh_velocity[axis]; speed != 0)
            fluid_.grid.shift(axis, speed * clock.step);
    fluid_.outside_forces.clear();
}

StepVote EulerianFluid::stable_step() const
{
    StepVote vote;
    vote.step = fluid_.stable_step();
    vote.kind = "solid";
    const BoxGrid& grid = fluid_.grid;
    const std::ptrdiff_t offset = fluid_.limiting_cell() - grid.at(0, 0, 0);
    if (offset < 0) return vote;
    const int k = static_cast<int>(offset / grid.stride(2)),
              j = static_cast<int>(offset % grid.stride(2) / grid.stride(1)),
              i = static_cast<int>(offset % grid.stride(2) % grid.stride(1));
    if (i >= grid.cells(0) || j >= grid.cells(1) || k >= grid.cells(2)) return vote;
    const Index solid = block_.solids[block_.cell(i, j, k)];
    vote.element = model_.solids.id[solid];
    vote.part = model_.parts[model_.solids.part[solid]].id;
    return vote;
}

/// Parts carry the sums of the group that begins with them; groups without a part those of the mesh.
Index EulerianFluid::part_of_group(const DeckGroup& group) const
{
    return group.parts.empty() ? model_.solids.part[block_.solids.front()] : group.parts.front();
}

void EulerianFluid::report(EnergyLedger& ledger) const
{
    const FluidEnergies& energies = fluid_.energies();
    ledger.kinetic += energies.kinetic;
    for (const DeckGroup& group : groups_.groups) {
        if (group.fluid == none || energies.group_internal.empty()) continue;
        ledger.add_part(part_of_group(group), energies.group_internal[group.fluid], 0);
    }
    ledger.advection_loss += energies.advection_loss;
    ledger.sliding -= energies.coupling_work; // the structures' share is booked by the couplings
    ledger.external_work += energies.outside_work - energies.outflow;
}

void EulerianFluid::collect(const State&, ElementResults& results) const
{
    collect_cells(results);
    if (!results.material_velocity.empty()) collect_nodes(results);
    if (!results.part_motion.empty()) collect_parts(results);
}

void EulerianFluid::collect_cells(ElementResults& results) const
{
    if (results.solid_stress.empty() && results.solid_density.empty() && results.solid_fraction.empty())
        return;
    const BoxGrid& grid = fluid_.grid;
    const BoxFields& fields = fluid_.fields;
    const bool mixed = !fields.groups[0].fraction.empty();
    for_cells(grid, [&](int i, int j, int k) {
        const Index solid = block_.solids[block_.cell(i, j, k)], row = results.row_of_solid(solid);
        if (row == none) return;
        const std::ptrdiff_t place = grid.at(i, j, k);
        if (!results.solid_stress.empty()) {
            ElementResults::Stress stress{};
            const bool filled = fields.total_mass()[place] > 0;
            if (filled) stress.xx = stress.yy = stress.zz = -fields.pressure[place];
            if (filled && !fields.viscous[0].empty()) {
                stress.xx += fields.viscous[0][place];
                stress.yy += fields.viscous[1][place];
                stress.zz += fields.viscous[2][place];
                stress.xy = fields.viscous[3][place];
                stress.yz = fields.viscous[4][place];
                stress.zx = fields.viscous[5][place];
            }
            results.solid_stress[row] = stress;
        }
        if (!results.solid_density.empty())
            results.solid_density[row] = fields.total_mass()[place] / grid.volume(i, j, k);
        if (results.solid_fraction.empty()) return;
        double filled = 0;
        const std::size_t count = groups_.groups.size();
        for (std::size_t g = 0; g < count; ++g) {
            const int number = groups_.groups[g].fluid;
            if (number == none) continue;
            const double share = mixed ? fields.groups[number].fraction[place] : 1;
            filled += share;
            if (g < results.solid_fraction.size()) results.solid_fraction[g][row] = share;
        }
        const int empty = groups_.vacuum();
        if (empty != none && empty < static_cast<int>(results.solid_fraction.size()))
            results.solid_fraction[empty][row] = std::max(1 - filled, 0.0);
    });
}

void EulerianFluid::collect_nodes(ElementResults& results) const
{
    for_nodes(fluid_.grid, [&](int i, int j, int k) {
        const std::ptrdiff_t place = fluid_.grid.at(i, j, k);
        const auto& v = fluid_.fields.velocity;
        results.material_velocity[block_.nodes[block_.node(i, j, k)]] = {v[0][place], v[1][place],
                                                                         v[2][place]};
    });
}

/// Mass, momentum and kinetic energy of the groups: a node has an eighth of each of its cells.
void EulerianFluid::collect_parts(ElementResults& results) const
{
    const BoxGrid& grid = fluid_.grid;
    const auto& v = fluid_.fields.velocity;
    for (const DeckGroup& group : groups_.groups) {
        if (group.fluid == none) continue;
        ElementResults::PartMotion& sum = results.part_motion[part_of_group(group)];
        sum.outside_state = true;
        for_cells(grid, [&](int i, int j, int k) {
            const std::ptrdiff_t place = grid.at(i, j, k);
            const double mass = fluid_.fields.groups[group.fluid].mass[place];
            if (mass == 0) return;
            sum.mass += mass;
            for (int corner = 0; corner < 8; ++corner) {
                const std::ptrdiff_t node =
                    grid.at(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
                for (int axis = 0; axis < 3; ++axis) {
                    sum.momentum[axis] += 0.125 * mass * v[axis][node];
                    sum.kinetic += 0.0625 * mass * v[axis][node] * v[axis][node];
                }
            }
        });
    }
}

namespace {

/// Ambient cells (ELFORM 7, AET) would need a state from outside.
void reject_ambient_parts(const Model& model)
{
    for (std::size_t index = 0; index < model.parts.size(); ++index) {
        if (!is_eulerian(model, static_cast<Index>(index))) continue;
        const Record& section = model.sections[model.parts[index].section];
        if (section.integer("ELFORM") != 7 && section.integer("AET") == 0) continue;
        throw DeckError(section.where,
                        fmt::format("*{} {}: ambient cells (ELFORM = 7, or AET) are not supported yet",
                                    section.keyword, section.id));
    }
}

} // namespace

std::vector<std::unique_ptr<EulerianFluid>> make_eulerian_fluids(const Model& model)
{
    std::vector<std::unique_ptr<EulerianFluid>> fluids;
    if (!has_eulerian_mesh(model)) return fluids;
    reject_ambient_parts(model);
    const DeckGroups groups = deck_groups_of(model);
    const FluidSettings settings = fluid_settings_of(model);
    for (MeshBlock& block : find_mesh_blocks(model))
        fluids.push_back(std::make_unique<EulerianFluid>(model, std::move(block), groups, settings));
    return fluids;
}

} // namespace plash

#include "ale/fluid.h"

#include "ale/absorbing_nodes.h"
#include "ale/cell_flux.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plash {

void FluidEnergies::serialise(Archive& archive)
{
    archive(kinetic, internal, outside_work, coupling_work, advection_loss, outflow, group_internal);
}

Fluid::Fluid(std::vector<FluidGroup> all_groups, LagrangeSettings settings, FluidFields all_fields)
    : groups(std::move(all_groups)), lagrange(settings), fields(std::move(all_fields))
{}

void Fluid::fill_place(std::ptrdiff_t place, double volume, int group, double fraction, double density,
                       double energy_per_mass)
{
    const double mass = fraction * volume * density;
    fields.groups[group].mass[place] = mass;
    fields.groups[group].energy[place] = mass * energy_per_mass;
    if (!fields.groups[group].fraction.empty()) fields.groups[group].fraction[place] = fraction;
    if (groups.size() == 1) return;
    fields.mass_of_groups[place] = 0;
    for (const GroupFields& other : fields.groups) fields.mass_of_groups[place] += other.mass[place];
}

void Fluid::keep_smooth_slopes(double share)
{
    double slowest = std::numeric_limits<double>::infinity(); // square
    for (const FluidGroup& group : groups) {
        const double energy = std::visit([](const auto& law) { return law.energy; }, group.law);
        const double density = group.reference_density;
        slowest = std::min(slowest, fluid_state(group, density, energy / density).stiffness / density);
    }
    smooth_square = groups.empty() ? 0 : share * share * slowest;
}

void Fluid::keep_ambient(std::vector<std::ptrdiff_t> places)
{
    ambient_places_ = std::move(places);
    ambient_state_.clear();
    ambient_volume_.clear();
    for (const std::ptrdiff_t place : ambient_places_) ambient_volume_.push_back(volume_of(place));
    for (const std::ptrdiff_t place : ambient_places_)
        for (const GroupFields& group : fields.groups)
            ambient_state_.push_back(
                {group.mass[place], group.energy[place], group.fraction.empty() ? 1 : group.fraction[place]});
}

void Fluid::close(const DryFace& face)
{
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!(face.fluids >> g & 1)) continue;
        GroupFields& own = fields.groups[g];
        if (own.fraction[face.cell] == 1) { // it gives whatever leaves it, without a look at shares
            own.fraction[face.cell] = marked_full;
            for (AlignedDoubles& side : own.share_of_outflow) side[face.cell] = 1;
        }
        own.share_of_outflow[face.side][face.cell] = 0;
    }
}

void Fluid::start()
{
    update_contents();
    slip_after_remap(fields, slipping);
    hold_nodes(fields, held);
    limit_ = evaluate(0);
    find_node_masses();
    sum_energies();
}

/// Gives ambient cells their state back. What that adds to internal and kinetic energy has come in from
/// outside; the nodes keep their velocities. Returns what came in with the motion.
double Fluid::restore_ambient()
{
    if (ambient_places_.empty()) return 0;
    const double internal = sum_internal(), kinetic = kinetic_energy();
    std::size_t entry = 0;
    for (std::size_t number = 0; number < ambient_places_.size(); ++number) {
        const std::ptrdiff_t place = ambient_places_[number];
        const double size = volume_of(place) / ambient_volume_[number]; // 1 unless the mesh is stretched
        double total = 0;
        for (GroupFields& group : fields.groups) {
            const auto& [mass, energy, fraction] = ambient_state_[entry++];
            group.mass[place] = size * mass;
            group.energy[place] = size * energy;
            if (!group.fraction.empty()) group.fraction[place] = fraction;
            total += size * mass;
        }
        if (fields.groups.size() > 1) fields.mass_of_groups[place] = total;
    }
    update_contents();
    find_node_masses();
    const double gain = kinetic_energy() - kinetic;
    energies_.outflow += internal - sum_internal() - gain;
    return gain;
}

/// Returns the kinetic energy that has left through open sides.
double Fluid::remap()
{
    const double before = open_sides ? sum_internal() : 0;
    const double left = sweep();
    slip_after_remap(fields, slipping);
    hold_nodes(fields, held);
    if (open_sides) energies_.outflow += before - sum_internal() + left;
    if (!fields.lost_motion.empty()) energies_.advection_loss -= return_lost_motion();
    return left;
}

void Fluid::advance(double step, double impulse_step)
{
    const double gravity_work = accelerate(step);
    const OutsideWork by_loads = push_nodes(fields, loads, step, step, gravity);
    double absorbed = 0; // correction of gravity's work
    if (!absorbing.empty()) {
        find_absorbing_forces(fields, absorbing, step, outside_pressure, absorbing_forces_);
        absorbed = push_nodes(fields, absorbing_forces_, step, step, gravity).gravity;
    }
    const OutsideWork outside =
        apply_outside(fields, outside_forces, held, slipping, step, impulse_step, gravity);
    energies_.outside_work += gravity_work + outside.gravity + outside.driving + further_gravity_work(step);
    if (!loads.empty()) energies_.outside_work += by_loads.gravity + work_of_forces(fields, loads, step);
    if (!absorbing.empty())
        energies_.outside_work += absorbed + work_of_forces(fields, absorbing_forces_, step);
    energies_.coupling_work += outside.forces;
    deform(step);
    if (outside_pressure != 0) energies_.outside_work += work_on_sides(step);
    const double before = kinetic_energy();
    const double left = remap();
    const double came_in = restore_ambient();
    ++steps_;
    limit_ = evaluate(step);
    sum_energies();
    energies_.advection_loss += before - left - (energies_.kinetic - came_in);
}

Fluid::Unrest Fluid::unrest()
{
    constexpr double least_share = 1e-3; // of the heaviest node's mass
    if (!(limit_.rate > 0)) return {};
    const double step = stable_step();
    const auto velocity = fields.velocity, mean = fields.mean_velocity;
    accelerate(step);
    push_nodes(fields, loads, step, step, gravity);
    apply_outside(fields, outside_forces, held, slipping, step, step, gravity);
    for (const HeldNode& node : held)
        for (int axis = 0; axis < 3; ++axis)
            if (node.axes & (1u << axis)) fields.velocity[axis][node.place] = velocity[axis][node.place];
    const double heaviest = *std::max_element(fields.node_mass.begin(), fields.node_mass.end());
    Unrest unrest;
    for (std::size_t number = 0; number < node_count(); ++number) {
        const std::ptrdiff_t place = node_place(number);
        if (!(fields.node_mass[place] > least_share * heaviest)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const double now = std::abs(fields.velocity[axis][place] - velocity[axis][place]) / step;
            if (now > unrest.acceleration) unrest = {now, number};
        }
    }
    fields.velocity = velocity;
    fields.mean_velocity = mean;
    return unrest;
}

void Fluid::sum_energies()
{
    energies_.kinetic = kinetic_energy();
    energies_.internal = 0;
    energies_.group_internal.resize(groups.size());
    for (int group = 0; group < static_cast<int>(groups.size()); ++group) {
        energies_.group_internal[group] = internal_energy(group);
        energies_.internal += energies_.group_internal[group];
    }
}

double Fluid::sum_internal() const
{
    double sum = 0;
    for (int group = 0; group < static_cast<int>(groups.size()); ++group) sum += internal_energy(group);
    return sum;
}

void Fluid::serialise(Archive& archive)
{
    archive(fields, limit_.rate, limit_.place, energies_, steps_, lagrange.mesh_velocity, absorbing);
}

} // namespace plash

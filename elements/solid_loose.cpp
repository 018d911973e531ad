#include "elements/solid_group.h"
#include "elements/solid_stability.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();
/// A corner is loose when the group's mass on its node is less than this share of the element's own: four
/// hexahedra around a node make 0.5, eight make 1.
constexpr double loose_share = 0.6;
/// The step stays this far below the bound: Lanczos' frequencies come from below, and shapes change.
constexpr double loose_margin = 0.98;

std::array<Vec3, 8> volume_derivatives(const SolidGradient<double, SolidGradientRule::mean>& b)
{
    SolidModes<double> modes{};
    for (int i = 0; i < 3; ++i) {
        modes.linear[i] = (1.0 / 64) * b.linear[i];
        modes.hourglass[i] = (1.0 / 64) * b.bilinear[i];
    }
    std::array<Vec3, 8> corners;
    for_corners(modes, [&](int corner, const Vec3& value) { corners[corner] = value; });
    return corners;
}

/// What the hourglass control of a solid is to small motions.
void set_hourglass(const SolidHourglass& control, const SolidGradient<double, SolidGradientRule::mean>& b,
                   double mass, double speed, LinearSolid& solid)
{
    using Form = SolidHourglass::Form;
    const double inverse_length = 1 / std::cbrt(b.volume);
    switch (control.form) {
    case Form::viscous:
        solid.hourglass_damping = hourglass_damping(control, mass, speed, inverse_length);
        break;
    case Form::stiffness:
        solid.hourglass = hourglass_stiffness(control, mass / b.volume * speed * speed, b, 1 / b.volume);
        break;
    case Form::total_strain:
    case Form::assumed_strain: // the largest factor of assumed_strain_forces for a cube
        solid.hourglass = control.coefficient * control.shear_modulus / (64 * 3 * inverse_length) * 2 *
                          (1 + control.poisson_ratio) / (1 - control.poisson_ratio);
        break;
    case Form::none:
    case Form::assumed_rate:
        break;
    }
}

/// Largest step that bears stiffness and damping, found from above [time].
double bearable_step(std::span<const LinearSolid> solids, std::span<const Vec3> inverse_mass, double start)
{
    double step = start;
    for (int i = 0; i < 6; ++i) {
        const double next = loose_margin * 2 / std::sqrt(largest_eigenvalue(solids, inverse_mass, step));
        const bool close = next > 0.999 * step;
        step = std::min(step, next);
        if (close) break;
    }
    return step;
}

/// Largest step that a solid bears on its own nodes [time].
double lone_step(LinearSolid solid, double mass, double start)
{
    std::array<Index, 8> nodes = solid.node;
    std::sort(nodes.begin(), nodes.end());
    const auto end = std::unique(nodes.begin(), nodes.end());
    for (Index& node : solid.node)
        node = static_cast<Index>(std::lower_bound(nodes.begin(), end, node) - nodes.begin());
    const auto count = static_cast<double>(end - nodes.begin());
    const std::vector<Vec3> inverse(end - nodes.begin(), {count / mass, count / mass, count / mass});
    return bearable_step({&solid, 1}, inverse, start);
}

/// What linear bulk viscosity leaves of a step.
double slowed_by(double linear)
{
    return 1 / (linear + std::sqrt(1 + linear * linear));
}

/// By node: belongs to a solid that may take its mass with it (*DEFINE_ADAPTIVE_SOLID_TO_SPH); empty without.
std::vector<bool> nodes_that_may_lose(const Model& model)
{
    if (model.stand_ins.empty()) return {};
    std::vector<bool> may(model.nodes.size());
    for (const StandIns& stand_ins : model.stand_ins)
        for (Index node : model.solids.nodes[stand_ins.solid]) may[node] = true;
    return may;
}

/// Solids with numbers of their own for their nodes.
struct Cluster {
    std::vector<LinearSolid> solids;
    std::vector<Vec3> inverse_mass;
    std::vector<Index> number; ///< by node of the group; none: not of the cluster

    Cluster(std::size_t nodes, std::size_t solid_count) : number(nodes, none) { solids.reserve(solid_count); }
    void add(LinearSolid solid, std::span<const Vec3> node_inverse_mass)
    {
        for (Index& node : solid.node) {
            if (number[node] == none) {
                number[node] = static_cast<Index>(inverse_mass.size());
                inverse_mass.push_back(node_inverse_mass[node]);
            }
            node = number[node];
        }
        solids.push_back(solid);
    }
};

} // namespace

/// An element's step, length over wave speed, is that of a plane wave in a mesh, where neighbours share the
/// nodes' masses. An element on its own swells and shrinks faster: a cube with 2 / L sqrt(3 K / rho), which
/// for nu = 0.3 is 1.36 times 2 c / L; rows, plates and corners lie between. Where few elements of the group
/// share nodes, its largest frequency is found. If TSSFAC times the step does not bear it, the elements there
/// get a step that does, with all of the damping; all others keep LS-DYNA's. An element whose nodes are all
/// its own has that of its damping at rest as well, even where it bears more: near the limit it swells and
/// shrinks in a few steps, and a vote that falls whenever it shrinks takes some of its energy away each time.
void SolidGroup::hold_back_loose_elements(const State& state)
{
    // Numbers of the group's own nodes, by entry of the patches, and their masses.
    std::vector<Index> own = patches_.nodes;
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    std::vector<Index> number(patches_.nodes.size());
    std::transform(patches_.nodes.begin(), patches_.nodes.end(), number.begin(), [&](Index node) {
        return static_cast<Index>(std::lower_bound(own.begin(), own.end(), node) - own.begin());
    });
    const auto own_corner = [&](const Patches::Patch& patch, std::size_t place, int corner) {
        const std::uint16_t* offset = patches_.corner_offsets(static_cast<Index>(place / lane_count), corner);
        return number[patch.first_node + offset[place % lane_count] / 4];
    };
    std::vector<double> mass(own.size());
    double smallest = no_bound;
    for_each_element([&](const Patches::Patch& patch, std::size_t place) {
        std::array<Index, 8> corners;
        for (int i = 0; i < 8; ++i) corners[i] = own_corner(patch, place, i);
        std::sort(corners.begin(), corners.end());
        const auto end = std::unique(corners.begin(), corners.end());
        const double share = constant_of(place, mass_constant) / static_cast<double>(end - corners.begin());
        for (auto node = corners.begin(); node != end; ++node) mass[*node] += share;
        smallest = std::min(smallest, first_step_[place]);
    });
    if (!std::isfinite(smallest)) return; // gases without energy
    const double scaled = setup_.model.controls.time.step_scale * smallest;
    const double linear = setup_.parameters.viscosity.linear, slowed = slowed_by(linear);

    const auto linear_solid = [&](const Patches::Patch& patch, std::size_t place) {
        Vec3 corners[8];
        LinearSolid solid;
        for (int i = 0; i < 8; ++i) {
            corners[i] = state.position[corner(patch, place, i)];
            solid.node[i] = own_corner(patch, place, i);
        }
        const SolidModes<double> position = modes_of(corners);
        const auto b = gradient_of<SolidGradientRule::mean>(position);
        solid.gradient = volume_derivatives(b);
        solid.volume = b.volume;
        // Fully integrated elements count the linear viscosity at rest.
        const double undamped = first_step_[place] / (setup_.eight_points ? slowed : 1);
        const double crossing =
            setup_.parameters.length_factor * b.volume / std::sqrt(largest_face_squared(position));
        const double speed = std::isfinite(undamped) ? crossing / undamped : 0;
        const double own_mass = constant_of(place, mass_constant), density = own_mass / b.volume;
        solid.shear = std::min(setup_.shear_modulus, 0.75 * density * speed * speed);
        solid.bulk = density * speed * speed - 4.0 / 3 * solid.shear;
        solid.bulk_viscosity = linear * density * speed * std::cbrt(b.volume);
        if (!setup_.eight_points) set_hourglass(setup_.parameters.hourglass, b, own_mass, speed, solid);
        return solid;
    };

    // Whose neighbours may take mass from common nodes: some day it may be alone.
    const std::vector<bool> may_lose = nodes_that_may_lose(setup_.model);
    for_each_element([&](const Patches::Patch& patch, std::size_t place) {
        bool may = false;
        for (int i = 0; i < 8 && !may_lose.empty(); ++i) may = may || may_lose[corner(patch, place, i)];
        if (!may) return;
        const double own_mass = constant_of(place, mass_constant);
        limit_step(place, lone_step(linear_solid(patch, place), own_mass, scaled) /
                              setup_.model.controls.time.step_scale);
    });

    // Loose elements that would not bear the group's step on their own.
    std::vector<std::size_t> loose, apart;
    std::vector<bool> around(own.size());
    for_each_element([&](const Patches::Patch& patch, std::size_t place) {
        double least = no_bound, most = 0;
        for (int i = 0; i < 8; ++i) {
            least = std::min(least, mass[own_corner(patch, place, i)]);
            most = std::max(most, mass[own_corner(patch, place, i)]);
        }
        if (least >= loose_share * constant_of(place, mass_constant)) return;
        const LinearSolid solid = linear_solid(patch, place);
        const double share = constant_of(place, mass_constant) / distinct_corners(patch, place).count;
        const double square = lone_frequency_squared(solid, share);
        if (!(loose_margin * 2 < scaled * std::sqrt(square))) {
            if (!setup_.eight_points && most < 1.5 * share) apart.push_back(place);
            return;
        }
        loose.push_back(place);
        for (Index node : solid.node) around[node] = true;
    });
    for (std::size_t place : apart) limit_step(place, slowed * first_step_[place]);
    if (loose.empty()) return;

    // They and all that share nodes with them, held where the deck holds them from start to end.
    std::vector<Vec3> inverse_mass;
    for (double m : mass) inverse_mass.push_back({1 / m, 1 / m, 1 / m});
    for (const FixedNodes& fixed : setup_.model.fixed_nodes) {
        if (fixed.local || fixed.system != none || fixed.birth > 0 || fixed.death < forever) continue;
        for (Index node : fixed.nodes) {
            const auto place = std::lower_bound(own.begin(), own.end(), node);
            if (place == own.end() || *place != node) continue;
            Vec3& value = inverse_mass[place - own.begin()];
            if (fixed.freedoms & 1) value.x = 0;
            if (fixed.freedoms & 2) value.y = 0;
            if (fixed.freedoms & 4) value.z = 0;
        }
    }
    const auto beside = [&](const Patches::Patch& patch, std::size_t place) {
        bool any = false;
        for (int i = 0; i < 8; ++i) any = any || around[own_corner(patch, place, i)];
        return any;
    };
    std::size_t members = 0;
    for_each_element(
        [&](const Patches::Patch& patch, std::size_t place) { members += beside(patch, place) ? 1 : 0; });
    Cluster cluster(own.size(), members);
    for_each_element([&](const Patches::Patch& patch, std::size_t place) {
        if (beside(patch, place)) cluster.add(linear_solid(patch, place), inverse_mass);
    });
    // Bulk viscosity acts in every other step of the fastest vibrations, with half of its strength on the
    // whole.
    const double squeezed = setup_.eight_points ? scaled : slowed * scaled;
    const auto bears = [&](double step, double damped) {
        return loose_margin * 2 >=
               step * std::sqrt(largest_eigenvalue(cluster.solids, cluster.inverse_mass, damped));
    };
    if (bears(scaled, no_bound) && bears(squeezed, 2 * squeezed)) return;
    const double together = bearable_step(cluster.solids, cluster.inverse_mass, scaled);
    for (std::size_t place : loose) {
        // No element needs less than it does on its own.
        const double alone =
            lone_step(linear_solid(patch_of(place), place), constant_of(place, mass_constant), scaled);
        limit_step(place, std::max(together, alone) / setup_.model.controls.time.step_scale);
    }
}

void SolidGroup::limit_step(std::size_t place, double limit)
{
    if (!(limit < first_step_[place])) return;
    if (step_factor_.empty()) step_factor_.assign(patches_.batch_count(), broadcast<Lanes>(1));
    if (step_limit_.empty()) step_limit_.assign(patches_.batch_count(), broadcast<Lanes>(no_bound));
    // One-point elements vote for less while they are compressed. The limit counts that already, and holds at
    // rest as well: a step that changes with every swing of the element would feed it.
    const double at_rest =
        setup_.eight_points ? limit : limit / slowed_by(setup_.parameters.viscosity.linear);
    step_factor_[place / lane_count][place % lane_count] = std::min(1.0, at_rest / first_step_[place]);
    step_limit_[place / lane_count][place % lane_count] = limit;
    first_step_[place] = limit;
}

} // namespace plash

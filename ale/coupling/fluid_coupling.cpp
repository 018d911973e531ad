#include "ale/coupling/fluid_coupling.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

using Direction = CouplingOptions::Direction;

/// Density times square of the sound speed at the reference density [pressure].
double reference_stiffness(const DeckGroup& group)
{
    return fluid_state(group.law, group.density, group.energy_per_mass).stiffness;
}

} // namespace

FluidCoupling::FluidCoupling(const Model& model, CouplingOptions options, Surface surface,
                             EulerianFluid& fluid, const std::vector<Vec3>& position)
    : model_(model),
      options_(std::move(options)),
      // Two points a cell: the cells between them may not find a way through.
      points_(
          std::move(surface), options_.points_per_edge,
          [&](const Vec3& a, const Vec3& b) { return fluid.fluid().point_spacing(a, b); }, position),
      fluid_(fluid),
      touches_(points_.size()),
      penetration_(points_.size()),
      slip_(points_.size()),
      force_(points_.size()),
      cell_(points_.size()),
      segment_near_(points_.surface().segments.size()),
      load_(fluid.fluid().fields.node_mass.size()),
      structure_load_(position.size()),
      dry_faces_(fluid.fluid()),
      interface_depth_(fluid.fluid()),
      entry_(fluid.fluid().fields.node_mass.size(), none)
{
    for (const DeckGroup& group : fluid.groups().groups)
        if (group.fluid != none) bulk_modulus_.push_back(reference_stiffness(group));
    for (const Record& record : model.others)
        hydrostatic_ = hydrostatic_ || record.keyword == "INITIAL_HYDROSTATIC_ALE";
    if (!hydrostatic_) return;
    rest_depth_.resize(points_.size());
    rest_unevenness_.resize(points_.size());
}

/// Share of the coupled fluids half a cell before the surface: a surface that stands anywhere in its cell,
/// with fluid up to it, sees the same.
double FluidCoupling::fraction_before(const Touch& touch) const
{
    const Fluid& fluid = fluid_.fluid();
    const double reach = 0.5 * length_along(fluid.edges(touch.place), touch.normal);
    const MeshPoint before = fluid.locate(touch.position + reach * touch.normal, touch.place.cell);
    if (!before.inside) return 0;
    const PlaceWeights around = fluid.cell_weights(before);
    double sum = 0;
    for (std::size_t g = 0; g < fluid.groups.size(); ++g) {
        if (!(options_.fluids >> g & 1)) continue;
        const AlignedDoubles& fraction = fluid.fields.groups[g].fraction;
        for (int corner = 0; corner < 8; ++corner)
            sum += around.weight[corner] * (fraction.empty() ? 1.0 : fraction[around.place[corner]]);
    }
    return sum;
}

/// How much more of a partly empty cell is full than lies on the fluid's side of the surface through a point.
double FluidCoupling::share_behind(const MeshPoint& at, const Vec3& normal) const
{
    const Fluid& fluid = fluid_.fluid();
    const std::ptrdiff_t cell = fluid.place_of(at);
    double filled = 0;
    for (const GroupFields& group : fluid.fields.groups)
        filled += group.fraction.empty() ? 1 : group.fraction[cell];
    if (filled >= 1) return 0;
    return std::max(filled - share_before_plane(fluid.edges(at), at.part, normal), 0.0);
}

/// Whether fluid may stand at the points of a segment.
bool FluidCoupling::is_near(std::size_t segment, const State& state) const
{
    const Segment& own = points_.surface().segments[segment];
    if (!is_exposed(own, state)) return false;
    const auto& nodes = own.nodes;
    Vec3 low = state.position[nodes[0]], high = low;
    for (const Index node : nodes) {
        const Vec3& x = state.position[node];
        low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
        high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    const Vec3 reach{own.half_thickness, own.half_thickness, own.half_thickness};
    return !fluid_.fluid().dry_around(low - reach, high + reach, cell_[points_.first_point(segment)],
                                      options_.fluids);
}

/// Lists the points at which fluid may stand; most points of most surfaces are far from any. What those that
/// were near and are no longer knew is forgotten.
void FluidCoupling::find_near(const Clock& clock, const State& state)
{
    for (const Index point : near_) touches_[point].active = touches_[point].place.inside = false;
    near_.clear();
    if (clock.time < options_.start || clock.time > options_.end) return;
    const std::size_t segments = points_.surface().segments.size();
    for_chunks(segments, [&](std::size_t begin, std::size_t end) {
        for (std::size_t segment = begin; segment < end; ++segment)
            segment_near_[segment] = is_near(segment, state);
    });
    for (std::size_t segment = 0; segment < segments; ++segment) {
        if (!segment_near_[segment]) continue;
        for (std::size_t point = points_.first_point(segment); point < points_.first_point(segment + 1);
             ++point)
            near_.push_back(static_cast<Index>(point));
    }
}

/// Lists the points that fluid stands before; the others have neither force nor memory.
void FluidCoupling::list_active()
{
    for (const Index point : active_) {
        if (touches_[point].active) continue;
        penetration_[point] = 0;
        if (hydrostatic_) rest_depth_[point] = rest_unevenness_[point] = 0;
        slip_[point] = force_[point] = {};
    }
    active_.clear();
    for (const Index point : near_)
        if (touches_[point].active) active_.push_back(point);
}

void FluidCoupling::serialise(Archive& archive)
{
    archive(penetration_, rest_depth_, rest_unevenness_, slip_, force_, cell_, work_on_structure_);
    if (!archive.loading()) return;
    active_.clear();
    for (std::size_t point = 0; point < points_.size(); ++point)
        if (penetration_[point] != 0 || dot(slip_[point], slip_[point]) > 0 ||
            dot(force_[point], force_[point]) > 0)
            active_.push_back(static_cast<Index>(point));
}

/// Where a point lies. On a face between two cells, which is where walls stand in a mesh that fits them, it
/// lies in the one on the fluid's side, whatever round-off says: that one holds its fluid. On a face that the
/// surface crosses it lies in the upper cell, so that round-off does not decide with which springs it goes.
MeshPoint FluidCoupling::place_before(const Touch& touch, const std::array<int, 3>& guess) const
{
    constexpr double round_off = 1e-9;
    const Fluid& fluid = fluid_.fluid();
    const MeshPoint at = fluid.locate(touch.position, guess);
    if (at.inside && std::all_of(at.part.begin(), at.part.end(),
                                 [](double part) { return part > round_off && part < 1 - round_off; }))
        return at;
    if (!at.inside)
        return fluid.locate(touch.position + 2 * round_off * std::sqrt(touch.area) * touch.normal, guess);
    const std::array<Vec3, 3> edges = fluid.edges(at);
    const Vec3 upward = 0.25 * round_off * (edges[0] + edges[1] + edges[2]);
    const Vec3 forward = 2 * round_off * length_along(edges, touch.normal) * touch.normal;
    return fluid.locate(touch.position + forward + upward, at.cell);
}

void FluidCoupling::look(std::size_t point, const State& state)
{
    Touch& touch = touches_[point];
    const CouplingPoints::Motion motion = points_.motion(point, state);
    touch.area = norm(motion.area);
    if (!(touch.area > 0)) return;
    touch.normal = ((options_.turned ? -1 : 1) / touch.area) * motion.area;
    touch.position = motion.position + points_.half_thickness(point) * touch.normal;
    const Fluid& fluid = fluid_.fluid();
    const MeshPoint at = touch.place = place_before(touch, cell_[point]);
    if (!at.inside) return;
    cell_[point] = at.cell;
    // A point that holds fluid lets it go later than it took it: what has come through would be lost with the
    // spring, again and again where the fraction wavers.
    const double least = (penetration_[point] != 0 ? 0.5 : 1) * options_.least_fraction;
    if (fraction_before(touch) < least) return;

    touch.at = fluid.node_weights(at);
    double filled = 0, density = 0, heaviest = 0;
    for (const std::ptrdiff_t place : touch.at.place)
        heaviest = std::max(heaviest, fluid.fields.node_mass[place]);
    // Nodes with next to nothing bear no spring, and would make that of the others as weak as they are.
    const double least_mass = 1e-4 * heaviest;
    for (int corner = 0; corner < 8; ++corner) {
        double& weight = touch.at.weight[corner];
        if (!(fluid.fields.node_mass[touch.at.place[corner]] > least_mass)) weight = 0;
        filled += weight;
    }
    if (filled < 1e-6) return;
    for (double& weight : touch.at.weight) weight /= filled;
    double stiffness = 0;
    for (std::size_t g = 0; g < fluid.groups.size(); ++g) {
        if (!(options_.fluids >> g & 1) || bulk_modulus_[g] < stiffness) continue;
        const AlignedDoubles& fraction = fluid.fields.groups[g].fraction;
        const std::ptrdiff_t cell = fluid.place_of(at);
        const bool only = fluid.groups.size() == 1 || fraction.empty() || fraction[cell] > 0;
        if (!only) continue;
        stiffness = bulk_modulus_[g];
        density = fluid.groups[g].reference_density;
    }
    const double length = length_along(fluid.edges(at), touch.normal);
    const double penalty = options_.stiffest ? 1 : options_.penalty;
    const double damping = options_.stiffest ? 1 : options_.damping;
    touch.stiffness = penalty * stiffness * touch.area / length;
    touch.damper = 2 * damping * std::sqrt(touch.stiffness * 0.5 * density * touch.area * length);
    touch.sound_rate = std::sqrt(stiffness / density) / length;
    touch.velocity = motion.velocity;
    touch.excess = options_.leak_control > 0 ? length * share_behind(at, touch.normal) : 0;
    touch.active = true;
}

/// A spring k and a damper c between masses are stable in central difference while k dt^2 + 2 c dt stays
/// below four times the mass; half of that is used. Sums over all points of a node bound the largest
/// eigenvalue (Gershgorin).
double FluidCoupling::needed_mass(const Touch& touch) const
{
    const double step = step_bound();
    return 0.5 * (touch.stiffness * step * step + 2 * touch.damper * step);
}

/// Adds up in load_ what the points want of the fluid's nodes.
void FluidCoupling::add_loads()
{
    for (const Index point : active_) {
        const Touch& touch = touches_[point];
        const double needed = needed_mass(touch);
        for (int corner = 0; corner < 8; ++corner)
            load_[touch.at.place[corner]] += touch.at.weight[corner] * needed;
    }
}

void FluidCoupling::clear_loads()
{
    for (const Index point : active_)
        for (const std::ptrdiff_t place : touches_[point].at.place) load_[place] = 0;
}

void FluidCoupling::limit_stiffness(const State& state)
{
    const AlignedDoubles& mass = fluid_.fluid().fields.node_mass;
    const auto for_corners = [&](std::size_t point, auto&& visit) {
        for (int corner = 0; corner < 4; ++corner) {
            const Index node = points_.nodes(point)[corner];
            if (state.mass[node] > 0) visit(node, points_.place(point).weight[corner]);
        }
    };
    add_loads();
    for (const Index point : active_) {
        const double needed = needed_mass(touches_[point]);
        for_corners(point, [&](Index node, double weight) { structure_load_[node] += weight * needed; });
    }
    for_chunks(active_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry) {
            const Index point = active_[entry];
            Touch& touch = touches_[point];
            double share = 1;
            for (int corner = 0; corner < 8; ++corner) {
                const std::ptrdiff_t place = touch.at.place[corner];
                if (touch.at.weight[corner] > 0) share = std::min(share, mass[place] / load_[place]);
            }
            for_corners(point, [&](Index node, double) {
                share = std::min(share, state.mass[node] / structure_load_[node]);
            });
            touch.stiffness *= share;
            touch.damper *= share;
        }
    });
    clear_loads();
    for (const Index point : active_)
        for_corners(point, [&](Index node, double) { structure_load_[node] = 0; });
}

/// Pressure of a fluid at rest on the surface at a point [pressure]: that of the cell before it, and along
/// the surface's normal what the fluid weighs between the middle of the cell and the surface. Across the
/// normal it stays that of the cell, for so it presses on the nodes of the mesh: fluid between surfaces along
/// its faces is in balance to round-off.
double FluidCoupling::pressure_before(const Touch& touch, const Vec3& gravity) const
{
    const Fluid& fluid = fluid_.fluid();
    const double reach = 0.5 * length_along(fluid.edges(touch.place), touch.normal);
    const Vec3 place = touch.position + reach * touch.normal;
    const MeshPoint before = fluid.locate(place, touch.place.cell);
    if (!before.inside) return 0;
    const std::ptrdiff_t cell = fluid.place_of(before);
    double filled = 0;
    for (const GroupFields& group : fluid.fields.groups)
        filled += group.fraction.empty() ? 1 : group.fraction[cell];
    if (!(filled > 0)) return 0;
    const std::array<Vec3, 3> edges = fluid.edges(before);
    Vec3 middle = place;
    for (int axis = 0; axis < 3; ++axis) middle += (0.5 - before.part[axis]) * edges[axis];
    const double density = fluid.fields.total_mass()[cell] / (filled * fluid.volume_of(cell));
    return fluid.fields.pressure[cell] +
           density * dot(gravity, touch.normal) * dot(touch.position - middle, touch.normal);
}

/// The point carries the pressure of a fluid at rest: its spring starts as long as that takes.
void FluidCoupling::rest_on(std::size_t point, const Vec3& gravity)
{
    Touch& touch = touches_[point];
    touch.approach = {};
    touch.pressing = touch.area * pressure_before(touch, gravity);
    slip_[point] = {};
    penetration_[point] = touch.stiffness > 0 ? touch.pressing / touch.stiffness : 0;
    if (hydrostatic_) rest_unevenness_[point] = 0;
}

void FluidCoupling::stretch(std::size_t point, const Clock& clock)
{
    Touch& touch = touches_[point];
    const auto& v = fluid_.fluid().fields.velocity;
    touch.approach = touch.velocity;
    for (int corner = 0; corner < 8; ++corner) {
        const std::ptrdiff_t place = touch.at.place[corner];
        touch.approach -= touch.at.weight[corner] * Vec3{v[0][place], v[1][place], v[2][place]};
    }
    penetration_[point] += dot(touch.approach, touch.normal) * clock.last_step;
}

void FluidCoupling::load_spring(std::size_t point, const Clock& clock)
{
    correct_depth(point, clock);
    Touch& touch = touches_[point];
    const double depth = penetration_[point];
    touch.pressing = touch.stiffness * depth + touch.damper * dot(touch.approach, touch.normal);
    if (options_.pressure_curve != none)
        touch.pressing = touch.area * curve_value(model_, options_.pressure_curve, depth);
}

/// In compression only the fluid leaves the surface where the points around press it away no longer, taken
/// together. One by one they would press on what comes and let go what returns, so that any wavering of the
/// fluid pumps it through the surface.
void FluidCoupling::separate()
{
    for (const Index point : active_) {
        const Touch& touch = touches_[point];
        for (int corner = 0; corner < 8; ++corner)
            load_[touch.at.place[corner]] += touch.at.weight[corner] * touch.pressing;
    }
    for_chunks(active_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry) {
            const Index point = active_[entry];
            Touch& touch = touches_[point];
            if (touch.pressing >= 0) continue;
            double around = 0;
            for (int corner = 0; corner < 8; ++corner)
                around += touch.at.weight[corner] * load_[touch.at.place[corner]];
            if (around > 0) continue;
            touch.pressing = 0;
            penetration_[point] = std::max(penetration_[point], 0.0);
        }
    });
    clear_loads();
}

void FluidCoupling::press(std::size_t point, const Clock& clock)
{
    const Touch& touch = touches_[point];
    const double pressing = touch.pressing;
    force_[point] = -pressing * touch.normal;

    const bool held = options_.direction == Direction::all;
    if (!held && options_.friction == 0) return;
    const Vec3 across = touch.approach - dot(touch.approach, touch.normal) * touch.normal;
    Vec3& slip = slip_[point];
    slip += clock.last_step * across;
    slip -= dot(slip, touch.normal) * touch.normal;
    Vec3 drag = touch.stiffness * slip + touch.damper * across;
    const double most =
        held ? std::numeric_limits<double>::infinity() : options_.friction * std::max(pressing, 0.0);
    if (const double size = norm(drag); size > most) {
        drag = (most / size) * drag;
        if (touch.stiffness > 0) slip = (1 / touch.stiffness) * drag;
    }
    force_[point] -= drag;
}

void FluidCoupling::push_fluid(const Touch& touch, const Vec3& force)
{
    auto& outside = fluid_.fluid().outside_forces;
    for (int corner = 0; corner < 8; ++corner) {
        const double weight = touch.at.weight[corner];
        if (weight == 0) continue;
        Index& entry = entry_[touch.at.place[corner]];
        if (entry == none) {
            entry = static_cast<Index>(outside.size());
            outside.push_back({touch.at.place[corner], {}});
        }
        auto& sum = outside[entry].force;
        sum[0] -= weight * force.x;
        sum[1] -= weight * force.y;
        sum[2] -= weight * force.z;
    }
}

/// Only where the mesh has void: what a dry face keeps back, void replaces in what passes it.
void FluidCoupling::find_dry_faces()
{
    if (!fluid_.fluid().lagrange.void_allowed) return;
    present_.clear();
    asking_.clear();
    for (const Index point : near_) {
        const Touch& touch = touches_[point];
        if (!touch.place.inside) continue;
        if (touch.active) asking_.push_back(static_cast<Index>(present_.size()));
        present_.push_back({touch.place, touch.position, touch.normal});
    }
    dry_faces_.find(fluid_.fluid(), present_, options_.fluids);
    interface_depth_.collect(fluid_.fluid(), present_, asking_, options_.fluids);
}

/// In the order of the points, so that sums are the same for any number of threads.
void FluidCoupling::hand_out(const Clock&, State& state)
{
    for (const Index point : active_) {
        const Vec3& force = force_[point];
        if (force.x == 0 && force.y == 0 && force.z == 0) continue;
        for (int corner = 0; corner < 4; ++corner)
            state.force[points_.nodes(point)[corner]] += points_.place(point).weight[corner] * force;
        push_fluid(touches_[point], force);
    }
    for (const NodeForceFromOutside& outside : fluid_.fluid().outside_forces) entry_[outside.place] = none;
}

void FluidCoupling::add_forces(const Clock& clock, State& state)
{
    const std::vector<Vec3>& velocity = state.velocity;
    // Trapezoidal rule over the last step: the forces of both ends on the way between.
    const auto work_of = [&](std::size_t begin, std::size_t end) {
        double work = 0;
        for (std::size_t entry = begin; entry < end; ++entry) {
            const Index point = active_[entry];
            const Vec3& force = force_[point];
            for (int corner = 0; corner < 4; ++corner)
                work +=
                    points_.place(point).weight[corner] * dot(force, velocity[points_.nodes(point)[corner]]);
        }
        return work;
    };
    const double before = sum_chunks(active_.size(), work_of);
    find_near(clock, state);
    for_chunks(near_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry) look(near_[entry], state);
    });
    list_active();
    find_dry_faces();
    limit_stiffness(state);
    // A force by a curve over the penetration has no penetration of its own for every force.
    const bool rests =
        clock.relaxing || (hydrostatic_ && clock.cycle == 0 && options_.pressure_curve == none);
    const std::array<double, 3> gravity = fluid_.gravity(clock.time);
    for_chunks(active_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry) {
            if (rests)
                rest_on(active_[entry], {gravity[0], gravity[1], gravity[2]});
            else
                stretch(active_[entry], clock);
        }
    });
    sum_depths();
    for_chunks(active_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry) {
            const Index point = active_[entry];
            if (!rests)
                load_spring(point, clock);
            else
                remember_rest(point);
        }
    });
    if (options_.direction == Direction::compression) separate();
    for_chunks(active_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry) press(active_[entry], clock);
    });
    work_on_structure_ += 0.5 * clock.last_step * (before + sum_chunks(active_.size(), work_of));
    hand_out(clock, state);
}

void FluidCoupling::report(EnergyLedger& ledger) const
{
    ledger.sliding -= work_on_structure_;
}

void FluidCoupling::collect(const State& state, ElementResults& results) const
{
    if (options_.contact != 0) results.contacts.push_back(as_contact(state));
    if (results.coupling_force.empty()) return;
    for (const Index point : active_)
        for (int corner = 0; corner < 4; ++corner)
            results.coupling_force[points_.nodes(point)[corner]] +=
                points_.place(point).weight[corner] * force_[point];
}

/// The force as that of a contact between the fluid and the structure.
ElementResults::ContactForce FluidCoupling::as_contact(const State& state) const
{
    ElementResults::ContactForce contact;
    contact.contact = std::abs(options_.contact);
    const bool structure_is_slave = options_.contact < 0;
    Vec3& force = structure_is_slave ? contact.slave_force : contact.master_force;
    Vec3& moment = structure_is_slave ? contact.slave_moment : contact.master_moment;
    for (const Index point : active_) {
        force += force_[point];
        moment += cross(points_.motion(point, state).position, force_[point]);
    }
    (structure_is_slave ? contact.master_force : contact.slave_force) = -force;
    (structure_is_slave ? contact.master_moment : contact.slave_moment) = -moment;
    (structure_is_slave ? contact.slave_energy : contact.master_energy) = -work_on_structure_;
    return contact;
}

Vec3 FluidCoupling::force() const
{
    Vec3 sum{};
    for (const Index point : active_) sum += force_[point];
    return sum;
}

} // namespace plash

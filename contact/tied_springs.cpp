#include "contact/tied_springs.h"

#include "contact/penalty_law.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

constexpr std::string_view voter = "tied contact at node";

bool all_turn(const State& state, const TiedPoint& point)
{
    return std::all_of(point.corner.begin(), point.corner.end(),
                       [&](Index corner) { return state.inertia[corner] > 0; });
}

} // namespace

std::vector<double> node_areas(const Surface& surface, const std::vector<Vec3>& position)
{
    std::vector<double> area(surface.nodes.size());
    for (const Segment& segment : surface.segments) {
        const int corners = segment.nodes[3] == segment.nodes[2] ? 3 : 4;
        const double share = segment_area(segment.nodes, position) / corners;
        for (int i = 0; i < corners; ++i) {
            const auto place =
                std::lower_bound(surface.nodes.begin(), surface.nodes.end(), segment.nodes[i],
                                 [](const ContactNode& a, Index node) { return a.node < node; });
            area[place - surface.nodes.begin()] += share;
        }
    }
    return area;
}

TiedSprings::TiedSprings(const Contact& contact, const Model& model, const Surface& slave,
                         const Surface& master, std::vector<TiedPoint> points)
    : contact_(contact),
      model_(model),
      segments_(master.segments),
      rotations_(contact.tie.rotations || contact.tie.moment_offset)
{
    // Sides of a block beside the tied face share its rim, but not its area.
    Surface face = slave;
    std::erase_if(face.segments, [&](const Segment& segment) {
        return !std::all_of(segment.nodes.begin(), segment.nodes.end(), [&](Index corner) {
            return std::any_of(points.begin(), points.end(), [&](const TiedPoint& point) {
                return slave.nodes[point.slave].node == corner;
            });
        });
    });
    const std::vector<double> area = node_areas(face, model.nodes.position);
    const bool by_force = contact.tie.by_force;
    for (const TiedPoint& point : points) {
        const Segment& segment = master.segments[point.segment];
        const ContactNode& node = slave.nodes[point.slave];
        Spring spring{point, TieShape(point.s, point.t, point.triangle())};
        spring.side = point.height < -1e-9 * point.size ? -1 : 1;
        spring.unscaled = contact.penalty_scale *
                          unscaled_stiffness(contact.penalty_option, node.stiffness, segment.stiffness);
        // A lone node, or one of a node set, stands for a segment's share.
        const double own = area[point.slave] > 0 ? area[point.slave] : segment.size * segment.size;
        spring.area = by_force ? 1 : own;
        if (contact.tie.normal_stiffness > 0) spring.unscaled = contact.tie.normal_stiffness * own;
        springs_.push_back(spring);
    }
}

TiedSprings::TiedSprings(const Contact& contact, const Model& model, std::vector<Segment> segments)
    : contact_(contact),
      model_(model),
      segments_(std::move(segments)),
      rotations_(contact.tie.rotations || contact.tie.moment_offset)
{}

void TiedSprings::hold(const TiedPoint& point, double side, double stiffness, double area, const State& state)
{
    Spring spring{point, TieShape(point.s, point.t, point.triangle())};
    spring.side = side;
    spring.area = area;
    const double own = contact_.tie.normal_stiffness * area;
    spring.unscaled = own > 0 ? own : contact_.penalty_scale * stiffness;
    if (first_step_ > 0) set_stiffness(spring, state);
    springs_.push_back(spring);
    set_vote(state);
}

std::vector<Index> TiedSprings::held_nodes() const
{
    std::vector<Index> nodes;
    for (const Spring& spring : springs_) {
        if (!spring.broken) nodes.push_back(spring.point.node);
    }
    return nodes;
}

/// Once the step is known; springs without a stiffness of their own, and those of SOFT = 1 and 2, take what
/// the masses and the step bear.
void TiedSprings::set_stiffness(Spring& spring, const State& state) const
{
    double smallest = state.mass[spring.point.node] > 0 ? state.mass[spring.point.node] : 1e300;
    for (Index corner : spring.point.corner) {
        if (state.mass[corner] > 0) smallest = std::min(smallest, state.mass[corner]);
    }
    if (smallest == 1e300) smallest = 0;
    const double step2 = first_step_ * first_step_;
    const double soft = 0.5 * contact_.soft_scale * smallest / step2;
    spring.stiffness = spring.unscaled;
    if (contact_.soft != 0 || spring.unscaled == 0) spring.stiffness = std::max(spring.unscaled, soft);
    if (!rotations_ || !state.rotational() || state.inertia[spring.point.node] == 0) return;
    const double lever = spring.stiffness * spring.point.size * spring.point.size / 12;
    spring.turn_stiffness = std::min(lever, 0.1 * state.inertia[spring.point.node] / step2);
}

/// Gershgorin's bound for the springs on the nodes' masses; nodes without mass in the State (rigid bodies)
/// count as heavy.
void TiedSprings::set_vote(const State& state)
{
    std::vector<std::pair<Index, double>> hung;
    for (const Spring& spring : springs_) {
        hung.emplace_back(spring.point.node, spring.stiffness);
        for (int i = 0; i < 4; ++i) {
            hung.emplace_back(spring.point.corner[i], std::abs(spring.shape.value[i]) * spring.stiffness);
        }
    }
    std::sort(hung.begin(), hung.end());
    double largest = 0;
    for (std::size_t i = 0; i < hung.size();) {
        const Index node = hung[i].first;
        double sum = 0;
        for (; i < hung.size() && hung[i].first == node; ++i) sum += hung[i].second;
        if (state.mass[node] <= 0 || sum <= largest * state.mass[node]) continue;
        largest = sum / state.mass[node];
        vote_ = {2 / std::sqrt(2 * largest), voter, model_.nodes.id[node], 0};
    }
}

void TiedSprings::follow_erosion(const State& state)
{
    if (state.deletions == deletions_seen_) return;
    deletions_seen_ = state.deletions;
    for (Spring& spring : springs_) {
        if (spring.broken || is_exposed(segments_[spring.point.segment], state)) continue;
        spring.broken = true;
        ++broken_;
        released_.push_back(spring.point.node);
    }
}

bool TiedSprings::fails(const Spring& spring, double tension, double shear) const
{
    const Tie& tie = contact_.tie;
    if (tie.failure <= 1) return false;
    double value = 0;
    if (tie.normal_strength > 0 && tension > 0) {
        value += std::pow(tension / spring.area / tie.normal_strength, tie.normal_exponent);
    }
    if (tie.shear_strength > 0 && tie.failure != 4) {
        value += std::pow(shear / spring.area / tie.shear_strength, tie.shear_exponent);
    }
    return value >= 1;
}

/// Force of a spring at n; marks it broken where it fails.
void TiedSprings::load(const Clock& clock, const State& state, Spring& spring) const
{
    const TiedPoint& point = spring.point;
    const TieFrame frame(spring.shape, at_corners(state.position, point));
    const Vec3 gap = state.position[point.node] - frame.place - point.height * frame.normal;
    const Vec3 normal = spring.side * frame.normal;
    const double open = dot(gap, normal);
    Vec3 slip = gap - open * normal;
    const bool tension_only = contact_.tie.failure == 4;
    if (tension_only) slip = {};
    const double normal_force = spring.stiffness * open;
    const double shear_stiffness = spring.stiffness * contact_.tie.stiffness_ratio;
    const double shear_force = shear_stiffness * norm(slip);

    const double opening = std::sqrt(std::max(open, 0.0) * std::max(open, 0.0) + dot(slip, slip));
    const double limit = contact_.tie.parameter;
    const bool softens = (contact_.tie.failure == 6 || contact_.tie.failure == 8) && limit > 0;
    if (spring.onset == 0 && fails(spring, normal_force, shear_force)) {
        spring.onset = std::max(opening, 1e-300);
        if (!softens || spring.onset >= limit) spring.broken = true;
    }
    if (spring.onset > 0 && softens && opening > spring.onset && !spring.broken) {
        const double kept = spring.onset * (limit - opening) / (opening * (limit - spring.onset));
        spring.damage = std::max(spring.damage, 1 - kept);
        if (opening >= limit) spring.broken = true;
    }
    if (spring.broken) return;
    const double left = 1 - spring.damage;
    const double pull = open > 0 ? left * normal_force : (tension_only ? 0 : normal_force);
    spring.force = -pull * normal - (left * shear_stiffness) * slip;

    const auto corner_velocity = at_corners(state.velocity, point);
    const TieRates rates = tie_rates(spring.shape, frame, point.height, corner_velocity);
    if (contact_.damping > 0 && !tension_only && state.mass[point.node] > 0) {
        double inverse = 0;
        for (int i = 0; i < 4; ++i) {
            const double mass = state.mass[point.corner[i]];
            if (mass > 0) inverse += spring.shape.value[i] * spring.shape.value[i] / mass;
        }
        const double facet_mass = inverse > 0 ? 1 / inverse : 1e6 * state.mass[point.node];
        const double damping = damping_coefficient(contact_.damping, left * spring.stiffness,
                                                   state.mass[point.node], facet_mass);
        spring.force -= damping * (state.velocity[point.node] - rates.velocity);
    }
    Vec3 on_segment{};
    if (spring.turn_stiffness > 0) {
        Vec3 spin = rates.spin;
        const bool turn = all_turn(state, point);
        if (turn) {
            spin = {};
            for (int i = 0; i < 4; ++i)
                spin += spring.shape.value[i] * state.angular_velocity[point.corner[i]];
        }
        const Vec3 turned = clock.last_step * (state.angular_velocity[point.node] - spin);
        spring.moment -= spring.turn_stiffness * turned;
        if (!turn) on_segment = -spring.moment;
    }
    spring.corner_force = spread_to_corners(spring.shape, frame, point.height, -spring.force, on_segment);
}

void TiedSprings::add_forces(const Clock& clock, State& state)
{
    released_.clear();
    follow_erosion(state);
    if (clock.time < contact_.birth || clock.time > contact_.death) return;
    if (clock.last_step > 0 && first_step_ == 0) {
        first_step_ = clock.last_step;
        for (Spring& spring : springs_) set_stiffness(spring, state);
        set_vote(state);
    }
    for (Spring& spring : springs_) {
        if (spring.broken) continue;
        const TiedPoint& point = spring.point;
        const Vec3 force_before = spring.force, moment_before = spring.moment;
        const std::array<Vec3, 4> corners_before = spring.corner_force;
        load(clock, state, spring);
        if (spring.broken) {
            spring.force = spring.moment = {};
            spring.corner_force = {};
            ++broken_;
            released_.push_back(point.node);
        }
        double slave = dot(spring.force + force_before, state.velocity[point.node]), master = 0;
        state.force[point.node] += spring.force;
        for (int i = 0; i < 4; ++i) {
            master += dot(spring.corner_force[i] + corners_before[i], state.velocity[point.corner[i]]);
            state.force[point.corner[i]] += spring.corner_force[i];
        }
        if (spring.turn_stiffness > 0) {
            const Vec3 moment = spring.moment + moment_before;
            slave += dot(moment, state.angular_velocity[point.node]);
            state.moment[point.node] += spring.moment;
            if (all_turn(state, point)) {
                for (int i = 0; i < 4; ++i) {
                    const double share = spring.shape.value[i];
                    master -= share * dot(moment, state.angular_velocity[point.corner[i]]);
                    state.moment[point.corner[i]] -= share * spring.moment;
                }
            }
        }
        slave_energy_ -= 0.5 * clock.last_step * slave;
        master_energy_ -= 0.5 * clock.last_step * master;
    }
}

void TiedSprings::collect(const State& state, ElementResults::ContactForce& sum) const
{
    sum.slave_energy += slave_energy_;
    sum.master_energy += master_energy_;
    for (const Spring& spring : springs_) {
        sum.slave_force += spring.force;
        sum.slave_moment += cross(state.position[spring.point.node], spring.force);
        for (int i = 0; i < 4; ++i) {
            sum.master_force += spring.corner_force[i];
            sum.master_moment += cross(state.position[spring.point.corner[i]], spring.corner_force[i]);
        }
    }
}

void TiedSprings::collect_nodes(std::vector<Vec3>& contact_force) const
{
    for (const Spring& spring : springs_) {
        contact_force[spring.point.node] += spring.force;
        for (int i = 0; i < 4; ++i) contact_force[spring.point.corner[i]] += spring.corner_force[i];
    }
}

void TiedSprings::serialise(Archive& archive)
{
    archive(springs_, broken_, slave_energy_, master_energy_, deletions_seen_, first_step_);
    archive(vote_.step, vote_.element);
    vote_.kind = voter;
}

void TiedContact::add_forces(const Clock& clock, State& state)
{
    springs_.add_forces(clock, state);
}

void TiedContact::collect(const State& state, ElementResults& results) const
{
    ElementResults::ContactForce sum;
    sum.contact = contact_.id;
    springs_.collect(state, sum);
    results.contacts.push_back(sum);
    if (!results.contact_force.empty()) springs_.collect_nodes(results.contact_force);
}

} // namespace plash

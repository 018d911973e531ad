#include "contact/rigid_wall.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

/// Share of m / dt^2 for nodes of rigid bodies; a spring on a free mass is stable up to 4.
constexpr double spring_share = 0.1;

} // namespace

RigidWallTerm::RigidWallTerm(const RigidWall& wall, const Model& model, const State& state)
    : wall_(wall), model_(model), velocity_(wall.start_velocity * wall.normal)
{
    std::vector<bool> candidate(state.size(), wall.all_nodes);
    for (Index node : wall.nodes) candidate[node] = true;
    for (Index node : wall.excluded) candidate[node] = false;
    std::vector<bool> weighty(state.size()); // has mass, or will have when it comes out of a solid
    for (std::size_t node = 0; node < state.size(); ++node) weighty[node] = state.mass[node] > 0;
    if (!model.stand_ins.empty())
        for (Index node : model.particles.node) weighty[node] = true;
    for (std::size_t node = 0; node < state.size(); ++node) {
        const double gap = dot(model.nodes.position[node] - wall.tail, wall.normal);
        if (wall.offset > 0 && gap > wall.offset) continue;
        if (!candidate[node] || !weighty[node]) continue;
        nodes_.push_back(static_cast<Index>(node));
        mass_.push_back(state.mass[node]);
    }
    if (wall.friction >= 2) welded_.resize(nodes_.size());
}

/// In the first cycle rigid bodies have taken their nodes, and the step is known.
void RigidWallTerm::start(const Clock& clock, const State& state)
{
    started_ = true;
    spring_rate_ = spring_share / (clock.step * clock.step);
    const auto of_body = [&](std::size_t i) { return state.mass[nodes_[i]] == 0 && mass_[i] > 0; };
    bool rigid = false;
    for (std::size_t i = 0; i < nodes_.size(); ++i) rigid = rigid || of_body(i);
    const bool parts_are_switched =
        std::any_of(model_.others.begin(), model_.others.end(),
                    [](const Record& record) { return record.keyword == "DEFORMABLE_TO_RIGID_AUTOMATIC"; });
    if (!rigid && !parts_are_switched) return;
    pushed_.resize(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (!of_body(i)) { // never, should its mass go some day but to a body
            if (!parts_are_switched) pushed_[i].baseline = -forever;
            continue;
        }
        const WallMeeting met = meet(wall_, state.position[nodes_[i]], state.position[nodes_[i]]);
        if (met.inside) pushed_[i].baseline = met.now;
    }
}

/// Where a node would be after the step without the wall, as the wall sees it.
WallMeeting RigidWallTerm::meeting_of(std::size_t i, const Clock& clock, const State& state,
                                      const Vec3& wall_velocity) const
{
    const Index node = nodes_[i];
    const Vec3 now = state.position[node] - moved_;
    const Vec3 free = state.velocity[node] + (clock.velocity_step() / state.mass[node]) * state.force[node];
    return meet(wall_, now, now + clock.step * (free - wall_velocity));
}

/// Velocity of the wall from n to n+1.
Vec3 RigidWallTerm::next_velocity(const Clock& clock, const State& state)
{
    if (wall_.motion_curve != none) {
        const auto curve = [&](double time) { return load_value(model_, wall_.motion_curve, clock, time); };
        const double rate = wall_.motion_is_displacement
                                ? (curve(clock.time + clock.step) - curve(clock.time)) / clock.step
                                : curve(clock.time + 0.5 * clock.step);
        return rate * wall_.motion_direction;
    }
    if (wall_.mass == 0) return {};
    // Plastic impact of a mass with all nodes that it touches: momentum along the normal is shared. Which
    // nodes touch depends on the outcome; nodes only leave from one round to the next, so it settles soon.
    const double before = dot(velocity_, wall_.normal);
    double next = before;
    for (int round = 0; round < 10; ++round) {
        const Vec3 trial = next * wall_.normal;
        std::vector<Sums> partial((nodes_.size() + chunk_length - 1) / chunk_length);
        for_chunks(nodes_.size(), [&](std::size_t begin, std::size_t end) {
            Sums& sums = partial[begin / chunk_length];
            for (std::size_t i = begin; i < end; ++i) {
                const double mass = state.mass[nodes_[i]];
                if (mass == 0) continue;
                const WallMeeting met = meeting_of(i, clock, state, trial);
                if (!met.inside) continue;
                const Vec3 free =
                    state.velocity[nodes_[i]] + (clock.velocity_step() / mass) * state.force[nodes_[i]];
                sums.mass += mass;
                sums.momentum += mass * (dot(free, wall_.normal) + std::max(met.now, 0.0) / clock.step);
            }
        });
        double mass = wall_.mass, momentum = wall_.mass * before;
        for (const Sums& sums : partial) {
            mass += sums.mass;
            momentum += sums.momentum;
        }
        const double solved = momentum / mass;
        if (std::abs(solved - next) <= 1e-12 * std::abs(next)) break;
        next = solved;
    }
    return next * wall_.normal;
}

/// Force of friction on a node that slides over the wall; `stopping` would bring it to rest in the step.
Vec3 RigidWallTerm::friction_of(const Vec3& slip_velocity, double normal_force, const Vec3& normal,
                                double stopping) const
{
    const double speed = norm(slip_velocity);
    if (speed == 0) return {};
    if (wall_.orthotropic) {
        const Vec3 a = unit(wall_.friction_axis - dot(wall_.friction_axis, normal) * normal);
        const Vec3 b = cross(normal, a);
        const auto coefficient = [&](int axis) {
            const double fixed = wall_.static_friction[axis], moving = wall_.dynamic_friction[axis];
            return moving + (fixed - moving) * std::exp(-wall_.friction_decay[axis] * speed);
        };
        const Vec3 coulomb = (normal_force * coefficient(0) * dot(slip_velocity, a) / speed) * a +
                             (normal_force * coefficient(1) * dot(slip_velocity, b) / speed) * b;
        const double size = norm(coulomb);
        return size > stopping ? -(stopping / speed) * slip_velocity : -coulomb;
    }
    if (wall_.friction == 2) return {};
    const bool sticks = wall_.friction >= 1;
    const double limit = sticks ? stopping : std::min(stopping, wall_.friction * std::abs(normal_force));
    return (-limit / speed) * slip_velocity;
}

/// Whether the step leaves a node clearly in front of an endless plane: what most nodes are, told by three
/// dot products. Round-off, a billionth of the numbers that went in, is left to `meet`.
bool RigidWallTerm::stays_clear(Index node, const Clock& clock, const State& state) const
{
    const Vec3 arm = state.position[node] - moved_ - wall_.tail;
    const double gap = dot(arm, wall_.normal);
    const double pushed = clock.velocity_step() / state.mass[node] * dot(state.force[node], wall_.normal);
    const double speed = dot(state.velocity[node] - velocity_, wall_.normal);
    const double size = std::abs(arm.x) + std::abs(arm.y) + std::abs(arm.z);
    return gap + clock.step * (speed + pushed) >
           1e-9 * (size + clock.step * (std::abs(speed) + std::abs(pushed)));
}

void RigidWallTerm::stop_node(std::size_t i, const Clock& clock, State& state, Sums& sums)
{
    const Index node = nodes_[i];
    const double mass = state.mass[node], span = clock.velocity_step();
    const Vec3 free = state.velocity[node] + (span / mass) * state.force[node];
    WallMeeting met = meeting_of(i, clock, state, velocity_);
    const bool held = !welded_.empty() && welded_[i];
    if (!met.inside && !held) return;
    const Vec3 relative = free - velocity_;
    if (held && !met.inside) {
        met.normal = wall_.normal; // welding is for planes
        met.now = dot(state.position[node] - moved_ - wall_.tail, wall_.normal);
        met.next = met.now + clock.step * dot(relative, wall_.normal);
    }
    // Lands on the surface; what is already behind it stops where it is.
    const double target = met.now > 0 ? 0 : met.now;
    const double normal_force = mass * (target - met.next) / clock.step / span;
    if (normal_force < 0 && !held) return; // from behind it comes back by itself
    Vec3 force = normal_force * met.normal;
    if (wall_.friction > 0 || wall_.orthotropic) {
        const Vec3 sliding = relative - dot(relative, met.normal) * met.normal;
        force += friction_of(sliding, normal_force, met.normal, mass * norm(sliding) / span);
    }
    if (!welded_.empty() && -dot(relative, met.normal) > wall_.weld_velocity) welded_[i] = true;
    const Vec3 next = free + (span / mass) * force;
    sums.power_before += dot(force, state.velocity[node]);
    sums.power_after += dot(force, next);
    sums.force -= force;
    state.force[node] += force;
}

void RigidWallTerm::push_node(std::size_t i, const Clock& clock, State& state, Sums& sums)
{
    Pushed& pushed = pushed_[i];
    const Index node = nodes_[i];
    const Vec3 now = state.position[node] - moved_;
    const Vec3 relative = state.velocity[node] - velocity_;
    const WallMeeting met = meet(wall_, now - clock.last_step * relative, now);
    Vec3 force{};
    if (met.inside && met.next < pushed.baseline) {
        const double normal_force = spring_rate_ * mass_[i] * (pushed.baseline - met.next);
        force = normal_force * met.normal;
        const Vec3 sliding = relative - dot(relative, met.normal) * met.normal;
        // Friction grows with the slip up to its limit, so that a body at rest does not chatter.
        const double stopping = spring_share * mass_[i] * norm(sliding) / clock.step;
        if (wall_.friction > 0 || wall_.orthotropic)
            force += friction_of(sliding, normal_force, met.normal, stopping);
    }
    sums.pushed_power += dot(force + pushed.force, state.velocity[node]);
    sums.force -= force;
    pushed.force = force;
    state.force[node] += force;
}

void RigidWallTerm::constrain(const Clock& clock, State& state)
{
    if (!started_) start(clock, state);
    const Vec3 velocity_before = velocity_;
    const bool active = clock.time >= wall_.birth && clock.time <= wall_.death;
    velocity_ = active || wall_.motion_curve != none ? next_velocity(clock, state) : velocity_;
    std::vector<Sums> partial((nodes_.size() + chunk_length - 1) / chunk_length);
    if (active) {
        const bool plane = wall_.shape == RigidWall::Shape::plane && welded_.empty();
        for_chunks(nodes_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                Sums& sums = partial[begin / chunk_length];
                if (state.mass[nodes_[i]] > 0) {
                    if (plane && stays_clear(nodes_[i], clock, state)) continue;
                    stop_node(i, clock, state, sums);
                } else if (!pushed_.empty()) {
                    push_node(i, clock, state, sums);
                }
            }
        });
    }
    force_ = {};
    Sums all;
    for (const Sums& sums : partial) {
        force_ += sums.force;
        all.power_before += sums.power_before;
        all.power_after += sums.power_after;
        all.pushed_power += sums.pushed_power;
    }
    work_.add(all.power_before, clock.last_step, all.power_after, clock.step);
    pushed_work_ += 0.5 * clock.last_step * all.pushed_power;
    if (wall_.mass > 0) {
        const double gain = clock.velocity_step() / wall_.mass * dot(force_, wall_.normal);
        velocity_ = velocity_before + gain * wall_.normal;
        const Vec3 before = clock.last_step == 0 ? 2.0 * velocity_before - velocity_ : velocity_before;
        kinetic_ = 0.5 * wall_.mass * dot(before, velocity_);
    }
    wall_work_.add(dot(force_, velocity_before), clock.last_step, dot(force_, velocity_), clock.step);
    moved_ += clock.step * velocity_;
}

/// What is lost (or stored in springs) between wall and nodes: the forces' work on both sides. What drives a
/// wall works against the nodes' force on it; a moving mass has kinetic energy instead.
void RigidWallTerm::report(EnergyLedger& ledger) const
{
    ledger.rigid_wall -= work_.done + pushed_work_ + wall_work_.done;
    if (wall_.motion_curve != none) ledger.external_work -= wall_work_.done;
    ledger.kinetic += kinetic_;
}

void RigidWallTerm::collect(const State&, ElementResults& results) const
{
    results.walls.push_back({wall_.id, -dot(force_, wall_.normal), force_,
                             -(work_.done + pushed_work_ + wall_work_.done), moved_});
}

void RigidWallTerm::serialise(Archive& archive)
{
    archive(pushed_, welded_, started_, spring_rate_, moved_, velocity_, work_, pushed_work_, wall_work_,
            kinetic_);
}

} // namespace plash

#include "rigid/rigid_bodies.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"
#include "core/run_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

/// Gives the nodes of a body its velocity at the start, which may come from a card and not from them: the
/// first state of result files shows it, and contacts and dampers feel it in the first cycle.
void show_velocity(const RigidBody& body, State& state)
{
    for (Index node : body.nodes) {
        const Vec3 arm = state.position[node] - body.center;
        state.velocity[node] = body.velocity + cross(body.angular_velocity, arm);
        if (state.rotational()) state.angular_velocity[node] = body.angular_velocity;
    }
}

} // namespace

RigidBodies::RigidBodies(const Model& model, RigidSetup setup, State& state)
    : model_(model),
      bodies_(std::move(setup.bodies)),
      welds_(std::move(setup.welds)),
      switches_(std::move(setup.switches)),
      notices_(std::move(setup.notices))
{
    std::vector<Index> of_node(state.size(), none);
    for (std::size_t number = 0; number < bodies_.size(); ++number) {
        bodies_[number].acceleration_of_node.resize(bodies_[number].nodes.size());
        if (bodies_[number].released) continue; // a switch engages it
        const bool has_masses = !bodies_[number].node_mass.empty();
        for (Index node : bodies_[number].nodes) {
            of_node[node] = static_cast<Index>(number);
            if (bodies_[number].number == none && !has_masses) {
                bodies_[number].node_mass.push_back(state.mass[node]);
                if (state.rotational()) bodies_[number].node_inertia.push_back(state.inertia[node]);
            }
            state.mass[node] = 0;
            if (state.rotational()) state.inertia[node] = 0;
        }
        show_velocity(bodies_[number], state);
    }
    before_.resize(bodies_.size());
    std::size_t largest = 0;
    for (const RigidBody& body : bodies_) largest = std::max(largest, body.nodes.size());
    partial_.resize((largest + chunk_length - 1) / chunk_length);
    add_drives(setup.of_number);
    add_supports(of_node);
    add_joints(of_node, setup.of_number);
    add_springs(setup.of_number);
    add_loads(setup.of_number);
    rows_.prepare(bodies_.size());
}

void RigidBodies::constrain(const Clock& clock, State& state)
{
    if (clock.last_step == 0) start();
    for (const Weld& weld : welds_)
        if (weld.failed && !bodies_[weld.body].released) release(weld.body, state);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        before_[i] = {bodies_[i].velocity, bodies_[i].angular_velocity, bodies_[i].angular_momentum};
    if (!begun_.empty()) take_last_work(clock, state);
    take_forces(clock, state);
    if (!rows_.empty()) {
        set_targets(clock, state);
        rows_.satisfy(bodies_, clock);
        book_rows(clock);
        look_for_failed_joints(clock, state);
    }
    kinetic_ = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (!bodies_[i].released) move(clock, state, bodies_[i], before_[i]);
    for (Weld& weld : welds_) {
        RigidBody& body = bodies_[weld.body];
        if (!body.released && !weld.failed) weld.failed = weld_fails(weld, body, state, clock);
    }
}

/// Bodies have moved on to the places of n+1 when a phase ends with step n: they go back.
void RigidBodies::begin_phase(bool relaxing, State& state)
{
    const bool first_time = first_.size() < bodies_.size(); // a phase may come to rest more than once
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        RigidBody& body = bodies_[i];
        if (relaxing) {
            if (first_time) first_.push_back({body.velocity, body.angular_velocity, body.angular_momentum});
            body.velocity = body.angular_velocity = body.angular_momentum = {};
        } else {
            body.center = body.shown_center;
            body.orientation = body.shown_orientation;
            body.velocity = first_[i].velocity;
            body.angular_velocity = first_[i].angular_velocity;
            body.angular_momentum = spatial_inertia(body, body.orientation) * body.angular_velocity;
        }
        if (!body.released) show_velocity(body, state);
    }
    if (!relaxing) first_.clear();
}

/// Velocities at t = 0 that fit joints, supports and driven velocities.
void RigidBodies::start()
{
    if (rows_.empty()) return;
    for (Drive& drive : drives_) {
        const PrescribedMotion& motion = drive.motion;
        BodyRow& row = rows_.rows[drive.row];
        row.active = motion.kind == PrescribedMotion::Kind::velocity && motion.birth <= 0;
        row.target = row.active ? motion.scale * curve_value(model_, motion.curve, 0) : 0;
    }
    for (Support& support : supports_) rows_.rows[support.row].active = support.birth <= 0;
    rows_.project_start(bodies_);
    for (Drive& drive : drives_) {
        if (drive.motor) continue;
        const RigidBody& body = bodies_[drive.body];
        drive.rate =
            dot(drive.motion.rotation ? body.angular_velocity : body.velocity, drive.motion.direction);
    }
}

/// Forces of the nodes and loads of the bodies change their momenta; the velocities without any condition.
void RigidBodies::take_forces(const Clock& clock, const State& state)
{
    const double velocity_step = clock.velocity_step();
    sums_.assign(bodies_.size(), {});
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const RigidBody& body = bodies_[b];
        if (body.released) continue;
        const std::size_t chunks = (body.nodes.size() + chunk_length - 1) / chunk_length;
        for_chunks(body.nodes.size(), [&](std::size_t begin, std::size_t end) {
            Sums& sum = partial_[begin / chunk_length];
            sum = {};
            for (std::size_t i = begin; i < end; ++i) {
                const Index node = body.nodes[i];
                sum.force += state.force[node];
                sum.moment += cross(state.position[node] - body.center, state.force[node]);
                if (state.rotational()) sum.moment += state.moment[node];
            }
        });
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
            sums_[b].force += partial_[chunk].force;
            sums_[b].moment += partial_[chunk].moment;
        }
        if (body.own_inertia && !model_.body_loads.empty()) add_missing_weight(clock, bodies_[b], sums_[b]);
    }
    for (Load& entry : loads_) {
        const RigidBodyLoad& load = *entry.load;
        const RigidBody& body = bodies_[entry.body];
        Vec3 direction = load.direction;
        if (load.plane[0] != none) {
            const auto at = [&](int i) { return state.position[load.plane[i]]; };
            direction = unit(cross(at(1) - at(0), at(2) - at(0)));
        }
        const double magnitude = load.scale * load_value(model_, load.curve, clock, clock.time);
        const Vec3 now = magnitude * direction;
        const Vec3 mean = 0.5 * (now + entry.last_magnitude * entry.last_direction);
        entry.work += clock.last_step * dot(mean, load.moment ? body.angular_velocity : body.velocity);
        entry.last_magnitude = magnitude;
        entry.last_direction = direction;
        (load.moment ? sums_[entry.body].moment : sums_[entry.body].force) += now;
    }
    for (JointSpring& spring : springs_) {
        const JointSpring::Push push = spring.act(model_, bodies_, clock);
        Sums &first = sums_[spring.first()], &second = sums_[spring.second()];
        second.force += push.force;
        second.moment += push.moment + cross(push.place - bodies_[spring.second()].center, push.force);
        first.force -= push.force;
        first.moment -= push.moment + cross(push.place - bodies_[spring.first()].center, push.force);
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        RigidBody& body = bodies_[b];
        if (body.released) continue;
        body.velocity += velocity_step * (translational_mobility(body) * sums_[b].force);
        body.angular_momentum += velocity_step * sums_[b].moment;
        if (rows_.empty() || !rows_.touched()[b])
            body.angular_velocity = midpoint_angular_velocity(body, body.angular_momentum, clock.step);
    }
}

/// Body loads act on the nodes; this is what they leave out of a body whose mass is not that of its nodes.
void RigidBodies::add_missing_weight(const Clock& clock, RigidBody& body, Sums& sums)
{
    Vec3 acceleration{};
    for (const BodyLoad& load : model_.body_loads) {
        const bool loaded = load.parts.empty() ||
                            std::find(load.parts.begin(), load.parts.end(), body.number) != load.parts.end();
        if (loaded) acceleration -= body_load_value(model_, load, clock) * load.direction;
    }
    const Vec3 arm = body.orientation * body.missing_moment;
    sums.force += body.missing_mass * acceleration;
    sums.moment += cross(arm, acceleration);
    const Vec3 mean = 0.5 * (acceleration + body.last_body_load);
    body_load_work_ +=
        clock.last_step * dot(mean, body.missing_mass * body.velocity + cross(body.angular_velocity, arm));
    body.last_body_load = acceleration;
}

/// Displacement from another body (VAD = 4): the distance at the birth and what the curve adds to it, at n+1.
void RigidBodies::set_relative_target(const Clock& clock, const State& state, Drive& drive)
{
    const PrescribedMotion& motion = drive.motion;
    BodyRow& row = rows_.rows[drive.row];
    const RigidBody &lead = bodies_[row.first], &body = bodies_[row.second];
    const Vec3 apart = body.center - lead.center;
    Vec3& direction = drive.motion.direction;
    direction = motion.line[0] == none
                    ? unit(apart)
                    : unit(state.position[motion.line[1]] - state.position[motion.line[0]]);
    row.axis1 = transpose(lead.orientation) * direction;
    if (!drive.born) drive.travelled = dot(apart, direction);
    drive.born = true;
    const double time = clock.time + clock.step - motion.birth;
    row.target = drive.travelled + motion.scale * curve_value(model_, motion.curve, time);
    if (row.kind == BodyRow::Kind::distance && !(row.target > 0)) {
        throw RunError(
            fmt::format("the prescribed displacement brings the mass centers of the rigid bodies {} "
                        "and {} together; along two nodes (NODE1, NODE2) they may pass",
                        model_.body_id(body.number), model_.body_id(lead.number)));
    }
}

void RigidBodies::set_targets(const Clock& clock, const State& state)
{
    for (Drive& drive : drives_) {
        BodyRow& row = rows_.rows[drive.row];
        row.active = clock.time >= drive.motion.birth && clock.time <= drive.motion.death &&
                     acts_now(model_, drive.motion.curve, clock);
        if (!row.active) continue;
        if (drive.motion.kind == PrescribedMotion::Kind::relative_displacement)
            set_relative_target(clock, state, drive);
        else
            row.target = prescribed_rate(model_, drive.motion, clock, drive.rate, drive.travelled);
    }
    for (Support& support : supports_)
        rows_.rows[support.row].active = clock.time >= support.birth && clock.time <= support.death;
}

/// Forces of the conditions at n, and the work of those that drive.
void RigidBodies::book_rows(const Clock& clock)
{
    const double per_impulse = 1 / clock.velocity_step();
    for (Drive& drive : drives_) {
        const BodyRow& row = rows_.rows[drive.row];
        const double last_rate = drive.rate;
        drive.force = row.active ? row.impulse * per_impulse : 0;
        const bool relative = drive.motion.kind == PrescribedMotion::Kind::relative_displacement;
        if (row.active && !relative) {
            drive.rate = row.target;
        } else if (!drive.motor) {
            const RigidBody& body = bodies_[drive.body];
            const Vec3 direction = drive.motion.local ? body.orientation * row.axis2 : drive.motion.direction;
            drive.rate = dot(drive.motion.rotation ? body.angular_velocity : body.velocity, direction);
        }
        drive.work.add(drive.force * last_rate, clock.last_step, drive.force * drive.rate, clock.step);
    }
    for (Support& support : supports_) {
        const BodyRow& row = rows_.rows[support.row];
        support.force = row.active ? row.impulse * per_impulse : 0;
    }
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        const JointRows& joint = joints_[j];
        Vec3 force{}, moment{};
        for (std::size_t i = joint.begin; i < joint.begin + joint.count; ++i) {
            const BodyRows::Momenta direction = rows_.second_direction(i);
            force += (rows_.rows[i].impulse * per_impulse) * direction.linear;
            moment += (rows_.rows[i].impulse * per_impulse) * direction.angular;
        }
        const Vec3 arm = bodies_[rows_.rows[joint.begin].second].orientation * joint.arm2;
        joint_force_[j] = force;
        joint_moment_[j] = moment - cross(arm, force);
    }
}

/// A joint that reaches its strength still acts in that step.
void RigidBodies::look_for_failed_joints(const Clock& clock, const State& state)
{
    for (std::size_t j = 0; j < joints_.size(); ++j) {
        JointRows& joint = joints_[j];
        const auto& failure = model_.joints[joint.joint].failure;
        if (!failure || joint.failed) continue;
        joint.failed = joint_fails(*failure, joint_force_[j], joint_moment_[j], model_, state, clock.time);
        if (!joint.failed) continue;
        for (std::size_t i = joint.begin; i < joint.begin + joint.count; ++i) rows_.rows[i].dead = true;
    }
}

void RigidBodies::move(const Clock& clock, State& state, RigidBody& body, const Motion& before)
{
    const double velocity_step = clock.velocity_step();
    const bool first = clock.last_step == 0;
    // The first velocities are those of n = 0; the forces at 0 give those at -1/2 that belong to them.
    Motion old = before;
    if (first) {
        old = {2.0 * before.velocity - body.velocity, 2.0 * before.angular_velocity - body.angular_velocity,
               2.0 * before.angular_momentum - body.angular_momentum};
    }
    // As for nodes: the product of the half-step rates, written for the rotation as mean minus half change.
    kinetic_ += 0.5 * body.mass * dot(old.velocity, body.velocity);
    kinetic_ += 0.25 * (dot(old.angular_velocity, old.angular_momentum) +
                        dot(body.angular_velocity, body.angular_momentum)) -
                0.25 * dot(body.angular_momentum - old.angular_momentum,
                           body.angular_velocity - old.angular_velocity);
    if (!first) {
        const double linear = dot(body.velocity, body.velocity) - dot(old.velocity, old.velocity);
        const double angular = dot(body.angular_velocity, body.angular_momentum) -
                               dot(old.angular_velocity, old.angular_momentum);
        kinetic_ += 0.5 * clock.step_change() * (body.mass * linear + angular);
    }

    body.acceleration = (1 / velocity_step) * (body.velocity - before.velocity);
    body.angular_acceleration = (1 / velocity_step) * (body.angular_velocity - before.angular_velocity);
    if (!first) body.angle += clock.last_step * before.angular_velocity;
    body.shown_center = body.center;
    body.shown_orientation = body.orientation;
    const Vec3 next_center = body.center + clock.step * body.velocity;
    const Matrix3 next_orientation = rotation(clock.step * body.angular_velocity) * body.orientation;
    for_chunks(body.nodes.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Index node = body.nodes[i];
            const Vec3 place = next_center + next_orientation * body.arm[i];
            const Vec3 velocity = (1 / clock.step) * (place - state.position[node]);
            body.acceleration_of_node[i] = (1 / velocity_step) * (velocity - state.velocity[node]);
            state.velocity[node] = velocity;
            if (state.rotational()) state.angular_velocity[node] = body.angular_velocity;
        }
    });
    body.center = next_center;
    body.orientation = next_orientation;
}

StepVote RigidBodies::stable_step() const
{
    StepVote vote;
    for (const JointSpring& spring : springs_) {
        const double step = spring.stable_step(model_, bodies_);
        if (step < vote.step) vote = {step, "joint stiffness", spring.card().id, 0};
    }
    return vote;
}

void RigidBodies::report(EnergyLedger& ledger) const
{
    ledger.kinetic += kinetic_;
    ledger.external_work += body_load_work_ + switched_energy_;
    for (const Drive& drive : drives_) ledger.external_work += drive.work.done;
    for (const Load& load : loads_) ledger.external_work += load.work;
    for (const JointSpring& spring : springs_) {
        ledger.internal += spring.energy();
        ledger.springs += spring.energy();
    }
}

void RigidBodies::serialise(Archive& archive)
{
    for (RigidBody& body : bodies_) {
        archive(body.released, body.center, body.orientation, body.velocity, body.angular_momentum,
                body.angular_velocity, body.shown_center, body.shown_orientation, body.angle,
                body.acceleration, body.last_body_load, body.angular_acceleration, body.acceleration_of_node);
    }
    for (BodyRow& row : rows_.rows) archive(row.impulse, row.target, row.active, row.dead);
    for (Drive& drive : drives_) archive(drive.travelled, drive.born, drive.rate, drive.force, drive.work);
    for (Support& support : supports_) archive(support.force);
    for (Load& load : loads_) archive(load.last_magnitude, load.work, load.last_direction);
    for (JointSpring& spring : springs_) archive(spring);
    for (JointRows& joint : joints_) archive(joint.failed);
    for (Index number : switches_.bodies()) {
        RigidBody& body = bodies_[number];
        archive(body.arm, body.mass, body.body_inertia, body.node_mass, body.node_inertia);
    }
    archive(welds_, switches_, joint_force_, joint_moment_, before_, kinetic_, body_load_work_, begun_,
            switched_energy_);
}

} // namespace plash

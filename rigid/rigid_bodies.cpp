#include "rigid/rigid_bodies.h"

#include "core/prescribed_rate.h"

namespace plash {

RigidBodies::RigidBodies(const Model& model, std::vector<RigidBody> bodies, State& state)
    : model_(model), bodies_(std::move(bodies))
{
    for (std::size_t number = 0; number < bodies_.size(); ++number) {
        for (Index node : bodies_[number].nodes) {
            state.mass[node] = 0;
            if (state.rotational()) state.inertia[node] = 0;
        }
        for (const PrescribedMotion& motion : model.prescribed_motions) {
            if (motion.rigid_part == bodies_[number].part) drives_.push_back({&motion, number, 0, 0, {}});
        }
    }
}

void RigidBodies::constrain(const Clock& clock, State& state)
{
    kinetic_ = 0;
    for (std::size_t number = 0; number < bodies_.size(); ++number) {
        move(clock, state, bodies_[number], number);
    }
}

void RigidBodies::move(const Clock& clock, State& state, RigidBody& body, std::size_t number)
{
    Vec3 force{}, moment{};
    for (Index node : body.nodes) {
        force += state.force[node];
        moment += cross(state.position[node] - body.center, state.force[node]);
        if (state.rotational()) moment += state.moment[node];
    }
    const double velocity_step = clock.velocity_step();
    const bool first = clock.last_step == 0;
    const Vec3 velocity_before = body.velocity, spin_before = body.angular_velocity;
    const Vec3 momentum_before = body.angular_momentum;

    body.velocity += (velocity_step / body.mass) * force;
    if (body.fixed & 1) body.velocity.x = 0;
    if (body.fixed & 2) body.velocity.y = 0;
    if (body.fixed & 4) body.velocity.z = 0;
    body.angular_momentum += velocity_step * moment;
    body.angular_velocity = midpoint_angular_velocity(body, body.angular_momentum, clock.step);

    for (Drive& drive : drives_) {
        if (drive.body != number) continue;
        const PrescribedMotion& motion = *drive.motion;
        if (clock.time < motion.birth || clock.time > motion.death) {
            drive.force = 0;
            drive.work.add(0, clock.last_step, 0, clock.step);
            continue;
        }
        Vec3& rate = motion.rotation ? body.angular_velocity : body.velocity;
        const Vec3& rate_before = motion.rotation ? spin_before : velocity_before;
        const double before = dot(rate_before, motion.direction);
        const double next = prescribed_rate(model_, motion, clock, before, drive.travelled);
        const double change = next - dot(rate, motion.direction);
        rate += change * motion.direction;
        double inertia = body.mass;
        if (motion.rotation) {
            const Matrix3 middle = rotation(0.5 * clock.step * body.angular_velocity) * body.orientation;
            const Matrix3 spatial = spatial_inertia(body, middle);
            inertia = dot(motion.direction, spatial * motion.direction);
            body.angular_momentum = spatial * body.angular_velocity;
        }
        drive.force = inertia * change / velocity_step;
        drive.work.add(drive.force * before, clock.last_step, drive.force * next, clock.step);
    }

    // As for nodes: the product of the half-step rates, written for the rotation as mean minus half change.
    const Vec3 old_velocity = first ? 2.0 * velocity_before - body.velocity : velocity_before;
    kinetic_ += 0.5 * body.mass * dot(old_velocity, body.velocity);
    const Vec3 momentum_change = body.angular_momentum - momentum_before;
    const double rotating_after = 0.5 * dot(body.angular_velocity, body.angular_momentum);
    const double rotating_before = first ? rotating_after : 0.5 * dot(spin_before, momentum_before);
    kinetic_ += 0.5 * (rotating_before + rotating_after) -
                0.25 * dot(momentum_change, body.angular_velocity - spin_before);

    body.angular_acceleration = (1 / velocity_step) * (body.angular_velocity - spin_before);
    body.acceleration.resize(body.nodes.size());
    const Vec3 next_center = body.center + clock.step * body.velocity;
    const Matrix3 next_orientation = rotation(clock.step * body.angular_velocity) * body.orientation;
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
        const Index node = body.nodes[i];
        const Vec3 place = next_center + next_orientation * body.arm[i];
        const Vec3 velocity = (1 / clock.step) * (place - state.position[node]);
        body.acceleration[i] = (1 / velocity_step) * (velocity - state.velocity[node]);
        state.velocity[node] = velocity;
        if (state.rotational()) state.angular_velocity[node] = body.angular_velocity;
    }
    body.center = next_center;
    body.orientation = next_orientation;
}

void RigidBodies::report(EnergyLedger& ledger) const
{
    ledger.kinetic += kinetic_;
    for (const Drive& drive : drives_) ledger.external_work += drive.work.done;
}

void RigidBodies::serialise(Archive& archive)
{
    for (RigidBody& body : bodies_) {
        archive(body.center, body.orientation, body.velocity, body.angular_momentum, body.angular_velocity);
    }
    for (Drive& drive : drives_) archive(drive.travelled, drive.work);
}

void RigidBodies::collect(const State&, ElementResults& results) const
{
    for (const Drive& drive : drives_) {
        if (!results.boundary_forces_wanted) break;
        ElementResults::BoundaryForce entry{none, bodies_[drive.body].part, {}, {}, drive.work.done};
        (drive.motion->rotation ? entry.moment : entry.force) = drive.force * drive.motion->direction;
        results.motions.push_back(entry);
    }
    for (const RigidBody& body : bodies_) {
        // Nothing has moved yet when the run ends in its first cycle.
        for (std::size_t i = 0; i < body.acceleration.size(); ++i) {
            const Index node = body.nodes[i];
            if (!results.acceleration.empty()) results.acceleration[node] = body.acceleration[i];
            if (!results.angular_acceleration.empty()) {
                results.angular_acceleration[node] = body.angular_acceleration;
            }
        }
        if (results.part_motion.empty()) continue;
        auto& motion = results.part_motion[body.part];
        motion.mass += body.mass;
        motion.kinetic += 0.5 * body.mass * dot(body.velocity, body.velocity) +
                          0.5 * dot(body.angular_velocity, body.angular_momentum);
        motion.momentum[0] += body.mass * body.velocity.x;
        motion.momentum[1] += body.mass * body.velocity.y;
        motion.momentum[2] += body.mass * body.velocity.z;
    }
}

} // namespace plash

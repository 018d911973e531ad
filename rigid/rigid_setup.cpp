// What the deck does to rigid bodies becomes rows, drives, supports and loads of the bodies.

#include "rigid/rigid_bodies.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace plash {

namespace {

constexpr Vec3 global_axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// One freedom of a node that the deck holds, as a direction in the six velocities of its body: angular
/// velocities count as those of a point one radius of gyration away.
struct Candidate {
    Index node;
    int freedom; ///< 0..2 translation, 3..5 rotation
    std::array<double, 6> vector;
};

Candidate candidate_of(const RigidBody& body, std::size_t position, int freedom, double gyration)
{
    const Vec3 e = global_axes[freedom % 3];
    const Vec3 linear = freedom < 3 ? e : Vec3{};
    const Vec3 turning = freedom < 3 ? (1 / gyration) * cross(body.arm[position], e) : e;
    return {body.nodes[position], freedom, {linear.x, linear.y, linear.z, turning.x, turning.y, turning.z}};
}

double product(const std::array<double, 6>& a, const std::array<double, 6>& b)
{
    double sum = 0;
    for (int i = 0; i < 6; ++i) sum += a[i] * b[i];
    return sum;
}

/// The few candidates that hold all that all of them hold: the largest remaining one again and again
/// (Gram-Schmidt with pivots).
std::vector<Candidate> independent(std::vector<Candidate> candidates)
{
    std::vector<Candidate> chosen;
    std::vector<std::array<double, 6>> rest;
    for (const Candidate& candidate : candidates) rest.push_back(candidate.vector);
    while (chosen.size() < 6) {
        std::size_t best = 0;
        double largest = 0;
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const double size = product(rest[i], rest[i]);
            if (size > largest * (1 + 1e-9)) { // ties: the first one
                largest = size;
                best = i;
            }
        }
        if (largest < 1e-12) break;
        chosen.push_back(candidates[best]);
        std::array<double, 6> direction = rest[best];
        for (double& value : direction) value /= std::sqrt(largest);
        for (auto& vector : rest) {
            const double share = product(vector, direction);
            for (int i = 0; i < 6; ++i) vector[i] -= share * direction[i];
        }
    }
    return chosen;
}

} // namespace

Index RigidBodies::body_of(BodyNumber number, const std::vector<Index>& of_number,
                           const Location& where) const
{
    const Index body =
        number < 0 || number >= static_cast<Index>(of_number.size()) ? none : of_number[number];
    if (body == none) {
        throw DeckError(where,
                        fmt::format("part {} is no rigid body (*MAT_RIGID, *CONSTRAINED_NODAL_RIGID_BODY "
                                    "or *DEFORMABLE_TO_RIGID)",
                                    number < 0 ? 0 : model_.body_id(number)));
    }
    return body;
}

void RigidBodies::add_drives(const std::vector<Index>& of_number)
{
    for (const PrescribedMotion& motion : model_.prescribed_motions) {
        if (motion.rigid_part == none) continue;
        const Index body = body_of(motion.rigid_part, of_number, motion.where);
        Drive drive;
        drive.motion = motion;
        drive.row = rows_.rows.size();
        drive.body = body;
        BodyRow row;
        row.kind = BodyRow::Kind::rate;
        row.second = body;
        if (motion.kind == PrescribedMotion::Kind::relative_displacement) {
            row.kind = motion.line[0] == none ? BodyRow::Kind::distance : BodyRow::Kind::point;
            row.first = body_of(motion.lead, of_number, motion.where);
            row.one_sided = true;
            row.active = false;
            if (row.kind == BodyRow::Kind::distance &&
                norm(bodies_[body].center - bodies_[row.first].center) == 0) {
                throw DeckError(motion.where, "the mass centers of both rigid bodies are one point: a "
                                              "displacement between them needs a direction, NODE1 and NODE2");
            }
        } else if (motion.local) {
            const auto& local = bodies_[body].local_axes;
            const Vec3& d = motion.direction;
            row.axis2 = d.x * local[0] + d.y * local[1] + d.z * local[2];
            drive.motion.direction = row.axis2;
            (motion.rotation ? row.spin2 : row.run2) = 1;
        } else {
            row.axis1 = motion.direction;
            (motion.rotation ? row.turn : row.slide) = 1;
        }
        rows_.rows.push_back(row);
        drives_.push_back(std::move(drive));
    }
}

void RigidBodies::add_supports(const std::vector<Index>& of_node)
{
    // By body and time of life, so that only freedoms that are held together are weighed against one another.
    std::map<std::tuple<Index, double, double>, std::vector<Candidate>> held;
    for (const FixedNodes& fixed : model_.fixed_nodes) {
        for (Index node : fixed.nodes) {
            if (of_node[node] == none) continue;
            const RigidBody& body = bodies_[of_node[node]];
            const Matrix3& inertia = body.body_inertia;
            const double trace = inertia.row[0].x + inertia.row[1].y + inertia.row[2].z;
            const double gyration = trace > 0 ? std::sqrt(trace / body.mass) : 1;
            const std::size_t position =
                std::find(body.nodes.begin(), body.nodes.end(), node) - body.nodes.begin();
            for (int freedom = 0; freedom < 6; ++freedom) {
                if (fixed.freedoms >> freedom & 1)
                    held[{of_node[node], fixed.birth, fixed.death}].push_back(
                        candidate_of(body, position, freedom, gyration));
            }
        }
    }
    for (const auto& [key, candidates] : held) {
        const auto [body, birth, death] = key;
        for (const Candidate& candidate : independent(candidates)) {
            const Vec3 direction = global_axes[candidate.freedom % 3];
            const bool rotation = candidate.freedom >= 3;
            const std::size_t position =
                std::find(bodies_[body].nodes.begin(), bodies_[body].nodes.end(), candidate.node) -
                bodies_[body].nodes.begin();
            BodyRow row;
            row.second = body;
            row.axis1 = direction;
            row.arm2 = bodies_[body].arm[position];
            row.kind = BodyRow::Kind::rate;
            (rotation ? row.turn : row.slide) = 1;
            if (!rotation && birth <= 0 && death == forever) {
                row.kind = BodyRow::Kind::point;
                row.arm1 = bodies_[body].center + row.arm2; // of the ground
            }
            supports_.push_back({candidate.node, rows_.rows.size(), direction, rotation, birth, death, 0});
            rows_.rows.push_back(row);
        }
    }
}

void RigidBodies::add_joints(const std::vector<Index>& of_node, const std::vector<Index>& of_number)
{
    for (std::size_t number = 0; number < model_.joints.size(); ++number) {
        const Joint& joint = model_.joints[number];
        std::array<Index, 2> pair{none, none};
        for (int i = 0; i < 2 && joint.by_places; ++i)
            pair[i] = body_of(joint.bodies[i], of_number, joint.where);
        for (int i = 0; i < 6; ++i) {
            const Index node = joint.nodes[i];
            if (node == none) continue;
            const Index body = of_node[node];
            if (body == none) {
                throw DeckError(joint.where,
                                fmt::format("joint {}, field N{}: node {} belongs to no rigid body", joint.id,
                                            i + 1, model_.nodes.id[node]));
            }
            if (pair[i % 2] == none) pair[i % 2] = body;
            if (pair[i % 2] != body) {
                throw DeckError(
                    joint.where,
                    fmt::format("joint {}, field N{}: node {} belongs to another rigid body than N{}",
                                joint.id, i + 1, model_.nodes.id[node], i % 2 + 1));
            }
        }
        if (pair[0] == none || pair[1] == none) {
            throw DeckError(joint.where, fmt::format("joint {} needs the nodes N1 and N2", joint.id));
        }
        if (pair[0] == pair[1]) {
            throw DeckError(joint.where,
                            fmt::format("joint {}: N1 and N2 belong to one rigid body", joint.id));
        }
        joints_.push_back(
            add_joint(model_, static_cast<Index>(number), bodies_, pair[0], pair[1], rows_.rows));
        const bool rotates = joint.type == Joint::Type::rotational_motor;
        if (!rotates && joint.type != Joint::Type::translational_motor) continue;
        Drive drive;
        drive.motion.rotation = rotates;
        drive.motion.kind = joint.motion;
        drive.motion.curve = joint.curve;
        drive.motion.where = joint.where;
        drive.row = rows_.rows.size() - 1;
        drive.body = pair[1];
        drive.motor = true;
        drive.joint = static_cast<Index>(joints_.size()) - 1;
        drives_.push_back(std::move(drive));
    }
    joint_force_.resize(joints_.size());
    joint_moment_.resize(joints_.size());
}

void RigidBodies::add_springs(const std::vector<Index>& of_number)
{
    for (const JointStiffness& card : model_.joint_stiffnesses) {
        const Index first = body_of(card.first, of_number, card.where);
        const Index second = body_of(card.second, of_number, card.where);
        if (first == second) {
            throw DeckError(card.where,
                            fmt::format("joint stiffness {} acts between a body and itself", card.id));
        }
        springs_.emplace_back(card, first, second, bodies_);
    }
}

void RigidBodies::add_loads(const std::vector<Index>& of_number)
{
    for (const RigidBodyLoad& load : model_.rigid_body_loads)
        loads_.push_back({&load, body_of(load.body, of_number, load.where), 0, 0, {}});
}

void RigidBodies::collect(const State&, ElementResults& results) const
{
    if (results.boundary_forces_wanted) {
        for (const Drive& drive : drives_) {
            if (drive.motor) continue;
            const Vec3 direction = drive.motion.local
                                       ? bodies_[drive.body].shown_orientation * rows_.rows[drive.row].axis2
                                       : drive.motion.direction;
            ElementResults::BoundaryForce entry{none, bodies_[drive.body].number, {}, {}, drive.work.done};
            (drive.motion.rotation ? entry.moment : entry.force) = drive.force * direction;
            results.motions.push_back(entry);
        }
        for (const Support& support : supports_) {
            ElementResults::BoundaryForce entry{support.node, none, {}, {}, 0};
            (support.rotation ? entry.moment : entry.force) = support.force * support.direction;
            results.supports.push_back(entry);
        }
        for (const Load& load : loads_) {
            ElementResults::BoundaryForce entry{none, bodies_[load.body].number, {}, {}, load.work};
            (load.load->moment ? entry.moment : entry.force) = load.last_magnitude * load.last_direction;
            results.loads.push_back(entry);
        }
    }
    if (results.rigid_motions_wanted) {
        for (const RigidBody& body : bodies_) {
            if (body.number == none) continue;
            ElementResults::RigidMotion motion;
            motion.body = model_.body_id(body.number);
            motion.nodal = body.number >= static_cast<Index>(model_.parts.size());
            motion.place = body.shown_center;
            motion.displacement = body.shown_center - body.first_center;
            motion.velocity = body.velocity;
            motion.acceleration = body.acceleration;
            motion.angle = body.angle;
            motion.angular_velocity = body.angular_velocity;
            motion.angular_acceleration = body.angular_acceleration;
            for (int axis = 0; axis < 3; ++axis)
                motion.axes[axis] = body.shown_orientation * body.local_axes[axis];
            results.rigid_bodies.push_back(motion);
        }
        for (std::size_t j = 0; j < joints_.size(); ++j) {
            ElementResults::JointForce entry{model_.joints[joints_[j].joint].id, joint_force_[j],
                                             joint_moment_[j], 0};
            for (const Drive& drive : drives_)
                if (drive.joint == static_cast<Index>(j)) entry.energy += drive.work.done;
            results.joints.push_back(entry);
        }
    }
    for (const RigidBody& body : bodies_) {
        if (body.released) continue;
        results.rigid_mass += body.mass;
        results.rigid_momentum += body.mass * body.velocity;
        for (std::size_t i = 0; i < body.nodes.size(); ++i) {
            const Index node = body.nodes[i];
            if (!results.acceleration.empty()) results.acceleration[node] = body.acceleration_of_node[i];
            if (!results.angular_acceleration.empty())
                results.angular_acceleration[node] = body.angular_acceleration;
        }
        if (body.number == none || body.number >= static_cast<Index>(results.part_motion.size())) continue;
        auto& motion = results.part_motion[body.number];
        motion.mass += body.mass;
        motion.kinetic += 0.5 * body.mass * dot(body.velocity, body.velocity) +
                          0.5 * dot(body.angular_velocity, body.angular_momentum);
        motion.momentum[0] += body.mass * body.velocity.x;
        motion.momentum[1] += body.mass * body.velocity.y;
        motion.momentum[2] += body.mass * body.velocity.z;
    }
}

} // namespace plash

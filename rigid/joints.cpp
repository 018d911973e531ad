#include "rigid/joints.h"

#include "core/local_axes.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Builds rows between two bodies from global places and directions of now.
struct RowMaker {
    const std::vector<RigidBody>& bodies;
    Index first, second;
    std::vector<BodyRow>& rows;

    Vec3 arm(Index body, const Vec3& place) const
    {
        return transpose(bodies[body].orientation) * (place - bodies[body].center);
    }
    Vec3 axis(Index body, const Vec3& direction) const
    {
        return transpose(bodies[body].orientation) * direction;
    }
    BodyRow& add(BodyRow::Kind kind, const Vec3& place1, const Vec3& place2, const Vec3& axis1,
                 const Vec3& axis2)
    {
        BodyRow row;
        row.kind = kind;
        row.first = first;
        row.second = second;
        row.arm1 = arm(first, place1);
        row.arm2 = arm(second, place2);
        row.axis1 = axis(first, axis1);
        row.axis2 = axis(second, axis2);
        rows.push_back(row);
        return rows.back();
    }
    void point(const Vec3& place1, const Vec3& place2, const Vec3& direction)
    {
        add(BodyRow::Kind::point, place1, place2, direction, {}).target = dot(direction, place2 - place1);
    }
    void angle(const Vec3& axis1, const Vec3& axis2)
    {
        const Vec3& center = bodies[second].center;
        add(BodyRow::Kind::angle, center, center, axis1, axis2).target = dot(axis1, axis2);
    }
};

struct Frame {
    Vec3 axis, side1, side2;
};

Frame frame_along(const Vec3& axis)
{
    const Vec3 other = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 side = unit(cross(axis, other));
    return {axis, side, cross(axis, side)};
}

} // namespace

JointRows add_joint(const Model& model, Index number, const std::vector<RigidBody>& bodies, Index first,
                    Index second, std::vector<BodyRow>& rows)
{
    using Type = Joint::Type;
    const Joint& joint = model.joints[number];
    const auto fail = [&](const std::string& text) {
        throw DeckError(joint.where, fmt::format("joint {}: {}", joint.id, text));
    };
    const auto place = [&](int node) {
        if (joint.by_places) return joint.places[node - 1];
        if (joint.nodes[node - 1] == none) fail(fmt::format("node N{} is missing", node));
        return model.nodes.position[joint.nodes[node - 1]];
    };
    const auto direction = [&](int from, int to) {
        const Vec3 axis = unit(place(to) - place(from));
        if (norm(axis) < 0.5) fail(fmt::format("nodes N{} and N{} lie at one point: no axis", from, to));
        return axis;
    };
    RowMaker make{bodies, first, second, rows};
    JointRows result{number, rows.size(), 0, make.arm(second, place(2))};
    const Vec3 p1 = place(1), p2 = place(2);
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    switch (joint.type) {
    case Type::spherical:
        for (const Vec3& e : {x, y, z}) make.point(p1, p2, e);
        break;
    case Type::revolute: {
        const Frame frame = frame_along(direction(1, 3));
        for (const Vec3& e : {frame.axis, frame.side1, frame.side2}) make.point(p1, p2, e);
        make.angle(frame.axis, frame.side1);
        make.angle(frame.axis, frame.side2);
        break;
    }
    case Type::cylindrical:
    case Type::translational: {
        const Frame frame = frame_along(direction(1, 3));
        make.point(p1, p2, frame.side1);
        make.point(p1, p2, frame.side2);
        make.angle(frame.axis, frame.side1);
        make.angle(frame.axis, frame.side2);
        if (joint.type == Type::translational) make.angle(frame.side1, frame.side2);
        break;
    }
    case Type::planar: {
        const Frame frame = frame_along(direction(1, 3));
        make.point(p1, p2, frame.axis);
        make.angle(frame.axis, frame.side1);
        make.angle(frame.axis, frame.side2);
        break;
    }
    case Type::universal:
        for (const Vec3& e : {x, y, z}) make.point(p1, p2, e);
        make.angle(direction(1, 3), direction(2, 4));
        break;
    case Type::locking:
        for (const Vec3& e : {x, y, z}) make.point(p1, p2, e);
        make.angle(x, y);
        make.angle(y, z);
        make.angle(z, x);
        break;
    case Type::gears:
    case Type::pulley: {
        BodyRow& row = make.add(BodyRow::Kind::rate, p1, p2, direction(1, 3), direction(2, 4));
        row.spin1 = 1;
        row.spin2 = joint.type == Type::gears ? joint.parameter : -joint.parameter;
        break;
    }
    case Type::rack_and_pinion: {
        BodyRow& row = make.add(BodyRow::Kind::rate, p1, p2, direction(1, 3), direction(2, 4));
        row.run2 = 1;
        row.spin1 = -joint.parameter;
        break;
    }
    case Type::screw: {
        BodyRow& row = make.add(BodyRow::Kind::rate, p1, p2, direction(1, 3), {});
        row.slide = 1;
        row.turn = -joint.parameter;
        break;
    }
    case Type::translational_motor:
        make.add(BodyRow::Kind::rate, p1, p2, direction(1, 3), {}).slide = 1;
        break;
    case Type::rotational_motor:
        make.add(BodyRow::Kind::rate, p1, p2, direction(1, 3), {}).turn = 1;
        break;
    case Type::constant_velocity: {
        for (const Vec3& e : {x, y, z}) make.point(p1, p2, e);
        BodyRow& row = make.add(BodyRow::Kind::rate, p1, p2, direction(1, 3), direction(2, 4));
        row.turn = row.turn2 = 1;
        break;
    }
    }
    result.count = rows.size() - result.begin;
    return result;
}

bool joint_fails(const JointFailure& failure, const Vec3& force, const Vec3& moment, const Model& model,
                 const State& state, double time)
{
    if (time >= failure.end) return true;
    const auto axes = failure.system == none ? CoordinateSystem{}.axes
                                             : axes_at(model.coordinate_systems[failure.system], state);
    const auto use = [&](const Vec3& load, const std::array<double, 3>& strength) {
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            if (strength[i] == 0) continue;
            const double share = dot(load, axes[i]) / strength[i];
            sum += share * share;
        }
        return sum;
    };
    const double of_force = use(force, failure.force), of_moment = use(moment, failure.moment);
    return failure.coupled ? of_force + of_moment >= 1 : of_force >= 1 || of_moment >= 1;
}

} // namespace plash

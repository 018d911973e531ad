#include "elements/discrete_triad.h"

#include "core/local_axes.h"
#include "math/matrix3.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Axes with r along a direction and s as near as possible to what is given.
Triad triad_along(const Vec3& direction, const Vec3& s, const Vec3& otherwise)
{
    const Vec3 r = unit(direction);
    Vec3 across = s - dot(s, r) * r;
    if (norm(across) < 1e-6) across = otherwise - dot(otherwise, r) * r;
    const Vec3 second = unit(across);
    return {r, second, cross(r, second)};
}

/// The axes after r has turned to a direction by the shortest way.
Triad carried_to(const Triad& axes, const Vec3& direction)
{
    const Vec3 r = unit(direction);
    const Vec3 sum = axes[0] + r;
    const double scale = 1 + dot(axes[0], r);
    if (scale < 1e-9) return triad_along(direction, axes[1], axes[2]); // turned round
    const Vec3 s = axes[1] - (dot(axes[1], r) / scale) * sum;
    const Vec3 second = unit(s - dot(s, r) * r);
    return {r, second, cross(r, second)};
}

Triad turned(const Triad& axes, const Vec3& turn)
{
    if (dot(turn, turn) == 0) return axes;
    const Matrix3 matrix = rotation(turn);
    const Vec3 r = unit(matrix * axes[0]);
    const Vec3 s = matrix * axes[1];
    const Vec3 second = unit(s - dot(s, r) * r);
    return {r, second, cross(r, second)};
}

Triad mean_of_triads(const Triad& a, const Triad& b)
{
    return triad_along(a[0] + b[0], a[1] + b[1], a[2] + b[2]);
}

} // namespace

Triad first_triad(const Model& model, Index beam, const TriadRule& rule)
{
    const auto& nodes = model.beams.nodes[beam];
    const Vec3 side = model.nodes.position[nodes[1]] - model.nodes.position[nodes[0]];
    const double length = norm(side);
    const Part& part = model.parts[model.beams.part[beam]];
    if (rule.follows_line() && length == 0) {
        throw DeckError(part.where,
                        fmt::format("beam {} of part {} has no length, so that r cannot lie along "
                                    "it (SCOOR = {} of its section); use 0, 1, 3 or their negatives",
                                    model.beams.id[beam], part.id, rule.scoor));
    }
    Vec3 third{};
    if (!model.beams.orientation.empty()) third = model.beams.orientation[beam];
    if (norm(third) == 0 && nodes[2] != none)
        third = model.nodes.position[nodes[2]] - model.nodes.position[nodes[0]];
    const bool oriented = length > 0 && norm(cross(side, third)) > 1e-6 * length * norm(third);
    Triad axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    if (rule.system != none) axes = model.coordinate_systems[rule.system].axes;
    if (rule.system == none && oriented) return triad_along(side, third, third);
    return rule.follows_line() ? triad_along(side, axes[1], axes[2]) : axes;
}

TriadStep turn_triad(const Triad& before, const TriadRule& rule, const TriadEnds& ends, double time_step,
                     const Model& model, const State& state)
{
    if (rule.system != none && model.coordinate_systems[rule.system].nodes[0] != none) {
        const Triad end = axes_at(model.coordinate_systems[rule.system], state);
        return {mean_of_triads(before, end), end};
    }
    Vec3 spin = rule.scoor > 0   ? ends.second_spin
                : rule.scoor < 0 ? ends.first_spin
                                 : 0.5 * (ends.first_spin + ends.second_spin);
    for (int axis = 0; axis < 3; ++axis) {
        if (rule.held[axis]) spin -= dot(spin, before[axis]) * before[axis];
    }
    TriadStep step{turned(before, (0.5 * time_step) * spin), turned(before, time_step * spin)};
    if (rule.follows_line()) {
        step.middle = carried_to(step.middle, ends.side - (0.5 * time_step) * ends.velocity);
        step.end = carried_to(step.end, ends.side);
    }
    return step;
}

} // namespace plash

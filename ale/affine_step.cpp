#include "ale/mesh_motion.h"
#include "core/prescribed_rate.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

void set_axis(Vec3& vector, int axis, double value)
{
    vector.*vector_component[axis] = value;
}

/// The motion v = f + G (x - centre) by the rule of the midpoint, of second order in time:
/// x' = x + dt (1 + dt / 2 G) (f + G (x - centre)).
AffineStep step_by_curves(const MeshMotion& motion, const MeshMotion::Rule& rule, const Model& model,
                          double middle, double step)
{
    Vec3 flow{};
    double slope[3][3] = {};
    for (int row = 0; row < 3; ++row) {
        const auto value = [&](int column) {
            const Index curve = rule.curves[4 * row + column];
            return curve == none || (motion.held & (1u << row)) ? 0 : curve_value(model, curve, middle);
        };
        set_axis(flow, row, value(0));
        for (int column = 0; column < 3; ++column) slope[row][column] = value(column + 1);
    }
    AffineStep result;
    result.from = result.to = motion.centre;
    const double offset[3] = {flow.x, flow.y, flow.z};
    for (int row = 0; row < 3; ++row) {
        double along = offset[row];
        for (int column = 0; column < 3; ++column) {
            double square = 0;
            for (int k = 0; k < 3; ++k) square += slope[row][k] * slope[k][column];
            result.gradient[row].*vector_component[column] +=
                step * (slope[row][column] + 0.5 * step * square);
            along += 0.5 * step * slope[row][column] * offset[column];
        }
        result.to.*vector_component[row] += step * along;
    }
    return result;
}

std::array<Vec3, 3> axes_of(const std::vector<Vec3>& nodes)
{
    const Vec3 x = unit(nodes[1] - nodes[0]), z = unit(cross(x, nodes[2] - nodes[0]));
    return {x, cross(z, x), z};
}

AffineStep step_of_frame(const std::vector<Vec3>& before, const std::vector<Vec3>& after)
{
    AffineStep result;
    result.from = before[0];
    result.to = after[0];
    const std::array<Vec3, 3> old = axes_of(before), now = axes_of(after);
    for (int row = 0; row < 3; ++row) {
        result.gradient[row] = {};
        for (int axis = 0; axis < 3; ++axis)
            result.gradient[row] += (now[axis].*vector_component[row]) * old[axis];
    }
    return result;
}

/// Axis by axis of the system of the first three nodes: how far others reach from the fourth one, before and
/// after. What lies within such a reach stays within it.
AffineStep step_of_enclosing(const MeshMotion& motion, const std::vector<Vec3>& before,
                             const std::vector<Vec3>& after)
{
    AffineStep result;
    result.from = before[3];
    result.to = after[3];
    result.gradient = {};
    const std::array<Vec3, 3> old = axes_of(before), now = axes_of(after);
    for (int axis = 0; axis < 3; ++axis) {
        const auto reach = [axis](const std::vector<Vec3>& nodes, const std::array<Vec3, 3>& axes) {
            double far = 0;
            for (std::size_t n = 4; n < nodes.size(); ++n)
                far = std::max(far, std::abs(dot(nodes[n] - nodes[3], axes[axis])));
            return far;
        };
        const double was = reach(before, old);
        const bool stretches = was > 0 && !(motion.stiff & (1u << axis));
        const double stretch = stretches ? reach(after, now) / was : 1;
        for (int row = 0; row < 3; ++row)
            result.gradient[row] += (stretch * (now[axis].*vector_component[row])) * old[axis];
    }
    return result;
}

/// Of a box that is flat along an axis there is nothing to stretch by.
AffineStep step_of_extent(const MeshMotion& motion, const std::vector<Vec3>& before,
                          const std::vector<Vec3>& after)
{
    AffineStep result;
    for (int axis = 0; axis < 3; ++axis) {
        const auto component = vector_component[axis];
        double low[2], high[2];
        const std::vector<Vec3>* const times[] = {&before, &after};
        for (int time = 0; time < 2; ++time) {
            low[time] = high[time] = times[time]->front().*component;
            for (const Vec3& node : *times[time]) {
                low[time] = std::min(low[time], node.*component);
                high[time] = std::max(high[time], node.*component);
            }
        }
        result.from.*component = 0.5 * (low[0] + high[0]);
        result.to.*component = 0.5 * (low[1] + high[1]);
        const bool stretches = high[0] - low[0] > 0 && !(motion.stiff & (1u << axis));
        if (stretches) result.gradient[axis].*component = (high[1] - low[1]) / (high[0] - low[0]);
    }
    return result;
}

} // namespace

AffineStep affine_step(const MeshMotion& motion, const Model& model, double time, double step,
                       const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                       const std::array<double, 3>& velocity)
{
    const MeshMotion::Rule& rule = motion.rules[motion.rule_number(time)];
    AffineStep result;
    switch (rule.kind) {
    case MeshMotion::Kind::curves:
        return step_by_curves(motion, rule, model, time + 0.5 * step, step);
    case MeshMotion::Kind::frame:
        result = step_of_frame(before, after);
        break;
    case MeshMotion::Kind::extent:
        result = step_of_extent(motion, before, after);
        break;
    case MeshMotion::Kind::enclosing:
        result = step_of_enclosing(motion, before, after);
        break;
    default:
        result.to = step * Vec3{velocity[0], velocity[1], velocity[2]};
        return result;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (motion.held & (1u << axis)) set_axis(result.to, axis, result.from.*vector_component[axis]);
    return result;
}

} // namespace plash

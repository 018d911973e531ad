#include "ale/slip_nodes.h"

namespace plash {

namespace {

Vec3 velocity_at(const std::array<AlignedDoubles, 3>& velocity, std::ptrdiff_t place)
{
    return {velocity[0][place], velocity[1][place], velocity[2][place]};
}

/// Returns what has been taken.
Vec3 take_across(std::array<AlignedDoubles, 3>& velocity, const SlipNode& node)
{
    const Vec3 own = velocity_at(velocity, node.place);
    Vec3 across{};
    for (int i = 0; i < node.count; ++i) across += dot(own, node.directions[i]) * node.directions[i];
    velocity[0][node.place] -= across.x;
    velocity[1][node.place] -= across.y;
    velocity[2][node.place] -= across.z;
    return across;
}

} // namespace

int span_of(const std::vector<Vec3>& directions, std::array<Vec3, 3>& across)
{
    int count = 0;
    for (const Vec3& direction : directions) {
        Vec3 rest = unit(direction);
        for (int i = 0; i < count; ++i) rest -= dot(rest, across[i]) * across[i];
        // Of faces that are nearly one plane the first decides.
        if (count < 3 && norm(rest) > 0.1) across[count++] = unit(rest);
    }
    return count;
}

double slip_along(FluidFields& fields, std::span<const SlipNode> nodes, double step,
                  const std::array<double, 3>& gravity)
{
    double fall = 0;
    for (const SlipNode& node : nodes) {
        take_across(fields.velocity, node);
        const Vec3 taken = take_across(fields.mean_velocity, node);
        fall += fields.node_mass[node.place] * step *
                (gravity[0] * taken.x + gravity[1] * taken.y + gravity[2] * taken.z);
    }
    return fall;
}

void slip_after_remap(FluidFields& fields, std::span<const SlipNode> nodes)
{
    for (const SlipNode& node : nodes) {
        const Vec3 taken = take_across(fields.velocity, node);
        if (fields.lost_motion.empty()) continue;
        fields.lost_motion[node.place] += 0.5 * fields.node_mass[node.place] * dot(taken, taken);
    }
}

} // namespace plash

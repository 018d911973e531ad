#include "core/state.h"

#include "core/parallel.h"

namespace plash {

void State::clear_forces()
{
    for_chunks(force.size(), [&](std::size_t begin, std::size_t end) {
        std::fill(force.begin() + begin, force.begin() + end, Vec3{});
        if (rotational()) std::fill(moment.begin() + begin, moment.begin() + end, Vec3{});
    });
}

void State::serialise(Archive& archive)
{
    archive.section("nodes");
    archive(position, velocity, mass, angular_velocity, inertia);
    archive(deleted_shells, deleted_solids, deleted_beams, deletions);
}

void State::need_rotation()
{
    if (rotational()) return;
    angular_velocity.resize(size());
    moment.resize(size());
    inertia.resize(size());
}

} // namespace plash

#pragma once

#include "core/results.h"
#include "elements/patches.h"

namespace plash {

/// A mass that moves.
inline void add_motion(double mass, const Vec3& velocity, ElementResults::PartMotion& motion)
{
    motion.mass += mass;
    motion.kinetic += 0.5 * mass * dot(velocity, velocity);
    motion.momentum[0] += mass * velocity.x;
    motion.momentum[1] += mass * velocity.y;
    motion.momentum[2] += mass * velocity.z;
}

/// Calls work(patch, batch, lane, motion) for every element on all threads: it may write rows of the element
/// in `results`, and adds to `motion`, which is summed in the order of the patches into that of the part.
template <class Work>
void collect_patches(const Patches& patches, Index part, ElementResults& results, Work&& work)
{
    const auto patch_total = static_cast<std::ptrdiff_t>(patches.patches.size());
    std::vector<ElementResults::PartMotion> motions(patch_total);
#pragma omp parallel for schedule(static) if (patch_total > 1)
    for (std::ptrdiff_t number = 0; number < patch_total; ++number) {
        const Patches::Patch& patch = patches.patches[number];
        ElementResults::PartMotion motion; // of its own: neighbours in `motions` share cache lines
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch)
            for (int lane = 0; lane < patches.active_lanes(batch); ++lane) work(patch, batch, lane, motion);
        motions[number] = motion;
    }
    if (results.part_motion.empty()) return;
    ElementResults::PartMotion& sum = results.part_motion[part];
    for (const ElementResults::PartMotion& motion : motions) {
        sum.mass += motion.mass;
        sum.kinetic += motion.kinetic;
        for (int i = 0; i < 3; ++i) sum.momentum[i] += motion.momentum[i];
    }
}

} // namespace plash

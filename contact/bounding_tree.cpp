#include "contact/bounding_tree.h"

#include "core/parallel.h"

#include <algorithm>

namespace plash {

void Bounds::grow(double by)
{
    low -= {by, by, by};
    high += {by, by, by};
}

void BoundingTree::fit(std::span<const Bounds> items)
{
    const auto groups_of = [](std::size_t count) { return (count + 7) / 8; };
    std::size_t depth = 0;
    for (std::size_t count = items.size(); count > 0; count = groups_of(count)) {
        ++depth;
        if (count <= 8) break;
    }
    levels_.resize(depth);
    const Bounds nothing;
    std::size_t below = items.size();
    for (std::size_t level = 0; level < depth; ++level) {
        std::vector<Group>& groups = levels_[level];
        groups.resize(groups_of(below));
        for_chunks(groups.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t group = begin; group < end; ++group) {
                for (int lane = 0; lane < 8; ++lane) {
                    const std::size_t child = 8 * group + lane;
                    Bounds box = nothing;
                    if (child < below && level == 0) {
                        box = items[child];
                    } else if (child < below) {
                        const Group& inner = levels_[level - 1][child];
                        for (int i = 0; i < 8; ++i) {
                            box.low = {std::min(box.low.x, inner.low.x[i]),
                                       std::min(box.low.y, inner.low.y[i]),
                                       std::min(box.low.z, inner.low.z[i])};
                            box.high = {std::max(box.high.x, inner.high.x[i]),
                                        std::max(box.high.y, inner.high.y[i]),
                                        std::max(box.high.z, inner.high.z[i])};
                        }
                    }
                    groups[group].low.x[lane] = box.low.x;
                    groups[group].low.y[lane] = box.low.y;
                    groups[group].low.z[lane] = box.low.z;
                    groups[group].high.x[lane] = box.high.x;
                    groups[group].high.y[lane] = box.high.y;
                    groups[group].high.z[lane] = box.high.z;
                }
            }
        });
        below = groups.size();
    }
}

} // namespace plash

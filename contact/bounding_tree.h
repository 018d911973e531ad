#pragma once

#include "math/lanes.h"
#include "math/vector3.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace plash {

/// An axis-parallel box; empty until something is added.
struct Bounds {
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

    void add(const Vec3& point)
    {
        low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
    }
    void add(const Bounds& other)
    {
        low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
        high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y),
                std::max(high.z, other.high.z)};
    }
    void grow(double by);
};

/// Tree of boxes over items that are sorted so that runs lie close together: eight items a leaf, eight boxes
/// a node, one vector comparison a node. Refitting costs one pass; a query about the logarithm of the count.
class BoundingTree {
public:
    /// Sets the boxes of all items.
    void fit(std::span<const Bounds> items);

    /// function(item) for every item whose box meets `box`, in rising order within each leaf.
    template <class Function>
    void query(const Bounds& box, Function&& function) const
    {
        if (levels_.empty()) return;
        struct Place {
            int level;
            std::uint32_t group;
        };
        Place stack[8 * 24]; // eight children a level, 24 levels hold more than any memory
        int count = 0;
        stack[count++] = {static_cast<int>(levels_.size()) - 1, 0};
        while (count > 0) {
            const Place place = stack[--count];
            unsigned hits = overlapping(levels_[place.level][place.group], box);
            while (hits != 0) {
                const std::uint32_t child = 8 * place.group + std::countr_zero(hits);
                hits &= hits - 1;
                if (place.level == 0) {
                    function(static_cast<std::int32_t>(child));
                } else {
                    stack[count++] = {place.level - 1, child};
                }
            }
        }
    }

private:
    struct Group {
        Vector3<Lanes> low, high;
    };
    std::vector<std::vector<Group>> levels_; ///< level 0: boxes of the items themselves

    static unsigned overlapping(const Group& group, const Bounds& box)
    {
        const LaneMask x = (group.low.x <= box.high.x) & (group.high.x >= box.low.x);
        const LaneMask y = (group.low.y <= box.high.y) & (group.high.y >= box.low.y);
        const LaneMask z = (group.low.z <= box.high.z) & (group.high.z >= box.low.z);
        return bits_of(x & y & z);
    }
};

} // namespace plash

#pragma once

#include "math/vector3.h"

#include <array>
#include <cmath>

namespace plash {

/// The direction along which two segments press on one another: a weighted mean of the normals in their
/// middles, and what turning it costs.
class MeanNormal {
public:
    using Corners = std::array<Vec3, 4>; ///< of a segment; a triangle repeats the third

    /// Weights with the signs that the normals have in the mean.
    MeanNormal(const Corners& first, double first_weight, const Corners& second, double second_weight)
        : first_(first, first_weight), second_(second, second_weight)
    {
        sum_ = first_weight * first_.normal + second_weight * second_.normal;
    }

    Vec3 direction() const { return unit(sum_); }

    /// Adds forces on the corners that work as an energy that changes by moment . d(angle) with the
    /// direction; each segment's share is a couple of its own, and all of them together are the moment's part
    /// across the direction, turned round.
    void add_turning(const Vec3& moment, Corners& on_first, Corners& on_second) const
    {
        const double length = norm(sum_);
        if (length == 0) return;
        const Vec3 by_sum = (1 / length) * cross(moment, (1 / length) * sum_);
        first_.add(by_sum, on_first);
        second_.add(by_sum, on_second);
    }

private:
    struct Side {
        Vec3 one, other; ///< diagonals, or two sides of a triangle; the normal is along their product
        Vec3 normal;
        double size = 0, weight = 0;
        bool triangle = false;

        Side(const Corners& q, double with_weight) : weight(with_weight)
        {
            const Vec3 last = q[3] - q[2];
            triangle = dot(last, last) == 0;
            one = triangle ? q[1] - q[0] : q[2] - q[0];
            other = triangle ? q[2] - q[0] : q[3] - q[1];
            const Vec3 product = cross(one, other);
            size = norm(product);
            if (size > 0) normal = (1 / size) * product;
        }

        /// by_sum  derivative of the energy by the sum of the weighted normals
        void add(const Vec3& by_sum, Corners& forces) const
        {
            if (size == 0) return;
            const Vec3 by_product = (weight / size) * (by_sum - dot(by_sum, normal) * normal);
            const Vec3 by_one = cross(other, by_product), by_other = cross(by_product, one);
            const int to_one = triangle ? 1 : 2, to_other = triangle ? 2 : 3, from_other = triangle ? 0 : 1;
            forces[to_one] -= by_one;
            forces[0] += by_one;
            forces[to_other] -= by_other;
            forces[from_other] += by_other;
        }
    };

    Side first_, second_;
    Vec3 sum_;
};

} // namespace plash

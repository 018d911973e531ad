#pragma once

#include "math/symmetric_tensor.h"
#include "math/tensor3.h"
#include "sph/pairs.h"
#include "sph/ring_radius.h"

namespace plash {

/// Sums of the gradient loop for one particle: two cache lines.
struct alignas(64) GradientSums {
    double velocity[9]; ///< sum of weight_j (v_j - v_i) (grad W_ij)^T, by rows
    double moment[6];   ///< sum of weight_j (x_j - x_i) (grad W_ij)^T: xx, yy, zz, xy, yz, zx
    double spare;

    Tensor3<double> gradient() const
    {
        const double* v = velocity;
        return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]};
    }
};
static_assert(sizeof(GradientSums) == 128);

/// Inverse of the moment of a kernel [-]. Particles with too few neighbours to carry a linear field keep the
/// plain gradient.
/// scale  1 where weights are volumes, 1 / density where they are masses
inline SymmetricTensor<double> gradient_correction(const GradientSums& sums, double scale, int dimension)
{
    constexpr double smallest_determinant = 0.1; // 1 inside, 1/2 at a flat surface, 1/8 at a corner in space
    const double* s = sums.moment;
    const SymmetricTensor<double> m{scale * s[0], scale * s[1], dimension == 2 ? 1 : scale * s[2],
                                    scale * s[3], scale * s[4], scale * s[5]};
    const double xx = m.yy * m.zz - m.yz * m.yz, xy = m.yz * m.zx - m.xy * m.zz,
                 zx = m.xy * m.yz - m.yy * m.zx;
    const double determinant = m.xx * xx + m.xy * xy + m.zx * zx;
    if (!(determinant > smallest_determinant)) return {1, 1, 1, 0, 0, 0};
    const double per = 1 / determinant;
    return {per * xx, per * (m.xx * m.zz - m.zx * m.zx), per * (m.xx * m.yy - m.xy * m.xy),
            per * xy, per * (m.xy * m.zx - m.xx * m.yz), per * zx};
}

inline Tensor3<double> full_tensor(const SymmetricTensor<double>& b)
{
    return {b.xx, b.xy, b.zx, b.xy, b.yy, b.yz, b.zx, b.yz, b.zz};
}

/// Gradient of the velocity by pairs, and what corrects it: `velocity` times the inverse of `moment` is exact
/// for any linear field (Randles & Libersky 1996; Bonet & Lok 1999). Velocities at n - 1/2 at the positions
/// of n - 1/2. With `rings` the rows of v_y are weighed by mean radii; the taker divides by the own one.
template <class Lane, class Kernel, bool rings = false>
class VelocityGradient {
public:
    /// sums  by particle of the run, zeroed; in and out
    VelocityGradient(const MotionRecord* records, Index first, int dimension, double half_step,
                     GradientSums* sums)
        : records_(records), run_(records + first), steepness_(dimension), half_step_(half_step), sums_(sums)
    {}

    void expect(Index place) const { __builtin_prefetch(&records_[place]); }
    void open(Index particle)
    {
        own_ = Moving<Lane>::same(run_[particle]);
        for (auto& line : sum_)
            for (Lane& sum : line) sum = Lane{};
    }
    void inside(const std::uint16_t* places)
    {
        Lane to_other[2][8];
        add_pairs(run_, places, to_other);
        // Two lines a particle: even and odd lines of the sums.
        std::uint16_t even[lanes_in<Lane>], odd[lanes_in<Lane>];
        for (int l = 0; l < lanes_in<Lane>; ++l) {
            even[l] = 2 * places[l];
            odd[l] = 2 * places[l] + 1;
        }
        add_to_lines(sums_->velocity, even, to_other[0]);
        add_to_lines(sums_->velocity, odd, to_other[1]);
    }
    void outside(const Index* places)
    {
        Lane to_other[2][8];
        add_pairs(records_, places, to_other);
    }
    void close(Index particle)
    {
        add_sums_to_line(sums_[particle].velocity, sum_[0]);
        add_sums_to_line(sums_[particle].velocity + 8, sum_[1]);
    }

private:
    const MotionRecord* records_;
    const MotionRecord* run_;
    Steepness<Kernel> steepness_;
    double half_step_;
    GradientSums* sums_;
    Moving<Lane> own_;
    Lane sum_[2][8];

    template <class Place>
    void add_pairs(const MotionRecord* records, const Place* places, Lane (&to_other)[2][8])
    {
        const auto other = Moving<Lane>::load(records, places);
        Vector3<Lane> velocity = own_.velocity - other.velocity;
        const Vector3<Lane> apart = own_.position - other.position - broadcast<Lane>(half_step_) * velocity;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane inverse_smoothing = reciprocal(0.5 * (own_.smoothing + other.smoothing));
        const Vector3<Lane> slope =
            steepness_(square, reciprocal_root(square), inverse_smoothing) * apart; // -grad W
        if constexpr (rings) velocity.y *= mean_radius(own_.position.x, other.position.x);
        const Lane values[2][8] = {
            {velocity.x * slope.x, velocity.x * slope.y, velocity.x * slope.z, velocity.y * slope.x,
             velocity.y * slope.y, velocity.y * slope.z, velocity.z * slope.x, velocity.z * slope.y},
            {velocity.z * slope.z, apart.x * slope.x, apart.y * slope.y, apart.z * slope.z, apart.x * slope.y,
             apart.y * slope.z, apart.z * slope.x, Lane{}}};
        for (int line = 0; line < 2; ++line) {
            for (int k = 0; k < 8; ++k) {
                sum_[line][k] += other.weight * values[line][k];
                to_other[line][k] = own_.weight * values[line][k];
            }
        }
    }
};

} // namespace plash

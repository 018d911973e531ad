#pragma once

#include "sph/pairs.h"

namespace plash {

/// Continuity by pairs: sum over neighbours of weight_j (v_i - v_j) . grad W_ij, the rate of density where
/// weights are masses and the rate of the logarithm of density where they are volumes (Monaghan 2005). Taken
/// with velocities at n - 1/2 at the positions of n - 1/2, so that it is centred in the step that it spans.
template <class Lane, class Kernel>
class DensityRate {
public:
    /// records  of all particles; the run begins at `first`
    /// rate     by particle of the run, zeroed; in and out
    DensityRate(const MotionRecord* records, Index first, int dimension, double half_step, double* rate)
        : records_(records), run_(records + first), steepness_(dimension), half_step_(half_step), rate_(rate)
    {}

    void open(Index particle)
    {
        own_ = Moving<Lane>::same(run_[particle]);
        sum_ = Lane{};
    }
    void inside(const std::uint16_t* places)
    {
        const auto other = Moving<Lane>::load(run_, places);
        const Lane approach = approach_to(other);
        sum_ += other.weight * approach;
        add_to_places(rate_, places, own_.weight * approach);
    }
    void outside(const Index* places)
    {
        const auto other = Moving<Lane>::load(records_, places);
        sum_ += other.weight * approach_to(other);
    }
    void close(Index particle) { rate_[particle] += sum_of_lanes(sum_); }

private:
    const MotionRecord* records_;
    const MotionRecord* run_;
    Steepness<Kernel> steepness_;
    double half_step_;
    double* rate_;
    Moving<Lane> own_;
    Lane sum_;

    /// (v_i - v_j) . grad W
    Lane approach_to(const Moving<Lane>& other) const
    {
        const Vector3<Lane> velocity = own_.velocity - other.velocity;
        const Vector3<Lane> apart = own_.position - other.position - broadcast<Lane>(half_step_) * velocity;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane inverse_smoothing = reciprocal(0.5 * (own_.smoothing + other.smoothing));
        return -dot(apart, velocity) * steepness_(square, reciprocal_root(square), inverse_smoothing);
    }
};

} // namespace plash

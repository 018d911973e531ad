#pragma once

#include "sph/pairs.h"
#include "sph/ring_radius.h"

namespace plash {

/// Sums of the force loop for one particle: one cache line.
struct alignas(64) ForceSums {
    Vec3 force;         ///< all pair forces, per weight of the particle
    double spare = 0;   ///< keeps the line full
    Vec3 viscous_force; ///< the share of viscosity in `force`
    double heat = 0;    ///< power of viscosity that heats the particle, per weight
};
static_assert(sizeof(ForceSums) == 64);

/// Coefficients of Monaghan & Gingold's viscosity (1983): quadratic Q1 and linear Q2.
struct ArtificialViscosity {
    double quadratic = 1.5, linear = 0.06;
};

/// Where the force loop finds its particles, by sorted place.
struct PairRecords {
    const MotionRecord* motion;
    const PushRecord* push;
    const TensionRecord* tension; ///< nullptr: push is a scalar

    PairRecords from(Index first) const
    {
        return {motion + first, push + first, tension ? tension + first : nullptr};
    }
};

/// Pressure and viscosity by pairs: weight_i weight_j (push_i + push_j + Pi_ij) acts along the line of the
/// two particles, so linear and angular momentum are kept to round-off. Pi holds Monaghan & Gingold's
/// viscosity where particles approach, and laminar viscosity (Monaghan & Cleary 1999).
///
/// With `tensor`, push is a full tensor: that of the TensionRecord, with the push of the PushRecord as its zz
/// component. With `rings`, forces are those of rings, by radian (sph/rings.h); viscosity acts along the line
/// of the two all the same, weighed by their mean radius.
template <class Lane, class Kernel, bool tensor, bool rings = false>
class PairForce {
public:
    /// records  of all particles; the run begins at `first`
    /// sums     by particle of the run, zeroed; in and out
    PairForce(const PairRecords& records, Index first, int dimension, const ArtificialViscosity& viscosity,
              ForceSums* sums)
        : records_(records),
          run_(records.from(first)),
          steepness_(dimension),
          viscosity_(viscosity),
          sums_(sums)
    {}

    void open(Index particle)
    {
        own_ = Moving<Lane>::same(run_.motion[particle]);
        const PushRecord& push = run_.push[particle];
        push_ = broadcast<Lane>(push.push);
        scale_ = broadcast<Lane>(push.scale);
        sound_ = broadcast<Lane>(push.sound);
        laminar_ = broadcast<Lane>(push.viscosity);
        if constexpr (tensor) {
            for (int k = 0; k < 8; ++k) tension_[k] = broadcast<Lane>(run_.tension[particle].component[k]);
        }
        for (Lane& sum : sum_) sum = Lane{};
    }
    void inside(const std::uint16_t* places)
    {
        Lane to_other[8];
        add_pairs(run_, places, to_other);
        add_to_lines(&sums_->force.x, places, to_other);
    }
    void outside(const Index* places)
    {
        Lane to_other[8];
        add_pairs(records_, places, to_other);
    }
    void close(Index particle) { add_sums_to_line(&sums_[particle].force.x, sum_); }

private:
    PairRecords records_;
    PairRecords run_;
    Steepness<Kernel> steepness_;
    ArtificialViscosity viscosity_;
    ForceSums* sums_;
    Moving<Lane> own_;
    Lane push_, scale_, sound_, laminar_;
    Lane tension_[8];
    Lane sum_[8];

    template <class Place>
    void add_pairs(const PairRecords& records, const Place* places, Lane (&to_other)[8])
    {
        const auto other = Moving<Lane>::load(records.motion, places);
        Lane push[4];
        load_half_lines(&records.push->push, places, push);

        const Vector3<Lane> apart = own_.position - other.position;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane inverse_distance = reciprocal_root(square);
        const Lane smoothing = 0.5 * (own_.smoothing + other.smoothing);
        const Lane steepness = steepness_(square, inverse_distance, reciprocal(smoothing));

        const Lane opening = dot(own_.velocity - other.velocity, apart); // r dr/dt
        const Lane opening_rate = opening * reciprocal(square + 0.01 * (smoothing * smoothing));
        const Lane approach = min(smoothing * opening_rate, Lane{}); // Monaghan's mu
        const Lane artificial =
            approach * (viscosity_.quadratic * approach - (0.5 * viscosity_.linear) * (sound_ + push[2]));
        const Lane viscous = (0.5 * artificial) * (scale_ + push[1]) - (laminar_ + push[3]) * opening_rate;
        Lane viscous_pull = steepness * viscous;
        if constexpr (rings) viscous_pull *= 0.5 * (own_.position.x + abs(other.position.x));
        const Lane heat = -0.5 * viscous_pull * opening;
        const Vector3<Lane> viscous_force = viscous_pull * apart;
        const Vector3<Lane> force =
            steepness * pushed(records, places, push[0], other.position.x, apart) + viscous_force;

        const Lane values[8] = {force.x,         force.y,         force.z,         Lane{},
                                viscous_force.x, viscous_force.y, viscous_force.z, heat};
        for (int k = 0; k < 8; ++k) {
            sum_[k] += other.weight * values[k];
            to_other[k] = (k < 7 ? -own_.weight : own_.weight) * values[k];
        }
    }

    /// (push_i + push_j) times the vector from j to i; in rings each row is weighed by radii.
    template <class Place>
    Vector3<Lane> pushed(const PairRecords& records, const Place* places, Lane push, Lane radius,
                         const Vector3<Lane>& apart) const
    {
        Lane t[8];
        if constexpr (tensor) load_lines(records.tension->component, places, t);
        if constexpr (rings) {
            const Lane own_radius = own_.position.x;
            const Lane mean = mean_radius(own_radius, radius);
            if constexpr (!tensor) {
                return {(own_radius * push_ + radius * push) * apart.x, mean * (push_ + push) * apart.y,
                        Lane{}};
            } else {
                const auto radial = [&](int k) { return own_radius * tension_[k] + radius * t[k]; };
                return {radial(0) * apart.x + radial(1) * apart.y,
                        mean * ((tension_[3] + t[3]) * apart.x + (tension_[4] + t[4]) * apart.y), Lane{}};
            }
        } else if constexpr (!tensor) {
            return (push_ + push) * apart;
        } else {
            for (int k = 0; k < 8; ++k) t[k] += tension_[k];
            return {t[0] * apart.x + t[1] * apart.y + t[2] * apart.z,
                    t[3] * apart.x + t[4] * apart.y + t[5] * apart.z,
                    t[6] * apart.x + t[7] * apart.y + (push_ + push) * apart.z};
        }
    }
};

} // namespace plash

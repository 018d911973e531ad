#pragma once

#include "sph/pairs.h"
#include "sph/ring_radius.h"

namespace plash {

/// Sums of the force loop for one particle: one cache line.
struct alignas(64) ForceSums {
    Vec3 force;         ///< all pair forces [force]
    double spare = 0;   ///< keeps the line full
    Vec3 viscous_force; ///< the share of viscosity in `force`
    double heat = 0;    ///< power of viscosity that heats the particle [energy/time]
};
static_assert(sizeof(ForceSums) == 64);

/// What pairs do to the opened particle.
template <class Lane>
struct PairEffect {
    Vector3<Lane> force, viscous_force;
    Lane loss; ///< power that their motion loses to the heat of each of the two
};

/// Adds up what pairs do: to the opened particle in lanes, to the others in their lines. A force on the one
/// is taken from the other as it is, so momentum is kept to round-off.
template <class Lane>
class ForceTally {
public:
    explicit ForceTally(ForceSums* sums) : sums_(sums) {}

    void open()
    {
        for (Lane& sum : sum_) sum = Lane{};
    }
    template <class Wide>
    void add(const PairEffect<Wide>& pair)
    {
        sum_[0] += in_one_batch(pair.force.x);
        sum_[1] += in_one_batch(pair.force.y);
        sum_[2] += in_one_batch(pair.force.z);
        sum_[4] += in_one_batch(pair.viscous_force.x);
        sum_[5] += in_one_batch(pair.viscous_force.y);
        sum_[6] += in_one_batch(pair.viscous_force.z);
        sum_[7] -= in_one_batch(pair.loss);
    }
    template <class Wide>
    void take_from(const std::uint16_t* places, const PairEffect<Wide>& pair)
    {
        const Wide values[8] = {pair.force.x,         pair.force.y,         pair.force.z,         Wide{},
                                pair.viscous_force.x, pair.viscous_force.y, pair.viscous_force.z, pair.loss};
        subtract_from_lines(&sums_->force.x, places, values);
    }
    void close(Index particle) { add_sums_to_line(&sums_[particle].force.x, sum_); }

private:
    ForceSums* sums_;
    Lane sum_[8];
};

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
    static constexpr bool takes_two = !rings;

    /// records  of all particles; the run begins at `first`
    /// sums     by particle of the run, zeroed; in and out
    PairForce(const PairRecords& records, Index first, int dimension, const ArtificialViscosity& viscosity,
              ForceSums* sums)
        : records_(records),
          run_(records.from(first)),
          steepness_(dimension),
          viscosity_(viscosity),
          tally_(sums)
    {}

    void expect(Index place) const
    {
        __builtin_prefetch(&records_.motion[place]);
        __builtin_prefetch(&records_.push[place]);
        if constexpr (tensor) __builtin_prefetch(&records_.tension[place]);
    }
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
        tally_.open();
    }
    template <class Wide = Lane>
    void inside(const std::uint16_t* places)
    {
        const auto pair = effect<Wide>(run_, places);
        tally_.add(pair);
        tally_.take_from(places, pair);
    }
    void outside(const Index* places) { tally_.add(effect<Lane>(records_, places)); }
    void close(Index particle) { tally_.close(particle); }

private:
    PairRecords records_;
    PairRecords run_;
    Steepness<Kernel> steepness_;
    ArtificialViscosity viscosity_;
    ForceTally<Lane> tally_;
    Moving<Lane> own_;
    Lane push_, scale_, sound_, laminar_;
    Lane tension_[8];

    template <class Wide, class Place>
    PairEffect<Wide> effect(const PairRecords& records, const Place* places) const
    {
        const auto own = own_.template in<Wide>();
        const auto other = Moving<Wide>::load(records.motion, places);
        Wide push[4];
        load_half_lines(&records.push->push, places, push);

        const Vector3<Wide> apart = own.position - other.position;
        const Wide square = dot(apart, apart) + tiny_square;
        const Wide smoothing = 0.5 * (own.smoothing + other.smoothing);
        const Wide steepness =
            (own.weight * other.weight) * steepness_(square, reciprocal_root(square), reciprocal(smoothing));

        const Wide opening = dot(own.velocity - other.velocity, apart); // r dr/dt
        const Wide opening_rate = opening * reciprocal(square + 0.01 * (smoothing * smoothing));
        const Wide approach = min(smoothing * opening_rate, Wide{}); // Monaghan's mu
        const Wide artificial = approach * (viscosity_.quadratic * approach -
                                            (0.5 * viscosity_.linear) * (widened<Wide>(sound_) + push[2]));
        const Wide viscous = artificial * (0.5 * (widened<Wide>(scale_) + push[1])) -
                             (widened<Wide>(laminar_) + push[3]) * opening_rate;
        Wide pull = steepness * viscous;
        if constexpr (rings) pull = 0.5 * (pull * (own.position.x + abs(other.position.x)));
        const Wide loss = (0.5 * pull) * opening;
        if constexpr (!rings && !tensor) {
            const Wide all = steepness * (widened<Wide>(push_) + push[0]) + pull;
            return {all * apart, pull * apart, loss};
        } else {
            const Vector3<Wide> viscous_force = pull * apart;
            return {steepness * pushed(records, places, push[0], other.position.x, apart) + viscous_force,
                    viscous_force, loss};
        }
    }

    /// (push_i + push_j) times the vector from j to i; in rings each row is weighed by radii.
    template <class Wide, class Place>
    Vector3<Wide> pushed(const PairRecords& records, const Place* places, Wide push, Wide radius,
                         const Vector3<Wide>& apart) const
    {
        const Wide own_push = widened<Wide>(push_);
        Wide t[8];
        if constexpr (tensor) load_lines(records.tension->component, places, t);
        if constexpr (rings) {
            const Wide own_radius = own_.position.x;
            const Wide mean = mean_radius(own_radius, radius);
            if constexpr (!tensor) {
                return {(own_radius * own_push + radius * push) * apart.x, mean * (own_push + push) * apart.y,
                        Wide{}};
            } else {
                const auto radial = [&](int k) { return own_radius * tension_[k] + radius * t[k]; };
                return {radial(0) * apart.x + radial(1) * apart.y,
                        mean * ((tension_[3] + t[3]) * apart.x + (tension_[4] + t[4]) * apart.y), Wide{}};
            }
        } else {
            for (int k = 0; k < 8; ++k) t[k] = t[k] + widened<Wide>(tension_[k]);
            return {t[0] * apart.x + t[1] * apart.y + t[2] * apart.z,
                    t[3] * apart.x + t[4] * apart.y + t[5] * apart.z,
                    t[6] * apart.x + t[7] * apart.y + (own_push + push) * apart.z};
        }
    }
};

} // namespace plash

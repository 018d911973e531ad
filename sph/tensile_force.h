#pragma once

#include "math/lanes_math.h"
#include "sph/pair_force.h"

#include <algorithm>

namespace plash {

/// Monaghan's artificial pressure against clumping in tension (2000): pairs that come closer
/// than the spacing are pushed apart by (R_i + R_j) f^4 with f = W(r) / W(spacing) and R = -epsilon times the
/// push where that is negative. It acts along the line of the pair and keeps both momenta.
template <class Lane, class Kernel>
class TensileForce {
public:
    /// sums  by particle of the run, zeroed; in and out. What the motion does against this force is booked as
    ///       heat, as that of viscosity is.
    TensileForce(const PairRecords& records, Index first, int dimension, bool volume_weighted,
                 double strength, ForceSums* sums)
        : records_(records),
          run_(records.from(first)),
          dimension_(dimension),
          volumes_(volume_weighted),
          strength_(strength),
          steepness_(dimension),
          tally_(sums)
    {}

    void open(Index particle)
    {
        own_ = Moving<Lane>::same(run_.motion[particle]);
        const PushRecord& push = run_.push[particle];
        volume_ = volumes_ ? own_.weight : own_.weight * push.scale;
        push_ = broadcast<Lane>(std::min(push.push, 0.0));
        tally_.open();
    }
    void inside(const std::uint16_t* places)
    {
        const auto pair = effect(run_, places);
        tally_.add(pair);
        tally_.take_from(places, pair);
    }
    void outside(const Index* places) { tally_.add(effect(records_, places)); }
    void close(Index particle) { tally_.close(particle); }

private:
    PairRecords records_;
    PairRecords run_;
    int dimension_;
    bool volumes_;
    double strength_;
    Steepness<Kernel> steepness_;
    ForceTally<Lane> tally_;
    Moving<Lane> own_;
    Lane volume_, push_;

    template <class Place>
    PairEffect<Lane> effect(const PairRecords& records, const Place* places) const
    {
        const auto other = Moving<Lane>::load(records.motion, places);
        Lane push[4];
        load_half_lines(&records.push->push, places, push);
        const Lane volume = 0.5 * (volume_ + (volumes_ ? other.weight : other.weight * push[1]));
        const Lane spacing = dimension_ == 2 ? sqrt(volume) : power(volume, 1.0 / 3.0);

        const Vector3<Lane> apart = own_.position - other.position;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane inverse_distance = reciprocal_root(square);
        const Lane inverse_smoothing = reciprocal(0.5 * (own_.smoothing + other.smoothing));
        const Lane f = Kernel::value(square * inverse_distance * inverse_smoothing) /
                       max(Kernel::value(spacing * inverse_smoothing), broadcast<Lane>(1e-6));
        const Lane f2 = f * f;
        const Lane repulsion = -strength_ * (push_ + min(push[0], Lane{})) * (f2 * f2);
        const Lane pull = (own_.weight * other.weight * repulsion) *
                          steepness_(square, inverse_distance, inverse_smoothing);
        const Vector3<Lane> force = pull * apart;
        return {force, force, 0.5 * pull * dot(own_.velocity - other.velocity, apart)};
    }
};

} // namespace plash

#pragma once

#include "math/lanes_math.h"
#include "sph/pair_force.h"

namespace plash {

/// Sums over the neighbours of a particle that say how it should drift against its own velocity, and how full
/// its kernel is: one cache line.
struct alignas(64) DriftSums {
    Vec3 smoothed;      ///< sum of m_j / mean density (v_j - v_i) W [velocity]
    double filling = 0; ///< sum of V_j W, without the particle itself [-]
    Vec3 crowding;     ///< sum of V_j (1 + R f^4) grad W: points to where the particles are denser [1/length]
    double spread = 0; ///< sum of V_j (x_j - x_i) . grad W: the dimension inside, less near a surface [-]
};
static_assert(sizeof(DriftSums) == 64);

/// What XSPH (Monaghan 1989) and particle shifting (Lind et al. 2012; the pairing term R f^4 with
/// f = W(r) / W(spacing) and R = 0.2 of Sun et al. 2017) ask of the pairs.
template <class Lane, class Kernel>
class DriftPass {
public:
    /// sums  by particle of the run, zeroed; in and out
    DriftPass(const PairRecords& records, Index first, int dimension, bool volume_weighted, DriftSums* sums)
        : records_(records),
          run_(records.from(first)),
          norm_(Kernel::norm(dimension)),
          dimension_(dimension),
          volumes_(volume_weighted),
          steepness_(dimension),
          sums_(sums)
    {}

    void open(Index particle)
    {
        own_ = Moving<Lane>::same(run_.motion[particle]);
        const double scale = run_.push[particle].scale;
        take(own_.weight, broadcast<Lane>(scale), own_volume_, own_density_);
        for (Lane& sum : sum_) sum = Lane{};
    }
    void inside(const std::uint16_t* places)
    {
        Lane to_other[8];
        add_pairs(run_, places, to_other);
        add_to_lines(&sums_->smoothed.x, places, to_other);
    }
    void outside(const Index* places)
    {
        Lane to_other[8];
        add_pairs(records_, places, to_other);
    }
    void close(Index particle) { add_sums_to_line(&sums_[particle].smoothed.x, sum_); }

private:
    PairRecords records_;
    PairRecords run_;
    double norm_;
    int dimension_;
    bool volumes_;
    Steepness<Kernel> steepness_;
    DriftSums* sums_;
    Moving<Lane> own_;
    Lane own_volume_, own_density_;
    Lane sum_[8];

    /// Volume and density of particles from what their records hold.
    void take(Lane weight, Lane scale, Lane& volume, Lane& density) const
    {
        volume = volumes_ ? weight : weight * scale;
        density = volumes_ ? scale : reciprocal(scale);
    }

    template <class Place>
    void add_pairs(const PairRecords& records, const Place* places, Lane (&to_other)[8])
    {
        const auto other = Moving<Lane>::load(records.motion, places);
        Lane push[4];
        load_half_lines(&records.push->push, places, push);
        Lane volume, density;
        take(other.weight, push[1], volume, density);

        const Vector3<Lane> apart = own_.position - other.position;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane inverse_distance = reciprocal_root(square);
        const Lane inverse_smoothing = reciprocal(0.5 * (own_.smoothing + other.smoothing));
        const Lane q = square * inverse_distance * inverse_smoothing;
        const Lane area = inverse_smoothing * inverse_smoothing;
        const Lane kernel = (norm_ * (dimension_ == 2 ? area : area * inverse_smoothing)) * Kernel::value(q);
        // A particle that stands in its own padded batch is at no distance from itself and must not count.
        const Lane apart_at_all = square > 1e-150 ? broadcast<Lane>(1.0) : Lane{};

        // f = W(r) / W(spacing), the spacing being that of a full lattice of the two volumes.
        const Lane mean_volume = 0.5 * (own_volume_ + volume);
        const Lane spacing = dimension_ == 2 ? sqrt(mean_volume) : power(mean_volume, 1.0 / 3.0);
        const Lane f =
            Kernel::value(q) / max(Kernel::value(spacing * inverse_smoothing), broadcast<Lane>(1e-6));
        const Lane f2 = f * f;
        const Lane slope = -(1.0 + 0.2 * (f2 * f2)) * steepness_(square, inverse_distance, inverse_smoothing);
        const Lane spread = square * steepness_(square, inverse_distance, inverse_smoothing);

        const Lane blend = (2.0 * kernel) * reciprocal(own_density_ + density);
        const Vector3<Lane> pull = blend * (other.velocity - own_.velocity);
        const Lane filling = kernel * apart_at_all;
        const Lane mass = volume * density, own_mass = own_volume_ * own_density_;
        const Vector3<Lane> gradient = slope * apart;
        const Lane values[8] = {pull.x, pull.y, pull.z, filling, gradient.x, gradient.y, gradient.z, spread};
        for (int k = 0; k < 8; ++k) {
            sum_[k] += (k < 3 ? mass : volume) * values[k];
            to_other[k] = (k < 3 ? -own_mass : k == 3 || k == 7 ? own_volume_ : -own_volume_) * values[k];
        }
    }
};

} // namespace plash

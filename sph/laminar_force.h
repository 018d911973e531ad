#pragma once

#include "sph/pair_force.h"

namespace plash {

/// Laminar viscosity along the difference of the velocities (Morris, Fox & Zhu 1997, eq. 22):
/// V_i V_j (mu_i + mu_j) (x_ij . grad W) / r^2 v_ij. On a lattice its Laplacian is right to 0.3 % at h = 1.5
/// spacings, where that of central forces lacks 11 % along the axes; it has no bulk viscosity. It does not
/// keep angular momentum: at a free surface it brakes a rotation, which central forces do not.
template <class Lane, class Kernel>
class LaminarForce {
public:
    /// records    of all particles; the run begins at `first`
    /// viscosity  by sorted place, scaled as pushes are
    /// sums       by particle of the run, zeroed; in and out
    LaminarForce(const MotionRecord* records, const double* viscosity, Index first, int dimension,
                 ForceSums* sums)
        : records_(records), viscosity_(viscosity), first_(first), steepness_(dimension), sums_(sums)
    {}

    void open(Index particle)
    {
        own_ = Moving<Lane>::same(records_[first_ + particle]);
        own_viscosity_ = broadcast<Lane>(viscosity_[first_ + particle]);
        for (Lane& sum : sum_) sum = Lane{};
    }
    void inside(const std::uint16_t* places)
    {
        Lane to_other[8];
        add_pairs(first_, places, to_other);
        add_to_lines(&sums_->force.x, places, to_other);
    }
    void outside(const Index* places)
    {
        Lane to_other[8];
        add_pairs(0, places, to_other);
    }
    void close(Index particle) { add_sums_to_line(&sums_[particle].force.x, sum_); }

private:
    const MotionRecord* records_;
    const double* viscosity_;
    Index first_;
    Steepness<Kernel> steepness_;
    ForceSums* sums_;
    Moving<Lane> own_;
    Lane own_viscosity_;
    Lane sum_[8];

    template <class Place>
    void add_pairs(Index first, const Place* places, Lane (&to_other)[8])
    {
        const auto other = Moving<Lane>::load(records_ + first, places);
        Lane viscosity{};
        for (int l = 0; l < lanes_in<Lane>; ++l) set_lane(viscosity, l, viscosity_[first + places[l]]);
        const Vector3<Lane> apart = own_.position - other.position;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane inverse_smoothing = reciprocal(0.5 * (own_.smoothing + other.smoothing));
        const Lane drag =
            (own_viscosity_ + viscosity) * steepness_(square, reciprocal_root(square), inverse_smoothing);
        const Vector3<Lane> velocity = own_.velocity - other.velocity;
        const Vector3<Lane> force = -drag * velocity;
        const Lane heat = 0.5 * drag * dot(velocity, velocity);
        const Lane values[8] = {force.x, force.y, force.z, Lane{}, force.x, force.y, force.z, heat};
        for (int k = 0; k < 8; ++k) {
            sum_[k] += other.weight * values[k];
            to_other[k] = (k < 7 ? -own_.weight : own_.weight) * values[k];
        }
    }
};

} // namespace plash

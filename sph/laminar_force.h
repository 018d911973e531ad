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
    /// bend       by image, see ParticleArrays; may be nullptr
    /// sums       by particle of the run, zeroed; in and out
    LaminarForce(const MotionRecord* records, const double* viscosity, const Vec3* bend, Index first_image,
                 Index first, int dimension, ForceSums* sums)
        : records_(records),
          viscosity_(viscosity),
          bend_(bend),
          first_image_(first_image),
          first_(first),
          steepness_(dimension),
          tally_(sums)
    {}

    void open(Index particle)
    {
        own_ = Moving<Lane>::same(records_[first_ + particle]);
        own_viscosity_ = broadcast<Lane>(viscosity_[first_ + particle]);
        tally_.open();
    }
    void inside(const std::uint16_t* places)
    {
        const auto pair = effect(first_, places);
        tally_.add(pair);
        tally_.take_from(places, pair);
    }
    void outside(const Index* places)
    {
        PairEffect<Lane> pair = effect(0, places);
        if (bend_) pair.loss += 0.5 * dot(pair.force, bend_of(places));
        tally_.add(pair);
    }
    void close(Index particle) { tally_.close(particle); }

private:
    const MotionRecord* records_;
    const double* viscosity_;
    const Vec3* bend_;
    Index first_image_;
    Index first_;
    Steepness<Kernel> steepness_;
    ForceTally<Lane> tally_;
    Moving<Lane> own_;
    Lane own_viscosity_;

    /// Motion against a wall heats the fluid by the force times v - U, which is half of what a mirror image
    /// without bend differs by.
    Vector3<Lane> bend_of(const Index* places) const
    {
        Vector3<Lane> bend{};
        for (int l = 0; l < lanes_in<Lane>; ++l) {
            if (places[l] < first_image_) continue;
            const Vec3& of_image = bend_[places[l] - first_image_];
            set_lane(bend.x, l, of_image.x);
            set_lane(bend.y, l, of_image.y);
            set_lane(bend.z, l, of_image.z);
        }
        return bend;
    }

    template <class Place>
    PairEffect<Lane> effect(Index first, const Place* places) const
    {
        const auto other = Moving<Lane>::load(records_ + first, places);
        Lane viscosity{};
        for (int l = 0; l < lanes_in<Lane>; ++l) set_lane(viscosity, l, viscosity_[first + places[l]]);
        const Vector3<Lane> apart = own_.position - other.position;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane inverse_smoothing = reciprocal(0.5 * (own_.smoothing + other.smoothing));
        const Lane drag = (own_.weight * other.weight) * (own_viscosity_ + viscosity) *
                          steepness_(square, reciprocal_root(square), inverse_smoothing);
        const Vector3<Lane> velocity = own_.velocity - other.velocity;
        const Vector3<Lane> force = -drag * velocity;
        return {force, force, -0.5 * drag * dot(velocity, velocity)};
    }
};

} // namespace plash

#pragma once

#include "sph/pair_force.h"

namespace plash {

/// Sums for a density that is computed anew from the particles' places (Shepard 1968; Colagrossi & Landrini
/// 2003): rho_i = sum of m_j W_ij / sum of V_j W_ij, both sums with the particle itself.
struct FilterSums {
    double mass = 0;   ///< [mass/volume]
    double volume = 0; ///< [-]
};

template <class Lane, class Kernel>
class DensityFilter {
public:
    /// mass, volume  by particle of the run, zeroed; in and out
    DensityFilter(const PairRecords& records, Index first, int dimension, bool volume_weighted, double* mass,
                  double* volume)
        : records_(records),
          run_(records.from(first)),
          norm_(Kernel::norm(dimension)),
          dimension_(dimension),
          volumes_(volume_weighted),
          mass_(mass),
          volume_(volume)
    {}

    void open(Index particle)
    {
        own_ = Moving<Lane>::same(run_.motion[particle]);
        own_fluid_ = amounts(own_.weight, broadcast<Lane>(run_.push[particle].scale));
        sum_ = {Lane{}, Lane{}};
    }
    void inside(const std::uint16_t* places)
    {
        Amounts other;
        const Lane kernel = kernel_to(run_, places, other);
        add(other, kernel);
        add_to_places(mass_, places, own_fluid_.mass * kernel);
        add_to_places(volume_, places, own_fluid_.volume * kernel);
    }
    void outside(const Index* places)
    {
        Amounts other;
        const Lane kernel = kernel_to(records_, places, other);
        add(other, kernel);
    }
    void close(Index particle)
    {
        const double h = run_.motion[particle].smoothing;
        const double self = norm_ * Kernel::value(0.0) / (dimension_ == 2 ? h * h : h * h * h);
        mass_[particle] += sum_of_lanes(sum_.mass) + self * lane_of(own_fluid_.mass, 0);
        volume_[particle] += sum_of_lanes(sum_.volume) + self * lane_of(own_fluid_.volume, 0);
    }

private:
    struct Amounts {
        Lane mass, volume;
    };
    PairRecords records_;
    PairRecords run_;
    double norm_;
    int dimension_;
    bool volumes_;
    double* mass_;
    double* volume_;
    Moving<Lane> own_;
    Amounts own_fluid_;
    Amounts sum_;

    Amounts amounts(Lane weight, Lane scale) const
    {
        return {volumes_ ? weight * scale : weight, volumes_ ? weight : weight * scale};
    }
    void add(const Amounts& other, Lane kernel)
    {
        sum_.mass += other.mass * kernel;
        sum_.volume += other.volume * kernel;
    }

    template <class Place>
    Lane kernel_to(const PairRecords& records, const Place* places, Amounts& amount) const
    {
        const auto other = Moving<Lane>::load(records.motion, places);
        Lane push[4];
        load_half_lines(&records.push->push, places, push);
        amount = amounts(other.weight, push[1]);
        const Vector3<Lane> apart = own_.position - other.position;
        const Lane square = dot(apart, apart) + tiny_square;
        const Lane per = reciprocal(0.5 * (own_.smoothing + other.smoothing));
        const Lane power = per * per * (dimension_ == 2 ? broadcast<Lane>(1.0) : per);
        const Lane value = norm_ * power * Kernel::value(square * reciprocal_root(square) * per);
        return square > 1e-150 ? value : Lane{}; // the padding of a batch is the particle itself
    }
};

} // namespace plash

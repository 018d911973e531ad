#pragma once

#include "sph/pairs.h"
#include "sph/ring_radius.h"

#include <array>

namespace plash {

/// Density diffusion of the delta-SPH scheme, and the sources that the continuity loop needs for it.
struct DensityDiffusion {
    double strength = 0; ///< delta, 0.1 as a rule [-]
    Vec3 gravity{};      ///< acceleration that the fluid at rest is stratified by [length/time^2]
    const PushRecord* push = nullptr;    ///< by sorted place
    const std::uint8_t* part = nullptr;  ///< by sorted place; density does not diffuse across parts,
    const std::uint8_t* image = nullptr; ///< by image: nor from mirrors, which show water at rest upside down
    Index first_image = 0;               ///< sorted place
    bool volume_weighted = false;
};

/// Continuity by pairs: sum over neighbours of weight_j (v_i - v_j) . grad W_ij, the rate of density where
/// weights are masses and the rate of the logarithm of density where they are volumes (Monaghan 2005). Taken
/// with velocities at n - 1/2 at the positions of n - 1/2, so that it is centred in the step that it spans.
///
/// With `diffusive` also the diffusion of Molteni & Colagrossi (2009),
///   delta h c sum of 2 V_j (rho_j - rho_i - hydrostatic difference) (x_j - x_i) . grad W / r^2;
/// taking the hydrostatic difference rho g . (x_j - x_i) / c^2 away, as Fourtakas et al. (2019) do, keeps
/// still water still right up to its surface, where the plain term is inconsistent.
///
/// With `rings` also the moment of the kernel that their sums are divided by (sph/rings.h), half the sum of
/// weight_j (x_j - x_i) . grad W_ij.
template <class Lane, class Kernel, bool diffusive = false, bool rings = false>
class DensityRate {
public:
    static constexpr bool takes_two = !diffusive && !rings;

    /// records    of all particles; the run begins at `first`
    /// rate       by particle of the run, zeroed; in and out
    /// spread     rate of density by diffusion [mass/volume/time], likewise; only used if diffusive
    /// moment     likewise; only used if rings [-]
    DensityRate(const MotionRecord* records, Index first, int dimension, double half_step, double* rate,
                const DensityDiffusion& diffusion = {}, double* spread = nullptr, double* moment = nullptr)
        : records_(records),
          run_(records + first),
          first_(first),
          steepness_(dimension),
          half_step_(half_step),
          rate_(rate),
          diffusion_(diffusion),
          spread_(spread),
          moment_(moment)
    {}

    void expect(Index place) const { __builtin_prefetch(&records_[place]); }
    void open(Index particle)
    {
        own_ = Moving<Lane>::same(run_[particle]);
        sum_ = Lane{};
        if constexpr (rings) moment_sum_ = Lane{};
        if constexpr (diffusive) {
            const PushRecord& push = diffusion_.push[first_ + particle];
            own_fluid_ = fluid_of(own_.weight, broadcast<Lane>(push.scale), broadcast<Lane>(push.sound));
            part_ = diffusion_.part[first_ + particle];
            spread_sum_ = Lane{};
        }
    }
    template <class Wide = Lane>
    void inside(const std::uint16_t* places)
    {
        const auto own = own_.template in<Wide>();
        const auto other = Moving<Wide>::load(run_, places);
        Vector3<Wide> apart;
        Wide slope;
        const auto [approach, to_other] = approach_to(own, other, apart, slope);
        sum_ += in_one_batch(other.weight * approach);
        add_to_places(rate_, places, own.weight * to_other);
        if constexpr (rings) {
            const Lane share = 0.5 * slope * dot(apart, apart);
            moment_sum_ += other.weight * share;
            add_to_places(moment_, places, own.weight * share);
        }
        if constexpr (diffusive) {
            Lane volume;
            const Lane flow = flow_from(first_, places, other, apart, slope, volume);
            spread_sum_ += volume * flow;
            add_to_places(spread_, places, -own_fluid_.volume * flow);
        }
    }
    void outside(const Index* places)
    {
        const auto other = Moving<Lane>::load(records_, places);
        Vector3<Lane> apart;
        Lane slope;
        sum_ += in_one_batch(other.weight * approach_to(own_, other, apart, slope)[0]);
        if constexpr (rings) moment_sum_ += other.weight * (0.5 * slope * dot(apart, apart));
        if constexpr (diffusive) {
            Lane volume;
            const Lane flow = flow_from(0, places, other, apart, slope, volume);
            spread_sum_ += volume * flow;
        }
    }
    void close(Index particle)
    {
        rate_[particle] += sum_of_lanes(sum_);
        if constexpr (rings) moment_[particle] += sum_of_lanes(moment_sum_);
        if constexpr (diffusive) spread_[particle] += sum_of_lanes(spread_sum_);
    }

private:
    /// What diffusion needs of particles.
    struct Fluid {
        Lane volume, density, sound;
    };

    const MotionRecord* records_;
    const MotionRecord* run_;
    Index first_;
    Steepness<Kernel> steepness_;
    double half_step_;
    double* rate_;
    DensityDiffusion diffusion_;
    double* spread_;
    double* moment_;
    Moving<Lane> own_;
    Lane sum_, spread_sum_, moment_sum_;
    Fluid own_fluid_;
    std::uint8_t part_ = 0;

    Fluid fluid_of(Lane weight, Lane scale, Lane sound) const
    {
        if (diffusion_.volume_weighted) return {weight, scale, sound};
        return {weight * scale, reciprocal(scale), sound};
    }

    /// (v_i - v_j) . grad W, with grad W = -slope * apart, as the particle and the other one see it: the
    /// same, but in rings, each of which weighs motion along the axis by the mean radius over its own.
    template <class Wide>
    std::array<Wide, 2> approach_to(const Moving<Wide>& own, const Moving<Wide>& other, Vector3<Wide>& apart,
                                    Wide& slope) const
    {
        const Vector3<Wide> velocity = own.velocity - other.velocity;
        apart = own.position - other.position - broadcast<Wide>(half_step_) * velocity;
        const Wide square = dot(apart, apart) + tiny_square;
        const Wide inverse_smoothing = reciprocal(0.5 * (own.smoothing + other.smoothing));
        slope = steepness_(square, reciprocal_root(square), inverse_smoothing);
        if constexpr (!rings) {
            const Wide approach = -dot(apart, velocity) * slope;
            return {approach, approach};
        } else {
            const Wide radius = other.position.x;
            const Wide across = -(apart.x * velocity.x) * slope;
            const Wide along = -(apart.y * velocity.y) * slope * mean_radius(own.position.x, radius);
            return {across + along / ring_radius(own.position.x, own.smoothing),
                    across + along / ring_radius(radius, other.smoothing)};
        }
    }

    /// Density that flows from the other particle per volume of it.
    template <class Place>
    Lane flow_from(Index first, const Place* places, const Moving<Lane>& other, const Vector3<Lane>& apart,
                   Lane slope, Lane& volume) const
    {
        Lane push[4];
        load_half_lines(&diffusion_.push[first].push, places, push);
        const Fluid fluid = fluid_of(other.weight, push[1], push[2]);
        volume = fluid.volume;
        const Lane sound = 0.5 * (own_fluid_.sound + fluid.sound);
        const Lane smoothing = 0.5 * (own_.smoothing + other.smoothing);
        const Vec3& g = diffusion_.gravity;
        const Lane depth = -(g.x * apart.x + g.y * apart.y + g.z * apart.z); // g . (x_j - x_i)
        const Lane at_rest = 0.5 * (own_fluid_.density + fluid.density) * depth * reciprocal(sound * sound);
        Lane same{};
        for (int l = 0; l < lanes_in<Lane>; ++l) {
            const Index place = first + places[l];
            const Index image = place - diffusion_.first_image;
            const bool mirrored = image >= 0 && diffusion_.image[image] == mirror_image;
            set_lane(same, l, diffusion_.part[place] == part_ && !mirrored ? 1.0 : 0.0);
        }
        return same * (2 * diffusion_.strength) * smoothing * sound * slope *
               (fluid.density - own_fluid_.density - at_rest);
    }
};

} // namespace plash

#pragma once

#include "sph/images.h"
#include "sph/pairs.h"

namespace plash {

/// Sums what the images of absorbing planes add to motion and heat of the particles, over the pairs of a run.
/// A pair of a particle i and an image j adds w_i w_j (push_j v_i + push_i v_j) . x_ij steepness; in all
/// other pairs that of the other side takes it back. Particles asleep do not: they have v_j = 0, and keep
/// their energy.
template <class Kernel>
class AbsorbedPower {
public:
    /// force  by sorted place, in and out: with the velocities of the particles it gives the power [force]
    AbsorbedPower(const ParticleArrays& arrays, const Images& images, Index first, int dimension,
                  std::vector<Vec3>& force)
        : arrays_(arrays), images_(images), first_(first), steepness_(dimension), force_(force)
    {}

    double power = 0; ///< of what the images carry on of the velocities [energy/time]

    void open(Index particle) { own_ = first_ + particle; }
    void inside(const std::uint16_t*) {} // images stand outside of all runs
    void outside(const Index* place)
    {
        const std::size_t other = *place, real_count = arrays_.real_count();
        const bool at_rest = !arrays_.asleep.empty() && asleep(other);
        if (!at_rest && (other < real_count || !images_.absorbs(other - real_count))) return;
        const MotionRecord &a = arrays_.motion[own_], &b = arrays_.motion[other];
        const Vec3 apart = a.position - b.position;
        const double square = dot(apart, apart) + tiny_square;
        const double steepness = steepness_(square, 1 / std::sqrt(square), 2 / (a.smoothing + b.smoothing));
        const double pull = a.weight * b.weight * steepness;
        if (at_rest) {
            force_[own_] += pull * pushed(other, apart);
            return;
        }
        const Vec3 own_force = pull * pushed(own_, apart);
        const Index source = images_.source(other - real_count);
        const Matrix3& flow = images_.flow(other - real_count);
        force_[own_] += pull * pushed(other, apart);
        force_[source] += transpose(flow) * own_force;
        power += dot(own_force, b.velocity - flow * arrays_.motion[source].velocity);
    }
    void close(Index) {}

private:
    const ParticleArrays& arrays_;
    const Images& images_;
    Index first_, own_ = 0;
    Steepness<Kernel> steepness_;
    std::vector<Vec3>& force_;

    bool asleep(std::size_t place) const
    {
        const std::size_t real_count = arrays_.real_count();
        return arrays_.asleep[place < real_count ? place : images_.source(place - real_count)];
    }
    Vec3 pushed(std::size_t place, const Vec3& apart) const
    {
        const double push = arrays_.push[place].push;
        if (arrays_.tension.empty()) return push * apart;
        const double* t = arrays_.tension[place].component;
        return {t[0] * apart.x + t[1] * apart.y + t[2] * apart.z,
                t[3] * apart.x + t[4] * apart.y + t[5] * apart.z,
                t[6] * apart.x + t[7] * apart.y + push * apart.z};
    }
};

} // namespace plash

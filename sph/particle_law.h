#pragma once

#include "sph/pair_force.h"
#include "sph/particle_arrays.h"

#include <cmath>
#include <limits>
#include <span>

namespace plash {

/// What all particles of a part share besides their law.
struct PartConstants {
    int dimension = 3;
    double density = 0;                ///< reference, of the law [mass/volume]
    bool volume_weighted = false;      ///< weights of pairs are volumes (the fluid forms), not masses
    bool failed_carry_nothing = false; ///< IEROD = 1
    double smoothing = 0;              ///< h at the reference density [length]
    double smoothing_mass = 0; ///< of the particle that has this h, and its bounds; 0: all particles [mass]
    double smallest_smoothing = 0;       ///< [length]
    double largest_smoothing = 0;        ///< [length]
    bool smoothing_by_cube_root = false; ///< DERIV = 1
    ArtificialViscosity viscosity;
    double bulk_length = 0; ///< that viscosity of solid elements goes by, over h; 0: viscosity of pairs [-]
    double laminar_viscosity = 0;     ///< dynamic [stress time]
    bool laminar_by_velocity = false; ///< it does not act along the line of pairs

    /// How much larger than those of the part the smoothing length of a particle and its bounds are: all
    /// particles carry as much mass in their kernels as their neighbours do.
    double size_of(double mass) const
    {
        if (smoothing_mass == 0) return 1;
        const double ratio = mass / smoothing_mass;
        return dimension == 2 ? std::sqrt(ratio) : std::cbrt(ratio);
    }
};

/// The shortest stable step of some particles and whose it is.
struct ParticleVote {
    double step = std::numeric_limits<double>::infinity(); ///< [time]
    Index place = none;                                    ///< sorted place

    void take(const ParticleVote& other)
    {
        if (other.step < step) *this = other;
    }
};

/// The law of a part: from the density rate to density, energy, pressure and smoothing length at n.
class ParticleLaw {
public:
    virtual ~ParticleLaw() = default;

    virtual double initial_energy() const { return 0; }      ///< by reference volume [energy/volume]
    virtual double initial_compression() const { return 1; } ///< density over reference density
    /// Density over reference density where the pressure is given, with the energy of the start.
    virtual double compression_at(double /*pressure*/) const { return initial_compression(); }
    virtual bool has_strength() const { return false; } ///< needs velocity gradients and a stress tensor
    virtual double shear_sound() const { return 0; }    ///< over that of longitudinal waves [-]
    virtual int history_size() const { return 0; }      ///< variables of a particle
    virtual void start_history(double* /*variables*/) const {}
    virtual double plastic_strain(const double* /*variables*/) const { return 0; } ///< effective [-]

    /// Advances the particles at `places` over the step that ends at n; a step of 0 only evaluates the law.
    virtual ParticleVote advance(const PartConstants&, std::span<const Index> places, double step,
                                 ParticleArrays&) const = 0;
};

} // namespace plash

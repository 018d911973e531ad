#pragma once

#include "core/archive.h"
#include "math/symmetric_tensor.h"
#include "math/tensor3.h"
#include "math/vector3.h"
#include "model/record.h"
#include "sph/pairs.h"

#include <cstdint>
#include <vector>

namespace plash {

inline Vec3 wide(const Vector3<float>& a)
{
    return {a.x, a.y, a.z};
}
inline Vector3<float> narrow(const Vec3& a)
{
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// What a body of particles carries from step to step, by sorted place. Behind the particles stand their
/// images (mirror and periodic copies), in those arrays alone that pair loops read of neighbours; they are
/// copied from their originals each step.
struct ParticleArrays {
    // Of particles and images.
    std::vector<MotionRecord> motion;
    std::vector<PushRecord> push;
    std::vector<std::uint8_t> part;     ///< part of the body, not of the Model
    std::vector<std::uint8_t> image;    ///< of images alone: an ImageKind
    std::vector<double> laminar;        ///< viscosity along differences of velocity, scaled; empty without
    std::vector<std::uint8_t> bonded;   ///< 1: waits in a solid, as a neighbour of others; empty without
    std::vector<float> reach;           ///< of the lists: half of kernel radius and skin [length]
    std::vector<TensionRecord> tension; ///< only of bodies whose push is a tensor

    std::vector<Index> node;           ///< index in the State
    std::vector<std::uint8_t> asleep;  ///< 1: outside of the active regions; empty: nobody can be
    std::vector<double> own_mass;      ///< where weights are volumes, see mass() [mass]
    std::vector<double> rate;          ///< of density, or of its logarithm where weights are volumes [1/time]
    std::vector<double> diffusion;     ///< rate of density by diffusion; empty without [mass/volume/time]
    std::vector<double> kept_pressure; ///< where it is not all of the push; else empty [stress]
    std::vector<double> energy;        ///< internal energy by initial volume [energy/volume]
    std::vector<Vector3<float>> viscous_force; ///< share of viscosity in the last force [force]
    std::vector<float> heat;                   ///< its heating power [energy/time]
    // Only of laminar fluids beside walls without slip.
    std::vector<Tensor3<double>> wall_gradient; ///< of the velocity as viscosity sees it [1/time]
    std::vector<Vec3> bend; ///< of images alone: what the curvature at the wall adds to their motion
                            ///< [velocity]
    // Only of bodies with boundaries that let waves out.
    std::vector<double> rest_pressure; ///< at the start [stress]
    std::vector<Vec3> rest_velocity;   ///< likewise [velocity]

    // Only of rings (sph/rings.h).
    std::vector<double> first_radius; ///< at the start [length]
    std::vector<double> moment;       ///< by how much pair sums of linear fields are right [-]

    std::vector<double> bulk; ///< viscosity as of solid elements, where it is asked for; else empty [stress]

    std::vector<Vec3> drift; ///< of the particles against their velocity; empty without [velocity]

    // Only of bodies whose push is a tensor.
    std::vector<Tensor3<double>> gradient;           ///< of the velocity, corrected where asked for [1/time]
    std::vector<SymmetricTensor<double>> correction; ///< of kernel gradients [-]
    std::vector<SymmetricTensor<double>> stress;     ///< Cauchy, global axes; of solids [stress]
    std::vector<double> history;                     ///< `history_size` variables of the law a particle
    int history_size = 0;

    Vec3 build_origin;                          ///< that build_position counts from [length]
    double build_rounding = 0;                  ///< the largest error of build_position [length]
    std::vector<Vector3<float>> build_position; ///< at the last neighbour search [length]

    double mass(std::size_t place) const { return own_mass.empty() ? motion[place].weight : own_mass[place]; }

    // Density and pressure stand in the push, as pair loops see them: scaled by 1 / density^2 where weights
    // are masses.
    double density(std::size_t place) const
    {
        return own_mass.empty() ? 1 / push[place].scale : push[place].scale;
    }
    void set_density(std::size_t place, double value)
    {
        push[place].scale = own_mass.empty() ? 1 / value : value;
    }
    double scaling(std::size_t place) const
    {
        return own_mass.empty() ? push[place].scale * push[place].scale : 1;
    }
    double pressure(std::size_t place) const
    {
        return kept_pressure.empty() ? push[place].push / scaling(place) : kept_pressure[place];
    }
    /// To be called after set_density.
    void set_pressure(std::size_t place, double value)
    {
        if (kept_pressure.empty()) {
            push[place].push = value * scaling(place);
        } else {
            kept_pressure[place] = value;
        }
    }
    /// Another density under the pressure that there is.
    void change_density(std::size_t place, double value)
    {
        const double before = pressure(place);
        set_density(place, value);
        set_pressure(place, before);
    }
    Index size() const { return static_cast<Index>(motion.size()); }     ///< with the images
    Index real_count() const { return static_cast<Index>(node.size()); } ///< without them

    /// Keeps where everybody stands: as offsets from the middle, in single precision.
    void remember_build();
    Vec3 built_at(std::size_t place) const { return build_origin + wide(build_position[place]); }

    void serialise(Archive& archive)
    {
        archive(motion, push, node, part, image, bonded, asleep, own_mass, rate, diffusion, kept_pressure,
                energy, viscous_force, heat, laminar, wall_gradient, rest_pressure, rest_velocity,
                first_radius, moment, bulk, drift, tension, gradient, correction, stress, history, reach,
                build_origin, build_rounding, build_position);
    }
};

} // namespace plash

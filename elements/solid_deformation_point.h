#pragma once

#include "elements/solid_axes.h"
#include "elements/solid_step.h"
#include "math/tensor3.h"

namespace plash {

/// Material point of a solid whose stress follows from the deformation gradient between the initial and the
/// present place (materials/mooney_rivlin.h, materials/rubber.h). With the centre rule the forces of an
/// elastic element are the exact derivative of its strain energy.
template <class Law, SolidGradientRule rule>
struct DeformationPoint {
    Law law;

    static constexpr bool has_history = requires { Law::history_size; };
    static constexpr int modes = rule == SolidGradientRule::mean ? 6 : 3;
    static constexpr int history_size = [] {
        if constexpr (has_history) return int{Law::history_size};
        return 0;
    }();
    static constexpr int constant_size = 3 * modes; ///< gradient operator at the start over 64 volume
    static constexpr bool modulus_changes = false;
    static constexpr bool can_fail = false;
    static constexpr int plastic_strain = -1;

    template <class Lane>
    void start(const SolidModes<Lane>& position, [[maybe_unused]] Lane* history, Lane* constants) const
    {
        if constexpr (requires { law.axes; }) start_solid_axes(law.axes, position, history + point_history);
        const SolidGradient<Lane, rule> b = gradient_of<rule>(position);
        const Lane scale = 1.0 / (64.0 * b.volume);
        const auto put = [&](int mode, const Vector3<Lane>& value) {
            Lane* place = constants + point_constants + 3 * mode;
            place[0] = scale * value.x;
            place[1] = scale * value.y;
            place[2] = scale * value.z;
        };
        for (int mode = 0; mode < 3; ++mode) put(mode, b.linear[mode]);
        for (std::size_t mode = 0; mode < b.bilinear.size(); ++mode) put(3 + mode, b.bilinear[mode]);
    }

    /// The deformation gradient, or the stretches that the law finds in it.
    template <class Lane>
    auto see(const SolidMotion<Lane>& motion) const
    {
        if constexpr (requires { law.stretches(deformation(motion)); }) {
            return law.stretches(deformation(motion));
        } else {
            return deformation(motion);
        }
    }

    template <class Seen>
    auto wave_modulus(const Seen& seen) const
    {
        return law.wave_modulus(seen);
    }

    template <class Lane, class Seen>
    void update(SymmetricTensor<Lane>& stress, HistoryView<Lane> history, const SolidMotion<Lane>& motion,
                const Seen& seen) const
    {
        if constexpr (has_history) {
            if constexpr (requires { law.rotate_history(history, motion.rotation); })
                law.rotate_history(history, motion.rotation);
            law.update(stress, seen, motion.increment, history, motion.time_step);
        } else {
            stress = law.stress(seen);
        }
    }

private:
    template <class Lane>
    static Tensor3<Lane> deformation(const SolidMotion<Lane>& motion)
    {
        Tensor3<Lane> f;
        for (int mode = 0; mode < modes; ++mode) {
            const Lane* c = motion.constants + 3 * mode;
            const Vector3<Lane>& x =
                mode < 3 ? motion.position.linear[mode] : motion.position.hourglass[mode - 3];
            f.add_dyad(x, Vector3<Lane>{c[0], c[1], c[2]});
        }
        return f;
    }
};

} // namespace plash

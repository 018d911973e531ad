#pragma once

#include "elements/solid_axes.h"
#include "elements/solid_step.h"
#include "math/tensor3.h"

namespace plash {

/// Material point of a law of the deformation gradient (elements/solid_deformation_point.h) in fully
/// integrated solids, whose strains are not those of a single gradient: the point follows its own. A step
/// multiplies it by the rotation R and by exp(e) ~ 1 + e + e^2 / 2 with the strain increment e in the axes of
/// the step's end; as e there is R^(1/2) e_middle R^(-1/2), the product is symmetric in time and off by the
/// cube of the increment. The mean volume strain of the element enters by e.
template <class Law>
struct FollowedPoint {
    Law law;

    static constexpr int gradient = [] { // behind the law's own variables; row by row
        if constexpr (requires { Law::history_size; }) return int{Law::history_size};
        return 0;
    }();
    static constexpr int history_size = gradient + 9;
    static constexpr int constant_size = 0;
    static constexpr bool modulus_changes = false;
    static constexpr bool can_fail = false;
    static constexpr int plastic_strain = -1;

    template <class Lane>
    void start([[maybe_unused]] const SolidModes<Lane>& position, Lane* history, Lane* /*constants*/) const
    {
        if constexpr (requires { law.axes; }) start_solid_axes(law.axes, position, history + point_history);
        for (const int diagonal : {0, 4, 8})
            history[point_history + gradient + diagonal] = broadcast<Lane>(1);
    }

    template <class Lane>
    Lane wave_modulus(const SolidMotion<Lane>&, HistoryView<Lane> history) const
    {
        return law.wave_modulus(seen(gradient_at(history)));
    }

    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, HistoryView<Lane> history,
                const SolidMotion<Lane>& motion) const
    {
        const Tensor3<Lane> turned = motion.rotation * gradient_at(history);
        const Tensor3<Lane> once = product(motion.increment, turned);
        const Tensor3<Lane> now = turned + once + broadcast<Lane>(0.5) * product(motion.increment, once);
        const Lane parts[9] = {now.xx, now.xy, now.xz, now.yx, now.yy, now.yz, now.zx, now.zy, now.zz};
        for (int i = 0; i < 9; ++i) history[gradient + i] = parts[i];
        if constexpr (requires { Law::history_size; }) {
            if constexpr (requires { law.rotate_history(history, motion.rotation); })
                law.rotate_history(history, motion.rotation);
            law.update(stress, seen(now), motion.increment, history, motion.time_step);
        } else {
            stress = law.stress(seen(now));
        }
    }

private:
    template <class Lane>
    static Tensor3<Lane> gradient_at(HistoryView<Lane> history)
    {
        const Lane* f = history.values + gradient;
        return {f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8]};
    }

    template <class Lane>
    static Tensor3<Lane> product(const SymmetricTensor<Lane>& s, const Tensor3<Lane>& m)
    {
        return Tensor3<Lane>{s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz} * m;
    }

    template <class Lane>
    auto seen(const Tensor3<Lane>& deformation) const
    {
        if constexpr (requires { law.stretches(deformation); }) {
            return law.stretches(deformation);
        } else {
            return deformation;
        }
    }
};

} // namespace plash

#pragma once

#include "materials/plastic_return.h"
#include "materials/von_mises.h"

namespace plash {

/// One step of shell points for isotropic von Mises laws whose flow stress depends on the plastic increment
/// of the step alone: elastic trial, return (Simo & Taylor 1986) and thickness strain.
template <class Lane>
struct PlaneStressTrial {
    SymmetricTensor<Lane>& stress;    ///< trial, then the end of the step
    SymmetricTensor<Lane>& increment; ///< its zz is set
    double young_modulus, poisson_ratio;
    Lane sum_before; ///< of the two normal stresses
    PlaneStressPath<Lane> path;

    PlaneStressTrial(SymmetricTensor<Lane>& s, SymmetricTensor<Lane>& e, double young, double poisson)
        : stress(s),
          increment(e),
          young_modulus(young),
          poisson_ratio(poisson),
          sum_before(s.xx + s.yy),
          path(trial_of(s, e, young, poisson), 0, young, poisson)
    {}

    /// Square of the von Mises stress of the trial.
    Lane square() const { return path.slow_square + path.fast_square; }

    /// The strain increment as if it kept the volume, as the flow does: for strain rates where they matter.
    SymmetricTensor<Lane> isochoric_increment() const
    {
        SymmetricTensor<Lane> change = increment;
        change.zz = -increment.xx - increment.yy;
        return change;
    }

    struct Flow {
        Lane plastic;    ///< increment of plastic strain
        Lane equivalent; ///< von Mises stress at the end [stress]
    };

    /// Brings the lanes in `yielding` back to yield(plastic increment) -> {stress, slope}.
    /// bound  yield stress at the start of the step [stress]
    template <class Yield>
    Flow flow(const MaskOf<Lane>& yielding, const Lane& bound, Yield&& yield)
    {
        const auto at = [&](const Lane& m) {
            const Lane u = 1.0 / (1.0 + path.slow * m), w = 1.0 / (1.0 + path.fast * m);
            const Lane slow = path.slow_square * u * u, fast = path.fast_square * w * w;
            const Lane both = slow + fast, equivalent = sqrt(both);
            const Lane fall = path.slow * slow * u + path.fast * fast * w;
            const Lane plastic = (2.0 / 3) * m * equivalent;
            const auto now = yield(plastic);
            return ReturnPoint<Lane>{equivalent, -fall,    plastic, (2.0 / 3) * (both - m * fall),
                                     now.stress, now.slope};
        };
        const Lane trial = max(sqrt(square()), broadcast<Lane>(1e-300));
        const Lane start = 0.75 / path.fast * (trial - bound) / trial;
        Lane m = return_parameter<Lane>(yielding, start, at);
        m = yielding ? m : Lane{};
        const Lane plastic = path.shrink(stress, m);
        increment.zz = -poisson_ratio / young_modulus * (stress.xx + stress.yy - sum_before) -
                       (1.0 / 3) * m * (stress.xx + stress.yy);
        const Lane u = 1.0 / (1.0 + path.slow * m), w = 1.0 / (1.0 + path.fast * m);
        return {plastic, sqrt(path.slow_square * u * u + path.fast_square * w * w)};
    }

private:
    static SymmetricTensor<Lane>& trial_of(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                                           double young_modulus, double poisson_ratio)
    {
        add_plane_elastic_stress(stress, increment, young_modulus, poisson_ratio);
        increment.zz = -poisson_ratio / (1 - poisson_ratio) * (increment.xx + increment.yy);
        return stress;
    }
};

} // namespace plash

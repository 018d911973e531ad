#pragma once

#include "math/lanes.h"
#include "math/tensor3.h"

namespace plash {

/// The left Cauchy-Green tensor F F^T of a deformation gradient and its invariants.
template <class Lane>
struct LeftCauchyGreen {
    SymmetricTensor<Lane> left;
    Lane first, second, third;

    /// Its largest principal value (the largest squared stretch), from above: a bound by its deviator, and
    /// three steps of Newton's iteration on the characteristic polynomial, which stay above the largest root.
    Lane largest_square() const
    {
        const SymmetricTensor<Lane> part = deviator(left);
        Lane s = (1.0 / 3) * first + sqrt((2.0 / 3) * contract(part, part));
        for (int round = 0; round < 3; ++round) {
            const Lane value = ((s - first) * s + second) * s - third;
            const Lane slope = (3.0 * s - 2.0 * first) * s + second;
            // Near a threefold root the bound is good already, and the quotient all round-off.
            s -= slope > 1e-6 * s * s ? max(value, Lane{}) / slope : Lane{};
        }
        return s;
    }
};

template <class Lane>
inline LeftCauchyGreen<Lane> left_cauchy_green(const Tensor3<Lane>& f)
{
    const SymmetricTensor<Lane> l{
        f.xx * f.xx + f.xy * f.xy + f.xz * f.xz, f.yx * f.yx + f.yy * f.yy + f.yz * f.yz,
        f.zx * f.zx + f.zy * f.zy + f.zz * f.zz, f.xx * f.yx + f.xy * f.yy + f.xz * f.yz,
        f.yx * f.zx + f.yy * f.zy + f.yz * f.zz, f.zx * f.xx + f.zy * f.xy + f.zz * f.xz};
    const Lane first = trace(l), volume = determinant(f);
    return {l, first, 0.5 * (first * first - contract(l, l)), volume * volume};
}

} // namespace plash

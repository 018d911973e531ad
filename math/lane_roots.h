#pragma once

#include "math/lanes.h"

namespace plash {

/// First guess of a^(-1/3) from the exponent bits, within 4 %.
inline Lanes guess_inverse_cube_root(Lanes a)
{
    // Bits as a number, times 1/3, back to bits: there is no integer division for lanes.
    const Lanes bits = __builtin_convertvector(reinterpret_cast<LaneMask>(a), Lanes);
    const LaneMask third = __builtin_convertvector(bits * (1.0 / 3.0), LaneMask);
    return reinterpret_cast<Lanes>(0x553ef0ff289dd796LL - third);
}

inline double guess_inverse_cube_root(double a)
{
    return guess_inverse_cube_root(broadcast<Lanes>(a))[0];
}

/// a^(-1/3) for a > 0 without division, to round-off: Newton's iteration on r^-3 = a from the exponent bits.
template <class Lane>
inline Lane inverse_cube_root(Lane a)
{
    Lane root = guess_inverse_cube_root(a);
    const Lane third = a * (1.0 / 3.0);
    for (int i = 0; i < 5; ++i) root *= 4.0 / 3.0 - third * (root * root * root);
    return root;
}

} // namespace plash

#pragma once

#include <cmath>

namespace plash {

/// Symmetric second-order tensor (stress, strain increment). Shear components are tensor components,
/// not engineering shear. The order is LS-DYNA's: xx, yy, zz, xy, yz, zx.
template <class T>
struct SymmetricTensor {
    T xx{}, yy{}, zz{}, xy{}, yz{}, zx{};
};

template <class T>
inline SymmetricTensor<T> operator+(const SymmetricTensor<T>& a, const SymmetricTensor<T>& b)
{
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.zx + b.zx};
}

template <class T>
inline SymmetricTensor<T> operator-(const SymmetricTensor<T>& a, const SymmetricTensor<T>& b)
{
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.zx - b.zx};
}

template <class T>
inline SymmetricTensor<T> operator*(const T& factor, const SymmetricTensor<T>& a)
{
    return {factor * a.xx, factor * a.yy, factor * a.zz, factor * a.xy, factor * a.yz, factor * a.zx};
}

template <class T>
inline T trace(const SymmetricTensor<T>& a)
{
    return a.xx + a.yy + a.zz;
}

/// Full contraction a : b.
template <class T>
inline T contract(const SymmetricTensor<T>& a, const SymmetricTensor<T>& b)
{
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}

/// Deviator of a.
template <class T>
inline SymmetricTensor<T> deviator(const SymmetricTensor<T>& a)
{
    const T mean = trace(a) * (1.0 / 3.0);
    return {a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.yz, a.zx};
}

/// Equivalent stress of von Mises.
inline double von_mises_stress(const SymmetricTensor<double>& stress)
{
    const SymmetricTensor<double> s = deviator(stress);
    return std::sqrt(1.5 * contract(s, s));
}

} // namespace plash

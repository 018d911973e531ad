#pragma once

#include "math/symmetric_tensor.h"
#include "math/vector3.h"

namespace plash {

/// A full second-order tensor by rows; T is double or a lane type (Matrix3 is the one for rigid bodies).
template <class T>
struct Tensor3 {
    T xx{}, xy{}, xz{}, yx{}, yy{}, yz{}, zx{}, zy{}, zz{};

    /// Adds the dyad a b^T.
    void add_dyad(const Vector3<T>& a, const Vector3<T>& b)
    {
        xx += a.x * b.x;
        xy += a.x * b.y;
        xz += a.x * b.z;
        yx += a.y * b.x;
        yy += a.y * b.y;
        yz += a.y * b.z;
        zx += a.z * b.x;
        zy += a.z * b.y;
        zz += a.z * b.z;
    }
};

template <class T>
inline Tensor3<T> operator+(const Tensor3<T>& a, const Tensor3<T>& b)
{
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
            a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}

template <class T>
inline Tensor3<T> operator-(const Tensor3<T>& a, const Tensor3<T>& b)
{
    return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yx - b.yx, a.yy - b.yy,
            a.yz - b.yz, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}

template <class T>
inline Vector3<T> operator*(const Tensor3<T>& m, const Vector3<T>& a)
{
    return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.yx * a.x + m.yy * a.y + m.yz * a.z,
            m.zx * a.x + m.zy * a.y + m.zz * a.z};
}

template <class T>
inline Tensor3<T> operator*(const T& factor, const Tensor3<T>& m)
{
    return {factor * m.xx, factor * m.xy, factor * m.xz, factor * m.yx, factor * m.yy,
            factor * m.yz, factor * m.zx, factor * m.zy, factor * m.zz};
}

template <class T>
inline Tensor3<T> operator*(const Tensor3<T>& a, const Tensor3<T>& b)
{
    return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
            a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
            a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
            a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
            a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

/// Transpose of m times a.
template <class T>
inline Vector3<T> transposed_times(const Tensor3<T>& m, const Vector3<T>& a)
{
    return {m.xx * a.x + m.yx * a.y + m.zx * a.z, m.xy * a.x + m.yy * a.y + m.zy * a.z,
            m.xz * a.x + m.yz * a.y + m.zz * a.z};
}

template <class T>
inline T determinant(const Tensor3<T>& m)
{
    return m.xx * (m.yy * m.zz - m.yz * m.zy) + m.xy * (m.yz * m.zx - m.yx * m.zz) +
           m.xz * (m.yx * m.zy - m.yy * m.zx);
}

/// Symmetric part of m.
template <class T>
inline SymmetricTensor<T> symmetric_part(const Tensor3<T>& m)
{
    return {m.xx, m.yy, m.zz, 0.5 * (m.xy + m.yx), 0.5 * (m.yz + m.zy), 0.5 * (m.zx + m.xz)};
}

/// Vector w of the skew part of m: (m - m^T) / 2 applied to a is w x a.
template <class T>
inline Vector3<T> axial_vector(const Tensor3<T>& m)
{
    return {0.5 * (m.zy - m.yz), 0.5 * (m.xz - m.zx), 0.5 * (m.yx - m.xy)};
}

/// Rotation from the axial vector of the mid-step velocity gradient times half the step (Hughes & Winget
/// 1980): orthogonal for any step, and exact for a rigid rotation.
template <class T>
inline Tensor3<T> incremental_rotation(const Vector3<T>& half_turn)
{
    const T square = dot(half_turn, half_turn);
    const T s = 2.0 / (1.0 + square);
    const Vector3<T> h = s * half_turn;
    const T diagonal = 1.0 - s * square;
    const T xy = h.x * half_turn.y, yz = h.y * half_turn.z, zx = h.z * half_turn.x;
    return {diagonal + h.x * half_turn.x, xy - h.z, zx + h.y, xy + h.z,
            diagonal + h.y * half_turn.y, yz - h.x, zx - h.y, yz + h.x,
            diagonal + h.z * half_turn.z};
}

/// A strain increment of the middle of a step in the axes of its end, to second order in the turn: s + h x s
/// - s x h with half the turn h. Without it stress lags behind a spinning body by half a step, which feeds
/// its vibrations (Rubinstein & Atluri 1983, Comput. Methods Appl. Mech. Engng 36, 277-290, on objective
/// integration).
template <class T>
inline SymmetricTensor<T> turned_half(const SymmetricTensor<T>& s, const Vector3<T>& h)
{
    const T xy = h.x * s.zx - h.y * s.yz, yz = h.y * s.xy - h.z * s.zx, zx = h.z * s.yz - h.x * s.xy;
    return {s.xx + 2.0 * (h.y * s.zx - h.z * s.xy), s.yy + 2.0 * (h.z * s.xy - h.x * s.yz),
            s.zz + 2.0 * (h.x * s.yz - h.y * s.zx), s.xy + h.z * (s.xx - s.yy) - xy,
            s.yz + h.x * (s.yy - s.zz) - yz,        s.zx + h.y * (s.zz - s.xx) - zx};
}

/// r s r^T.
template <class T>
inline SymmetricTensor<T> rotated(const SymmetricTensor<T>& s, const Tensor3<T>& r)
{
    const Vector3<T> x = {r.xx * s.xx + r.xy * s.xy + r.xz * s.zx, r.xx * s.xy + r.xy * s.yy + r.xz * s.yz,
                          r.xx * s.zx + r.xy * s.yz + r.xz * s.zz};
    const Vector3<T> y = {r.yx * s.xx + r.yy * s.xy + r.yz * s.zx, r.yx * s.xy + r.yy * s.yy + r.yz * s.yz,
                          r.yx * s.zx + r.yy * s.yz + r.yz * s.zz};
    const Vector3<T> z = {r.zx * s.xx + r.zy * s.xy + r.zz * s.zx, r.zx * s.xy + r.zy * s.yy + r.zz * s.yz,
                          r.zx * s.zx + r.zy * s.yz + r.zz * s.zz};
    return {x.x * r.xx + x.y * r.xy + x.z * r.xz, y.x * r.yx + y.y * r.yy + y.z * r.yz,
            z.x * r.zx + z.y * r.zy + z.z * r.zz, x.x * r.yx + x.y * r.yy + x.z * r.yz,
            y.x * r.zx + y.y * r.zy + y.z * r.zz, z.x * r.xx + z.y * r.xy + z.z * r.xz};
}

} // namespace plash

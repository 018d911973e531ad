#pragma once

#include "math/lanes.h"
#include "math/symmetric_tensor.h"
#include "math/vector3.h"

#include <array>

namespace plash {

/// Eigenvalues of a symmetric tensor with unit eigenvectors; T is double or a lane type.
template <class T>
struct PrincipalAxes {
    std::array<T, 3> value;
    std::array<Vector3<T>, 3> axis;

    /// Sum of value times axis (x) axis.
    SymmetricTensor<T> tensor() const
    {
        SymmetricTensor<T> sum;
        for (int i = 0; i < 3; ++i) {
            const Vector3<T>& a = axis[i];
            sum = sum + value[i] * SymmetricTensor<T>{a.x * a.x, a.y * a.y, a.z * a.z,
                                                      a.x * a.y, a.y * a.z, a.z * a.x};
        }
        return sum;
    }
};

namespace principal_axes_detail {

/// The rotation in the plane of two axes p and q that clears their entry `pq`: Golub & Van Loan (1996),
/// algorithm 8.4.1, with cosine and sine from the sides of the triangle, so that only one quotient is left.
/// pr, qr  entries of the third axis r
template <class T>
inline void rotate(T& pp, T& qq, T& pq, T& pr, T& qr, Vector3<T>& p, Vector3<T>& q)
{
    const T zero{};
    const T difference = qq - pp, twice = 2.0 * pq;
    const T root = sqrt(difference * difference + twice * twice);
    const T side = abs(difference) + root;
    // Nothing to clear, or numbers whose squares are none any more.
    const MaskOf<T> clear = MaskOf<T>(twice == 0.0) | MaskOf<T>(root < 1e-150);
    const T inverse = 1.0 / sqrt(clear ? broadcast<T>(1) : side * side + twice * twice);
    const T c = clear ? broadcast<T>(1) : side * inverse;
    const T s = (difference < 0.0 ? -twice : twice) * (clear ? zero : inverse);
    const T mean = 0.5 * (pp + qq), half = 0.5 * (difference < 0.0 ? -root : root);
    pp = clear ? pp : mean - half;
    qq = clear ? qq : mean + half;
    pq = zero;
    const T old = pr;
    pr = c * old - s * qr;
    qr = s * old + c * qr;
    const Vector3<T> axis = p;
    p = c * axis - s * q;
    q = s * axis + c * q;
}

} // namespace principal_axes_detail

/// By cyclic Jacobi rotations, to round-off of the norm for any tensor.
template <class T>
inline PrincipalAxes<T> principal_axes(const SymmetricTensor<T>& t)
{
    using principal_axes_detail::rotate;
    constexpr int most_sweeps = 30;
    const T zero{}, one = broadcast<T>(1);
    SymmetricTensor<T> m = t;
    Vector3<T> x{one, zero, zero}, y{zero, one, zero}, z{zero, zero, one};
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        const T off = m.xy * m.xy + m.yz * m.yz + m.zx * m.zx;
        const T on = m.xx * m.xx + m.yy * m.yy + m.zz * m.zz;
        if (!any(off > 1e-32 * on)) break;
        rotate(m.xx, m.yy, m.xy, m.zx, m.yz, x, y);
        rotate(m.xx, m.zz, m.zx, m.xy, m.yz, x, z);
        rotate(m.yy, m.zz, m.yz, m.xy, m.zx, y, z);
    }
    return {{m.xx, m.yy, m.zz}, {x, y, z}};
}

} // namespace plash

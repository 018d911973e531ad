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

/// By cyclic Jacobi rotations, to round-off for any tensor.
template <class T>
inline PrincipalAxes<T> principal_axes(const SymmetricTensor<T>& t)
{
    const T zero{}, one = broadcast<T>(1);
    T m[3][3] = {{t.xx, t.xy, t.zx}, {t.xy, t.yy, t.yz}, {t.zx, t.yz, t.zz}};
    T v[3][3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    for (int sweep = 0; sweep < 30; ++sweep) {
        const T off = m[0][1] * m[0][1] + m[1][2] * m[1][2] + m[0][2] * m[0][2];
        const T on = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2];
        if (!any(off > 1e-32 * on)) break;
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                // Golub & Van Loan (1996), algorithm 8.4.1: the smaller rotation that clears the entry.
                const MaskOf<T> clear = m[p][q] == 0.0;
                const T theta = (m[q][q] - m[p][p]) / (2.0 * (clear ? one : m[p][q]));
                const T root = abs(theta) + sqrt(theta * theta + 1.0);
                const T tangent = clear ? zero : (theta < 0.0 ? -one : one) / root;
                const T c = 1.0 / sqrt(tangent * tangent + 1.0), s = tangent * c;
                for (int k = 0; k < 3; ++k) {
                    const T kp = m[k][p], kq = m[k][q];
                    m[k][p] = c * kp - s * kq;
                    m[k][q] = s * kp + c * kq;
                }
                for (int k = 0; k < 3; ++k) {
                    const T pk = m[p][k], qk = m[q][k];
                    m[p][k] = c * pk - s * qk;
                    m[q][k] = s * pk + c * qk;
                    const T vp = v[k][p], vq = v[k][q];
                    v[k][p] = c * vp - s * vq;
                    v[k][q] = s * vp + c * vq;
                }
            }
    }
    PrincipalAxes<T> result;
    for (int i = 0; i < 3; ++i) {
        result.value[i] = m[i][i];
        result.axis[i] = {v[0][i], v[1][i], v[2][i]};
    }
    return result;
}

} // namespace plash

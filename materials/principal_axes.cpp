#include "materials/principal_axes.h"

#include <cmath>

namespace plash {

SymmetricTensor<double> PrincipalAxes::tensor() const
{
    SymmetricTensor<double> sum;
    for (int i = 0; i < 3; ++i) {
        const Vec3& a = axis[i];
        sum = sum + value[i] * SymmetricTensor<double>{a.x * a.x, a.y * a.y, a.z * a.z,
                                                       a.x * a.y, a.y * a.z, a.z * a.x};
    }
    return sum;
}

PrincipalAxes principal_axes(const SymmetricTensor<double>& t)
{
    double m[3][3] = {{t.xx, t.xy, t.zx}, {t.xy, t.yy, t.yz}, {t.zx, t.yz, t.zz}};
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 30; ++sweep) {
        const double off = m[0][1] * m[0][1] + m[1][2] * m[1][2] + m[0][2] * m[0][2];
        const double on = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2];
        if (off <= 1e-32 * on) break;
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0) continue;
                // Golub & Van Loan (1996), algorithm 8.4.1: the smaller rotation that clears the entry.
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double tangent =
                    std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(tangent * tangent + 1), s = tangent * c;
                for (int k = 0; k < 3; ++k) {
                    const double kp = m[k][p], kq = m[k][q];
                    m[k][p] = c * kp - s * kq;
                    m[k][q] = s * kp + c * kq;
                }
                for (int k = 0; k < 3; ++k) {
                    const double pk = m[p][k], qk = m[q][k];
                    m[p][k] = c * pk - s * qk;
                    m[q][k] = s * pk + c * qk;
                    const double vp = v[k][p], vq = v[k][q];
                    v[k][p] = c * vp - s * vq;
                    v[k][q] = s * vp + c * vq;
                }
            }
    }
    PrincipalAxes result;
    for (int i = 0; i < 3; ++i) {
        result.value[i] = m[i][i];
        result.axis[i] = {v[0][i], v[1][i], v[2][i]};
    }
    return result;
}

} // namespace plash

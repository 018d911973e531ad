#pragma once

#include "math/vector3.h"

namespace plash {

/// 3 x 3 matrix by rows.
struct Matrix3 {
    Vec3 row[3]{};

    static Matrix3 identity() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
};

inline Vec3 operator*(const Matrix3& a, const Vec3& v)
{
    return {dot(a.row[0], v), dot(a.row[1], v), dot(a.row[2], v)};
}

inline Matrix3 transpose(const Matrix3& a)
{
    return {{{a.row[0].x, a.row[1].x, a.row[2].x},
             {a.row[0].y, a.row[1].y, a.row[2].y},
             {a.row[0].z, a.row[1].z, a.row[2].z}}};
}

inline Matrix3 operator*(const Matrix3& a, const Matrix3& b)
{
    const Matrix3 columns = transpose(b);
    Matrix3 product;
    for (int i = 0; i < 3; ++i) {
        product.row[i] = {dot(a.row[i], columns.row[0]), dot(a.row[i], columns.row[1]),
                          dot(a.row[i], columns.row[2])};
    }
    return product;
}

inline Matrix3 operator+(const Matrix3& a, const Matrix3& b)
{
    return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}};
}

/// v with v^T: the dyad a b^T.
inline Matrix3 dyad(const Vec3& a, const Vec3& b)
{
    return {{a.x * b, a.y * b, a.z * b}};
}

inline double determinant(const Matrix3& a)
{
    return dot(a.row[0], cross(a.row[1], a.row[2]));
}

/// Inverse of a regular matrix.
inline Matrix3 inverse(const Matrix3& a)
{
    const Vec3 c0 = cross(a.row[1], a.row[2]), c1 = cross(a.row[2], a.row[0]), c2 = cross(a.row[0], a.row[1]);
    const double scale = 1 / dot(a.row[0], c0);
    return transpose({{scale * c0, scale * c1, scale * c2}});
}

/// Rotation by the vector `turn` (axis times angle), Rodrigues' formula.
inline Matrix3 rotation(const Vec3& turn)
{
    const double angle = norm(turn);
    const double first = angle > 1e-4 ? std::sin(angle) / angle : 1 - angle * angle / 6;
    const double half = 0.5 * angle;
    const double ratio = half > 1e-4 ? std::sin(half) / half : 1 - half * half / 6;
    const double second = 0.5 * ratio * ratio;
    const Vec3 t = turn;
    const Matrix3 skew{{{0, -t.z, t.y}, {t.z, 0, -t.x}, {-t.y, t.x, 0}}};
    const Matrix3 square = skew * skew;
    Matrix3 result = Matrix3::identity();
    for (int i = 0; i < 3; ++i) result.row[i] += first * skew.row[i] + second * square.row[i];
    return result;
}

} // namespace plash

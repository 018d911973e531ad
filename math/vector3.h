#pragma once

#include <cmath>

namespace plash {

/// Three components of a vector; T is double for one point or a lane type for a batch of points.
template <class T>
struct Vector3 {
    T x{}, y{}, z{};

    Vector3& operator+=(const Vector3& other)
    {
        x += other.x;
        y += other.y;
        z += other.z;
        return *this;
    }
    Vector3& operator-=(const Vector3& other)
    {
        x -= other.x;
        y -= other.y;
        z -= other.z;
        return *this;
    }
    Vector3& operator*=(T factor)
    {
        x *= factor;
        y *= factor;
        z *= factor;
        return *this;
    }
};

using Vec3 = Vector3<double>;

/// The components of a vector by number.
inline constexpr double Vec3::*vector_component[3] = {&Vec3::x, &Vec3::y, &Vec3::z};

template <class T>
inline Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class T>
inline Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class T>
inline Vector3<T> operator-(const Vector3<T>& a)
{
    return {-a.x, -a.y, -a.z};
}

template <class T>
inline Vector3<T> operator*(const T& factor, const Vector3<T>& a)
{
    return {factor * a.x, factor * a.y, factor * a.z};
}

template <class T>
inline Vector3<T> operator*(const Vector3<T>& a, const T& factor)
{
    return factor * a;
}

template <class T>
inline T dot(const Vector3<T>& a, const Vector3<T>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
inline Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double norm(const Vec3& a)
{
    return std::sqrt(dot(a, a));
}

/// Unit vector along a; a zero vector stays zero.
inline Vec3 unit(const Vec3& a)
{
    const double length = norm(a);
    return length > 0 ? (1 / length) * a : a;
}

} // namespace plash

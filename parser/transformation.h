#pragma once

#include "math/vector3.h"
#include "parser/report.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace plash {

/// A linear map with a shift: what *DEFINE_TRANSFORMATION does to the points of an include.
struct Affine {
    std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}; ///< images of the unit vectors
    Vec3 shift{};

    Vec3 direction(const Vec3& v) const { return v.x * columns[0] + v.y * columns[1] + v.z * columns[2]; }
    Vec3 point(const Vec3& p) const { return direction(p) + shift; }
    bool is_identity() const;
};

/// First `first`, then `second`.
Affine then(const Affine& first, const Affine& second);

Affine scaling(const Vec3& factors);
Affine translation(const Vec3& by);
/// By an angle [radian] about the axis through a point (Rodrigues).
Affine rotation(const Vec3& axis, const Vec3& through, double angle);
/// At the plane through a point with a normal.
Affine mirror(const Vec3& through, const Vec3& normal);
/// The rigid motion that takes three points to three others: the first onto the first, the line 1-2 onto the
/// line, the plane onto the plane. Nothing when either three lie on one line.
std::optional<Affine> positioning(const std::array<Vec3, 3>& from, const std::array<Vec3, 3>& to);

/// Reads the lines of a *DEFINE_TRANSFORMATION, applied in their order. `node` looks up a node's position.
Affine transformation_of(const Record& record, const std::function<std::optional<Vec3>(Id)>& node,
                         Report& report);

} // namespace plash

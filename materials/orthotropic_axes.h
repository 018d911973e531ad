#pragma once

#include "materials/history.h"
#include "materials/parameters.h"
#include "math/tensor3.h"

namespace plash {

/// How the axes a, b, c of an orthotropic solid stand at the start (AOPT).
struct OrthotropicAxes {
    enum class Choice {
        nodes,  ///< AOPT 0: a from node 1 to 2, b in the plane of nodes 1, 2 and 4
        vectors ///< AOPT 2 and coordinate systems (AOPT < 0): the same for all elements
    };
    Choice choice = Choice::nodes;
    Vec3 a{1, 0, 0}, b{0, 1, 0}; ///< unit vectors, for `vectors`

    /// DeckError for the other values of AOPT and for vectors that span no plane.
    static OrthotropicAxes from_record(const Record& record, const Model& model);

    /// Variables of a point that keep its axes a and b; they turn with the material.
    static constexpr int history_size = 6;
};

/// a along `first`, b in the plane of `first` and `second`.
OrthotropicAxes axes_of(const Vec3& first, const Vec3& second);

/// Rows a, b, c of the axes of a batch.
template <class Lane>
inline Tensor3<Lane> stored_axes(const Lane* h)
{
    const Vector3<Lane> a{h[0], h[1], h[2]}, b{h[3], h[4], h[5]}, c = cross(a, b);
    return {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
}

template <class Lane>
inline Tensor3<Lane> transposed(const Tensor3<Lane>& m)
{
    return {m.xx, m.yx, m.zx, m.xy, m.yy, m.zy, m.xz, m.yz, m.zz};
}

template <class Lane>
inline void turn_axes(Lane* h, const Tensor3<Lane>& rotation)
{
    const Vector3<Lane> a = rotation * Vector3<Lane>{h[0], h[1], h[2]};
    const Vector3<Lane> b = rotation * Vector3<Lane>{h[3], h[4], h[5]};
    h[0] = a.x;
    h[1] = a.y;
    h[2] = a.z;
    h[3] = b.x;
    h[4] = b.y;
    h[5] = b.z;
}

} // namespace plash

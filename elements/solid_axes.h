#pragma once

#include "elements/solid_modes.h"
#include "materials/orthotropic_axes.h"

namespace plash {

/// Puts the axes of a batch of orthotropic solids into the first variables of their history.
template <class Lane>
inline void start_solid_axes(const OrthotropicAxes& axes, const SolidModes<Lane>& position, Lane* history)
{
    const auto put = [&](const Vector3<Lane>& a, const Vector3<Lane>& b) {
        const Lane values[OrthotropicAxes::history_size] = {a.x, a.y, a.z, b.x, b.y, b.z};
        for (int i = 0; i < OrthotropicAxes::history_size; ++i) history[i] = values[i];
    };
    if (axes.choice == OrthotropicAxes::Choice::vectors) {
        const auto all = [](double value) { return broadcast<Lane>(value); };
        return put({all(axes.a.x), all(axes.a.y), all(axes.a.z)},
                   {all(axes.b.x), all(axes.b.y), all(axes.b.z)});
    }
    // Eight times the corners' places from their mean: the patterns of the modes are orthogonal.
    Vector3<Lane> corner[8];
    for_corners(position, [&](int i, const Vector3<Lane>& place) { corner[i] = place; });
    const auto scaled = [](const Vector3<Lane>& v) { return (1.0 / sqrt(Lane{dot(v, v)})) * v; };
    const Vector3<Lane> a = scaled(corner[1] - corner[0]), edge = corner[3] - corner[0];
    put(a, scaled(cross(cross(a, edge), a)));
}

} // namespace plash

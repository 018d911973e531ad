#include "contact/touch_table.h"

#include "contact/closest_point.h"

namespace plash {

namespace {

SegmentCorners<double> corners_of(const ContactMesh::Facet& facet, const ContactMotion& motion)
{
    const auto& p = motion.position;
    return {p[facet.corner[0]], p[facet.corner[1]], p[facet.corner[2]], p[facet.corner[3]]};
}

} // namespace

void TouchTable::clear()
{
    *this = TouchTable(with_friction());
}

void TouchTable::copy(const TouchTable& from, std::size_t source, int source_layer, std::size_t to, int layer)
{
    facet_[layer * stride_ + to] = from.facet_[source_layer * from.stride_ + source];
    for (std::size_t field = 0; field < fields_; ++field)
        values_[place(field, layer, to)] = from.values_[from.place(field, source_layer, source)];
}

void TouchTable::set_owners(std::span<const Index> owner)
{
    TouchTable next(with_friction());
    next.stride_ = (owner.size() + lane_count - 1) / lane_count * lane_count;
    next.owner_.assign(owner.begin(), owner.end());
    next.count_.resize(next.stride_);
    next.followed_.resize(next.stride_);
    next.facet_.resize(layers * next.stride_);
    next.values_.resize(layers * fields_ * next.stride_);
    std::size_t old = 0;
    for (std::size_t i = 0; i < owner.size(); ++i) {
        while (old < owner_.size() && owner_[old] < owner[i]) ++old;
        if (old == owner_.size()) break;
        if (owner_[old] != owner[i]) continue;
        next.count_[i] = count_[old];
        next.followed_[i] = followed_[old];
        for (int layer = 0; layer < count_[old]; ++layer) next.copy(*this, old, layer, i, layer);
    }
    *this = std::move(next);
}

Touch TouchTable::touch(const ContactMesh& mesh, const ContactMotion& motion, std::size_t owner,
                        int layer) const
{
    const auto value = [&](Field field) { return values_[place(field, layer, owner)]; };
    Touch touch;
    touch.node = owner_[owner];
    touch.facet = facets(layer)[owner];
    touch.s = value(at_s);
    touch.t = value(at_t);
    touch.baseline = value(baseline);
    touch.rounding = value(rounding);
    touch.stiffness = value(stiffness);
    touch.weight = value(weight);
    if (followed_[owner]) {
        const auto& facet = mesh.facets[touch.facet];
        const auto corners = corners_of(facet, motion);
        const auto share = corner_shares(touch.s, touch.t, facet.triangle());
        touch.normal = value(side) * segment_normal(corners, touch.s, touch.t);
        const Vec3 foot =
            share[0] * corners.a + share[1] * corners.b + share[2] * corners.c + share[3] * corners.d;
        touch.penetration = mesh.nodes[touch.node].half_thickness + facet.half_thickness -
                            dot(motion.position[touch.node] - foot, touch.normal);
    } else {
        touch.normal = {value(normal_x), value(normal_y), value(normal_z)};
        touch.penetration = value(penetration);
    }
    if (with_friction()) touch.friction = {value(friction_x), value(friction_y), value(friction_z)};
    touch.force = value(pressing) * touch.normal + touch.friction;
    return touch;
}

void TouchTable::put(std::size_t owner, std::span<const Touch> touches)
{
    count_[owner] = static_cast<std::uint8_t>(touches.size());
    for (std::size_t number = 0; number < touches.size(); ++number) {
        const Touch& touch = touches[number];
        const int layer = static_cast<int>(number);
        const auto set = [&](Field field, double number) { value(field, layer, owner) = number; };
        facet_[layer * stride_ + owner] = touch.facet;
        set(at_s, touch.s);
        set(at_t, touch.t);
        set(normal_x, touch.normal.x);
        set(normal_y, touch.normal.y);
        set(normal_z, touch.normal.z);
        set(penetration, touch.penetration);
        set(baseline, touch.baseline);
        set(rounding, touch.rounding);
        set(stiffness, touch.stiffness);
        set(weight, touch.weight);
        if (!with_friction()) continue;
        set(friction_x, touch.friction.x);
        set(friction_y, touch.friction.y);
        set(friction_z, touch.friction.z);
    }
}

TouchList TouchTable::list(const ContactMesh& mesh, const ContactMotion& motion) const
{
    TouchList list;
    for (std::size_t owner = 0; owner < owner_.size(); ++owner)
        for (int layer = 0; layer < count_[owner]; ++layer)
            list.all.push_back(touch(mesh, motion, owner, layer));
    return list;
}

} // namespace plash

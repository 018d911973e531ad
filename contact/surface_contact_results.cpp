#include "contact/closest_point.h"
#include "contact/surface_contact.h"

#include <algorithm>

namespace plash {

bool SurfaceContact::presses() const
{
    return summed_ && std::any_of(sum_.begin(), sum_.end(),
                                  [](const NodeSum& sum) { return dot(sum.force, sum.force) > 0; });
}

/// Shares of a touch's facet corners in its contact point.
std::array<double, 4> SurfaceContact::shares(const Touch& touch) const
{
    return corner_shares(touch.s, touch.t, mesh_.facets[touch.facet].triangle());
}

/// Resultants of both sides.
void SurfaceContact::collect(const State& state, ElementResults& results) const
{
    ElementResults::ContactForce sum;
    sum.contact = contact_.id;
    sum.two_sides = contact_.master.kind != ContactSide::Kind::none;
    sum.slave_energy = energy_.slave;
    sum.master_energy = energy_.master;
    sum.friction_energy = energy_.friction;
    for (std::size_t i = 0; i < mass_.size(); ++i) {
        if (mesh_.nodes[i].sides & slave_bit) sum.slave_mass += mass_[i];
        if (mesh_.nodes[i].sides & master_bit) sum.master_mass += mass_[i];
    }
    touches().for_each([&](const Touch& touch) {
        const ContactMesh::Facet& facet = mesh_.facets[touch.facet];
        const auto share = shares(touch);
        Vec3 facet_moment{};
        for (int c = 0; c < 4; ++c) {
            facet_moment -= share[c] * cross(motion_.position[facet.corner[c]], touch.force);
        }
        const Vec3 node_moment = cross(motion_.position[touch.node], touch.force);
        const bool node_is_slave = (facet.belongs & master_bit) != 0;
        sum.slave_force += node_is_slave ? touch.force : -touch.force;
        sum.master_force += node_is_slave ? -touch.force : touch.force;
        sum.slave_moment += node_is_slave ? node_moment : facet_moment;
        sum.master_moment += node_is_slave ? facet_moment : node_moment;
    });
    if (facing_) add_facing(sum);
    if (ties_) {
        ties_->collect(state, sum);
        if (!results.contact_force.empty()) ties_->collect_nodes(results.contact_force);
    }
    if (!results.contact_force.empty() && !nothing_touches()) {
        for (std::size_t i = 0; i < sum_.size(); ++i) {
            results.contact_force[mesh_.nodes[i].node] += sum_[i].force;
        }
    }
    if (!results.contact_pressure.empty() && !nothing_touches()) add_pressures(results.contact_pressure);
    if (results.contact_faces_wanted) add_faces(results.contact_faces);
    results.contacts.push_back(sum);
}

/// Resultants of segments on segments: the first surface receives what its segments do; within one surface
/// the sums are those of each pair's first.
void SurfaceContact::add_facing(ElementResults::ContactForce& sum) const
{
    for (const FacingTouch& touch : facing_->touches()) {
        const bool first_is_slave = (mesh_.facets[touch.first].belongs & slave_bit) != 0;
        const double sign = first_is_slave ? 1 : -1;
        const auto moment = [&](Index facet, const std::array<Vec3, 4>& force) {
            Vec3 whole{};
            for (int c = 0; c < 4; ++c)
                whole += cross(motion_.position[mesh_.facets[facet].corner[c]], force[c]);
            return whole;
        };
        const Vec3 on_first = moment(touch.first, touch.on_first);
        const Vec3 on_second = moment(touch.second, touch.on_second);
        sum.slave_force += sign * touch.force;
        sum.master_force -= sign * touch.force;
        sum.slave_moment += first_is_slave ? on_first : on_second;
        sum.master_moment += first_is_slave ? on_second : on_first;
    }
}

/// Forces of each node, as the one that touches and as a corner, and a quarter (third) of the area of its
/// exposed facets.
SurfaceContact::NodeLoads SurfaceContact::node_loads() const
{
    const std::size_t count = mesh_.nodes.size();
    NodeLoads loads{std::vector<double>(count), std::vector<double>(count), std::vector<Vec3>(count)};
    const auto put = [&](Index node, double share, double force, const Vec3& friction) {
        loads.normal[node] += share * force;
        loads.friction[node] += share * friction;
    };
    touches().for_each([&](const Touch& touch) {
        const double force = dot(touch.force, touch.normal);
        const auto share = shares(touch);
        put(touch.node, 1, force, touch.friction);
        for (int i = 0; i < 4; ++i)
            put(mesh_.facets[touch.facet].corner[i], share[i], force, -touch.friction);
    });
    for (std::size_t number = 0; facing_ && number < facing_->touches().size(); ++number) {
        const FacingTouch& touch = facing_->touches()[number];
        for (int i = 0; i < 4; ++i) {
            put(mesh_.facets[touch.first].corner[i], touch.first_share[i], touch.pressing, touch.friction);
            put(mesh_.facets[touch.second].corner[i], touch.second_share[i], touch.pressing, -touch.friction);
        }
    }
    const std::vector<Vec3> position(motion_.position.begin(), motion_.position.end());
    for (const ContactMesh::Facet& facet : mesh_.facets) {
        if (!facet.exposed) continue;
        const int corners = facet.triangle() ? 3 : 4;
        const double share = segment_area(facet.corner, position) / corners;
        for (int i = 0; i < corners; ++i) loads.area[facet.corner[i]] += share;
    }
    return loads;
}

void SurfaceContact::add_pressures(std::vector<double>& pressure) const
{
    const NodeLoads loads = node_loads();
    for (std::size_t i = 0; i < loads.normal.size(); ++i) {
        if (loads.normal[i] > 0 && loads.area[i] > 0)
            pressure[mesh_.nodes[i].node] += loads.normal[i] / loads.area[i];
    }
}

/// Each exposed facet with the mean of what acts at its corners.
void SurfaceContact::add_faces(std::vector<ElementResults::ContactFace>& faces) const
{
    std::vector<double> deepest(mesh_.facets.size());
    const auto mark = [&](Index facet, double penetration) {
        deepest[facet] = std::max(deepest[facet], penetration);
    };
    touches().for_each([&](const Touch& touch) { mark(touch.facet, touch.penetration); });
    for (std::size_t number = 0; facing_ && number < facing_->touches().size(); ++number) {
        mark(facing_->touches()[number].first, facing_->touches()[number].penetration);
        mark(facing_->touches()[number].second, facing_->touches()[number].penetration);
    }
    NodeLoads loads{std::vector<double>(mesh_.nodes.size()), {}, std::vector<Vec3>(mesh_.nodes.size())};
    if (!motion_.position.empty()) loads = node_loads();
    for (std::size_t number = 0; number < mesh_.facets.size(); ++number) {
        const ContactMesh::Facet& facet = mesh_.facets[number];
        if (!facet.exposed) continue;
        ElementResults::ContactFace face;
        face.contact = contact_.id;
        face.part = facet.part;
        face.sides = facet.belongs;
        face.nodes = mesh_.segments[number].nodes;
        face.penetration = deepest[number];
        const int corners = facet.triangle() ? 3 : 4;
        for (int i = 0; i < corners; ++i) {
            const Index corner = facet.corner[i];
            if (loads.area.empty() || !(loads.area[corner] > 0)) continue;
            face.pressure += loads.normal[corner] / loads.area[corner] / corners;
            face.shear += (1 / loads.area[corner] / corners) * loads.friction[corner];
            if (!rubbed_off_.empty())
                face.friction_energy += rubbed_off_[corner] / loads.area[corner] / corners;
        }
        faces.push_back(face);
    }
}

} // namespace plash

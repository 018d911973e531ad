#include "contact/force_transducer.h"

#include "contact/closest_point.h"

#include <algorithm>

namespace plash {

ForceTransducer::ForceTransducer(const Contact& contact, const Model& model,
                                 const std::vector<PartData>& parts,
                                 std::vector<const SurfaceContact*> contacts)
    : contact_(contact),
      contacts_(std::move(contacts)),
      slave_(make_side(contact.slave, contact, model, parts)),
      master_(make_side(contact.master, contact, model, parts)),
      between_(contact.master.kind != ContactSide::Kind::none)
{}

ForceTransducer::Side ForceTransducer::make_side(const ContactSide& side, const Contact& contact,
                                                 const Model& model, const std::vector<PartData>& parts)
{
    Side result;
    result.node.resize(model.nodes.size());
    result.part.resize(model.parts.size(), side.kind == ContactSide::Kind::all);
    result.by_part = side.kind == ContactSide::Kind::all || side.kind == ContactSide::Kind::parts;
    if (side.kind == ContactSide::Kind::none) return result;
    for (Index part : side.parts) result.part[part] = true;
    SurfaceOptions options = surface_options(contact);
    options.with_beams = true;
    const std::vector<double> mass = lumped_masses(model, parts);
    for (const ContactNode& node : make_surface(model, parts, side, options).nodes) {
        result.node[node.node] = true;
        result.mass += mass[node.node];
    }
    return result;
}

bool ForceTransducer::Side::holds(const ContactMesh& mesh, Index facet) const
{
    const Segment& segment = mesh.segments[facet];
    if (by_part && segment.part != none) return part[segment.part];
    return std::all_of(segment.nodes.begin(), segment.nodes.end(), [&](Index n) { return node[n]; });
}

void ForceTransducer::add(const SurfaceContact& source, const State& state,
                          ElementResults::ContactForce& sum) const
{
    const ContactMesh& mesh = source.mesh();
    source.touches().for_each([&](const Touch& touch) {
        const Index node = mesh.nodes[touch.node].node;
        const auto& corners = mesh.segments[touch.facet].nodes;
        const auto share = corner_shares(touch.s, touch.t, mesh.facets[touch.facet].triangle());
        const Vec3 node_moment = cross(state.position[node], touch.force);
        const auto take = [&](Vec3& force, Vec3& moment, double sign) {
            force += sign * touch.force;
            moment += sign * node_moment;
        };
        if (!between_) {
            if (slave_.node[node]) take(sum.slave_force, sum.slave_moment, 1);
            for (int i = 0; i < 4; ++i) {
                if (!slave_.node[corners[i]]) continue;
                sum.slave_force -= share[i] * touch.force;
                sum.slave_moment -= share[i] * cross(state.position[corners[i]], touch.force);
            }
            return;
        }
        const bool slave_on_master = slave_.node[node] && master_.holds(mesh, touch.facet);
        const bool master_on_slave = master_.node[node] && slave_.holds(mesh, touch.facet);
        if (slave_on_master) take(sum.slave_force, sum.slave_moment, 1);
        if (master_on_slave && !slave_on_master) take(sum.slave_force, sum.slave_moment, -1);
    });
    if (source.facing()) add_facing(mesh, *source.facing(), state, sum);
}

void ForceTransducer::add_facing(const ContactMesh& mesh, const FacingSegments& facing, const State& state,
                                 ElementResults::ContactForce& sum) const
{
    for (const FacingTouch& touch : facing.touches()) {
        const auto take = [&](Index facet, const std::array<Vec3, 4>& on_corner, bool whole) {
            for (int i = 0; i < 4; ++i) {
                const Index corner = mesh.segments[facet].nodes[i];
                if (!whole && !slave_.node[corner]) continue;
                sum.slave_force += on_corner[i];
                sum.slave_moment += cross(state.position[corner], on_corner[i]);
            }
        };
        if (!between_) {
            take(touch.first, touch.on_first, false);
            take(touch.second, touch.on_second, false);
        } else if (slave_.holds(mesh, touch.first) && master_.holds(mesh, touch.second)) {
            take(touch.first, touch.on_first, true);
        } else if (slave_.holds(mesh, touch.second) && master_.holds(mesh, touch.first)) {
            take(touch.second, touch.on_second, true);
        }
    }
}

void ForceTransducer::collect(const State& state, ElementResults& results) const
{
    ElementResults::ContactForce sum;
    sum.contact = contact_.id;
    sum.slave_mass = slave_.mass;
    sum.master_mass = master_.mass;
    for (const SurfaceContact* contact : contacts_) add(*contact, state, sum);
    if (between_) {
        sum.master_force = -sum.slave_force;
        sum.master_moment = -sum.slave_moment;
    }
    results.contacts.push_back(sum);
}

} // namespace plash

#include "contact/closest_point.h"
#include "contact/lane_points.h"
#include "contact/surface_contact.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace plash {

namespace {

using Face = ContactMesh::Face;

/// One value for each of eight touches, filled one by one and then taken as lanes.
struct alignas(sizeof(Lanes)) LaneValues {
    double value[lane_count];

    Lanes lanes() const
    {
        Lanes lanes;
        std::memcpy(&lanes, value, sizeof lanes);
        return lanes;
    }
};

/// All bits of a lane where the bit of its number is set.
LaneMask mask_of(unsigned bits)
{
    const LaneMask bit = {1, 2, 4, 8, 16, 32, 64, 128};
    return (bit & static_cast<std::int64_t>(bits)) != 0;
}

Vector3<Lanes> choose(LaneMask mask, const Vector3<Lanes>& a, const Vector3<Lanes>& b)
{
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

std::array<Lanes, 4> shares_in_lanes(const Lanes& s, const Lanes& t, LaneMask triangle)
{
    const Lanes one = broadcast<Lanes>(1), zero{};
    const Lanes u = one - s, v = one - t;
    return {triangle ? u - t : u * v, triangle ? s : s * v, triangle ? t : s * t, triangle ? zero : u * t};
}

} // namespace

/// The facets of eight touches: corner [i][lane] of the mesh, what the law needs of each, and which are
/// triangles. Lanes without a touch repeat one that has.
struct SurfaceContact::FacetLanes {
    Index facet[lane_count];
    Index corner[4][lane_count];
    Lanes half_thickness, depth;
    LaneMask triangle;

    FacetLanes(const ContactMesh& mesh, const Index* number, unsigned active)
    {
        LaneValues thickness, reach;
        unsigned triangles = 0;
        const int spare = std::countr_zero(active);
        for (int lane = 0; lane < lane_count; ++lane) {
            facet[lane] = number[active >> lane & 1 ? lane : spare];
            const Face& one = mesh.faces[facet[lane]];
            for (int i = 0; i < 4; ++i) corner[i][lane] = one.corner[i];
            thickness.value[lane] = one.half_thickness;
            reach.value[lane] = one.depth;
            triangles |= static_cast<unsigned>(one.triangle()) << lane;
        }
        half_thickness = thickness.lanes();
        depth = reach.lanes();
        triangle = mask_of(triangles);
    }
};

/// Eight owners.
struct SurfaceContact::NodeBatch {
    std::size_t owner; ///< the first
    Index node[lane_count];
    Lanes half_thickness;
    Vector3<Lanes> place, velocity;
    LaneMask following; ///< owners whose touches are followed
};

/// One layer of the touches of eight owners.
struct SurfaceContact::TouchBatch {
    int layer;
    unsigned lanes;       ///< owners that have such a touch, a bit each
    unsigned followed;    ///< those of them that are followed
    LaneMask over;        ///< owners with a touch that has not ended
    Lanes s, t, active{}; ///< active: penetration that presses [length]
    Vector3<Lanes> normal{};
};

/// Coefficients of friction of a batch; without any, friction is left out.
struct SurfaceContact::FrictionLanes {
    Lanes at_rest{}, moving{}, decay{}, cap{};
    bool decays = false, capped = false;
};

SurfaceContact::FrictionLanes SurfaceContact::friction_lanes(const Index* node, const Index* facet) const
{
    LaneValues at_rest, moving, decay, stress;
    FrictionLanes lanes;
    const bool common = contact_.static_friction != -1;
    for (int lane = 0; lane < (common ? 1 : lane_count); ++lane) {
        Friction mixed;
        const Friction& one = friction_of(node[lane], facet[lane], mixed);
        at_rest.value[lane] = one.at_rest;
        moving.value[lane] = one.moving;
        decay.value[lane] = one.any() ? one.decay : 0;
        stress.value[lane] = one.shear_cap;
        lanes.decays = lanes.decays || decay.value[lane] != 0;
        lanes.capped = lanes.capped || one.shear_cap > 0;
    }
    if (common) {
        lanes.at_rest = broadcast<Lanes>(at_rest.value[0]);
        lanes.moving = broadcast<Lanes>(moving.value[0]);
        lanes.decay = broadcast<Lanes>(decay.value[0]);
        std::fill_n(stress.value, lane_count, stress.value[0]);
    } else {
        lanes.at_rest = at_rest.lanes();
        lanes.moving = moving.lanes();
        lanes.decay = decay.lanes();
    }
    if (!lanes.capped) return lanes;
    // The record of the facet is read only here: nothing else of the law needs it.
    LaneValues cap;
    for (int lane = 0; lane < lane_count; ++lane) {
        const double size = mesh_.facets[facet[lane]].size;
        cap.value[lane] = stress.value[lane] > 0 ? stress.value[lane] * size * size : 1e300;
    }
    lanes.cap = cap.lanes();
    return lanes;
}

/// Stiffness of the touches that are new on their facets, or of all when the step has become longer, and the
/// share that segments on segments leave to new touches.
void SurfaceContact::set_stiffness(int layer, std::size_t owner, unsigned active, const Index* facet,
                                   const Vector3<Lanes>& normal)
{
    double* stiffness = table_.line(TouchTable::stiffness, layer, owner);
    double* weight = table_.line(TouchTable::weight, layer, owner);
    for (; active != 0; active &= active - 1) {
        const int lane = std::countr_zero(active);
        const Index node = table_.node(owner + lane);
        if (stiffness[lane] == 0 || soft_changed_) stiffness[lane] = stiffness_of(node, facet[lane]);
        if (weight[lane] >= 0) continue;
        const Vec3 direction{normal.x[lane], normal.y[lane], normal.z[lane]};
        weight[lane] = facing_ ? facing_->node_weight(motion_, node, direction) : 1;
    }
}

/// Brings followed touches of the owners begin to end to where their nodes are and finds the forces of all.
/// Nodes whose touches have ended are looked up anew. What there is to sum up is left in the room.
void SurfaceContact::press(std::size_t begin, std::size_t end, const TouchFinder& finder, Room& room)
{
    room.pressed.clear();
    constexpr std::size_t faces_ahead = 6 * lane_count, corners_ahead = 3 * lane_count;
    const Vec3* place = motion_.position.data();
    const Vec3* velocity = motion_.velocity.data();
    for (std::size_t owner = begin; owner < end; owner += lane_count) {
        if (owner + faces_ahead < end)
            for (std::size_t i = owner + faces_ahead; i < owner + faces_ahead + lane_count; ++i)
                __builtin_prefetch(&mesh_.faces[table_.facets(0)[i]]);
        if (owner + corners_ahead < end) {
            table_.prefetch(0, owner + corners_ahead);
            // Those of the facet beside it lie in the same lines more often than not.
            for (std::size_t i = owner + corners_ahead; i < owner + corners_ahead + lane_count; i += 2) {
                const auto& corner = mesh_.faces[table_.facets(0)[i]].corner;
                __builtin_prefetch(&place[corner[0]]);
                __builtin_prefetch(&velocity[corner[0]]);
                __builtin_prefetch(&place[corner[2]]);
                __builtin_prefetch(&velocity[corner[2]]);
            }
        }
        std::uint64_t any = 0;
        std::memcpy(&any, table_.counts(owner), sizeof any);
        if (any != 0) press_batch(owner, std::min<std::size_t>(lane_count, end - owner), finder, room);
    }
}

void SurfaceContact::press_batch(std::size_t owner, std::size_t lanes, const TouchFinder& finder, Room& room)
{
    NodeBatch nodes;
    LaneValues thickness;
    unsigned followed = 0, in_layer[TouchTable::layers] = {}, ended = 0;
    std::size_t count = 0;
    nodes.owner = owner;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const std::size_t one = owner + std::min(lane, lanes - 1);
        nodes.node[lane] = table_.node(one);
        thickness.value[lane] = mesh_.half_thickness[nodes.node[lane]];
        if (lane >= lanes) continue;
        followed |= static_cast<unsigned>(table_.followed(one)) << lane;
        for (int layer = 0; layer < table_.count(one); ++layer) in_layer[layer] |= 1u << lane;
        count += table_.count(one);
    }
    nodes.half_thickness = thickness.lanes();
    nodes.place = points_in_lanes(motion_.position.data(), nodes.node);
    nodes.velocity = points_in_lanes(motion_.velocity.data(), nodes.node);
    nodes.following = mask_of(followed);
    std::optional<FacetLanes> facets[TouchTable::layers];
    TouchBatch touches[TouchTable::layers];
    for (int layer = 0; layer < TouchTable::layers && in_layer[layer] != 0; ++layer) {
        touches[layer].layer = layer;
        touches[layer].lanes = in_layer[layer];
        touches[layer].followed = followed & in_layer[layer];
        facets[layer].emplace(mesh_, table_.facets(layer) + owner, in_layer[layer]);
        ended |= place_touches(nodes, *facets[layer], touches[layer]);
    }
    if (ended != 0) {
        // Another facet, which the touch has held off so far, may go on with it in this very cycle.
        for (; ended != 0; ended &= ended - 1) {
            const std::size_t one = owner + std::countr_zero(ended);
            search_.pairs().quiet[one] = 0;
            finder.find(search_.pairs(), one, one + 1, table_, room.finder);
        }
        return press_batch(owner, lanes, finder, room); // none of these is followed any more
    }
    room.pressed.touches += count;
    if (contact_.constraint) return; // constrain() does
    for (int layer = 0; layer < TouchTable::layers && in_layer[layer] != 0; ++layer)
        press_touches(nodes, *facets[layer], touches[layer], room.pressed);
}

/// Takes touches that have just been found as they are and brings followed ones to where their nodes are now.
/// Returns which of these have ended.
unsigned SurfaceContact::place_touches(const NodeBatch& nodes, const FacetLanes& facets, TouchBatch& touches)
{
    const auto line = [&](TouchTable::Field field) { return table_.line(field, touches.layer, nodes.owner); };
    const auto get = [&](TouchTable::Field field) { return load<Lanes>(line(field)); };
    const LaneMask following = nodes.following;
    Lanes baseline = get(TouchTable::baseline);
    touches.s = get(TouchTable::at_s);
    touches.t = get(TouchTable::at_t);
    touches.over = mask_of(touches.lanes);
    unsigned ended = 0;
    if (touches.followed != 0) {
        const auto corner = [&](int i) { return points_in_lanes(motion_.position.data(), facets.corner[i]); };
        const SegmentCorners<Lanes> corners{corner(0), corner(1), corner(2), corner(3)};
        const auto foot = foot_near(nodes.place, corners, touches.s, touches.t);
        touches.normal = get(TouchTable::side) * segment_normal(corners, foot.s, foot.t);
        const Lanes distance = dot(foot.offset, touches.normal);
        const Lanes depth = nodes.half_thickness + facets.half_thickness - distance;
        const LaneMask lost = following & ((distance < -facets.depth) | (depth <= Lanes{}));
        ended = bits_of(lost) & touches.followed;
        touches.over &= ~lost;
        touches.s = following ? foot.s : touches.s;
        touches.t = following ? foot.t : touches.t;
        const LaneMask shallower = following & ~lost & (depth < baseline);
        baseline = shallower ? depth : baseline;
        touches.active = depth - baseline;
        store(line(TouchTable::at_s), touches.s);
        store(line(TouchTable::at_t), touches.t);
        if (bits_of(shallower) != 0) store(line(TouchTable::baseline), baseline);
    }
    if (touches.followed != touches.lanes) {
        const Vector3<Lanes> given{get(TouchTable::normal_x), get(TouchTable::normal_y),
                                   get(TouchTable::normal_z)};
        touches.normal = choose(following, touches.normal, given);
        touches.active = following ? touches.active : get(TouchTable::penetration) - baseline;
    }
    return ended;
}

/// Forces of the touches of one layer.
void SurfaceContact::press_touches(const NodeBatch& nodes, const FacetLanes& facets,
                                   const TouchBatch& touches, Pressed& pressed)
{
    const auto line = [&](TouchTable::Field field) { return table_.line(field, touches.layer, nodes.owner); };
    const auto get = [&](TouchTable::Field field) { return load<Lanes>(line(field)); };
    const Lanes zero{};
    const Vector3<Lanes>& normal = touches.normal;
    const auto share = shares_in_lanes(touches.s, touches.t, facets.triangle);
    Vector3<Lanes> velocity = nodes.velocity;
    for (int i = 0; i < 4; ++i)
        velocity -= share[i] * points_in_lanes(motion_.velocity.data(), facets.corner[i]);
    const Lanes closing = -dot(velocity, normal);
    unsigned unknown = soft_changed_ ? touches.lanes : bits_of(get(TouchTable::stiffness) == zero);
    unknown = (unknown | bits_of(get(TouchTable::weight) < zero)) & touches.lanes;
    if (unknown != 0) set_stiffness(touches.layer, nodes.owner, unknown, facets.facet, normal);
    Lanes stiffness = get(TouchTable::weight) * get(TouchTable::stiffness);
    Lanes force = rounded_force(stiffness, touches.active, get(TouchTable::rounding));
    if (contact_.damping > 0) force = damped(nodes, facets, share, stiffness, closing, force);
    force = touches.over ? force : zero;
    stiffness = touches.over ? stiffness : zero;
    Vector3<Lanes> whole = force * normal;
    if (table_.with_friction()) {
        const auto slip = broadcast<Lanes>(motion_.last_step) * (velocity + closing * normal);
        Lanes lost;
        whole += rubbed(nodes, facets, touches, slip, stiffness, force, lost);
        for (int lane = 0; lane < lane_count; ++lane) pressed.friction += lost[lane];
        if (!rubbed_off_.empty()) {
            Pressed::Rubbed& taken = pressed.rubbed.emplace_back();
            taken.loss = lost;
            std::copy_n(nodes.node, lane_count, taken.node);
            taken.facets = pressed.on_facets.size();
        }
    }
    store(line(TouchTable::pressing), force);
    // Every node is on the list once; the forces of its second and third touch are added to it there.
    if (touches.layer == 0) {
        Pressed::OnNodes& on_nodes = pressed.on_nodes.emplace_back();
        lanes_to_fours(whole, stiffness, on_nodes.force);
        std::copy_n(nodes.node, lane_count, on_nodes.node);
        on_nodes.lanes = touches.lanes;
    } else {
        Four more[lane_count];
        lanes_to_fours(whole, stiffness, more);
        for (int lane = 0; lane < lane_count; ++lane) pressed.on_nodes.back().force[lane] += more[lane];
    }
    Pressed::OnFacets& on_facets = pressed.on_facets.emplace_back();
    lanes_to_fours(-whole, stiffness, on_facets.force);
    for (int i = 0; i < 4; ++i) {
        on_facets.share[i] = share[i];
        std::copy_n(facets.corner[i], lane_count, on_facets.corner[i]);
    }
    on_facets.lanes = bits_of(touches.over);
}

/// Normal forces with the damping of the contact springs.
Lanes SurfaceContact::damped(const NodeBatch& nodes, const FacetLanes& facets,
                             const std::array<Lanes, 4>& share, const Lanes& stiffness, const Lanes& closing,
                             const Lanes& force) const
{
    const Lanes zero{};
    LaneValues own, inverse;
    for (int lane = 0; lane < lane_count; ++lane) {
        own.value[lane] = mass_[nodes.node[lane]];
        inverse.value[lane] = 0;
        for (int i = 0; i < 4; ++i) {
            const double mass = mass_[facets.corner[i][lane]];
            if (mass > 0) inverse.value[lane] += share[i][lane] * share[i][lane] / mass;
        }
    }
    const Lanes other = inverse.lanes() > zero ? 1 / max(inverse.lanes(), broadcast<Lanes>(1e-300)) : zero;
    const Lanes damping = damping_coefficient(contact_.damping, stiffness, own.lanes(), other);
    return force > zero ? max(zero, force + damping * closing) : force;
}

/// Friction on the nodes; `lost` is what it has taken in the last step.
Vector3<Lanes> SurfaceContact::rubbed(const NodeBatch& nodes, const FacetLanes& facets,
                                      const TouchBatch& touches, const Vector3<Lanes>& slip,
                                      const Lanes& stiffness, const Lanes& force, Lanes& lost)
{
    const auto line = [&](TouchTable::Field field) { return table_.line(field, touches.layer, nodes.owner); };
    const Lanes zero{};
    const FrictionLanes law = friction_lanes(nodes.node, facets.facet);
    const Vector3<Lanes> before{load<Lanes>(line(TouchTable::friction_x)),
                                load<Lanes>(line(TouchTable::friction_y)),
                                load<Lanes>(line(TouchTable::friction_z))};
    Lanes coefficient = law.at_rest;
    if (law.decays && motion_.last_step > 0) {
        const Lanes speed = (1 / motion_.last_step) * sqrt(dot(slip, slip));
        const Lanes left = map_lanes(-law.decay * speed, [](double x) { return std::exp(x); });
        coefficient = law.decay != zero ? law.moving + (law.at_rest - law.moving) * left : coefficient;
    }
    Lanes limit = contact_.friction_scale * coefficient * force;
    if (law.capped) limit = min(limit, law.cap);
    const LaneMask rubs = touches.over & ((law.at_rest > zero) | (law.moving > zero));
    const auto friction =
        choose(rubs, friction_force(before, touches.normal, slip, stiffness, limit), Vector3<Lanes>{});
    lost = touches.over ? -0.5 * dot(before + friction, slip) : zero;
    store(line(TouchTable::friction_x), friction.x);
    store(line(TouchTable::friction_y), friction.y);
    store(line(TouchTable::friction_z), friction.z);
    return friction;
}

void SurfaceContact::Pressed::clear()
{
    on_nodes.clear();
    on_facets.clear();
    rubbed.clear();
    touches = 0;
    friction = 0;
}

/// Adds what a chunk of the owners presses with to the sums of the nodes, in the order of the owners.
void SurfaceContact::sum_up(const Pressed& pressed)
{
    const auto add = [&](Index node, const Four& more) {
        Four sum;
        std::memcpy(&sum, &sum_[node], sizeof sum);
        sum += more;
        std::memcpy(static_cast<void*>(&sum_[node]), &sum, sizeof sum);
    };
    for (const Pressed::OnNodes& batch : pressed.on_nodes)
        for (unsigned left = batch.lanes; left != 0; left &= left - 1) {
            const int lane = std::countr_zero(left);
            add(batch.node[lane], batch.force[lane]);
        }
    for (const Pressed::OnFacets& batch : pressed.on_facets)
        for (unsigned left = batch.lanes; left != 0; left &= left - 1) {
            const int lane = std::countr_zero(left);
            for (int i = 0; i < 4; ++i) add(batch.corner[i][lane], batch.share[i][lane] * batch.force[lane]);
        }
    if (!rubbed_off_.empty()) share_out_friction(pressed);
}

/// Half of what friction has taken for the node, half for the corners of its facet.
void SurfaceContact::share_out_friction(const Pressed& pressed)
{
    for (const Pressed::Rubbed& batch : pressed.rubbed) {
        const Pressed::OnFacets& facets = pressed.on_facets[batch.facets];
        for (unsigned left = facets.lanes; left != 0; left &= left - 1) {
            const int lane = std::countr_zero(left);
            const double half = 0.5 * batch.loss[lane];
            rubbed_off_[batch.node[lane]] += half;
            for (int i = 0; i < 4; ++i) rubbed_off_[facets.corner[i][lane]] += facets.share[i][lane] * half;
        }
    }
}

} // namespace plash

#include "contact/closest_point.h"
#include "contact/lane_points.h"
#include "contact/surface_contact.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace plash {

namespace {

using Facet = ContactMesh::Facet;

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

/// The facets of eight touches: corner [i][lane] of the mesh, what the law needs of each, and which are
/// triangles. Lanes without a touch repeat one that has.
struct FacetLanes {
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
            const Facet& one = mesh.facets[facet[lane]];
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

std::array<Lanes, 4> shares_in_lanes(const Lanes& s, const Lanes& t, LaneMask triangle)
{
    const Lanes one = broadcast<Lanes>(1), zero{};
    const Lanes u = one - s, v = one - t;
    return {triangle ? u - t : u * v, triangle ? s : s * v, triangle ? t : s * t, triangle ? zero : u * t};
}

} // namespace

/// Coefficients of friction of a batch; without any, friction is left out.
struct SurfaceContact::FrictionLanes {
    Lanes at_rest{}, moving{}, decay{}, cap{};
    bool decays = false, capped = false;
};

SurfaceContact::FrictionLanes SurfaceContact::friction_lanes(const Index* node, const Index* facet) const
{
    LaneValues at_rest, moving, decay, cap;
    FrictionLanes lanes;
    const bool common = contact_.static_friction != -1;
    for (int lane = 0; lane < (common ? 1 : lane_count); ++lane) {
        Friction mixed;
        const Friction& one = friction_of(node[lane], facet[lane], mixed);
        const double size = mesh_.facets[facet[lane]].size;
        at_rest.value[lane] = one.at_rest;
        moving.value[lane] = one.moving;
        decay.value[lane] = one.any() ? one.decay : 0;
        cap.value[lane] = one.shear_cap > 0 ? one.shear_cap * size * size : 1e300;
        lanes.decays = lanes.decays || decay.value[lane] != 0;
        lanes.capped = lanes.capped || one.shear_cap > 0;
    }
    if (common) {
        lanes.at_rest = broadcast<Lanes>(at_rest.value[0]);
        lanes.moving = broadcast<Lanes>(moving.value[0]);
        lanes.decay = broadcast<Lanes>(decay.value[0]);
        for (int lane = 1; lanes.capped && lane < lane_count; ++lane) {
            const double size = mesh_.facets[facet[lane]].size;
            cap.value[lane] = frictions_.front().shear_cap * size * size;
        }
    } else {
        lanes.at_rest = at_rest.lanes();
        lanes.moving = moving.lanes();
        lanes.decay = decay.lanes();
    }
    if (lanes.capped) lanes.cap = cap.lanes();
    return lanes;
}

/// Stiffness of the touches that are new on their facets, or of all when the step has become longer, and the
/// share that segments on segments leave to new touches.
void SurfaceContact::set_stiffness(int layer, std::size_t owner, unsigned active, const Index* facet,
                                   const Vector3<Lanes>& normal)
{
    double* stiffness = table_.row(TouchTable::stiffness, layer) + owner;
    double* weight = table_.row(TouchTable::weight, layer) + owner;
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
/// Touches that have ended are taken out, and their nodes are looked up anew in the next cycle. What there is
/// to sum up is left in `pressed`.
void SurfaceContact::press(std::size_t begin, std::size_t end, Pressed& pressed)
{
    pressed.clear();
    constexpr std::size_t facets_ahead = 6 * lane_count, corners_ahead = 3 * lane_count;
    for (std::size_t owner = begin; owner < end; owner += lane_count) {
        if (owner + facets_ahead < end)
            for (std::size_t i = owner + facets_ahead; i < owner + facets_ahead + lane_count; ++i)
                __builtin_prefetch(&mesh_.facets[table_.facets(0)[i]]);
        if (owner + corners_ahead < end) {
            for (std::size_t i = owner + corners_ahead; i < owner + corners_ahead + lane_count; ++i) {
                const auto& corner = mesh_.facets[table_.facets(0)[i]].corner;
                __builtin_prefetch(&motion_.position[corner[0]]);
                __builtin_prefetch(&motion_.velocity[corner[0]]);
                __builtin_prefetch(&motion_.position[corner[2]]);
                __builtin_prefetch(&motion_.velocity[corner[2]]);
            }
        }
        std::uint64_t any = 0;
        std::memcpy(&any, table_.counts(owner), sizeof any);
        if (any != 0) press_batch(owner, std::min<std::size_t>(lane_count, end - owner), pressed);
    }
}

void SurfaceContact::press_batch(std::size_t owner, std::size_t lanes, Pressed& pressed)
{
    Index node[lane_count];
    LaneValues thickness;
    unsigned followed = 0, in_layer[TouchTable::layers] = {}, ended[TouchTable::layers] = {};
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const std::size_t one = owner + std::min(lane, lanes - 1);
        node[lane] = table_.node(one);
        thickness.value[lane] = mesh_.nodes[node[lane]].half_thickness;
        if (lane >= lanes) continue;
        followed |= static_cast<unsigned>(table_.followed(one)) << lane;
        for (int layer = 0; layer < table_.count(one); ++layer) in_layer[layer] |= 1u << lane;
        pressed.touches += table_.count(one);
    }
    const auto place = points_in_lanes(motion_.position.data(), node);
    const auto speed = points_in_lanes(motion_.velocity.data(), node);
    const LaneMask following = mask_of(followed);
    const Lanes zero{};
    Vector3<Lanes> node_force{};
    Lanes node_stiffness{};
    for (int layer = 0; layer < TouchTable::layers && in_layer[layer] != 0; ++layer) {
        const LaneMask active = mask_of(in_layer[layer]);
        const auto row = [&](TouchTable::Field field) { return table_.row(field, layer) + owner; };
        const auto get = [&](TouchTable::Field field) { return load<Lanes>(row(field)); };
        const auto get3 = [&](TouchTable::Field field) {
            return Vector3<Lanes>{get(field), get(TouchTable::Field(field + 1)),
                                  get(TouchTable::Field(field + 2))};
        };
        const FacetLanes facet(mesh_, table_.facets(layer) + owner, in_layer[layer]);
        const auto corner_point = [&](const std::vector<Vec3>& list, int i) {
            return points_in_lanes(list.data(), facet.corner[i]);
        };
        Lanes s = get(TouchTable::at_s), t = get(TouchTable::at_t), depth{},
              baseline = get(TouchTable::baseline);
        Vector3<Lanes> normal{};
        LaneMask over = active & ~following;
        if ((followed & in_layer[layer]) != 0) {
            const SegmentCorners<Lanes> corners{
                corner_point(motion_.position, 0), corner_point(motion_.position, 1),
                corner_point(motion_.position, 2), corner_point(motion_.position, 3)};
            const auto foot = foot_near(place, corners, s, t);
            normal = get(TouchTable::side) * segment_normal(corners, foot.s, foot.t);
            const Lanes distance = dot(foot.offset, normal);
            depth = thickness.lanes() + facet.half_thickness - distance;
            const LaneMask lost = (distance < -facet.depth) | (depth <= zero);
            ended[layer] = bits_of(lost) & followed & in_layer[layer];
            s = following ? foot.s : s;
            t = following ? foot.t : t;
            baseline = following ? min(baseline, depth) : baseline;
            store(row(TouchTable::at_s), s);
            store(row(TouchTable::at_t), t);
            store(row(TouchTable::baseline), baseline);
            over |= active & following & ~lost;
        }
        if ((in_layer[layer] & ~followed) != 0) {
            const auto given = get3(TouchTable::normal_x);
            const bool some = (followed & in_layer[layer]) != 0;
            const Lanes own = get(TouchTable::penetration);
            normal.x = some ? (following ? normal.x : given.x) : given.x;
            normal.y = some ? (following ? normal.y : given.y) : given.y;
            normal.z = some ? (following ? normal.z : given.z) : given.z;
            depth = some ? (following ? depth : own) : own;
        }
        if (contact_.constraint) continue; // constrain() finds the forces
        const auto share = shares_in_lanes(s, t, facet.triangle);
        Vector3<Lanes> velocity = speed;
        for (int i = 0; i < 4; ++i) velocity -= share[i] * corner_point(motion_.velocity, i);
        const Lanes closing = -dot(velocity, normal);
        unsigned unknown = soft_changed_ ? 0xffu : bits_of(get(TouchTable::stiffness) == zero);
        unknown |= bits_of(get(TouchTable::weight) < zero);
        if ((unknown &= in_layer[layer]) != 0) set_stiffness(layer, owner, unknown, facet.facet, normal);
        const Lanes stiffness = get(TouchTable::weight) * get(TouchTable::stiffness);
        Lanes force = rounded_force(stiffness, depth - baseline, get(TouchTable::rounding));
        if (contact_.damping > 0) {
            LaneValues own, inverse;
            for (int lane = 0; lane < lane_count; ++lane) {
                own.value[lane] = mass_[node[lane]];
                inverse.value[lane] = 0;
                for (int i = 0; i < 4; ++i) {
                    const double mass = mass_[facet.corner[i][lane]];
                    if (mass > 0) inverse.value[lane] += share[i][lane] * share[i][lane] / mass;
                }
            }
            const Lanes other =
                inverse.lanes() > zero ? 1 / max(inverse.lanes(), broadcast<Lanes>(1e-300)) : zero;
            const Lanes damping = damping_coefficient(contact_.damping, stiffness, own.lanes(), other);
            force = force > zero ? max(zero, force + damping * closing) : force;
        }
        force = over ? force : zero;
        Vector3<Lanes> whole = force * normal;
        if (table_.with_friction()) {
            const FrictionLanes coefficients = friction_lanes(node, facet.facet);
            const auto before = get3(TouchTable::friction_x);
            const auto slip = broadcast<Lanes>(motion_.last_step) * (velocity + closing * normal);
            Lanes coefficient = coefficients.at_rest;
            if (coefficients.decays && motion_.last_step > 0) {
                const Lanes argument = -coefficients.decay * (1 / motion_.last_step) * sqrt(dot(slip, slip));
                const Lanes decayed =
                    coefficients.moving + (coefficients.at_rest - coefficients.moving) *
                                              map_lanes(argument, [](double x) { return std::exp(x); });
                coefficient = coefficients.decay != zero ? decayed : coefficient;
            }
            Lanes limit = contact_.friction_scale * coefficient * force;
            if (coefficients.capped) limit = min(limit, coefficients.cap);
            auto friction = friction_force(before, normal, slip, stiffness, limit);
            const auto any = (coefficients.at_rest > zero) | (coefficients.moving > zero);
            friction.x = any & over ? friction.x : zero;
            friction.y = any & over ? friction.y : zero;
            friction.z = any & over ? friction.z : zero;
            const Lanes loss = over ? -0.5 * dot(before + friction, slip) : zero;
            for (int lane = 0; lane < lane_count; ++lane) pressed.friction += loss[lane];
            store(row(TouchTable::friction_x), friction.x);
            store(row(TouchTable::friction_y), friction.y);
            store(row(TouchTable::friction_z), friction.z);
            whole += friction;
        }
        store(row(TouchTable::pressing), force);
        const Lanes held = over ? stiffness : zero;
        node_force += whole;
        node_stiffness += held;
        Four on_facet[lane_count];
        lanes_to_fours(-whole, held, on_facet);
        for (unsigned left = bits_of(over); left != 0; left &= left - 1) {
            const int lane = std::countr_zero(left);
            Pressed::OnFacet& one = pressed.on_facets.emplace_back();
            one.force = on_facet[lane];
            for (int i = 0; i < 4; ++i) {
                one.share[i] = share[i][lane];
                one.corner[i] = facet.corner[i][lane];
            }
        }
    }
    Four on_node[lane_count];
    lanes_to_fours(node_force, node_stiffness, on_node);
    for (unsigned left = in_layer[0]; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        pressed.on_nodes.push_back({on_node[lane], node[lane]});
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        unsigned which = 0;
        for (int layer = 0; layer < TouchTable::layers; ++layer) which |= (ended[layer] >> lane & 1) << layer;
        if (which == 0) continue;
        table_.remove(owner + lane, which);
        search_.pairs().quiet[owner + lane] = 0;
    }
}

/// Adds what a chunk of the owners presses with to the sums of the nodes, in the order of the owners.
void SurfaceContact::sum_up(const Pressed& pressed)
{
    const auto add = [&](Index node, const Four& more) {
        Four sum;
        std::memcpy(&sum, &sum_now_[node], sizeof sum);
        sum += more;
        std::memcpy(static_cast<void*>(&sum_now_[node]), &sum, sizeof sum);
    };
    for (const Pressed::OnNode& one : pressed.on_nodes) add(one.node, one.force);
    for (const Pressed::OnFacet& one : pressed.on_facets)
        for (int i = 0; i < 4; ++i) add(one.corner[i], one.share[i] * one.force);
}

} // namespace plash

#include "contact/facing_segments.h"

#include "contact/bounding_tree.h"
#include "contact/closest_point.h"
#include "contact/mean_normal.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace plash {

namespace {

using PressFacet = ContactMesh::Facet;

/// Angle to its neighbours below which a facet counts as flat.
constexpr double flat_bend = 0.05;

SegmentOverlap::Corners corners_of(const ContactMotion& motion, const PressFacet& facet)
{
    const auto& p = motion.position;
    return {p[facet.corner[0]], p[facet.corner[1]], p[facet.corner[2]], p[facet.corner[3]]};
}

Vec3 middle_of(const SegmentOverlap::Corners& corner)
{
    return 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
}

Vec3 at_shares(const std::array<double, 4>& share, const PressFacet& facet, std::span<const Vec3> field)
{
    Vec3 sum{};
    for (int i = 0; i < 4; ++i) sum += share[i] * field[facet.corner[i]];
    return sum;
}

/// Least and largest size of the distances of some points from a plane; least is 0 if they lie on both sides.
struct PlaneDistance {
    double least = 1e300, largest = 0;

    PlaneDistance(const SegmentOverlap::Corners& points, const Vec3& origin, const Vec3& normal)
    {
        bool above = false, below = false;
        for (const Vec3& point : points) {
            const double distance = dot(point - origin, normal);
            above = above || distance >= 0;
            below = below || distance < 0;
            least = std::min(least, std::abs(distance));
            largest = std::max(largest, std::abs(distance));
        }
        if (above && below) least = 0;
    }
};

double reach_of(const PressFacet& a, const PressFacet& b)
{
    return std::max(a.half_thickness + b.half_thickness, std::max(a.depth, b.depth));
}

/// Whether all of `points` lie beyond one side of a segment by more than `by`.
bool beside_segment(const SegmentOverlap::Corners& points, const SegmentOverlap::Corners& segment,
                    const Vec3& normal, double by)
{
    const Vec3 middle = middle_of(segment);
    for (int i = 0; i < 4; ++i) {
        Vec3 outward = unit(cross(segment[(i + 1) % 4] - segment[i], normal));
        if (dot(outward, middle - segment[i]) > 0) outward = -outward;
        if (dot(outward, outward) == 0) continue;
        double least = 1e300;
        for (const Vec3& point : points) least = std::min(least, dot(point - segment[i], outward));
        if (least > by) return true;
    }
    return false;
}

} // namespace

FacingSegments::FacingSegments(const ContactMesh& mesh, const Options& options,
                               std::vector<Friction> frictions, std::vector<double> area_mass)
    : mesh_(mesh),
      options_(options),
      frictions_(std::move(frictions)),
      area_mass_(std::move(area_mass)),
      margin_(mesh.typical_size(0.5) / 3)
{}

void FacingSegments::clear()
{
    now_.clear();
    before_.clear();
    facet_begin_.clear();
    for (FacingPair& pair : pairs_) pair.touch = none;
}

Vec3 FacingSegments::normal_of(const ContactMotion& motion, Index facet) const
{
    const auto q = corners_of(motion, mesh_.facets[facet]);
    return segment_normal(SegmentCorners<double>{q[0], q[1], q[2], q[3]}, 0.5, 0.5);
}

/// As PairSearch: pairs hold until nodes may have moved relative to one another by the margin.
bool FacingSegments::holds(const ContactMotion& motion)
{
    const NodeVectors& position = motion.position;
    if (searched_at_.size() != position.size()) return false;
    if (motion.travelled + motion.step_range < test_due_) return true;
    Bounds moved;
    for (std::size_t i = 0; i < position.size(); ++i) moved.add(position[i] - searched_at_[i]);
    const double left = margin_ - norm(moved.high - moved.low);
    test_due_ = motion.travelled + left;
    return left >= motion.step_range;
}

bool FacingSegments::may_meet(Index a, Index b) const
{
    const PressFacet &first = mesh_.facets[a], &second = mesh_.facets[b];
    if (options_.two_sided) {
        const bool across = ((first.belongs & slave_bit) && (second.belongs & master_bit)) ||
                            ((first.belongs & master_bit) && (second.belongs & slave_bit));
        if (!across) return false;
    }
    if (first.rigid && second.rigid && first.part == second.part) return false;
    const Index solid = mesh_.segments[a].solid;
    if (solid != none && solid == mesh_.segments[b].solid) return false;
    for (Index corner : first.corner) {
        if (std::find(second.corner.begin(), second.corner.end(), corner) != second.corner.end())
            return false;
    }
    return true;
}

void FacingSegments::search(const ContactMotion& motion)
{
    ++searches_;
    searched_at_.assign(motion.position.begin(), motion.position.end());
    test_due_ = motion.travelled + margin_;
    const double margin = std::max(margin_, 1.5 * motion.step_range);
    const std::size_t count = mesh_.facets.size();
    std::vector<Bounds> boxes(count);
    std::vector<Vec3> normals(count);
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const PressFacet& facet = mesh_.facets[i];
            if (!facet.exposed) continue;
            for (Index corner : facet.corner) boxes[i].add(motion.position[corner]);
            boxes[i].grow(std::max(facet.half_thickness, facet.depth) + 0.5 * margin);
            normals[i] = normal_of(motion, static_cast<Index>(i));
        }
    });
    BoundingTree tree;
    tree.fit(boxes);
    std::vector<std::vector<FacingPair>> found((count + chunk_length - 1) / chunk_length);
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        std::vector<Index> others;
        for (std::size_t i = begin; i < end; ++i) {
            const Index a = static_cast<Index>(i);
            if (!mesh_.facets[i].exposed) continue;
            const auto at_a = corners_of(motion, mesh_.facets[i]);
            others.clear();
            tree.query(boxes[i], [&](Index b) {
                if (b <= a || !may_meet(a, b)) return;
                // Seen along the mean of both normals, 30 degrees at most from either, they may overlap.
                const auto at_b = corners_of(motion, mesh_.facets[b]);
                const PlaneDistance off(at_a, middle_of(at_b), normals[b]);
                const PlaneDistance warp(at_b, middle_of(at_b), normals[b]);
                if (off.least > reach_of(mesh_.facets[a], mesh_.facets[b]) + margin + warp.largest) return;
                if (beside_segment(at_a, at_b, normals[b], 1.6 * margin + 0.6 * (off.largest + warp.largest)))
                    return;
                others.push_back(b);
            });
            std::sort(others.begin(), others.end());
            for (Index b : others) {
                const FacingTouch* touch = touch_between(now_, a, b);
                const Index place = touch ? static_cast<Index>(touch - now_.data()) : none;
                found[begin / chunk_length].push_back({a, b, 0, place});
            }
        }
    });
    pairs_.clear();
    block_due_.clear();
    for (const auto& part : found) pairs_.insert(pairs_.end(), part.begin(), part.end());
    find_sharp_nodes(motion);
}

/// Rims, lone nodes, and nodes whose facets turn by more than 37 degrees.
void FacingSegments::find_sharp_nodes(const ContactMotion& motion)
{
    sharp_.assign(mesh_.nodes.size(), 1);
    for_chunks(sharp_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Index node = static_cast<Index>(i);
            const auto around = mesh_.facets_at_node(node);
            if (around.empty() || mesh_.on_rim[i]) continue;
            bool sharp = false;
            for (std::size_t k = 1; k < around.size(); ++k) {
                const double along = dot(normal_of(motion, around[0]), normal_of(motion, around[k]));
                sharp = sharp || (mesh_.facets[around[k]].one_sided ? along : std::abs(along)) < 0.8;
            }
            sharp_[i] = sharp;
        }
    });
    find_standing(motion);
}

/// Rings of facets between each facet and the next rim or sharp edge, four at most, times its size, over how
/// much it is bent against those around it; the fourth power of it.
void FacingSegments::find_standing(const ContactMotion& motion)
{
    constexpr int rings = 4;
    std::vector<int> ring(mesh_.nodes.size(), rings);
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (sharp_[i]) ring[i] = 0;
    const auto least = [&](const PressFacet& facet) {
        int least = rings;
        for (Index corner : facet.corner) least = std::min(least, ring[corner]);
        return least;
    };
    for (int round = 1; round < rings; ++round) {
        for (const PressFacet& facet : mesh_.facets) {
            if (!facet.exposed || least(facet) != round - 1) continue;
            for (Index corner : facet.corner) ring[corner] = std::min(ring[corner], round);
        }
    }
    standing_.resize(mesh_.facets.size());
    bend_.resize(mesh_.facets.size());
    std::vector<Vec3> normal;
    for (std::size_t i = 0; i < standing_.size(); ++i)
        normal.push_back(normal_of(motion, static_cast<Index>(i)));
    for (std::size_t i = 0; i < standing_.size(); ++i) {
        const double extent = (least(mesh_.facets[i]) + 0.25) * mesh_.facets[i].size;
        const Vec3& own = normal[i];
        double bend2 = 0, going_on2 = 0; // squares of the largest angles
        for (const Index corner : mesh_.facets[i].corner) {
            for (const Index other : mesh_.facets_at_node(corner)) {
                const double along = std::abs(dot(own, normal[other]));
                bend2 = std::max(bend2, 2 - 2 * along);
                if (facing_weight(along) > 0) going_on2 = std::max(going_on2, 2 - 2 * along);
            }
        }
        bend_[i] = std::sqrt(going_on2);
        const double flat = extent * extent / (bend2 + flat_bend * flat_bend);
        standing_[i] = flat * flat;
    }
}

double FacingSegments::node_weight(const ContactMotion& motion, Index node, const Vec3& normal) const
{
    double facing = 0;
    for (Index facet : mesh_.facets_at_node(node)) {
        const double along = -dot(normal_of(motion, facet), normal);
        facing = std::max(facing, mesh_.facets[facet].one_sided ? along : std::abs(along));
    }
    return 1 - facing_weight(facing);
}

double FacingSegments::areal_stiffness(Index a, Index b, double step) const
{
    const double first = area_mass_[a], second = area_mass_[b];
    if (!(first > 0) || !(second > 0) || step == 0) return 0;
    const double scale = 0.5 * (options_.stiffness_scale[mesh_.facets[a].belongs - 1] +
                                options_.stiffness_scale[mesh_.facets[b].belongs - 1]);
    return part_scale(a, b) * scale * first * second / (first + second) / (step * step);
}

/// SSF of *PART_CONTACT: LS-DYNA takes that of the segment that it tracks, or the larger one (SSFTYP = 1).
/// Here both of a pair are tracked.
double FacingSegments::part_scale(Index a, Index b) const
{
    if (options_.part_scale.empty()) return 1;
    const auto of = [&](Index facet) {
        const Index part = mesh_.facets[facet].part;
        return part == none ? 1.0 : options_.part_scale[part];
    };
    return options_.larger_part_scale ? std::max(of(a), of(b)) : 0.5 * (of(a) + of(b));
}

const FacingTouch* FacingSegments::touch_between(const std::vector<FacingTouch>& touches, Index a, Index b)
{
    const std::pair<Index, Index> key = std::minmax(a, b);
    const auto found = std::lower_bound(touches.begin(), touches.end(), key,
                                        [](const FacingTouch& touch, const auto& wanted) {
                                            return std::pair(touch.first, touch.second) < wanted;
                                        });
    const bool there = found != touches.end() && std::pair(found->first, found->second) == key;
    return there ? &*found : nullptr;
}

/// Lists the touches of the last cycle by facet.
void FacingSegments::index_touches()
{
    facet_begin_.clear();
    if (before_.empty()) return;
    facet_begin_.assign(mesh_.facets.size() + 1, 0);
    for (const FacingTouch& touch : before_) {
        ++facet_begin_[touch.first + 1];
        ++facet_begin_[touch.second + 1];
    }
    std::partial_sum(facet_begin_.begin(), facet_begin_.end(), facet_begin_.begin());
    of_facet_.resize(facet_begin_.back());
    for (std::size_t i = before_.size(); i-- > 0;) { // from behind: the ends become the beginnings
        of_facet_[--facet_begin_[before_[i].first + 1]] = static_cast<Index>(i);
        of_facet_[--facet_begin_[before_[i].second + 1]] = static_cast<Index>(i);
    }
    facet_begin_.erase(facet_begin_.begin());
    facet_begin_.push_back(static_cast<Index>(of_facet_.size()));
}

/// The touch of the last step of one of the two with a neighbour of the other, from about this direction: as
/// segments slide, they meet one after the other. turned: it has them the other way round. Of several that
/// agree with the direction alike, the one at the first corner.
///
/// Neighbours share an edge, so a pair that goes on with a touch is about as deep as this is. One that would
/// be deeper on that side has not slid there: a segment between two others that are joined at a fold comes
/// towards the second from its other side, and would be pushed through it.
const FacingTouch* FacingSegments::old_beside(Index a, Index b, const Vec3& direction,
                                              const SegmentOverlap& overlap, double tolerance,
                                              bool& turned) const
{
    const FacingTouch* best = nullptr;
    double nearest = 0.5;
    std::tuple<int, int, Index> best_place{};
    const auto look = [&](Index of, Index beside, int round) {
        const auto& corner = mesh_.facets[beside].corner;
        for (const Index number : old_touches_of(of)) {
            const FacingTouch& old = before_[number];
            const Index other = old.first == of ? old.second : old.first;
            if (other == beside || !mesh_.facets[other].exposed) continue;
            const auto& others = mesh_.facets[other].corner;
            const auto common =
                std::find_first_of(corner.begin(), corner.end(), others.begin(), others.end());
            if (common == corner.end()) continue;
            const bool swapped = round == 0 ? a > other : other > b;
            const double same_way = (swapped ? -1 : 1) * dot(old.normal, direction);
            const double along = std::abs(same_way);
            const double penetration = same_way < 0 ? overlap.deepest_behind() : overlap.deepest();
            if (penetration > old.penetration + tolerance) continue;
            const std::tuple place(round, static_cast<int>(common - corner.begin()), other);
            if (along < nearest || (along == nearest && (!best || place > best_place))) continue;
            nearest = along;
            best = &old;
            best_place = place;
            turned = swapped;
        }
    };
    look(a, b, 0);
    look(b, a, 1);
    return best;
}

Friction FacingSegments::friction_of(Index a, Index b) const
{
    const auto of = [&](Index facet) -> const Friction& {
        const Index part = mesh_.facets[facet].part;
        return part == none ? frictions_.back() : frictions_[part];
    };
    const Friction &first = of(a), &second = of(b);
    if (!options_.mixed_friction) return first;
    return {0.5 * (first.at_rest + second.at_rest), 0.5 * (first.moving + second.moving),
            0.5 * (first.decay + second.decay), 0.5 * (first.shear_cap + second.shear_cap)};
}

bool FacingSegments::touch_of(const ContactMotion& motion, double step, const FacingCandidate& candidate,
                              FacingTouch& touch) const
{
    const FacingPair& pair = pairs_[candidate.pair];
    const FacingTouch* old = candidate.old == none ? nullptr : &before_[candidate.old];
    const PressFacet &a = mesh_.facets[pair.first], &b = mesh_.facets[pair.second];
    const double gap = a.half_thickness + b.half_thickness, depth = std::max(a.depth, b.depth);
    const auto at_a = corners_of(motion, a), at_b = corners_of(motion, b);
    Vec3 normal = candidate.normal;
    if (a.one_sided ? dot(normal, candidate.first_normal) > 0
                    : b.one_sided && dot(normal, candidate.second_normal) < 0)
        normal = -normal;
    SegmentOverlap overlap(at_a, at_b, normal, gap);
    if (overlap.empty()) return false;
    const auto touching = [&](double penetration) { return penetration > 0 && gap - penetration >= -depth; };
    const bool fixed = a.one_sided || b.one_sided;
    if (!touching(overlap.deepest()) && (fixed || !touching(overlap.deepest_behind()))) return false;
    const auto turn_round = [&] {
        normal = -normal;
        overlap.turn_round();
    };
    bool turned = false;
    if (!old) {
        // What a step and the tilt of one normal against the other explain.
        const double tolerance = 0.1 * (gap + depth) + 2 * motion.step_range;
        old = old_beside(pair.first, pair.second, normal, overlap, tolerance, turned);
    }
    const Vec3 old_normal = old ? (turned ? -1.0 : 1.0) * old->normal : Vec3{};
    if (fixed) {
        if (old && dot(old_normal, normal) < 0) old = nullptr;
    } else if (old) {
        if (dot(old_normal, normal) < 0) turn_round();
    } else { // shells that meet: the side on which they were a step ago
        if (dot(middle_of(at_a) - middle_of(at_b), normal) < 0) turn_round();
        std::array<Vec3, 2> place{};
        const auto first = overlap.first_middle(), second = overlap.second_middle();
        for (int i = 0; i < 4; ++i) {
            const bool known = motion.last_step > 0;
            place[0] += first[i] * (known ? motion.previous(a.corner[i]) : at_a[i]);
            place[1] += second[i] * (known ? motion.previous(b.corner[i]) : at_b[i]);
        }
        if (dot(place[0] - place[1], normal) < 0) turn_round();
    }
    touch.penetration = overlap.deepest();
    if (!touching(touch.penetration)) return false;
    const double distance = gap - touch.penetration;
    const double weight = facing_weight(std::abs(candidate.along));
    touch.first = pair.first;
    touch.second = pair.second;
    touch.normal = normal;
    // A stiffness that grew under load would make energy.
    const bool goes_on = old && old->weight > 0 && dot(old_normal, normal) > 0.98;
    touch.weight = goes_on ? old->weight : weight;
    const double not_deeper = (1 + 1e-12) * touch.penetration; // but for round-off
    if (old) {
        touch.from_start = old->from_start;
        const double kept = old->from_start ? 1 : 1 - options_.baseline_decay;
        touch.baseline = std::min(kept * old->baseline, not_deeper);
        touch.rounding = old->rounding;
        // A pair that is new grows from nothing, and so does its friction.
        if (old->first == pair.first && old->second == pair.second) touch.friction = old->friction;
    } else {
        const double closing = dot(at_shares(overlap.second_middle(), b, motion.velocity) -
                                       at_shares(overlap.first_middle(), a, motion.velocity),
                                   normal);
        // Round-off of surfaces that slide across one another is no approach.
        const double path = std::max(0.0, closing) * motion.last_step;
        const double approach = path > 1e-9 * a.size ? path : 0;
        const bool sided = a.one_sided || b.one_sided;
        if (sided && motion.last_step > 0 && distance < 0 &&
            distance + motion.last_step * closing < -0.1 * depth)
            return false; // they come from within
        touch.from_start = motion.last_step == 0;
        touch.baseline = std::max(0.0, not_deeper - 1.5 * approach);
        touch.rounding = approach;
    }
    apply_law(motion, areal_stiffness(pair.first, pair.second, step), overlap, candidate, at_a, at_b, touch);
    return true;
}

/// What share of the forces across the normal two facets give to one another: all where they are tilted
/// against one another, or one of them against its neighbours. Where all are flat, these forces cancel
/// between neighbours but for the rim, where they would squeeze a sheet under a constant pressure
/// (docs/theory/contact.md).
/// along  cosine between the facets' normals
double FacingSegments::lateral_share(Index a, Index b, double along) const
{
    const double flat = flat_bend * flat_bend;
    const double bend2 =
        std::max({bend_[a] * bend_[a], bend_[b] * bend_[b], 2 - 2 * std::min(1.0, std::abs(along))});
    const double of_flat = flat / (bend2 + flat);
    const double share = 1 - of_flat * of_flat;
    return share > 1e-6 ? share : 0;
}

/// Forces of a touch: those of its energy, with damping and friction at the pressure's shares of the corners.
void FacingSegments::apply_law(const ContactMotion& motion, double stiffness, const SegmentOverlap& overlap,
                               const FacingCandidate& candidate, const SegmentOverlap::Corners& at_a,
                               const SegmentOverlap::Corners& at_b, FacingTouch& touch) const
{
    const PressFacet &a = mesh_.facets[touch.first], &b = mesh_.facets[touch.second];
    const double first_standing = standing_[touch.first], second_standing = standing_[touch.second];
    SegmentOverlap::Law law{touch.weight * stiffness, touch.baseline, touch.rounding};
    law.first_size = a.size * a.size;
    law.second_size = b.size * b.size;
    law.first_share = second_standing / (first_standing + second_standing);
    law.lateral = lateral_share(touch.first, touch.second, candidate.along);
    const auto load = overlap.load(law);
    touch.first_share = load.first;
    touch.second_share = load.second;
    touch.on_first = load.on_first;
    touch.on_second = load.on_second;
    touch.area = load.area;
    touch.stiffness = load.stiffness;
    if (load.force > 0 && law.lateral > 0) {
        MeanNormal(at_a, std::copysign(first_standing, dot(candidate.first_normal, touch.normal)), at_b,
                   std::copysign(second_standing, dot(candidate.second_normal, touch.normal)))
            .add_turning(load.moment, touch.on_first, touch.on_second);
    }
    const Vec3 velocity =
        at_shares(load.first, a, motion.velocity) - at_shares(load.second, b, motion.velocity);
    const double closing = -dot(velocity, touch.normal);
    touch.pressing = load.force;
    if (load.force > 0 && options_.damping > 0) {
        const double damping =
            damping_coefficient(options_.damping, touch.stiffness, area_mass_[touch.first] * load.area,
                                area_mass_[touch.second] * load.area);
        touch.pressing = std::max(0.0, load.force + damping * closing);
    }
    const Friction friction = friction_of(touch.first, touch.second);
    const Vec3 slip = motion.last_step * (velocity + closing * touch.normal);
    const Vec3 before = touch.friction;
    touch.friction = {};
    if (friction.any()) {
        const double speed = motion.last_step > 0 ? norm(slip) / motion.last_step : 0;
        double limit = options_.friction_scale * friction.coefficient(speed) * touch.pressing;
        if (friction.shear_cap > 0) limit = std::min(limit, friction.shear_cap * load.area);
        const double stiffness = options_.friction_stiffness_scale * touch.stiffness;
        touch.friction = friction_force(before, touch.normal, slip, stiffness, limit);
    }
    const Vec3 more = (touch.pressing - load.force) * touch.normal + touch.friction;
    touch.force = {};
    for (int i = 0; i < 4; ++i) {
        touch.on_first[i] += load.first[i] * more;
        touch.on_second[i] -= load.second[i] * more;
        touch.force += touch.on_first[i];
    }
    touch.friction_loss = -0.5 * dot(before + touch.friction, slip);
}

double FacingSegments::find(const ContactMotion& motion, double step)
{
    if (!holds(motion)) search(motion);
    std::swap(now_, before_);
    now_.clear();
    index_touches();
    chunks_.resize((pairs_.size() + chunk_length - 1) / chunk_length);
    block_due_.resize((pairs_.size() + block_length - 1) / block_length);
    for_chunks(pairs_.size(),
               [&](std::size_t begin, std::size_t end) { find_chunk(motion, step, begin, end); });
    double loss = 0;
    for (const Chunk& chunk : chunks_) {
        for (const Chunk::Found& one : chunk.found) {
            pairs_[one.pair].touch = static_cast<Index>(now_.size());
            now_.push_back(one.touch);
            loss += one.touch.friction_loss;
        }
    }
    return loss;
}

/// Touches of a chunk of the pairs.
void FacingSegments::find_chunk(const ContactMotion& motion, double step, std::size_t begin, std::size_t end)
{
    Chunk& chunk = chunks_[begin / chunk_length];
    chunk.due.clear();
    chunk.left.clear();
    chunk.found.clear();
    chunk.looked_at.clear();
    const double now = motion.travelled + motion.step_range;
    for (std::size_t block = begin / block_length; block * block_length < end; ++block) {
        if (block_due_[block] > now) continue;
        chunk.looked_at.push_back(block);
        for (std::size_t i = block * block_length; i < std::min(end, (block + 1) * block_length); ++i) {
            FacingPair& pair = pairs_[i];
            if (pair.due <= now) {
                FacingCandidate& one = chunk.due.emplace_back();
                one.pair = static_cast<Index>(i);
                one.old = pair.touch;
                if (one.old != none) one.old_normal = before_[one.old].normal;
                one.alone = old_touches_of(pair.first).empty() && old_touches_of(pair.second).empty();
            }
            pair.touch = none;
        }
    }
    FacingTest(mesh_, motion, standing_).test(pairs_, chunk.due, chunk.left);
    for (const std::size_t block : chunk.looked_at) {
        double due = pairs_[block * block_length].due;
        for (std::size_t i = block * block_length; i < std::min(end, (block + 1) * block_length); ++i)
            due = std::min(due, pairs_[i].due);
        block_due_[block] = due;
    }
    for (const FacingCandidate& one : chunk.left) {
        FacingTouch touch;
        if (touch_of(motion, step, one, touch)) chunk.found.push_back({one.pair, touch});
    }
}

void FacingSegments::serialise(Archive& archive)
{
    archive(pairs_, searched_at_, test_due_, sharp_, standing_, bend_, now_, searches_);
}

} // namespace plash

#include "contact/facing_test.h"

#include "contact/bounding_tree.h"
#include "contact/lane_points.h"

#include <cstring>

namespace plash {

namespace {

using LaneVec = Vector3<Lanes>;
using LaneCorners = std::array<LaneVec, 4>;

LaneVec choose(LaneMask mask, const LaneVec& a, const LaneVec& b)
{
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

LaneVec scaled_to_unit(const LaneVec& v)
{
    return (broadcast<Lanes>(1) / max(sqrt(dot(v, v)), broadcast<Lanes>(1e-300))) * v;
}

/// Normal of a facet in its middle, and how fast it turns.
struct LaneFrame {
    LaneVec normal, middle;
    Lanes turn; ///< [1/length]

    explicit LaneFrame(const LaneCorners& q)
    {
        const LaneVec last = q[3] - q[2];
        const LaneMask triangle = dot(last, last) == Lanes{};
        const LaneVec long_way = q[2] - q[0];
        const LaneVec one = choose(triangle, q[1] - q[0], long_way);
        const LaneVec other = choose(triangle, long_way, q[3] - q[1]);
        const LaneVec area = cross(one, other);
        const Lanes size = max(sqrt(dot(area, area)), broadcast<Lanes>(1e-300));
        normal = (broadcast<Lanes>(1) / size) * area;
        turn = 2 * (sqrt(dot(one, one)) + sqrt(dot(other, other))) / size;
        middle = broadcast<Lanes>(0.25) * (q[0] + q[1] + q[2] + q[3]);
    }
};

struct Extremes {
    Lanes low, high;

    Extremes(const LaneCorners& q, const LaneVec& axis)
    {
        const Lanes a = dot(q[0], axis), b = dot(q[1], axis), c = dot(q[2], axis), d = dot(q[3], axis);
        low = min(min(a, b), min(c, d));
        high = max(max(a, b), max(c, d));
    }
};

/// By how much the first is above the second by more than `above`, or below it by more than `below`.
Lanes clearance(const LaneCorners& first, const LaneCorners& second, const LaneVec& axis, Lanes above,
                Lanes below)
{
    const Extremes a(first, axis), b(second, axis);
    return max(a.low - b.high - above, b.low - a.high - below);
}

struct LanePoint {
    Lanes x, y;
};

/// The largest distance of two shadows beside one another, along the directions across all of their sides:
/// not above 0 if shadows that are convex overlap.
Lanes clearance_beside(const LaneCorners& first, const LaneCorners& second, const LaneVec& normal)
{
    const Lanes x = abs(normal.x), y = abs(normal.y), z = abs(normal.z), zero{}, one = broadcast<Lanes>(1);
    const LaneMask least_x = (x <= y) & (x <= z), least_y = ~least_x & (y <= z);
    const LaneVec least{least_x ? one : zero, least_y ? one : zero, least_x | least_y ? zero : one};
    const LaneVec along = scaled_to_unit(cross(normal, least));
    const LaneVec beside = cross(normal, along);
    std::array<LanePoint, 4> shadow[2];
    for (int i = 0; i < 4; ++i) {
        const LaneVec to_first = first[i] - second[0], to_second = second[i] - second[0];
        shadow[0][i] = {dot(to_first, along), dot(to_first, beside)};
        shadow[1][i] = {dot(to_second, along), dot(to_second, beside)};
    }
    Lanes largest = broadcast<Lanes>(-1e300);
    for (const auto& own : shadow) {
        for (int side = 0; side < 4; ++side) {
            const Lanes across_x = own[(side + 1) % 4].y - own[side].y;
            const Lanes across_y = own[side].x - own[(side + 1) % 4].x;
            Lanes low[2], high[2];
            for (int of = 0; of < 2; ++of) {
                for (int i = 0; i < 4; ++i) {
                    const Lanes at = across_x * shadow[of][i].x + across_y * shadow[of][i].y;
                    low[of] = i == 0 ? at : min(low[of], at);
                    high[of] = i == 0 ? at : max(high[of], at);
                }
            }
            const Lanes length =
                max(sqrt(across_x * across_x + across_y * across_y), broadcast<Lanes>(1e-300));
            largest = max(largest, max(low[0] - high[1], low[1] - high[0]) / length);
        }
    }
    return largest;
}

} // namespace

void FacingTest::test(std::vector<FacingPair>& pairs, std::span<const FacingCandidate> due,
                      std::vector<FacingCandidate>& left) const
{
    constexpr std::size_t facets_ahead = 2 * lane_count;
    for (std::size_t first = 0; first < due.size(); first += lane_count) {
        for (std::size_t i = first + facets_ahead;
             i < std::min(first + facets_ahead + lane_count, due.size()); ++i) {
            __builtin_prefetch(&mesh_.facets[pairs[due[i].pair].first]);
            __builtin_prefetch(&mesh_.facets[pairs[due[i].pair].second]);
        }
        test_batch(pairs, due.subspan(first, std::min<std::size_t>(lane_count, due.size() - first)), left);
    }
}

void FacingTest::test_batch(std::vector<FacingPair>& pairs, std::span<const FacingCandidate> batch,
                            std::vector<FacingCandidate>& left) const
{
    enum Row {
        gap_row,
        depth_row,
        first_standing,
        second_standing,
        first_sided,
        second_sided,
        has_old,
        old_x,
        old_y,
        old_z,
        alone,
        rows
    };
    alignas(sizeof(Lanes)) double place[rows][lane_count];
    Index corner[2][4][lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
        const FacingCandidate& one = batch[std::min<std::size_t>(lane, batch.size() - 1)];
        const FacingPair& pair = pairs[one.pair];
        const ContactMesh::Facet &a = mesh_.facets[pair.first], &b = mesh_.facets[pair.second];
        for (int i = 0; i < 4; ++i) {
            corner[0][i][lane] = a.corner[i];
            corner[1][i][lane] = b.corner[i];
        }
        place[gap_row][lane] = a.half_thickness + b.half_thickness;
        place[depth_row][lane] = std::max(a.depth, b.depth);
        place[first_standing][lane] = standing_[pair.first];
        place[second_standing][lane] = standing_[pair.second];
        place[first_sided][lane] = a.one_sided;
        place[second_sided][lane] = b.one_sided;
        place[has_old][lane] = one.old != none;
        place[old_x][lane] = one.old_normal.x;
        place[old_y][lane] = one.old_normal.y;
        place[old_z][lane] = one.old_normal.z;
        place[alone][lane] = one.alone;
    }
    const auto row = [&](int number) { return load<Lanes>(place[number]); };
    const auto corners = [&](int of) {
        LaneCorners q;
        for (int i = 0; i < 4; ++i) q[i] = points_in_lanes(motion_.position.data(), corner[of][i]);
        return q;
    };
    const LaneCorners at_a = corners(0), at_b = corners(1);
    const LaneFrame a(at_a), b(at_b);
    const Lanes zero{}, half = broadcast<Lanes>(0.5);
    const Lanes gap = row(gap_row), reach = max(gap, row(depth_row));

    // Distances from the second's plane.
    const Lanes origin = dot(b.middle, b.normal);
    const Extremes off(at_a, b.normal), warp(at_b, b.normal);
    const Lanes warped = max(abs(warp.low - origin), abs(warp.high - origin));
    const Lanes off_by = max(max(off.low - origin, origin - off.high), zero) - warped - reach;

    const LaneMask a_sided = row(first_sided) > zero, b_sided = row(second_sided) > zero;
    const LaneMask both_sided = a_sided & b_sided, shells = ~(a_sided | b_sided), old = row(has_old) > zero;
    const Lanes along = dot(a.normal, b.normal), turn = max(a.turn, b.turn);
    const Lanes cosine = abs(along);
    // Two facets turn towards one another with twice the speed of one.
    const Lanes away = max(both_sided ? along : -half, old ? -half : half - cosine);
    const Lanes face_by = away / (2 * turn);
    const LaneMask turned_away = (both_sided & (along > zero)) | (~old & (cosine <= half));

    const Lanes own = row(first_standing);
    const LaneVec normal =
        scaled_to_unit(row(second_standing) * b.normal + (along < zero ? -own : own) * a.normal);
    // A solid's facet is touched from its outside; which side of a shell it is does not follow from where the
    // two are now.
    const LaneMask from_below = a_sided & (dot(normal, a.normal) > zero);
    const Lanes over_by =
        clearance(at_a, at_b, normal, shells | from_below ? reach : gap, shells | ~from_below ? reach : gap);
    const Lanes aside = clearance_beside(at_a, at_b, normal);
    // The mean of normals that meet at 60 degrees at most turns by 1 / cos 30 of their turn.
    const Lanes aside_by = aside / (1 + 1.1548 * turn * reach);
    // A touch between shells stays on its side, and shells that nothing around has met on that on which they
    // were a step ago. This may change with what the neighbours meet: such a pair stays due.
    const Lanes range = broadcast<Lanes>(motion_.step_range), through = max(gap, range);
    const LaneMask old_below = dot(normal, LaneVec{row(old_x), row(old_y), row(old_z)}) < zero;
    const Lanes above = old ? (old_below ? reach : gap) : through;
    const Lanes below = old ? (old_below ? gap : reach) : through;
    const LaneMask side_known = shells & (old | (row(alone) > zero));
    const LaneMask side_kept = side_known & (clearance(at_a, at_b, normal, above, below) > zero);
    const LaneMask beside = (over_by > zero) | (aside > zero);

    // What follows from directions holds while they are nearly those of now.
    const Lanes held = half / turn;
    const Lanes turned_by = turned_away ? min(face_by, held) : zero;
    const LaneMask boxed = ~turned_away & beside & (cosine > half);
    const Lanes box_by = boxed ? min(max(over_by, aside_by), held) : zero;
    const Lanes free_path = max(off_by, max(turned_by, box_by));
    const unsigned rejected = bits_of((off_by > range) | turned_away | beside | side_kept);
    for (int lane = 0; lane < static_cast<int>(batch.size()); ++lane) {
        FacingCandidate one = batch[lane];
        pairs[one.pair].due = motion_.travelled + free_path[lane];
        if (rejected >> lane & 1) continue;
        const auto at = [&](const LaneVec& v) { return Vec3{v.x[lane], v.y[lane], v.z[lane]}; };
        one.normal = at(normal);
        one.first_normal = at(a.normal);
        one.second_normal = at(b.normal);
        one.along = along[lane];
        left.push_back(one);
    }
}

} // namespace plash

#include "contact/closest_point.h"
#include "contact/facing_test.h"
#include "contact/mean_normal.h"
#include "contact/segment_overlap.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plash {

namespace {

using testing::ContactModel;

constexpr double pi = 3.141592653589793;

/// Pairs of warped quadrilaterals, each pair close together and far from the others.
struct Couples {
    ContactModel built;
    ContactMesh mesh;
    ContactMotion motion;
    std::vector<FacingPair> pairs;
    std::vector<double> standing;

    explicit Couples(int count)
    {
        const Index part = built.add_part(1, 210, 0.2);
        std::mt19937 random(11);
        std::uniform_real_distribution<double> unit(-1, 1);
        for (int couple = 0; couple < count; ++couple) {
            const double turn = pi * unit(random), slant = 0.5 * pi * unit(random);
            const Vec3 offset{0.8 * unit(random), 0.8 * unit(random), 0.6 * unit(random)};
            for (int side = 0; side < 2; ++side) {
                const double c = std::cos(side * turn), s = std::sin(side * turn);
                const double tilt = side * slant * slant * slant; // mostly small
                built.add_sheet(part, 1, 1, [&](double u, double v) {
                    const double x = u - 0.5 + 0.15 * unit(random), y = v - 0.5 + 0.15 * unit(random);
                    const Vec3 flat{c * x - s * y, s * x + c * y, 0.1 * unit(random)};
                    const Vec3 tilted{std::cos(tilt) * flat.x + std::sin(tilt) * flat.z, flat.y,
                                      std::cos(tilt) * flat.z - std::sin(tilt) * flat.x};
                    return Vec3{10.0 * couple, 0, 0} + double(side) * offset + tilted;
                });
            }
        }
        ContactSide all;
        all.kind = ContactSide::Kind::all;
        const Contact contact;
        mesh = make_contact_mesh(contact, make_surface(built.model, part_data(built.model), all, {}), {},
                                 built.model.nodes.position);
        for (const auto& node : mesh.nodes)
            motion.position.own().push_back(built.model.nodes.position[node.node]);
        motion.velocity.own().resize(mesh.nodes.size());
        std::vector<Index> first(count, none);
        for (std::size_t facet = 0; facet < mesh.facets.size(); ++facet) {
            standing.push_back(std::exp(2 * unit(random)));
            const int couple =
                static_cast<int>(std::lround(motion.position[mesh.facets[facet].corner[0]].x / 10));
            if (first[couple] == none) {
                first[couple] = static_cast<Index>(facet);
            } else {
                pairs.push_back({first[couple], static_cast<Index>(facet)});
            }
        }
    }

    SegmentOverlap::Corners corners(Index facet) const
    {
        const auto& at = mesh.facets[facet].corner;
        return {motion.position[at[0]], motion.position[at[1]], motion.position[at[2]],
                motion.position[at[3]]};
    }

    /// On which sides of the second facet's normal a pair counts as touching, by plain geometry.
    /// within  distance below which it does; 0: the thicknesses
    struct Sides {
        bool above = false, below = false;

        bool any() const { return above || below; }
    };
    Sides touches(const FacingPair& pair, double within = 0) const
    {
        const auto a = corners(pair.first), b = corners(pair.second);
        const Vec3 to_a = normal_of(pair.first), to_b = normal_of(pair.second);
        const double along = dot(to_a, to_b);
        if (facing_weight(std::abs(along)) == 0) return {};
        const double own = along < 0 ? -standing[pair.first] : standing[pair.first];
        const Vec3 normal = unit(standing[pair.second] * to_b + own * to_a);
        const ContactMesh::Facet &first = mesh.facets[pair.first], &second = mesh.facets[pair.second];
        const double gap = within > 0 ? within : first.half_thickness + second.half_thickness;
        const double depth = std::max(first.depth, second.depth);
        const SegmentOverlap overlap(a, b, normal, gap);
        if (overlap.empty()) return {};
        const auto touching = [&](double penetration) {
            return penetration > 0 && gap - penetration > -depth;
        };
        return {touching(overlap.deepest()), touching(overlap.deepest_behind())};
    }

    Vec3 normal_of(Index facet) const
    {
        const auto q = corners(facet);
        return segment_normal(SegmentCorners<double>{q[0], q[1], q[2], q[3]}, 0.5, 0.5);
    }

    /// The same pairs with the facets the other way round.
    void swap_facets()
    {
        for (FacingPair& pair : pairs) std::swap(pair.first, pair.second);
    }

    /// Numbers of the pairs that the cheap test leaves; the others are told when they are due.
    /// side   on which all of them touched in the last cycle, along the second normal (1 or -1); 0: none did
    /// alone  nothing around has met either
    std::vector<Index> left(double side = 0, bool alone = false)
    {
        std::vector<FacingCandidate> due(pairs.size()), found;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            due[i].pair = static_cast<Index>(i);
            due[i].alone = alone;
            if (side == 0) continue;
            due[i].old = 0;
            due[i].old_normal = side * normal_of(pairs[i].second);
        }
        FacingTest(mesh, motion, standing).test(pairs, due, found);
        std::vector<Index> numbers;
        for (const FacingCandidate& one : found) numbers.push_back(one.pair);
        return numbers;
    }
};

} // namespace

/// Nothing that touches from either side, in either order, is left out, and most of what does not touch is.
TEST(FacingTest, LeavesAllPairsThatTouchOnEitherSide)
{
    Couples couples(2000);
    for (const char* order : {"as numbered", "swapped"}) {
        const std::vector<Index> left = couples.left();
        int touching = 0;
        for (std::size_t i = 0; i < couples.pairs.size(); ++i) {
            if (!couples.touches(couples.pairs[i]).any()) continue;
            ++touching;
            EXPECT_TRUE(std::binary_search(left.begin(), left.end(), static_cast<Index>(i)))
                << i << ' ' << order;
        }
        EXPECT_GT(touching, 300);
        EXPECT_LT(left.size(), 1.6 * touching);
        couples.swap_facets();
    }
}

/// A pair whose side is known from its own touch stays as long as it touches on that side, whichever facet
/// comes first; the two sides do not leave the same.
TEST(FacingTest, LeavesPairsThatTouchOnTheirSide)
{
    Couples couples(2000);
    for (const char* order : {"as numbered", "swapped"}) {
        EXPECT_NE(couples.left(1), couples.left(-1));
        for (const double side : {1.0, -1.0}) {
            const std::vector<Index> left = couples.left(side);
            int touching = 0;
            for (std::size_t i = 0; i < couples.pairs.size(); ++i) {
                const Couples::Sides sides = couples.touches(couples.pairs[i]);
                if (!(side > 0 ? sides.above : sides.below)) continue;
                ++touching;
                EXPECT_TRUE(std::binary_search(left.begin(), left.end(), static_cast<Index>(i)))
                    << i << ' ' << order << ' ' << side;
            }
            EXPECT_GT(touching, 300);
        }
        couples.swap_facets();
    }
}

/// Shells that met nothing before are looked at where they are closer than their thicknesses or have gone
/// through one another within the step, whichever comes first; of the others fewer are left.
TEST(FacingTest, LeavesShellsThatMeet)
{
    Couples couples(2000);
    for (const char* order : {"as numbered", "swapped"}) {
        couples.motion.step_range = 0;
        const std::size_t unknown = couples.left().size();
        for (const double range : {0.0, 0.3}) {
            couples.motion.step_range = range;
            const std::vector<Index> left = couples.left(0, true);
            EXPECT_LT(left.size(), unknown);
            int close = 0;
            for (std::size_t i = 0; i < couples.pairs.size(); ++i) {
                const Couples::Sides sides = couples.touches(couples.pairs[i], std::max(0.2, range));
                if (!sides.above || !sides.below) continue; // nowhere farther than this apart
                ++close;
                EXPECT_TRUE(std::binary_search(left.begin(), left.end(), static_cast<Index>(i)))
                    << i << ' ' << order << ' ' << range;
            }
            EXPECT_GT(close, 100);
        }
        couples.swap_facets();
    }
}

/// Whatever the nodes do on a path shorter than FacingPair::due, the pair does not come to touch.
TEST(FacingTest, PairsDoNotTouchBeforeTheyAreDue)
{
    Couples couples(2000);
    couples.left();
    const std::vector<Vec3> start = couples.motion.position.own();
    std::mt19937 random(5);
    std::normal_distribution<double> any;
    int waiting = 0;
    for (int trial = 0; trial < 40; ++trial) {
        waiting = 0;
        for (const FacingPair& pair : couples.pairs) {
            if (pair.due <= 0) continue;
            ++waiting;
            // Half the path each; half of the trials bring the facets straight together.
            const Vec3 way =
                couples.corners(pair.second)[trial % 4] - couples.corners(pair.first)[trial / 4 % 4];
            for (const Index facet : {pair.first, pair.second}) {
                for (const Index corner : couples.mesh.facets[facet].corner) {
                    const Vec3 wild{any(random), any(random), any(random)};
                    const Vec3 direct = (facet == pair.first ? 1.0 : -1.0) * way;
                    couples.motion.position.own()[corner] =
                        start[corner] + (0.499 * pair.due) * unit(trial % 2 == 0 ? wild : direct);
                }
            }
            EXPECT_FALSE(couples.touches(pair).any()) << pair.first;
        }
        couples.motion.position.own() = start;
    }
    EXPECT_GT(waiting, 500); // 529: shells have to be clear of one another by the same on both sides
}

/// Two facets that press on one another, a triangle or a parallelogram each.
struct PressedPair {
    std::array<SegmentOverlap::Corners, 2> at;
    double weight[2], rounding = 0, first_share = 0, gap = 0.3;

    explicit PressedPair(std::mt19937& random)
    {
        std::uniform_real_distribution<double> unit(-1, 1);
        for (int of = 0; of < 2; ++of) {
            const Vec3 middle{0.5 * unit(random), 0.5 * unit(random), of == 0 ? 0.1 : 0.0};
            const Vec3 u{0.5, 0.1 * unit(random), 0.12 * unit(random)};
            const Vec3 v{0.1 * unit(random), 0.5, 0.12 * unit(random)};
            const bool triangle = unit(random) < -0.3;
            at[of] = {middle - u - v, middle + u - v, middle + u + v, middle + (triangle ? u : -u) + v};
            if (unit(random) < 0) std::swap(at[of][1], at[of][triangle ? 2 : 3]);
            if (triangle) at[of][3] = at[of][2];
            weight[of] = std::exp(unit(random));
            if (dot(cross(at[of][1] - at[of][0], at[of][2] - at[of][0]), Vec3{0, 0, 1}) < 0)
                weight[of] = -weight[of];
        }
        rounding = 0.05 * std::max(0.0, unit(random));
        first_share = 0.5 + 0.5 * unit(random);
    }

    SegmentOverlap::Load load() const
    {
        const MeanNormal mean(at[0], weight[0], at[1], weight[1]);
        const SegmentOverlap overlap(at[0], at[1], mean.direction(), gap);
        SegmentOverlap::Load load = overlap.load({7, 0.05, rounding, 1.2, 0.8, first_share});
        mean.add_turning(load.moment, load.on_first, load.on_second);
        return load;
    }
};

/// The forces of a pair are the gradient of its energy: whatever both facets do, moved, turned, stretched or
/// sheared, they do the work by which it falls; and they add up to no force and no moment.
TEST(SegmentOverlap, ForcesAreTheGradientOfTheEnergy)
{
    std::mt19937 random(3);
    std::normal_distribution<double> any;
    int pressed = 0;
    for (int trial = 0; trial < 400; ++trial) {
        PressedPair pair(random);
        const SegmentOverlap::Load load = pair.load();
        if (load.energy < 1e-3) continue;
        ++pressed;
        const std::array<Vec3, 4>* forces[2] = {&load.on_first, &load.on_second};
        Vec3 sum{}, moment{};
        std::array<SegmentOverlap::Corners, 2> way{};
        double work = 0, size = 0;
        for (int of = 0; of < 2; ++of) {
            const Vec3 shift{any(random), any(random), any(random)};
            Vec3 row[3];
            for (Vec3& one : row) one = {any(random), any(random), any(random)};
            for (int i = 0; i < 4; ++i) {
                const Vec3 &force = (*forces[of])[i], &place = pair.at[of][i];
                way[of][i] = shift + Vec3{dot(row[0], place), dot(row[1], place), dot(row[2], place)};
                sum += force;
                moment += cross(place, force);
                work += dot(force, way[of][i]);
                size += norm(force) * norm(way[of][i]);
            }
        }
        EXPECT_LT(norm(sum), 1e-13 * size);
        EXPECT_LT(norm(moment), 1e-13 * size);
        const double step = 1e-5;
        double energy[2];
        for (const int sign : {0, 1}) {
            PressedPair moved = pair;
            for (int of = 0; of < 2; ++of)
                for (int i = 0; i < 4; ++i) moved.at[of][i] += (sign == 0 ? -step : step) * way[of][i];
            energy[sign] = moved.load().energy;
        }
        // The rounded law is no polynomial of second order: three points a triangle.
        EXPECT_NEAR((energy[0] - energy[1]) / (2 * step), work, (pair.rounding > 0 ? 3e-2 : 1e-6) * size)
            << trial;
    }
    EXPECT_GT(pressed, 200);
}

} // namespace plash

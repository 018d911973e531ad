#include "contact/closest_point.h"
#include "contact/touch.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

#include <omp.h>
#include <random>

namespace plash {

namespace {

using testing::ContactModel;

struct Scenery {
    ContactModel built;
    ContactMesh mesh;
    ContactMotion motion;

    void finish(Contact::Kind kind = Contact::Kind::single_surface)
    {
        ContactSide side;
        side.kind = ContactSide::Kind::all;
        Contact contact;
        contact.kind = kind;
        SurfaceOptions options;
        mesh = make_contact_mesh(contact, make_surface(built.model, part_data(built.model), side, options),
                                 {}, built.model.nodes.position);
        motion.velocity.own().resize(mesh.nodes.size());
        for (const auto& node : mesh.nodes)
            motion.position.own().push_back(built.model.nodes.position[node.node]);
    }

    std::vector<Touch> touches() const
    {
        PairSearch search(mesh, built.model.solids.nodes);
        search.update(mesh, motion);
        TouchTable table;
        table.set_owners(search.pairs().owner);
        TouchFinder::Room room;
        TouchFinder(mesh, motion, false).find(search.pairs(), 0, table.owners(), table, room);
        return table.list(mesh, motion).all;
    }
};

/// Crumpled sheets in a heap: every kind of neighbourhood.
Scenery heap(int sheets, int cells)
{
    Scenery scenery;
    const Index part = scenery.built.add_part(1, 210, 0.3);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> jitter(-0.3, 0.3);
    for (int sheet = 0; sheet < sheets; ++sheet) {
        const double turn = 0.7 * sheet;
        scenery.built.add_sheet(part, cells, cells, [&](double u, double v) {
            const double x = cells * (u - 0.5), y = cells * (v - 0.5);
            return Vec3{x * std::cos(turn) + jitter(random), y + jitter(random),
                        x * std::sin(turn) + sheet + jitter(random)};
        });
    }
    scenery.finish();
    return scenery;
}

} // namespace

TEST(ContactSearch, FindsExactlyThePairsWithinReach)
{
    const Scenery scenery = heap(4, 12);
    PairSearch search(scenery.mesh, scenery.built.model.solids.nodes);
    search.update(scenery.mesh, scenery.motion);
    const PairList& pairs = search.pairs();
    std::vector<std::pair<Index, Index>> found, expected;
    for (std::size_t i = 0; i < pairs.node.size(); ++i) found.push_back({pairs.node[i], pairs.facet[i]});
    for (std::size_t n = 0; n < scenery.mesh.nodes.size(); ++n) {
        for (std::size_t f = 0; f < scenery.mesh.facets.size(); ++f) {
            const auto& facet = scenery.mesh.facets[f];
            const auto& c = facet.corner;
            if (std::find(c.begin(), c.end(), static_cast<Index>(n)) != c.end()) continue;
            const auto& p = scenery.motion.position;
            const auto point =
                closest_point(p[n], SegmentCorners<double>{p[c[0]], p[c[1]], p[c[2]], p[c[3]]});
            const double reach =
                std::max(scenery.mesh.nodes[n].half_thickness + facet.half_thickness, facet.depth) +
                search.margin();
            if (std::sqrt(point.distance2) <= reach) {
                expected.push_back({static_cast<Index>(n), static_cast<Index>(f)});
            }
        }
    }
    EXPECT_GT(found.size(), 1000u);
    EXPECT_EQ(found, expected);
}

TEST(ContactSearch, SearchesWhenNodesHaveMovedByTheMarginRelativeToOneAnother)
{
    Scenery scenery = heap(2, 6);
    PairSearch search(scenery.mesh, scenery.built.model.solids.nodes);
    ContactMotion& motion = scenery.motion;
    const auto searched_after = [&](double path, double step) {
        motion.travelled += path;
        motion.step_range = step;
        search.update(scenery.mesh, motion);
        return search.searches();
    };
    EXPECT_EQ(searched_after(0, 0), 1) << "nothing had been searched before";
    for (Vec3& place : motion.position.own()) place += {1000, 50, 3};
    EXPECT_EQ(searched_after(100, 0), 1) << "moving as a whole is not relative motion";
    motion.position.own()[5].y += 0.9 * search.margin();
    EXPECT_EQ(searched_after(0.9 * search.margin(), 0), 1);
    EXPECT_EQ(searched_after(0, 0.2 * search.margin()), 2) << "the next step may leave the margin";
    motion.position.own()[5].y += 1.1 * search.margin();
    EXPECT_EQ(searched_after(1.1 * search.margin(), 0), 3);
}

TEST(ContactSearch, DoesNotDependOnTheNumberOfThreads)
{
    const Scenery scenery = heap(6, 40);
    const int threads = omp_get_max_threads();
    std::vector<Touch> one, many;
    omp_set_num_threads(1);
    one = scenery.touches();
    omp_set_num_threads(3);
    many = scenery.touches();
    omp_set_num_threads(threads);
    ASSERT_GT(one.size(), 100u);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].node, many[i].node);
        EXPECT_EQ(one[i].facet, many[i].facet);
        EXPECT_EQ(one[i].penetration, many[i].penetration);
    }
}

/// A sheet as thick as three elements does not touch itself, flat or bent over a radius larger than its
/// thickness.
TEST(ContactTouch, NeighboursInAThickSheetDoNotTouch)
{
    for (const double bend : {0.0, 0.05, 0.15}) {
        Scenery scenery;
        const Index part = scenery.built.add_part(1, 210, 3.0);
        scenery.built.add_sheet(part, 20, 8, [&](double u, double v) {
            const double x = 20 * (u - 0.5);
            if (bend == 0) return Vec3{x, 8 * v, 0};
            return Vec3{std::sin(bend * x) / bend, 8 * v, (1 - std::cos(bend * x)) / bend};
        });
        scenery.finish();
        EXPECT_EQ(scenery.touches().size(), 0u) << bend;
    }
}

/// Over a roof (convex ridge), past its free edges and over a valley, the penetration of a node is the
/// thickness less the true distance to the surface: continuous, without holes and without doubling on the
/// ridge.
TEST(ContactTouch, PenetrationFollowsTheDistanceAcrossARidge)
{
    for (const double slope : {0.8, -0.2}) {
        Scenery scenery;
        const Index part = scenery.built.add_part(1, 210, 1.0);
        scenery.built.add_sheet(part, 4, 4, [&](double u, double v) {
            const double x = 4 * (u - 0.5);
            return Vec3{x, 4 * (v - 0.5), -slope * std::abs(x)};
        });
        const Index probe = scenery.built.add_node({0, 0, 0});
        scenery.built.add_shell(part,
                                {probe, scenery.built.add_node({0, 0, 50}),
                                 scenery.built.add_node({0, 1, 50}), scenery.built.add_node({0, 1, 51})});
        scenery.finish();
        Index number = none;
        for (std::size_t i = 0; i < scenery.mesh.nodes.size(); ++i) {
            if (scenery.mesh.nodes[i].node == probe) number = static_cast<Index>(i);
        }
        for (double x = -2.5; x <= 2.5; x += 0.01) {
            // Height of 0.4 over the roof, measured along z; y not on a node line.
            const Vec3 place{x, 0.13, -slope * std::min(std::abs(x), 2.0) + 0.4};
            scenery.motion.position.own()[number] = place;
            double distance = 1e9;
            for (const auto& facet : scenery.mesh.facets) {
                const auto& c = facet.corner;
                if (std::find(c.begin(), c.end(), number) != c.end()) continue;
                const auto& p = scenery.motion.position;
                const SegmentCorners<double> corners{p[c[0]], p[c[1]], p[c[2]], p[c[3]]};
                distance = std::min(distance, std::sqrt(closest_point(place, corners).distance2));
            }
            int count = 0;
            for (const Touch& touch : scenery.touches()) {
                if (touch.node != number) continue;
                ++count;
                EXPECT_NEAR(touch.penetration, 1.0 - distance, 1e-10) << "x " << x << " slope " << slope;
            }
            EXPECT_EQ(count, distance < 1 ? 1 : 0) << "x " << x << " slope " << slope;
        }
    }
}

TEST(ContactTouch, ACornerOfARoomHoldsANodeFromThreeSides)
{
    Scenery scenery;
    const Index part = scenery.built.add_part(1, 210, 0.4);
    scenery.built.add_sheet(part, 4, 4, [](double u, double v) { return Vec3{4 * u, 4 * v, 0}; });
    scenery.built.add_sheet(part, 4, 4, [](double u, double v) { return Vec3{4 * u, 0, 4 * v}; });
    scenery.built.add_sheet(part, 4, 4, [](double u, double v) { return Vec3{0, 4 * u, 4 * v}; });
    const Index probe = scenery.built.add_node({0.3, 0.3, 0.3});
    scenery.built.add_shell(part,
                            {probe, scenery.built.add_node({40, 40, 40}),
                             scenery.built.add_node({41, 40, 40}), scenery.built.add_node({41, 41, 40})});
    scenery.finish();
    Vec3 normals{};
    int count = 0;
    for (const Touch& touch : scenery.touches()) {
        if (scenery.mesh.nodes[touch.node].node != probe) continue;
        normals += touch.normal;
        EXPECT_NEAR(touch.penetration, 0.1, 1e-12);
        ++count;
    }
    EXPECT_EQ(count, 3);
    EXPECT_NEAR(norm(normals - Vec3{1, 1, 1}), 0, 1e-12);
}

/// A node that flies through a whole plate within one step is pushed back to where it came from.
TEST(ContactTouch, APlatePassedInOneStepIsNoticed)
{
    Scenery scenery;
    const Index part = scenery.built.add_part(1, 210, 0.2);
    scenery.built.add_sheet(part, 4, 4, [](double u, double v) { return Vec3{4 * u, 4 * v, 0}; });
    const Index probe = scenery.built.add_node({1.3, 1.6, -0.15});
    scenery.built.add_shell(part, {probe, scenery.built.add_node({1, 1, 50}),
                                   scenery.built.add_node({2, 1, 50}), scenery.built.add_node({1, 2, 50})});
    scenery.finish();
    for (std::size_t i = 0; i < scenery.mesh.nodes.size(); ++i) {
        if (scenery.mesh.nodes[i].node == probe) scenery.motion.velocity.own()[i] = {0, 0, -5};
    }
    scenery.motion.last_step = 0.1;
    scenery.motion.step_range = 0.5;
    const auto touches = scenery.touches();
    ASSERT_EQ(touches.size(), 1u);
    EXPECT_NEAR(touches[0].normal.z, 1, 1e-12);
    EXPECT_NEAR(touches[0].penetration, 0.35, 1e-12);
    EXPECT_EQ(touches[0].baseline, 0);
}

} // namespace plash

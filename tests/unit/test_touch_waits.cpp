#include "contact/surface_contact.h"
#include "contact/touch.h"
#include "tests/support/contact_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

namespace plash {

namespace {

using testing::ContactModel;

/// A contact of one surface over all of a Model, whose nodes are moved by hand.
struct Moved {
    ContactModel built;
    ContactMesh mesh;
    ContactMotion motion;
    std::vector<Index> number; ///< of the mesh by Model node

    void finish()
    {
        ContactSide side;
        side.kind = ContactSide::Kind::all;
        const Contact contact;
        mesh = make_contact_mesh(contact, make_surface(built.model, part_data(built.model), side, {}), {},
                                 built.model.nodes.position);
        motion.velocity.own().resize(mesh.nodes.size());
        number.resize(built.model.nodes.size(), none);
        for (const auto& node : mesh.nodes) {
            number[node.node] = static_cast<Index>(motion.position.size());
            motion.position.own().push_back(built.model.nodes.position[node.node]);
        }
    }

    /// One step with the velocities as they are.
    void advance(double step)
    {
        for (std::size_t i = 0; i < motion.position.size(); ++i)
            motion.position.own()[i] += step * motion.velocity[i];
        motion.follow(step);
    }
};

/// Search, pairs and touches from cycle to cycle. Quiet nodes are another matter: none is.
struct Followed {
    PairSearch search;
    TouchTable table;
    TouchFinder::Room room;
    long searches = 0;

    explicit Followed(const Moved& moved) : search(moved.mesh, moved.built.model.solids.nodes) {}

    PairList& pairs() { return search.pairs(); }
    /// all: every pair is looked at, whatever it waits for
    void find(const Moved& moved, bool all = false)
    {
        search.update(moved.mesh, moved.motion);
        if (searches != search.searches()) table.set_owners(pairs().owner);
        searches = search.searches();
        std::fill(pairs().quiet.begin(), pairs().quiet.end(), 0);
        if (all) {
            std::fill(pairs().due.begin(), pairs().due.end(), 0);
            std::fill(pairs().others_due.begin(), pairs().others_due.end(), 0);
        }
        TouchFinder(moved.mesh, moved.motion, false).find(pairs(), 0, table.owners(), table, room);
    }
    std::size_t waiting()
    {
        std::size_t count = 0;
        for (std::size_t owner = 0; owner < pairs().owner.size(); ++owner)
            for (Index pair = pairs().begin[owner]; pair < pairs().begin[owner + 1]; ++pair)
                count += pairs().due[pair] > pairs().paths.now(owner);
        return count;
    }
    /// Path from now on before which a pair is not looked at.
    double wait(Index node, Index facet)
    {
        const auto owner =
            std::lower_bound(pairs().owner.begin(), pairs().owner.end(), node) - pairs().owner.begin();
        for (std::size_t pair = 0; pair < pairs().node.size(); ++pair)
            if (pairs().node[pair] == node && pairs().facet[pair] == facet)
                return pairs().due[pair] - pairs().paths.travelled(owner);
        ADD_FAILURE() << "no pair of node " << node << " and facet " << facet;
        return 0;
    }
};

/// Sheets that are thin beside their elements, and cubes of solids between them, fly through one another.
Moved heap(bool solids)
{
    Moved moved;
    const Index sheet = moved.built.add_part(1, 210, 0.05), block = moved.built.add_part(1, 210, 0);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    std::vector<Vec3> drift, spin;
    std::vector<std::size_t> end;
    for (int body = 0; body < 5; ++body) {
        if (solids && body % 2 == 0) {
            moved.built.add_block(block, {-2, -2, 0.9 * body}, {2, 2, 0.9 * body + 0.8}, {4, 4, 1});
        } else {
            moved.built.add_sheet(sheet, 6, 6, [&](double u, double v) {
                return Vec3{6 * u - 3 + jitter(random), 6 * v - 3 + jitter(random),
                            0.9 * body + 0.4 * jitter(random)};
            });
        }
        end.push_back(moved.built.model.nodes.size());
        drift.push_back({jitter(random), jitter(random), body % 2 ? -0.5 : 0.5});
        spin.push_back({0.5 * jitter(random), 0.5 * jitter(random), jitter(random)});
    }
    moved.finish();
    for (std::size_t body = 0, node = 0; body < end.size(); ++body)
        for (; node < end[body]; ++node)
            moved.motion.velocity.own()[moved.number[node]] =
                drift[body] + cross(spin[body], moved.built.model.nodes.position[node]) +
                0.2 * Vec3{jitter(random), jitter(random), jitter(random)};
    return moved;
}

/// A probe 0.2 over (or under) a flat sheet of 8 x 2 facets in z = 0, over the facet at the origin.
struct ProbeOverSheet : Moved {
    Index probe, near_facet = none, beside = none, far = none;

    ProbeOverSheet()
    {
        const Index sheet = built.add_part(1, 210, 0.01), other = built.add_part(1, 210, 0.02);
        built.add_sheet(sheet, 8, 2, [](double u, double v) { return Vec3{8 * u - 0.5, 2 * v - 0.5, 0}; });
        probe = built.add_node({0, 0, 0.2});
        built.add_shell(other, {probe, built.add_node({0, 0, 50}), built.add_node({0, 1, 50}),
                                built.add_node({1, 0, 50})});
        finish();
        probe = number[probe];
        for (std::size_t facet = 0; facet < mesh.facets.size(); ++facet) {
            const auto& corner = mesh.facets[facet].corner;
            const Vec3 middle = 0.5 * (motion.position[corner[0]] + motion.position[corner[2]]);
            if (norm(middle) < 1e-9) near_facet = static_cast<Index>(facet);
            if (norm(middle - Vec3{1, 0, 0}) < 1e-9) beside = static_cast<Index>(facet);
            if (norm(middle - Vec3{2, 0, 0}) < 1e-9) far = static_cast<Index>(facet);
        }
    }
};

/// A node rests on a sheet in front of another, in a contact of both surfaces; what touches is told cycle by
/// cycle.
struct NodeOnTwoSheets {
    ContactModel mesh;
    Index upper, lower, other, probe;
    std::size_t first_lower;
    State state;
    Clock clock;
    std::optional<SurfaceContact> term;

    /// The node stands `height` over the upper sheet, whose thickness and the node's are 0.1; the lower one
    /// lies `behind` it.
    NodeOnTwoSheets(double height, double behind, double lower_thickness)
    {
        upper = mesh.add_part(1, 210, 0.1);
        lower = mesh.add_part(1, 210, lower_thickness);
        other = mesh.add_part(1, 210, 0.1);
        const auto sheet = [&](Index part, double z) {
            return mesh.add_sheet(part, 4, 4, [&](double u, double v) {
                return Vec3{4 * u - 2.4, 4 * v - 2.4, z};
            });
        };
        sheet(upper, 0);
        first_lower = static_cast<std::size_t>(sheet(lower, -behind));
        probe = mesh.add_node({0, 0, height});
        mesh.add_shell(
            other, {probe, mesh.add_node({0, 0, 50}), mesh.add_node({0, 1, 50}), mesh.add_node({1, 0, 50})});
        Contact contact;
        contact.kind = Contact::Kind::two_way;
        contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
        contact.slave.parts = {other};
        contact.master.parts = {upper, lower};
        contact.limit_thickness = false;
        mesh.model.contacts.push_back(contact);
        state = mesh.state();
        clock.step = clock.last_step = 0.01;
        term.emplace(mesh.model.contacts[0], mesh.model, part_data(mesh.model));
    }

    std::vector<Touch> cycle(double probe_falls, double upper_falls)
    {
        for (std::size_t i = 0; i < first_lower; ++i) state.velocity[i].z = -upper_falls / clock.step;
        state.velocity[probe].z = -probe_falls / clock.step;
        for (std::size_t i = 0; i < state.size(); ++i) state.position[i] += clock.step * state.velocity[i];
        state.clear_forces();
        term->add_forces(clock, state);
        clock.time += clock.step;
        return term->touches().all;
    }
    Index part_of(const Touch& touch) const { return term->mesh().facets[touch.facet].part; }
};

} // namespace

/// A thin sheet is touched within the thicknesses, 0.005 + 0.01; behind its plane it holds, as deep as a
/// quarter of the diagonal, what touched it or a facet beside it.
TEST(TouchWaits, SheetsReachBehindTheirPlaneOnlyForWhatTouchedThemOrTheirNeighbours)
{
    const ProbeOverSheet set;
    const double gap = 0.015;
    Followed followed(set);
    followed.find(set);
    EXPECT_NEAR(followed.wait(set.probe, set.near_facet), 0.2 - gap, 1e-14);
    EXPECT_NEAR(followed.wait(set.probe, set.beside), std::hypot(0.5, 0.2) - gap, 1e-14);
    const auto owners = followed.pairs().owner;
    const auto owner = std::lower_bound(owners.begin(), owners.end(), set.probe) - owners.begin();
    const auto with_touch_of = [&](Index facet, Index asked) {
        Touch touch;
        touch.node = set.probe;
        touch.facet = facet;
        touch.normal = {0, 0, -1};
        touch.penetration = 0.215;
        followed.table.put(owner, {{touch}});
        followed.find(set, true);
        return followed.wait(set.probe, asked);
    };
    const double depth = std::sqrt(2.0) / 4;
    EXPECT_NEAR(with_touch_of(set.near_facet, set.near_facet), 0.2 - depth, 1e-14) << "it touches";
    EXPECT_EQ(with_touch_of(set.beside, set.near_facet), 0) << "from another facet all is looked at anew";
    ASSERT_EQ(followed.table.count(owner), 1);
    EXPECT_EQ(followed.table.facets(0)[owner], set.near_facet) << "it slides over the common edge";
    EXPECT_NEAR(with_touch_of(set.far, set.near_facet), 0.2 - gap, 1e-14);
    EXPECT_EQ(followed.table.count(owner), 0);
}

/// In front of a solid's face a node waits for the thickness; behind it for the depth if the node touches
/// anything, else for the tenth of it in which nodes count as having just come in; beside it for the overhang
/// of 0.025 of the side.
TEST(TouchWaits, SolidsReachOutwardByTheThicknessAndInwardByTheirDepth)
{
    for (const double height : {0.3, -0.3}) {
        Moved set;
        const Index block = set.built.add_part(1, 210, 0), other = set.built.add_part(1, 210, 0.02);
        set.built.add_block(block, {-1, -1, -2}, {1, 1, 0}, {2, 2, 2});
        Index probe = set.built.add_node({0.4, 0.4, height});
        set.built.add_shell(other, {probe, set.built.add_node({0, 0, 50}), set.built.add_node({0, 1, 50}),
                                    set.built.add_node({1, 0, 50})});
        set.finish();
        set.motion.last_step = 0.01; // not the first cycle
        probe = set.number[probe];
        Index top = none, next = none;
        for (std::size_t facet = 0; facet < set.mesh.facets.size(); ++facet) {
            const auto& corner = set.mesh.facets[facet].corner;
            const Vec3 middle = 0.5 * (set.motion.position[corner[0]] + set.motion.position[corner[2]]);
            if (norm(middle - Vec3{0.5, 0.5, 0}) < 1e-9) top = static_cast<Index>(facet);
            if (norm(middle - Vec3{-0.5, 0.5, 0}) < 1e-9) next = static_cast<Index>(facet);
        }
        const double gap = 0.01, depth = set.mesh.facets[top].depth, overhang = 0.025 - gap;
        EXPECT_NEAR(depth, 0.5, 1e-12) << "half of volume / area";
        Followed followed(set);
        followed.find(set);
        if (height > 0) {
            EXPECT_NEAR(followed.wait(probe, top), 0.3 - gap, 1e-14);
            // Over the next facet it would have to come down and across.
            EXPECT_NEAR(followed.wait(probe, next),
                        std::min(0.4 - overhang, std::hypot(0.4, 0.3) - 0.1 * depth), 1e-14);
            continue;
        }
        EXPECT_NEAR(followed.wait(probe, top), 0.3 - 0.1 * depth, 1e-14) << "it did not come in here";
        const auto& owners = followed.pairs().owner;
        const auto owner = std::lower_bound(owners.begin(), owners.end(), probe) - owners.begin();
        Touch touch;
        touch.node = probe;
        touch.facet = top;
        touch.normal = {0, 0, 1};
        touch.penetration = 0.31;
        followed.table.put(owner, {{touch}});
        followed.find(set, true);
        EXPECT_NEAR(followed.wait(probe, top), 0.3 - depth, 1e-14) << "it touches";
    }
}

/// A node touches the top of one block; that of another in the same place lies lower by some height. The
/// touch holds off the second until it can have become the closer one: either distance changes by no more
/// than the path. One that stands over both, touching nothing, may begin in any step.
TEST(TouchWaits, TouchHoldsOffFacesInItsPlaneUntilTheyMayBeCloser)
{
    const double step = 1e-8;
    struct Case {
        double penetration, lower;
    };
    for (const Case& one : {Case{2e-3, 1e-3}, Case{2e-3, 1e-5}, Case{1e-9, 2e-9}, Case{-1e-9, 2e-9}}) {
        Moved set;
        const Index block = set.built.add_part(1, 210, 0), other = set.built.add_part(1, 210, 0.02);
        set.built.add_block(block, {-1, -1, -2}, {1, 1, 0}, {2, 2, 2});
        set.built.add_block(block, {-0.9, -0.9, -2}, {1.1, 1.1, -one.lower}, {2, 2, 2});
        Index probe = set.built.add_node({0.4, 0.4, 0.01 - one.penetration});
        set.built.add_shell(other, {probe, set.built.add_node({0, 0, 50}), set.built.add_node({0, 1, 50}),
                                    set.built.add_node({1, 0, 50})});
        set.finish();
        probe = set.number[probe];
        set.motion.velocity.own()[probe] = {step, 0, 0};
        set.motion.follow(1);
        Followed followed(set);
        followed.find(set);
        const PairList& pairs = followed.pairs();
        const auto owner =
            std::lower_bound(pairs.owner.begin(), pairs.owner.end(), probe) - pairs.owner.begin();
        followed.find(set);
        ASSERT_EQ(followed.table.count(owner), one.penetration > 0 ? 1 : 0);
        if (one.penetration > step) {
            EXPECT_NEAR(pairs.quiet[owner] - pairs.paths.travelled(owner), one.lower / 2, 1e-12);
        } else {
            EXPECT_LE(pairs.quiet[owner], pairs.paths.now(owner));
        }
    }
}

/// A pair that waits for a path does not touch after any motion that is shorter: blocks with bumpy faces,
/// beside, over and within one another, are shifted as a whole. Touches of rims from behind are among them,
/// in the valleys of the faces.
TEST(TouchWaits, NoPairTouchesBeforeItsPath)
{
    Moved moved;
    const Index part = moved.built.add_part(1, 210, 0);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> jitter(-1, 1);
    std::vector<std::size_t> end;
    for (int body = 0; body < 12; ++body) {
        const Vec3 low{1.5 * (body % 3) + 0.3 * jitter(random), 1.5 * (body / 3 % 2) + 0.3 * jitter(random),
                       0.7 * (body / 6) + 0.1 * jitter(random)};
        moved.built.add_block(part, low, low + Vec3{1.5, 1.5, 0.6}, {3, 3, 1});
        end.push_back(moved.built.model.nodes.size());
    }
    for (Vec3& place : moved.built.model.nodes.position)
        place += 0.1 * Vec3{jitter(random), jitter(random), jitter(random)};
    moved.finish();
    Followed waits(moved);
    waits.find(moved);
    const PairList& pairs = waits.pairs();
    const std::vector<double> due = pairs.due;
    const NodeVectors start = moved.motion.position;
    std::size_t tested = 0, rims = 0;
    for (const double path : {0.03, 0.1, 0.3, 0.6}) {
        for (int round = 0; round < 100; ++round) {
            for (std::size_t body = 0, node = 0; body < end.size(); ++body) {
                Vec3 shift{jitter(random), jitter(random), jitter(random)}; // in a ball as wide as the path
                shift = (0.5 * path / std::max(1.0, norm(shift))) * shift;
                for (; node < end[body]; ++node)
                    if (moved.number[node] != none)
                        moved.motion.position.own()[moved.number[node]] = start[moved.number[node]] + shift;
            }
            Followed looks(moved);
            looks.find(moved, true);
            for (const Touch& touch : looks.table.list(moved.mesh, moved.motion).all) {
                const auto [first, last] = std::equal_range(pairs.node.begin(), pairs.node.end(), touch.node);
                for (auto node = first; node != last; ++node) {
                    const std::size_t pair = node - pairs.node.begin();
                    if (pairs.facet[pair] != touch.facet) continue;
                    EXPECT_LT(due[pair], path) << touch.node << " " << touch.facet;
                }
                ++tested;
                rims += std::min({touch.s, 1 - touch.s, touch.t, 1 - touch.t}) == 0;
            }
        }
    }
    EXPECT_GT(tested, 10000u);
    EXPECT_GT(rims, 500u);
    EXPECT_GT(std::count_if(due.begin(), due.end(), [](double one) { return one > 0; }), 0.5 * due.size());
}

/// Inside a block, below a valley of its faces, the edge at the bottom is touched from behind as soon as it
/// is closer than the faces beside it. From under one of them that is a short way, far shorter than the one
/// to the face beyond the edge: nothing but the wait at rims bounds it.
TEST(TouchWaits, RimsOfValleysAreNotTouchedBeforeTheirPath)
{
    std::size_t waited = 0;
    for (const double angle : {1.0, 3.0, 10.0, 20.0}) { // off the plane in which edge and face are as close
        for (const double radius : {0.1, -0.1, 0.2, -0.2, 0.4, -0.4}) { // below either face
            Moved set;
            const Index block = set.built.add_part(1, 210, 0), other = set.built.add_part(1, 210, 0);
            set.built.add_block(block, {-1, -1, -2}, {1, 1, 0}, {2, 2, 1});
            for (Vec3& place : set.built.model.nodes.position)
                if (std::abs(place.x) < 1e-9 && place.z > -1) place.z = -1;
            const Vec3 edge{0, 0.4, -1};
            const auto below = [&](double degrees) { // 45: where edge and face are as close
                const double turn = (45 + degrees) * std::numbers::pi / 180;
                return edge + Vec3{radius * std::sin(turn), 0, -std::abs(radius) * std::cos(turn)};
            };
            Index probe = set.built.add_node(below(angle));
            set.built.add_shell(other, {probe, set.built.add_node({0, 0, 50}), set.built.add_node({0, 1, 50}),
                                        set.built.add_node({1, 0, 50})});
            set.finish();
            probe = set.number[probe];
            Followed waits(set);
            waits.find(set);
            waits.find(set); // the touch of the first cycle had all be looked at anew
            for (const double past : {0.02, 0.5, 10.0}) {
                set.motion.position.own()[probe] = below(-past);
                const double path = norm(below(-past) - below(angle));
                Followed looks(set);
                looks.find(set, true);
                for (const Touch& touch : looks.table.list(set.mesh, set.motion).all) {
                    if (touch.node != probe) continue;
                    EXPECT_LT(waits.wait(probe, touch.facet), path) << angle << " " << radius << " " << past;
                    waited += waits.wait(probe, touch.facet) > 0;
                }
            }
        }
    }
    EXPECT_GT(waited, 20u) << "pairs that were told to wait at all";
}

/// What moves here is no path of what is there: pairs of the far body wait on, and go on with the same
/// touches.
TEST(TouchWaits, PathsAreThoseOfTheNeighbourhood)
{
    Moved moved;
    const Index part = moved.built.add_part(1, 210, 0);
    for (const double x : {0.0, 1000.0}) {
        moved.built.add_block(part, {x, 0, 0}, {x + 20, 20, 1}, {20, 20, 1});
        moved.built.add_block(part, {x, 0, 1.5}, {x + 20, 20, 2.5}, {20, 20, 1});
    }
    moved.finish();
    for (std::size_t i = 0; i < moved.motion.position.size(); ++i)
        if (moved.motion.position[i].x < 500 && moved.motion.position[i].z > 1.2)
            moved.motion.velocity.own()[i] = {0, 0, -0.1};
    Followed followed(moved);
    followed.find(moved);
    moved.advance(1);
    followed.find(moved);
    const PairList& pairs = followed.pairs();
    const std::size_t last = pairs.owner.size() - 1;
    ASSERT_LT(moved.motion.position[pairs.owner[0]].x, 500);
    ASSERT_GT(moved.motion.position[pairs.owner[last]].x, 500);
    EXPECT_EQ(pairs.paths.travelled(0), 0.1);
    EXPECT_EQ(pairs.paths.travelled(last), 0);
}

/// Waiting changes nothing but the work: bodies that fly through one another touch as if every pair were
/// looked at in every cycle.
TEST(TouchWaits, NoTouchIsMissed)
{
    for (const bool solids : {false, true}) {
        Moved moved = heap(solids);
        Followed waits(moved), looks(moved);
        std::size_t touches = 0, waiting = 0, pairs = 0;
        for (int cycle = 0; cycle < 500; ++cycle) {
            waits.find(moved);
            looks.find(moved, true);
            const std::vector<Touch> one = waits.table.list(moved.mesh, moved.motion).all;
            const std::vector<Touch> all = looks.table.list(moved.mesh, moved.motion).all;
            ASSERT_EQ(one.size(), all.size()) << "cycle " << cycle << ", solids " << solids;
            for (std::size_t i = 0; i < one.size(); ++i) {
                EXPECT_EQ(one[i].node, all[i].node);
                EXPECT_EQ(one[i].facet, all[i].facet);
                EXPECT_EQ(one[i].penetration, all[i].penetration);
                EXPECT_EQ(one[i].baseline, all[i].baseline);
            }
            touches += one.size();
            waiting += waits.waiting();
            pairs += waits.pairs().node.size();
            moved.advance(0.005);
        }
        EXPECT_GT(touches, 2000u) << solids;
        EXPECT_GT(waiting, 0.8 * pairs) << solids;
    }
}

/// Beside the rim of a foil a touch turns around the edge: at an angle of 2.4 degrees off the normal the
/// plane is closer by 9e-4 of the distance. Nothing moves, and no touch gets deeper by that it is followed.
TEST(QuietNodes, AreNotPressedByBeingFollowed)
{
    const double distance = 0.012, gap = 0.015;
    for (const double degrees : {0.0, 0.5, 1.5, 2.4}) {
        Moved set;
        const Index sheet = set.built.add_part(1, 210, 0.01), other = set.built.add_part(1, 210, 0.02);
        set.built.add_sheet(sheet, 4, 4, [](double u, double v) { return Vec3{4 * u - 4, 4 * v - 2.4, 0}; });
        const double angle = degrees * std::numbers::pi / 180;
        Index probe = set.built.add_node({distance * std::sin(angle), 0, distance * std::cos(angle)});
        set.built.add_shell(other, {probe, set.built.add_node({0, 0, 50}), set.built.add_node({0, 1, 50}),
                                    set.built.add_node({1, 0, 50})});
        set.finish();
        set.motion.follow(1);
        PairSearch search(set.mesh, set.built.model.solids.nodes);
        TouchTable table;
        TouchFinder::Room room;
        for (int cycle = 0; cycle < 4; ++cycle) {
            search.update(set.mesh, set.motion);
            if (cycle == 0) table.set_owners(search.pairs().owner);
            TouchFinder(set.mesh, set.motion, false).find(search.pairs(), 0, table.owners(), table, room);
            std::size_t found = 0;
            for (const Touch& touch : table.list(set.mesh, set.motion).all) {
                if (touch.node != set.number[probe]) continue;
                ++found;
                EXPECT_NEAR(touch.penetration, gap - distance, 1e-9) << degrees << ", cycle " << cycle;
            }
            EXPECT_EQ(found, 1u) << degrees << ", cycle " << cycle;
        }
    }
}

/// A node rests on a sheet, and half as deep in another right behind it, which the first holds off. Where the
/// first gives way within one step, the second takes the node over in that cycle, with all that presses.
TEST(QuietNodes, AreTakenOverByWhatTheirTouchHeldOff)
{
    const double behind = 5e-4;
    NodeOnTwoSheets set(0.1 + 5e-4, behind, 0.1);
    EXPECT_EQ(set.cycle(0, 0).size(), 0u);
    for (int rest = 0; rest < 3; ++rest) {
        const std::vector<Touch> on_upper = set.cycle(rest == 0 ? 1.5e-3 : 0, 0);
        ASSERT_EQ(on_upper.size(), 1u);
        EXPECT_EQ(set.part_of(on_upper[0]), set.upper);
        EXPECT_NEAR(on_upper[0].active_penetration(), 1e-3, 1e-12);
    }
    const std::vector<Touch> on_lower = set.cycle(0, 2e-3);
    ASSERT_EQ(on_lower.size(), 1u);
    EXPECT_EQ(set.part_of(on_lower[0]), set.lower);
    EXPECT_NEAR(on_lower[0].active_penetration(), 1e-3 - behind, 1e-12);
    EXPECT_GT(set.state.force[set.probe].z, 0);
}

/// The second sheet is thicker, and the node, which presses by 1e-6 on the first, 5e-3 deep in it. What it
/// begins with when the first gives way is what it pressed with and what it has come closer in that step,
/// however far the first sheet has moved, and whether the node was followed or looked up.
TEST(QuietNodes, AreNotShotByWhatTheirTouchHeldOff)
{
    for (const int rests : {0, 3}) {
        for (const double falls : {0.0, 3e-6}) {
            NodeOnTwoSheets set(0.1 + 1e-6, 5e-3, 0.12);
            const std::vector<Touch> found = set.cycle(0, 0);
            ASSERT_EQ(found.size(), 1u);
            EXPECT_EQ(set.part_of(found[0]), set.lower);
            EXPECT_EQ(found[0].active_penetration(), 0) << "it was there";
            set.cycle(2e-6, 0); // now the first touches, and is closer
            for (int rest = 0; rest <= rests; ++rest) {
                const std::vector<Touch> on_upper = set.cycle(rest == 0 ? 1e-6 : 0, 0);
                ASSERT_EQ(on_upper.size(), 1u);
                EXPECT_EQ(set.part_of(on_upper[0]), set.upper);
                EXPECT_NEAR(on_upper[0].active_penetration(), 1e-6, 1e-12);
            }
            const std::vector<Touch> on_lower = set.cycle(falls, 2e-3);
            ASSERT_EQ(on_lower.size(), 1u);
            EXPECT_EQ(set.part_of(on_lower[0]), set.lower);
            EXPECT_NEAR(on_lower[0].penetration, 5e-3 + 2e-6 + falls, 1e-12);
            EXPECT_NEAR(on_lower[0].active_penetration(), 1e-6 + falls, 1e-12) << rests;
        }
    }
}

/// Two sheets in the same place hold a node. Where the closer one gives way little by little, the other goes
/// on with the touch from the first, and the node is pressed as before.
TEST(QuietNodes, GoOnWithASheetInTheSamePlace)
{
    const double behind = 1e-6, pressed = 1e-3;
    NodeOnTwoSheets set(0.1 + 1e-3, behind, 0.1);
    EXPECT_EQ(set.cycle(0, 0).size(), 0u);
    EXPECT_EQ(set.cycle(1e-3 + pressed, 0).size(), 1u);
    for (int rest = 0; rest < 3; ++rest) {
        const std::vector<Touch> on_upper = set.cycle(0, 0);
        ASSERT_EQ(on_upper.size(), 1u);
        EXPECT_EQ(set.part_of(on_upper[0]), set.upper);
        EXPECT_NEAR(on_upper[0].active_penetration(), pressed, 1e-12);
    }
    for (int cycle = 0; cycle < 50; ++cycle) {
        const std::vector<Touch> on_lower = set.cycle(0, 1e-5);
        ASSERT_EQ(on_lower.size(), 1u);
        EXPECT_EQ(set.part_of(on_lower[0]), set.lower) << cycle;
        EXPECT_NEAR(on_lower[0].active_penetration(), pressed - behind, 1e-12) << cycle;
    }
}

/// A sheet of 0.1 whose one half is thinner: a node that is held by the thick half only and slides over the
/// border is held no more, however little it has slid.
TEST(QuietNodes, AreNotHeldByAThicknessBesideThem)
{
    ContactModel mesh;
    const Index thick = mesh.add_part(1, 210, 0.1), thin = mesh.add_part(1, 210, 0.02),
                other = mesh.add_part(1, 210, 0.1);
    mesh.add_sheet(thick, 4, 4, [](double u, double v) { return Vec3{4 * u - 2, 4 * v - 1.6, 0}; });
    for (std::size_t shell = 0; shell < 16; ++shell)
        if (shell % 4 > 1) mesh.model.shells.part[shell] = thin;
    const double beside = 5e-3;
    const Index probe = mesh.add_node({-beside, 0, 0.1 + 1e-3});
    mesh.add_shell(other,
                   {probe, mesh.add_node({0, 0, 50}), mesh.add_node({0, 1, 50}), mesh.add_node({1, 0, 50})});
    Contact contact;
    contact.kind = Contact::Kind::two_way;
    contact.slave.kind = contact.master.kind = ContactSide::Kind::parts;
    contact.slave.parts = {other};
    contact.master.parts = {thick, thin};
    contact.limit_thickness = false;
    mesh.model.contacts.push_back(contact);
    State state = mesh.state();
    Clock clock;
    clock.step = clock.last_step = 0.01;
    SurfaceContact term(mesh.model.contacts[0], mesh.model, part_data(mesh.model));
    const auto cycle = [&](double slides, double falls) {
        state.velocity[probe] = {slides / clock.step, 0, -falls / clock.step};
        state.position[probe] += clock.step * state.velocity[probe];
        state.clear_forces();
        term.add_forces(clock, state);
        clock.time += clock.step;
        return term.touches().all;
    };
    EXPECT_EQ(cycle(0, 0).size(), 0u);
    EXPECT_EQ(cycle(0, 2e-3).size(), 1u);
    EXPECT_EQ(cycle(0, 0).size(), 1u);
    const double slide = 1e-3;
    for (int i = 1; i * slide < 3 * beside; ++i) {
        const std::vector<Touch> touches = cycle(slide, 0);
        if (std::abs(i * slide - beside) < 0.5 * slide) continue; // on the border
        ASSERT_EQ(touches.size(), i * slide < beside ? 1u : 0u) << i;
        for (const Touch& touch : touches) EXPECT_NEAR(touch.active_penetration(), 1e-3, 1e-12);
    }
}

} // namespace plash

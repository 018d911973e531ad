#include "contact/tied_points.h"

#include <gtest/gtest.h>

#include <random>

namespace plash {

namespace {

class TiedPointMaps : public ::testing::TestWithParam<bool> {
protected:
    std::array<Vec3, 4> corner_{Vec3{0.1, 0, 0.2}, Vec3{2, 0.3, 0}, Vec3{2.2, 1.9, 0.4}, Vec3{-0.2, 1.6, 0}};
    std::mt19937 random_{7};
    TieShape shape_{0.3, 0.45, false};

    void SetUp() override
    {
        if (!GetParam()) return;
        corner_[3] = corner_[2];
        shape_ = TieShape(0.3, 0.45, true);
    }
    Vec3 any()
    {
        const auto number = [&] { return random_() / 2147483648.0 - 1; };
        return {number(), number(), number()};
    }
};

} // namespace

/// Rigid motion of the corners moves the point and turns the segment rigidly.
TEST_P(TiedPointMaps, FollowRigidMotion)
{
    const TieFrame frame(shape_, corner_);
    const Vec3 velocity = any(), spin = any();
    std::array<Vec3, 4> rates;
    for (int i = 0; i < 4; ++i) rates[i] = velocity + cross(spin, corner_[i]);
    const double height = 0.37;
    const TieRates tied = tie_rates(shape_, frame, height, rates);
    const Vec3 place = frame.place + height * frame.normal;
    EXPECT_NEAR(norm(tied.velocity - velocity - cross(spin, place)), 0, 1e-14);
    EXPECT_NEAR(norm(tied.spin - spin), 0, 1e-14);
}

/// The velocity is the derivative of the place, also where the segment warps and stretches.
TEST_P(TiedPointMaps, VelocityIsTheDerivativeOfThePlace)
{
    std::array<Vec3, 4> rate, before, after;
    const double step = 1e-6, height = -0.6;
    for (int i = 0; i < 4; ++i) rate[i] = i == 3 && GetParam() ? rate[2] : any();
    for (int i = 0; i < 4; ++i) {
        before[i] = corner_[i] - step * rate[i];
        after[i] = corner_[i] + step * rate[i];
    }
    const TieFrame low(shape_, before), high(shape_, after);
    const Vec3 slope = (0.5 / step) * (high.place + height * high.normal - low.place - height * low.normal);
    // Central difference: the step squared times third derivatives, and round-off over the step.
    EXPECT_NEAR(norm(tie_rates(shape_, TieFrame(shape_, corner_), height, rate).velocity - slope), 0, 1e-9);
}

/// Corner forces do the work of force and moment for any motion of the corners, and have their resultants.
TEST_P(TiedPointMaps, ForcesAreTheTransposeOfMotion)
{
    const TieFrame frame(shape_, corner_);
    const Vec3 force = any(), moment = any();
    const double height = 0.8;
    const auto spread = spread_to_corners(shape_, frame, height, force, moment);
    std::array<Vec3, 4> rate;
    Vec3 sum{}, turning{};
    double power = 0;
    for (int i = 0; i < 4; ++i) {
        rate[i] = i == 3 && GetParam() ? rate[2] : any();
        power += dot(spread[i], rate[i]);
        sum += spread[i];
        turning += cross(corner_[i], spread[i]);
    }
    const TieRates tied = tie_rates(shape_, frame, height, rate);
    EXPECT_NEAR(power, dot(force, tied.velocity) + dot(moment, tied.spin), 1e-14);
    EXPECT_NEAR(norm(sum - force), 0, 1e-14);
    const Vec3 place = frame.place + height * frame.normal;
    EXPECT_NEAR(norm(turning - cross(place, force) - moment), 0, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Shapes, TiedPointMaps, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "triangle" : "quadrilateral"; });

namespace {

Surface one_segment(double half_thickness)
{
    Surface surface;
    Segment segment;
    segment.nodes = {0, 1, 2, 3};
    segment.half_thickness = half_thickness;
    segment.size = 10;
    surface.segments.push_back(segment);
    return surface;
}

} // namespace

/// What the manual says about the distance: 0.6 (t_node + t_segment), or 0.05 of the shorter diagonal, or the
/// absolute values of negative SST and MST alone; and nodes beside the segment are not tied.
TEST(TiedSearch, TakesNodesWithinLsDynasDistance)
{
    std::vector<Vec3> position{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
    Surface slave;
    for (const double z : {0.3, 0.7, 0.75, 1.7, 1.9}) {
        ContactNode node;
        node.node = static_cast<Index>(position.size());
        node.half_thickness = z > 1 ? 0.5 : 0;
        slave.nodes.push_back(node);
        position.push_back({4, 6, z});
    }
    ContactNode beside;
    beside.node = static_cast<Index>(position.size());
    slave.nodes.push_back(beside);
    position.push_back({11, 5, 0.1});
    Contact contact;
    // Diagonal 14.14: 0.707 for nodes without thickness; 0.6 (1 + 2) = 1.8 with it.
    TieSearch found = find_tied_points(slave, one_segment(0), contact, position);
    ASSERT_EQ(found.points.size(), 2u);
    EXPECT_DOUBLE_EQ(found.points[0].height, 0.3);
    EXPECT_DOUBLE_EQ(found.points[1].s, 0.4);
    EXPECT_EQ(found.left_out, (std::vector<Index>{6, 7, 8, 9}));
    found = find_tied_points(slave, one_segment(1), contact, position);
    EXPECT_EQ(found.left_out, (std::vector<Index>{8, 9})) << "0.6 (1 + 2) = 1.8";
    contact.slave.thickness = contact.master.thickness = -0.4;
    found = find_tied_points(slave, one_segment(1), contact, position);
    EXPECT_EQ(found.points.size(), 1u) << "0.6 (0.4 + 0.4) = 0.48";
}

} // namespace plash

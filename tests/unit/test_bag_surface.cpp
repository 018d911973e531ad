#include "conditions/bag_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plash {

namespace {

/// A surface with its places.
struct Shape {
    std::vector<Vec3> place;
    std::vector<SegmentNodes> segments;
};

/// Six faces of a box, each of n x n segments with nodes of its own on a common lattice.
Shape box(int n, Vec3 size)
{
    Shape shape;
    const auto node = [&](int i, int j, int k) {
        return static_cast<Index>(i + (n + 1) * (j + (n + 1) * k));
    };
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i)
                shape.place.push_back({size.x * i / n, size.y * j / n, size.z * k / n});
    for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
            for (int side : {0, n}) {
                const int s = side;
                shape.segments.push_back(
                    {node(s, a, b), node(s, a + 1, b), node(s, a + 1, b + 1), node(s, a, b + 1)});
                shape.segments.push_back(
                    {node(a, s, b), node(a + 1, s, b), node(a + 1, s, b + 1), node(a, s, b + 1)});
                shape.segments.push_back(
                    {node(a, b, s), node(a + 1, b, s), node(a + 1, b + 1, s), node(a, b + 1, s)});
            }
    return shape;
}

double volume_of(const BagSurface& surface, const std::vector<Vec3>& place)
{
    std::vector<std::array<Vec3, 4>> forces;
    for (const SegmentNodes& segment : surface.segments())
        forces.push_back(unit_pressure_forces(segment, place));
    return surface.volume(place, forces);
}

} // namespace

// Half of the faces of the box above face inwards.
TEST(BagSurface, TurnsSegmentsOutwards)
{
    const Shape shape = box(3, {2, 3, 4});
    const BagSurface surface(shape.segments, shape.place);
    EXPECT_NEAR(volume_of(surface, shape.place), 24, 1e-12);
    EXPECT_EQ(surface.turned(), shape.segments.size() / 2);
    EXPECT_EQ(surface.hole_count(), 0u);
    const Vec3 middle{1, 1.5, 2};
    for (const SegmentNodes& segment : surface.segments()) {
        const auto force = unit_pressure_forces(segment, shape.place);
        EXPECT_GT(dot(force[0], shape.place[segment[0]] - middle), 0);
    }
}

TEST(BagSurface, ForcesOfUnitPressureAreTheGradientOfItsVolume)
{
    Shape shape = box(2, {1, 1.2, 0.9});
    for (Vec3& x : shape.place) x += 0.2 * Vec3{x.y * x.z, x.x * x.x, x.x * x.y}; // warped faces
    std::vector<SegmentNodes> mixed;                                              // and triangles among them
    for (std::size_t i = 0; i < shape.segments.size(); ++i) {
        const auto [a, b, c, d] = shape.segments[i];
        if (i % 3) {
            mixed.push_back({a, b, c, d});
        } else {
            mixed.push_back({a, b, c, c});
            mixed.push_back({a, c, d, d});
        }
    }
    const BagSurface surface(mixed, shape.place);
    for (const Index node : {0, 5, 13, 26}) {
        Vec3 force{};
        for (const SegmentNodes& segment : surface.segments()) {
            const auto corners = unit_pressure_forces(segment, shape.place);
            for (int c = 0; c < 4; ++c)
                if (segment[c] == node) force += corners[c];
        }
        for (double Vec3::*axis : vector_component) {
            constexpr double shift =
                1e-4; // the volume is of third order: central differences err by its square
            std::vector<Vec3> moved = shape.place;
            moved[node].*axis += shift;
            const double more = volume_of(surface, moved);
            moved[node].*axis -= 2 * shift;
            EXPECT_NEAR((more - volume_of(surface, moved)) / (2 * shift), force.*axis, 1e-9) << node;
        }
    }
}

TEST(BagSurface, ClosesEachHole)
{
    Shape shape = box(3, {2, 3, 4});
    std::erase_if(shape.segments, [&](const SegmentNodes& segment) {
        return std::all_of(segment.begin(), segment.end(),
                           [&](Index n) { return shape.place[n].z == 0 || shape.place[n].z == 4; }) &&
               shape.place[segment[0]].z == shape.place[segment[2]].z;
    });
    const BagSurface tube(shape.segments, shape.place);
    EXPECT_EQ(tube.hole_count(), 2u);
    EXPECT_NEAR(volume_of(tube, shape.place), 24, 1e-12);
    std::vector<Vec3> moved = shape.place;
    for (Vec3& x : moved) x += Vec3{100, -50, 7};
    EXPECT_NEAR(volume_of(tube, moved), 24, 1e-10);
}

// Two domes over the same rim, whose nodes there are not shared: the fans cancel.
TEST(BagSurface, SheetsThatMeetEncloseAVolume)
{
    Shape shape;
    constexpr int n = 8;
    double expected = 0;
    for (const double height : {0.3, -0.2}) {
        const auto first = static_cast<Index>(shape.place.size());
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const double x = 1.0 * i / n, y = 1.0 * j / n;
                shape.place.push_back({x, y, height * x * (1 - x) * y * (1 - y)});
            }
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const Index a = first + i + (n + 1) * j;
                shape.segments.push_back({a, a + 1, a + n + 2, a + n + 1}); // one of them faces inwards
                for (Index corner : shape.segments.back())
                    expected += std::abs(shape.place[corner].z) / 4 / (n * n);
            }
    }
    const BagSurface surface(shape.segments, shape.place);
    EXPECT_EQ(surface.hole_count(), 2u);
    EXPECT_NEAR(volume_of(surface, shape.place), expected, 1e-12);
    EXPECT_EQ(surface.turned(), static_cast<std::size_t>(n) * n);
}

TEST(BagSurface, AFlatBagStaysAsTheDeckHasIt)
{
    Shape shape = box(3, {2, 3, 0});
    const auto as_given = shape.segments;
    const BagSurface surface(as_given, shape.place);
    EXPECT_NEAR(volume_of(surface, shape.place), 0, 1e-12);
    EXPECT_EQ(surface.turned(), as_given.size() / 2); // as few as make it one surface
}

TEST(BagSurface, CountsEdgesOfThreeSegments)
{
    Shape shape = box(1, {1, 1, 1});
    shape.segments.push_back({0, 1, 7, 6}); // a wall from edge to edge
    const BagSurface surface(shape.segments, shape.place);
    EXPECT_EQ(surface.crossings(), 2u);
}

} // namespace plash

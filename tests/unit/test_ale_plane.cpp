#include "ale/plane_in_cell.h"
#include "ale/slope.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace plash {

namespace {

/// Normals of all kinds: general, along an axis, in a coordinate plane, nearly so, and with equal components.
std::vector<Vec3> normals()
{
    std::vector<Vec3> raw = {{1, 0, 0}, {0, 1, 0},    {0, 0, 1},       {1, 1, 0},       {0, 1, 3},
                             {1, 1, 1}, {1e-6, 1, 0}, {1e-6, 1e-7, 1}, {1, 2, 3},       {3, 1, 1},
                             {1, 1, 5}, {2, 2, 3},    {1e-3, 1, 1},    {0.2, 0.3, 0.5}, {0.45, 0.1, 0.45}};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 20; ++i) raw.push_back({uniform(random), uniform(random), uniform(random)});
    for (Vec3& normal : raw) normal = (1 / (normal.x + normal.y + normal.z)) * normal;
    return raw;
}

/// Volume by exact integration over columns along the largest component: the plane's height is linear in the
/// two other coordinates, cut at 0 and 1; many points in a plane with the midpoint rule.
double volume_by_columns(const Vec3& normal, double distance)
{
    std::array<double, 3> m{normal.x, normal.y, normal.z};
    std::sort(m.begin(), m.end());
    constexpr int points = 600;
    double sum = 0;
    for (int a = 0; a < points; ++a) {
        for (int b = 0; b < points; ++b) {
            const double rest = distance - m[0] * (a + 0.5) / points - m[1] * (b + 0.5) / points;
            sum += std::clamp(rest / m[2], 0.0, 1.0);
        }
    }
    return sum / (points * points);
}

} // namespace

TEST(PlaneInCell, VolumeEqualsIntegrationOverColumns)
{
    for (const Vec3& normal : normals()) {
        for (const double distance : {0.03, 0.2, 0.37, 0.5, 0.71, 0.95}) {
            // The midpoint rule errs by the square of the point distance along the kinks, below 1e-5 here.
            EXPECT_NEAR(volume_below_plane(normal, distance), volume_by_columns(normal, distance), 1e-5)
                << normal.x << " " << normal.y << " " << normal.z << " at " << distance;
        }
    }
}

TEST(PlaneInCell, DistanceInvertsVolume)
{
    for (const Vec3& normal : normals()) {
        for (const double volume : {1e-12, 1e-6, 0.003, 0.1, 0.4999, 0.5, 0.77, 0.999, 1 - 1e-9}) {
            const double distance = plane_distance(normal, volume);
            // Components below 1e-10 are taken as 1e-10; apart from that only round-off.
            EXPECT_NEAR(volume_below_plane(normal, distance), volume, 1e-9 * volume + 2e-10)
                << normal.x << " " << normal.y << " " << normal.z;
        }
    }
}

TEST(PlaneInCell, SlabsAddUpToTheWhole)
{
    for (const Vec3& normal : normals()) {
        for (const double volume : {0.01, 0.3, 0.5, 0.9}) {
            const double distance = plane_distance(normal, volume);
            for (int axis = 0; axis < 3; ++axis) {
                double sum = 0, start = 0;
                for (const double thickness : {0.001, 0.249, 0.5, 0.25}) {
                    sum += thickness * share_of_slab(normal, distance, axis, start, thickness);
                    start += thickness;
                }
                EXPECT_NEAR(sum, volume, 1e-8) << "axis " << axis;
            }
        }
    }
}

TEST(PlaneInCell, LanesEqualTheScalarReference)
{
    const auto all = normals();
    for (std::size_t first = 0; first + lane_count <= all.size(); first += lane_count) {
        const auto in_lanes = [](auto&& value_of) {
            Lanes values = broadcast<Lanes>(0);
            for (int lane = 0; lane < lane_count; ++lane) values[lane] = value_of(lane);
            return values;
        };
        const Vector3<Lanes> normal{in_lanes([&](int lane) { return all[first + lane].x; }),
                                    in_lanes([&](int lane) { return all[first + lane].y; }),
                                    in_lanes([&](int lane) { return all[first + lane].z; })};
        const Lanes volume = in_lanes([](int lane) { return 0.07 + 0.12 * lane; });
        const Lanes distance = plane_distance(normal, volume);
        for (int lane = 0; lane < lane_count; ++lane) {
            // The loop ends for all lanes at once, so that a lane may make a last step that alone it would
            // not.
            EXPECT_NEAR(distance[lane], plane_distance(all[first + lane], volume[lane]), 1e-12);
        }
    }
}

TEST(Slope, ReproducesALineAndFlattensExtrema)
{
    EXPECT_DOUBLE_EQ(limited_difference(0.7, 0.7, 0.7), 0.7);
    EXPECT_DOUBLE_EQ(limited_difference(-0.7, -0.7, -0.7), -0.7);
    EXPECT_DOUBLE_EQ(limited_difference(0.7, -0.2, 0.25), 0.0);
    EXPECT_DOUBLE_EQ(limited_difference(0.1, 0.9, 0.5), 0.2); // twice the smaller side
    EXPECT_DOUBLE_EQ(limited_difference(-0.1, -0.9, -0.5), -0.2);
    EXPECT_DOUBLE_EQ(mean_of_outflow(1.0, 0.4, 0.25),
                     1.15); // centre of the outer quarter: 3/8 of the width away
}

} // namespace plash

#include "contact/closest_point.h"

#include <gtest/gtest.h>

#include <random>

namespace plash {

namespace {

using Corners = SegmentCorners<double>;

Vec3 point_at(const Corners& q, double s, double t, bool triangle)
{
    const auto share = corner_shares(s, t, triangle);
    return share[0] * q.a + share[1] * q.b + share[2] * q.c + share[3] * q.d;
}

/// Smallest distance over a fine raster of the segment: an upper bound of the true distance.
double raster_distance(const Vec3& x, const Corners& q, bool triangle)
{
    constexpr int steps = 200;
    double best = 1e300;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= (triangle ? steps - i : steps); ++j) {
            best = std::min(best, norm(x - point_at(q, i / double(steps), j / double(steps), triangle)));
        }
    }
    return best;
}

Corners random_segment(std::mt19937& random, bool triangle, double warp)
{
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    const auto near = [&](double x, double y) {
        return Vec3{x + jitter(random), y + jitter(random), warp * jitter(random)};
    };
    Corners q{near(0, 0), near(1, 0), near(1, 1), near(0, 1)};
    if (triangle) q.d = q.c;
    return q;
}

} // namespace

TEST(ClosestPoint, AgreesWithARasterOfTheSegment)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-0.6, 1.6), height(-0.4, 0.4);
    for (int trial = 0; trial < 400; ++trial) {
        const bool triangle = trial % 2;
        const Corners q = random_segment(random, triangle, 1.0);
        const Vec3 x{place(random), place(random), height(random)};
        const auto found = closest_point(x, q);
        const double distance = std::sqrt(found.distance2);
        // The raster has cells of 1/200: the true distance is at most half a cell's diagonal smaller.
        const double raster = raster_distance(x, q, triangle);
        EXPECT_LT(distance, raster + 1e-9) << trial;
        EXPECT_GT(distance, raster - 0.005) << trial;
        // Parameters, offset and distance belong together.
        const Vec3 foot = point_at(q, found.s, found.t, triangle);
        EXPECT_NEAR(norm(x - foot - found.offset), 0, 1e-12) << trial;
        EXPECT_NEAR(norm(found.offset), distance, 1e-12) << trial;
    }
}

TEST(ClosestPoint, OffsetInsideIsPerpendicular)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(0.35, 0.65), height(-0.2, 0.2);
    for (int trial = 0; trial < 200; ++trial) {
        const Corners q = random_segment(random, false, 0.5);
        const Vec3 x{place(random), place(random), height(random)};
        const auto found = closest_point(x, q);
        ASSERT_EQ(found.feature, 0);
        const Vec3 along_s = (1 - found.t) * (q.b - q.a) + found.t * (q.c - q.d);
        const Vec3 along_t = (1 - found.s) * (q.d - q.a) + found.s * (q.c - q.b);
        // Four Newton iterations from the middle leave a residual at round-off for such segments.
        EXPECT_NEAR(dot(found.offset, along_s), 0, 1e-10);
        EXPECT_NEAR(dot(found.offset, along_t), 0, 1e-10);
    }
}

/// A node slides by up to a fortieth of a segment until its foot is followed: one round of Newton's method
/// leaves the square of that, times the twist (up to 0.4 in and 0.2 out of the plane here), and the distance
/// right to the square of what is left. Over segments without twist it is exact.
TEST(ClosestPoint, FootIsFollowed)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0.2, 0.8), height(-0.2, 0.2), part(-1, 1);
    for (const double path : {0.025, 0.0025}) {
        for (int trial = 0; trial < 200; ++trial) {
            Corners q = random_segment(random, trial % 4 == 0, 0.5);
            if (trial % 4 == 1) q.c = q.b + q.d - q.a;
            const Vec3 x{place(random), place(random), height(random)};
            const auto exact = closest_point(x, q);
            if (exact.feature != 0) continue;
            const auto followed =
                foot_near(x, q, exact.s + path * part(random), exact.t + path * part(random));
            const double left = trial % 4 < 2 ? 1e-14 : path * path;
            EXPECT_NEAR(followed.s, exact.s, left) << trial;
            EXPECT_NEAR(followed.t, exact.t, left) << trial;
            const Vec3 normal = segment_normal(q, followed.s, followed.t);
            const double sign = dot(exact.offset, normal) < 0 ? -1 : 1;
            EXPECT_NEAR(dot(followed.offset, normal), sign * norm(exact.offset), 1e-14 + 2 * left * left)
                << trial;
            const Vec3 foot = point_at(q, followed.s, followed.t, trial % 4 == 0);
            EXPECT_NEAR(norm(x - foot - followed.offset), 0, 1e-14);
        }
    }
}

TEST(ClosestPoint, NamesTheFeature)
{
    const Corners quad{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const auto feature = [&](double x, double y) { return closest_point(Vec3{x, y, 0.1}, quad).feature; };
    EXPECT_EQ(feature(0.3, 0.4), 0);
    EXPECT_EQ(feature(0.3, -0.4), 1);
    EXPECT_EQ(feature(1.3, 0.4), 2);
    EXPECT_EQ(feature(0.3, 1.4), 3);
    EXPECT_EQ(feature(-0.3, 0.4), 4);
    EXPECT_EQ(feature(-0.3, -0.4), 5);
    EXPECT_EQ(feature(1.3, -0.4), 6);
    EXPECT_EQ(feature(1.3, 1.4), 7);
    EXPECT_EQ(feature(-0.3, 1.4), 8);
    const Corners triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}};
    const auto on_triangle = [&](double x, double y) {
        return closest_point(Vec3{x, y, 0.1}, triangle).feature;
    };
    EXPECT_EQ(on_triangle(0.2, 0.3), 0);
    EXPECT_EQ(on_triangle(0.2, -0.3), 1);
    EXPECT_EQ(on_triangle(0.8, 0.8), 2);
    EXPECT_EQ(on_triangle(-0.2, 0.3), 4);
    EXPECT_EQ(on_triangle(1.4, -0.1), 6);
    EXPECT_EQ(on_triangle(-0.1, 1.4), 7);
}

TEST(ClosestPoint, LanesAgreeWithTheScalar)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-0.6, 1.6);
    for (int trial = 0; trial < 50; ++trial) {
        Corners scalar[lane_count];
        Vec3 x[lane_count];
        SegmentCorners<Lanes> q;
        Vector3<Lanes> point;
        for (int lane = 0; lane < lane_count; ++lane) {
            scalar[lane] = random_segment(random, lane % 3 == 0, 1.0);
            x[lane] = {place(random), place(random), 0.3 * place(random)};
            const auto put = [&](Vector3<Lanes>& to, const Vec3& from) {
                to.x[lane] = from.x, to.y[lane] = from.y, to.z[lane] = from.z;
            };
            put(q.a, scalar[lane].a), put(q.b, scalar[lane].b);
            put(q.c, scalar[lane].c), put(q.d, scalar[lane].d), put(point, x[lane]);
        }
        const auto batch = closest_point(point, q);
        for (int lane = 0; lane < lane_count; ++lane) {
            const auto one = closest_point(x[lane], scalar[lane]);
            // Contraction to fused multiply-adds may differ between the two: round-off only.
            EXPECT_NEAR(batch.s[lane], one.s, 1e-12);
            EXPECT_NEAR(batch.t[lane], one.t, 1e-12);
            EXPECT_NEAR(batch.distance2[lane], one.distance2, 1e-13);
            EXPECT_EQ(batch.feature[lane], one.feature);
        }
    }
}

} // namespace plash

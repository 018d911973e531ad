#include "elements/shell_fully_integrated.h"
#include "elements/shell_settings.h"
#include "elements/shell_triangle.h"
#include "materials/elastic.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <type_traits>

namespace plash {

namespace {

template <class Lane>
CornerPattern<Lane> pattern_of(const Vector3<Lane> (&corner)[4])
{
    return plash::pattern_of(corner[0], corner[1], corner[2], corner[3]);
}

ShellSettings settings_with(ShellHourglass::Kind kind)
{
    ShellSettings settings;
    settings.rule = gauss_rule(3);
    settings.shear_factor = 5.0 / 6;
    settings.hourglass.kind = kind;
    settings.thickness_change = true;
    settings.bulk_viscosity = true;
    settings.quadratic_viscosity = 1.5;
    settings.linear_viscosity = 0.06;
    settings.density = 7.8e-6;
    settings.wave_speed = 5439;
    settings.poisson_ratio = 0.3;
    settings.stiffness = {210, 80.77, 5.0 / 6, 7.8e-6 * 5439};
    return settings;
}

/// Four corners for a formulation: a triangle has its third one twice.
template <class Formulation, class Value>
void close_corners(Value (&corner)[4])
{
    if constexpr (std::is_same_v<Formulation, C0Triangle>) corner[3] = corner[2];
}

template <class Formulation>
constexpr int record_length = shell_record::points + Formulation::plane_points * 3 * shell_record::history;

template <class Formulation>
class ShellFormulations : public ::testing::Test {};
using AllFormulations = ::testing::Types<BelytschkoTsay, C0Triangle, FullyIntegratedShell>;
TYPED_TEST_SUITE(ShellFormulations, AllFormulations);

} // namespace

TYPED_TEST(ShellFormulations, LanesEqualTheScalarReference)
{
    for (const auto kind : {ShellHourglass::Kind::viscous, ShellHourglass::Kind::stiffness}) {
        const ShellSettings settings = settings_with(kind);
        const Elastic law{7.8e-6, 210, 0.3};
        constexpr int record_size = record_length<TypeParam>;
        std::vector<Lanes> record(record_size);
        std::vector<std::vector<double>> scalar_record(lane_count, std::vector<double>(record_size));
        record[shell_record::thickness] = broadcast<Lanes>(1.0);
        record[shell_record::mass_factor] = broadcast<Lanes>(1.0);
        record[shell_record::mass_factor][5] = 0; // an eroded element among the others
        for (int lane = 0; lane < lane_count; ++lane) {
            for (int i : {shell_record::thickness, shell_record::mass_factor})
                scalar_record[lane][i] = record[i][lane];
        }

        std::mt19937 generator(7);
        std::uniform_real_distribution<double> random(-1, 1);
        const Vec3 square[4] = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
        for (int step = 0; step < 3; ++step) {
            Vector3<Lanes> x[4], v[4], w[4];
            Vec3 xs[lane_count][4], vs[lane_count][4], ws[lane_count][4];
            const auto put = [&](Vector3<Lanes>& lanes, int lane, const Vec3& value) {
                lanes.x[lane] = value.x;
                lanes.y[lane] = value.y;
                lanes.z[lane] = value.z;
            };
            for (int lane = 0; lane < lane_count; ++lane) {
                for (int corner = 0; corner < 4; ++corner) {
                    const auto vector = [&](double size) {
                        return Vec3{size * random(generator), size * random(generator),
                                    size * random(generator)};
                    };
                    xs[lane][corner] = square[corner] + vector(2);
                    vs[lane][corner] = vector(3);
                    ws[lane][corner] = vector(0.2);
                }
                close_corners<TypeParam>(xs[lane]);
                close_corners<TypeParam>(vs[lane]);
                close_corners<TypeParam>(ws[lane]);
                for (int corner = 0; corner < 4; ++corner) {
                    put(x[corner], lane, xs[lane][corner]);
                    put(v[corner], lane, vs[lane][corner]);
                    put(w[corner], lane, ws[lane][corner]);
                }
            }
            const double time_step = 1.5e-3;
            const auto batch = TypeParam::template step<Lanes>(settings, law, pattern_of(x), pattern_of(v),
                                                               pattern_of(w), time_step, record.data());
            for (int lane = 0; lane < lane_count; ++lane) {
                const auto one = TypeParam::template step<double>(settings, law, pattern_of(xs[lane]),
                                                                  pattern_of(vs[lane]), pattern_of(ws[lane]),
                                                                  time_step, scalar_record[lane].data());
                // Same operations; only the contraction of products and sums may differ.
                const auto same = [&](double a, double b, double scale) {
                    EXPECT_NEAR(a, b, 1e-13 * scale) << "lane " << lane << " step " << step;
                };
                same(batch.force.diagonal13.x[lane], one.force.diagonal13.x, 10);
                same(batch.force.diagonal24.z[lane], one.force.diagonal24.z, 10);
                same(batch.force.alternating.y[lane], one.force.alternating.y, 10);
                same(batch.moment.diagonal13.y[lane], one.moment.diagonal13.y, 10);
                same(batch.moment.sum.x[lane], one.moment.sum.x, 10);
                same(batch.internal_work[lane], one.internal_work, 1);
                same(batch.hourglass_work[lane], one.hourglass_work, 1);
                same(batch.viscous_work[lane], one.viscous_work, 1);
                EXPECT_EQ(batch.force.diagonal13.x[lane] == 0, lane == 5);
                if (lane != 5) same(batch.squared_length[lane], one.squared_length, 100);
                for (int i = 0; i < record_size; ++i) same(record[i][lane], scalar_record[lane][i], 10);
            }
        }
    }
}

TYPED_TEST(ShellFormulations, AreInBalanceWhenWarpedAndDoTheWorkTheyBook)
{
    for (const bool warping : {false, true}) {
        for (const auto kind : {ShellHourglass::Kind::viscous, ShellHourglass::Kind::stiffness}) {
            ShellSettings settings = settings_with(kind);
            settings.warping = warping;
            settings.thickness_change = settings.bulk_viscosity = false;
            settings.reference_offset = 0.3;
            const Elastic law{7.8e-6, 210, 0.3};
            std::vector<double> record(record_length<TypeParam>);
            record[shell_record::thickness] = record[shell_record::mass_factor] = 1;
            // A warped element in an arbitrary plane.
            const Vec3 a{0.6, 0.8, 0}, b{-0.64, 0.48, 0.6}, c = cross(a, b);
            const auto at = [&](double x, double y, double z) { return x * a + y * b + z * c; };
            Vec3 x[4] = {at(0, 0, 0.5), at(9, 1, 0), at(12, 11, 1), at(-1, 8, -0.6)};
            Vec3 v[4] = {{1, 2, 3}, {-2, 1, 0.5}, {0.3, -1, -2}, {1, 1, -1}};
            Vec3 w[4] = {{0.1, 0.2, 0}, {-0.1, 0.1, 0.2}, {0, -0.3, 0.1}, {0.2, 0, 0}};
            close_corners<TypeParam>(x);
            close_corners<TypeParam>(v);
            close_corners<TypeParam>(w);
            const double time_step = 1e-9; // so small that both geometries of the step are the same
            const auto step = TypeParam::template step<double>(settings, law, pattern_of(x), pattern_of(v),
                                                               pattern_of(w), time_step, record.data());
            Vec3 force[4], moment[4], total{}, total_moment{};
            each_corner(step.force, [&](int corner, const Vec3& value) { force[corner] = value; });
            each_corner(step.moment, [&](int corner, const Vec3& value) { moment[corner] = value; });
            double size = 0, power = 0;
            for (int corner = 0; corner < 4; ++corner) {
                total += force[corner];
                total_moment += cross(x[corner], force[corner]) + moment[corner];
                size += norm(force[corner]);
                power += dot(force[corner], v[corner]) + dot(moment[corner], w[corner]);
            }
            ASSERT_GT(size, 0);
            EXPECT_LT(norm(total), 1e-14 * size);
            EXPECT_LT(norm(total_moment), 1e-13 * 12 * size);
            // Forces have grown from zero over the step, so the booked work is half of force times path.
            const double booked = 2 * (step.internal_work + step.hourglass_work);
            EXPECT_NEAR(-power * time_step, booked, 1e-8 * booked) << warping;
        }
    }
}

namespace {

/// Hourglass force and work of one step of a distorted element under nodal velocities and rotation rates.
struct HourglassAnswer {
    double force = 0, moment = 0, work = 0;
};

HourglassAnswer hourglass_of(ShellHourglass::Kind kind, const std::function<Vec3(const Vec3&, int)>& velocity,
                             const std::function<Vec3(const Vec3&, int)>& spin)
{
    const ShellSettings settings = settings_with(kind);
    const Elastic law{7.8e-6, 210, 0.3};
    std::vector<double> record(shell_record::points + 3 * shell_record::history);
    record[shell_record::thickness] = record[shell_record::mass_factor] = 1;
    const Vec3 x[4] = {{0, 0, 0}, {9, 1, 0}, {12, 11, 0}, {-1, 8, 0}};
    Vec3 v[4], w[4];
    for (int i = 0; i < 4; ++i) {
        v[i] = velocity(x[i], i);
        w[i] = spin(x[i], i);
    }
    const auto step = BelytschkoTsay::step<double>(settings, law, pattern_of(x), pattern_of(v), pattern_of(w),
                                                   1e-8, record.data());
    const double* q = &record[shell_record::hourglass_force];
    return {std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), std::sqrt(q[3] * q[3] + q[4] * q[4]),
            step.hourglass_work};
}

} // namespace

TEST(ShellHourglass, ResistsOnlyHourglassModes)
{
    const auto none = [](const Vec3&, int) { return Vec3{}; };
    const auto sign = [](int corner) { return corner % 2 ? -1.0 : 1.0; };
    for (const auto kind : {ShellHourglass::Kind::viscous, ShellHourglass::Kind::stiffness}) {
        // Rigid motion and every linear field of velocity and rotation: stretching, shear, bending, twist.
        const auto linear = [](const Vec3& x, int) {
            return Vec3{1 + 0.3 * x.x - 0.2 * x.y, 2 - 0.1 * x.x + 0.4 * x.y, 3 + 0.5 * x.x + 0.7 * x.y};
        };
        const HourglassAnswer smooth = hourglass_of(kind, linear, linear);
        const auto pattern = [&](Vec3 direction) {
            return [=](const Vec3&, int corner) { return sign(corner) * direction; };
        };
        const HourglassAnswer stretch = hourglass_of(kind, pattern({1, 0, 0}), none);
        const HourglassAnswer warp = hourglass_of(kind, pattern({0, 0, 1}), none);
        const HourglassAnswer turn = hourglass_of(kind, none, pattern({0, 1, 0}));
        for (const HourglassAnswer& mode : {stretch, warp}) {
            EXPECT_GT(mode.force, 0);
            EXPECT_GT(mode.work, 0);
            EXPECT_LT(smooth.force, 1e-12 * mode.force);
        }
        EXPECT_GT(turn.moment, 0);
        EXPECT_GT(turn.work, 0);
        EXPECT_LT(smooth.moment, 1e-12 * turn.moment);
        EXPECT_LT(std::abs(smooth.work), 1e-12 * stretch.work);
    }
}

TEST(C0Triangle, AnswersAlikeWhateverCornerComesFirst)
{
    const ShellSettings settings = settings_with(ShellHourglass::Kind::viscous);
    const Elastic law{7.8e-6, 210, 0.3};
    const Vec3 x[3] = {{0, 0, 0.5}, {9, 1, 0}, {3, 8, 1}};
    const Vec3 v[3] = {{1, 2, 3}, {-2, 1, 0.5}, {0.3, -1, -2}};
    const Vec3 w[3] = {{0.1, 0.2, 0}, {-0.1, 0.1, 0.2}, {0, -0.3, 0.1}};
    Vec3 first_force[3], first_moment[3];
    for (int turn = 0; turn < 3; ++turn) {
        const auto turned = [&](const Vec3(&field)[3]) {
            const Vec3 corner[4] = {field[turn], field[(turn + 1) % 3], field[(turn + 2) % 3],
                                    field[(turn + 2) % 3]};
            return pattern_of(corner);
        };
        std::vector<double> record(record_length<C0Triangle>);
        record[shell_record::thickness] = record[shell_record::mass_factor] = 1;
        const auto step =
            C0Triangle::step<double>(settings, law, turned(x), turned(v), turned(w), 1e-9, record.data());
        Vec3 force[3] = {}, moment[3] = {};
        each_corner(step.force,
                    [&](int corner, const Vec3& value) { force[(std::min(corner, 2) + turn) % 3] += value; });
        each_corner(step.moment, [&](int corner, const Vec3& value) {
            moment[(std::min(corner, 2) + turn) % 3] += value;
        });
        for (int corner = 0; corner < 3; ++corner) {
            if (turn == 0) first_force[corner] = force[corner];
            if (turn == 0) first_moment[corner] = moment[corner];
            // Frames that follow different sides turn differently by the strain of the step, 1e-9 here.
            EXPECT_LT(norm(force[corner] - first_force[corner]), 1e-9 * norm(force[corner]));
            EXPECT_LT(norm(moment[corner] - first_moment[corner]), 1e-9 * norm(moment[corner]));
        }
    }
}

TEST(ShellKernel, ThicknessFollowsTheStrainWhenAsked)
{
    // Uniaxial strain along x: the thickness strain of plane stress is -nu / (1 - nu) of the strain in plane.
    const Elastic law{7.8e-6, 210, 0.3};
    for (const bool change : {false, true}) {
        ShellSettings settings = settings_with(ShellHourglass::Kind::viscous);
        settings.thickness_change = change;
        std::vector<double> record(shell_record::points + 3 * shell_record::history);
        record[shell_record::thickness] = record[shell_record::mass_factor] = 1;
        constexpr int steps = 1000;
        double length = 1;
        const double speed = 0.1 / steps;
        for (int step = 0; step < steps; ++step) {
            length += speed;
            const Vec3 x[4] = {{0, 0, 0}, {length, 0, 0}, {length, 1, 0}, {0, 1, 0}};
            const Vec3 v[4] = {{0, 0, 0}, {speed, 0, 0}, {speed, 0, 0}, {0, 0, 0}};
            const Vec3 w[4] = {};
            BelytschkoTsay::step<double>(settings, law, pattern_of(x), pattern_of(v), pattern_of(w), 1.0,
                                         record.data());
        }
        const double expected = change ? std::exp(-0.3 / 0.7 * std::log(1.1)) : 1;
        EXPECT_NEAR(record[shell_record::thickness], expected, 1e-6);
        // Logarithmic strain to second order in the step.
        EXPECT_NEAR(record[int{shell_record::points} + int{shell_record::stress_xx}],
                    210 / 0.91 * std::log(1.1), 1e-6);
    }
}

TEST(ShellKernel, OffsetReferencePlaneBendsUnderMembraneForce)
{
    const Elastic law{7.8e-6, 210, 0.3};
    ShellSettings settings = settings_with(ShellHourglass::Kind::viscous);
    settings.reference_offset = 1; // nodes on the top surface
    std::vector<double> record(shell_record::points + 3 * shell_record::history);
    record[shell_record::thickness] = record[shell_record::mass_factor] = 1;
    const ShellIncrement<double> stretch{1e-3, 0, 0, 0, 0, 0, 0, 0, {}};
    ShellResultants<double> resultants;
    double thinning = 0;
    update_points(settings, law, stretch, 1.0, 1.0, &record[shell_record::points], resultants, thinning);
    EXPECT_NEAR(resultants.nxx, 210 / 0.91 * 1e-3, 1e-15);
    EXPECT_NEAR(resultants.mxx, -0.5 * resultants.nxx, 1e-15); // half the thickness below the nodes
}

TEST(ThicknessRules, GaussPointsIntegratePolynomialsExactly)
{
    for (int points = 1; points <= 10; ++points) {
        const ThicknessRule rule = gauss_rule(points);
        ASSERT_EQ(rule.size(), points);
        for (int degree = 0; degree < 2 * points; ++degree) {
            double integral = 0;
            for (int i = 0; i < points; ++i) integral += rule.weight[i] * std::pow(rule.place[i], degree);
            EXPECT_NEAR(integral, degree % 2 ? 0 : 1.0 / (degree + 1), 1e-15) << points << " " << degree;
        }
        for (int i = 1; i < points; ++i) EXPECT_LT(rule.place[i - 1], rule.place[i]);
    }
}

TEST(ThicknessRules, LobattoPointsReachTheSurfacesAndIntegratePolynomialsExactly)
{
    for (int points = 3; points <= 10; ++points) {
        const ThicknessRule rule = lobatto_rule(points);
        ASSERT_EQ(rule.size(), points);
        EXPECT_EQ(rule.place.front(), -1);
        EXPECT_EQ(rule.place.back(), 1);
        for (int degree = 0; degree < 2 * points - 2; ++degree) {
            double integral = 0;
            for (int i = 0; i < points; ++i) integral += rule.weight[i] * std::pow(rule.place[i], degree);
            EXPECT_NEAR(integral, degree % 2 ? 0 : 1.0 / (degree + 1), 1e-15) << points << " " << degree;
        }
    }
}

/// INTGRD of *CONTROL_SHELL speaks where the section does not, and not for two points.
TEST(ThicknessRules, TheControlCardChoosesLobattos)
{
    Model model;
    model.controls.elements.thickness_integration = 1;
    const auto rule_of = [&](double rule, Id points) {
        const Record section = testing::record_of("SECTION_SHELL", 1, {{"QR/IRID", rule}});
        return thickness_rule(model, section, points, "QR/IRID").place;
    };
    EXPECT_EQ(rule_of(0, 5), lobatto_rule(5).place);
    EXPECT_EQ(rule_of(0, 2), gauss_rule(2).place);
    EXPECT_EQ(rule_of(1, 5), trapezoidal_rule(5).place);
    model.controls.elements.thickness_integration = 0;
    EXPECT_EQ(rule_of(0, 5), gauss_rule(5).place);
}

TEST(ThicknessRules, TrapezoidalRuleTakesTheSurfaces)
{
    const ThicknessRule rule = trapezoidal_rule(5);
    EXPECT_EQ(rule.place, (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(rule.weight, (std::vector<double>{0.125, 0.25, 0.25, 0.25, 0.125}));
}

TEST(ShellLength, FollowsTheThreeRules)
{
    const Vec3 quad[4] = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
    const auto position = pattern_of(quad);
    EXPECT_DOUBLE_EQ(squared_length(position, 12.0, 0), 9);          // area / longest side
    EXPECT_DOUBLE_EQ(squared_length(position, 12.0, 1), 144.0 / 25); // area / diagonal
    EXPECT_DOUBLE_EQ(squared_length(position, 12.0, 2), 9);          // shortest side
    const Vec3 triangle[4] = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 3, 0}};
    EXPECT_DOUBLE_EQ(squared_length(pattern_of(triangle), 6.0, 0), 144.0 / 25); // its smallest height
    EXPECT_DOUBLE_EQ(squared_length(pattern_of(triangle), 6.0, 2), 9);
}

} // namespace plash

#include "elements/solid_points.h"
#include "materials/elastic.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace plash {

namespace {

using Form = SolidHourglass::Form;

constexpr double corner_sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/// Unit cube with every corner moved at random.
void distorted_cube(Vec3 (&corner)[8], double amplitude, unsigned seed)
{
    std::mt19937 random(seed);
    const auto shift = [&] { return amplitude * (random() / 2147483648.0 - 1.0); };
    for (int i = 0; i < 8; ++i) {
        corner[i] = {0.5 * corner_sign[i][0] + shift(), 0.5 * corner_sign[i][1] + shift(),
                     0.5 * corner_sign[i][2] + shift()};
    }
}

/// Volume by 2 x 2 x 2 Gauss points, which integrate the Jacobian determinant exactly.
double quadrature_volume(const Vec3 (&corner)[8])
{
    const double g = 1 / std::sqrt(3.0);
    double volume = 0;
    for (const auto& p : corner_sign) {
        Vec3 column[3]{};
        for (int i = 0; i < 8; ++i) {
            const auto& s = corner_sign[i];
            const double f[3] = {1 + s[0] * p[0] * g, 1 + s[1] * p[1] * g, 1 + s[2] * p[2] * g};
            column[0] += 0.125 * s[0] * f[1] * f[2] * corner[i];
            column[1] += 0.125 * s[1] * f[0] * f[2] * corner[i];
            column[2] += 0.125 * s[2] * f[0] * f[1] * corner[i];
        }
        volume += dot(column[0], cross(column[1], column[2]));
    }
    return volume;
}

SolidParameters steel_parameters(Form form, bool orthogonal)
{
    SolidParameters parameters;
    parameters.density = 7.85e-9;
    parameters.hourglass = {form, orthogonal, 0.1, 80769, 0.3};
    return parameters;
}

const RatePoint<Elastic> steel_point{{7.85e-9, 210000, 0.3}};

/// The linear velocity field x -> gradient x + (1, 2, 3).
Vec3 linear_velocity(const Tensor3<double>& gradient, const Vec3& place)
{
    return gradient * place + Vec3{1, 2, 3};
}

struct ScalarElement {
    Vec3 position[8], velocity[8];
    double history[point_history] = {};
    double constants[point_constants + total_hourglass_constants] = {1, 7.85e-9};

    /// For IHQ 7: the places are those of the start.
    void start_total()
    {
        start_total_hourglass(modes_of(position), history + hourglass_history, constants + point_constants);
    }

    template <SolidGradientRule rule>
    SolidResult<double> step(const SolidParameters& parameters, double time_step)
    {
        return solid_step<rule>(steel_point, parameters, modes_of(position), modes_of(velocity), time_step,
                                history, constants);
    }
};

} // namespace

TEST(SolidModes, GoBackToCornersAsTheTranspose)
{
    Vec3 a[8], b[8], back[8];
    distorted_cube(a, 0.3, 1);
    distorted_cube(b, 0.3, 2);
    const SolidModes<double> ma = modes_of(a), mb = modes_of(b);
    for_corners(mb, [&](int i, const Vec3& force) { back[i] = force; });
    double modal = 0, corners = 0;
    for (int i = 0; i < 3; ++i) modal += dot(ma.linear[i], mb.linear[i]);
    for (int i = 0; i < 4; ++i) modal += dot(ma.hourglass[i], mb.hourglass[i]);
    for (int i = 0; i < 8; ++i) corners += dot(a[i], back[i]);
    EXPECT_NEAR(modal, corners, 1e-13 * std::abs(modal));
}

TEST(SolidGradient, MeanRuleHasTheExactVolumeAndItsDerivative)
{
    for (unsigned seed = 1; seed < 6; ++seed) {
        Vec3 corner[8];
        distorted_cube(corner, 0.25, seed);
        const auto b = gradient_of<SolidGradientRule::mean>(modes_of(corner));
        EXPECT_NEAR(b.volume, quadrature_volume(corner), 1e-14);
        // The volume gradient of a velocity is the rate of the volume: central difference, cubic in the step.
        Vec3 velocity[8], ahead[8], behind[8];
        distorted_cube(velocity, 1.0, seed + 100);
        const double h = 1e-4;
        for (int i = 0; i < 8; ++i) {
            ahead[i] = corner[i] + h * velocity[i];
            behind[i] = corner[i] - h * velocity[i];
        }
        const double rate = (quadrature_volume(ahead) - quadrature_volume(behind)) / (2 * h);
        const Tensor3<double> gradient = volume_gradient(b, modes_of(velocity));
        EXPECT_NEAR(trace(symmetric_part(gradient)), rate, 1e-7);
    }
}

TEST(SolidGradient, BothRulesSeeALinearFieldExactly)
{
    Vec3 corner[8], velocity[8];
    distorted_cube(corner, 0.25, 3);
    const Tensor3<double> wanted{1, 2, 3, 4, 5, 6, 7, 8, 10};
    for (int i = 0; i < 8; ++i) velocity[i] = linear_velocity(wanted, corner[i]);
    const auto check = [&](const auto& b) {
        const Tensor3<double> g = (1 / b.volume) * volume_gradient(b, modes_of(velocity));
        EXPECT_NEAR(g.xx, 1, 1e-13);
        EXPECT_NEAR(g.xy, 2, 1e-13);
        EXPECT_NEAR(g.yz, 6, 1e-13);
        EXPECT_NEAR(g.zx, 7, 1e-13);
        EXPECT_NEAR(g.zz, 10, 1e-13);
    };
    check(gradient_of<SolidGradientRule::mean>(modes_of(corner)));
    check(gradient_of<SolidGradientRule::centre>(modes_of(corner)));
}

TEST(SolidGradient, LargestFaceIsHalfTheCrossProductOfDiagonals)
{
    constexpr int face[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (unsigned seed = 1; seed < 9; ++seed) {
        Vec3 corner[8];
        distorted_cube(corner, 0.3, seed);
        double largest = 0;
        for (const auto& f : face) {
            largest = std::max(largest,
                               0.5 * norm(cross(corner[f[2]] - corner[f[0]], corner[f[3]] - corner[f[1]])));
        }
        EXPECT_NEAR(std::sqrt(largest_face_squared(modes_of(corner))), largest, 1e-14);
    }
}

TEST(SolidStep, StepIsTheWaveTimeAcrossACube)
{
    ScalarElement cube;
    distorted_cube(cube.position, 0, 1);
    const auto result = cube.step<SolidGradientRule::centre>(steel_parameters(Form::viscous, false), 0);
    const double modulus = 210000 * 0.7 / (1.3 * 0.4); // E (1 - nu) / ((1 + nu) (1 - 2 nu))
    EXPECT_NEAR(result.vote.stable_step, 1 / std::sqrt(modulus / 7.85e-9), 1e-12 * result.vote.stable_step);
}

TEST(SolidStep, LinearMotionHasNoHourglassForces)
{
    const Tensor3<double> gradient{10, 20, -30, 5, -8, 25, 40, -3, 6};
    for (Form form : {Form::viscous, Form::stiffness, Form::assumed_strain, Form::assumed_rate}) {
        const auto check = [&](auto rule) {
            ScalarElement element;
            distorted_cube(element.position, 0.2, 5);
            const double h = 1e-6;
            // Linear in the mid-step places, where the strain is taken.
            for (int i = 0; i < 8; ++i) {
                element.velocity[i] = linear_velocity(gradient, element.position[i]);
                element.position[i] += 0.5 * h * element.velocity[i];
            }
            element.step<decltype(rule)::value>(steel_parameters(form, true), h);
            for (int i = 0; i < 12; ++i) {
                // Forces of the same speeds in an hourglass mode are of order 0.01 (viscous), 1 (stiff)
                // and 1000 (the rate form with this modulus as viscosity).
                EXPECT_NEAR(element.history[hourglass_history + i], 0,
                            form == Form::assumed_rate ? 1e-11 : 1e-13)
                    << static_cast<int>(form);
            }
        };
        check(std::integral_constant<SolidGradientRule, SolidGradientRule::centre>{});
        check(std::integral_constant<SolidGradientRule, SolidGradientRule::mean>{});
    }
}

TEST(SolidStep, PlainViscousTypeIsBlindToLinearMotionOfParallelepipeds)
{
    const Tensor3<double> shape{1, 0.2, 0.1, -0.1, 1.3, 0.3, 0.2, 0.1, 0.8};
    const Tensor3<double> gradient{10, 20, -30, 5, -8, 25, 40, -3, 6};
    ScalarElement element;
    distorted_cube(element.position, 0, 1);
    for (int i = 0; i < 8; ++i) {
        element.position[i] = shape * element.position[i];
        element.velocity[i] = linear_velocity(gradient, element.position[i]);
    }
    element.step<SolidGradientRule::centre>(steel_parameters(Form::viscous, false), 1e-9);
    for (int i = 0; i < 12; ++i) EXPECT_NEAR(element.history[hourglass_history + i], 0, 1e-13);
}

TEST(SolidStep, EveryFormResistsEveryHourglassMode)
{
    for (Form form : {Form::viscous, Form::stiffness, Form::assumed_strain, Form::assumed_rate}) {
        for (int mode = 0; mode < 4; ++mode) {
            for (int axis = 0; axis < 3; ++axis) {
                ScalarElement element;
                distorted_cube(element.position, 0.1, 5);
                SolidModes<double> pattern;
                pattern.hourglass[mode] = {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0,
                                           axis == 2 ? 1.0 : 0.0};
                for_corners(pattern, [&](int i, const Vec3& v) { element.velocity[i] = v; });
                const double h = 1e-8;
                const auto result = element.step<SolidGradientRule::mean>(steel_parameters(form, true), h);
                Vec3 force[8];
                for_corners(result.force, [&](int i, const Vec3& f) { force[i] = f; });
                double power = 0;
                for (int i = 0; i < 8; ++i) power += dot(force[i], element.velocity[i]);
                EXPECT_LT(power, 0);
                EXPECT_GT(element.history[hourglass_energy_history], 0)
                    << static_cast<int>(form) << " mode " << mode << " axis " << axis;
            }
        }
    }
}

TEST(SolidStep, AssumedStrainTypeBendsLikeAnElasticPlate)
{
    // A box a x b x c whose ends turn about y: u = q xi zeta along x, which is bending with the strain
    // 2 q zeta / a. Plate theory (plane strain across): energy = E / (1 - nu^2) / 2 * (2 q / a)^2 * a b c
    // / 3.
    const double a = 2, b = 1.5, c = 0.7, young = 210000, nu = 0.3, q = 1e-6;
    ScalarElement element;
    for (int i = 0; i < 8; ++i) {
        const auto& s = corner_sign[i];
        element.position[i] = {0.5 * a * s[0], 0.5 * b * s[1], 0.5 * c * s[2]};
        element.velocity[i] = {q * s[0] * s[2], 0, 0};
    }
    SolidParameters parameters = steel_parameters(Form::assumed_strain, true);
    parameters.hourglass.coefficient = 1;
    parameters.hourglass.shear_modulus = young / (2 * (1 + nu));
    element.constants[inverse_volume_constant] = 1 / (a * b * c);
    element.step<SolidGradientRule::mean>(parameters, 1.0);
    const double energy = 0.5 * young / (1 - nu * nu) * (2 * q / a) * (2 * q / a) * a * b * c / 3;
    // The mid-step geometry differs from the end's by q: relative 1e-6.
    EXPECT_NEAR(element.history[hourglass_energy_history], energy, 3e-6 * energy);
}

TEST(TotalHourglass, ForcesAreTheDerivativeOfItsEnergy)
{
    // Any shape, far away from where it began: forces against central differences of the energy, and no
    // resultant and no moment.
    SolidHourglass control = steel_parameters(Form::total_strain, true).hourglass;
    control.shear_modulus = 3;
    Vec3 start[8], now[8], force[8];
    distorted_cube(start, 0.2, 3);
    distorted_cube(now, 0.25, 8);
    double shares[12], lengths[total_hourglass_constants];
    start_total_hourglass(modes_of(start), shares, lengths);
    const auto energy = [&] { return total_hourglass(control, modes_of(now), shares, lengths).energy; };
    for_corners(total_hourglass(control, modes_of(now), shares, lengths).force,
                [&](int i, const Vec3& f) { force[i] = f; });
    Vec3 sum{}, moment{};
    double largest = 0;
    for (int i = 0; i < 8; ++i) {
        sum += force[i];
        moment += cross(now[i], force[i]);
        largest = std::max(largest, norm(force[i]));
        for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            const double h = 1e-5, middle = now[i].*axis;
            now[i].*axis = middle + h;
            const double above = energy();
            now[i].*axis = middle - h;
            const double below = energy();
            now[i].*axis = middle;
            EXPECT_NEAR(force[i].*axis, (below - above) / (2 * h), 1e-8 * largest) << i;
        }
    }
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(norm(sum), 1e-14 * largest);
    EXPECT_LT(norm(moment), 1e-14 * largest);
}

TEST(TotalHourglass, LinearDeformationOfAnySizeHasNone)
{
    const SolidHourglass control = steel_parameters(Form::total_strain, true).hourglass;
    const Tensor3<double> deformation{-0.5, 1.2, 0.3, -0.8, -0.1,
                                      0.4,  0.3, 0.2, 1.4}; // turns by more than 90 degrees
    Vec3 corner[8];
    distorted_cube(corner, 0.2, 3);
    double shares[12], lengths[total_hourglass_constants];
    start_total_hourglass(modes_of(corner), shares, lengths);
    for (Vec3& place : corner) place = linear_velocity(deformation, place);
    const auto total = total_hourglass(control, modes_of(corner), shares, lengths);
    EXPECT_LT(total.energy, 1e-20 * control.shear_modulus);
    for (const Vec3& force : total.force.hourglass) EXPECT_LT(norm(force), 1e-13 * control.shear_modulus);
}

TEST(TotalHourglass, IsTypeSixForSmallMotionsAndForgetsNoneOfALargeOne)
{
    // A small motion in all modes at once: the energies differ by the order of the motion. A loop of large
    // motions that ends where it began: type 7 has nothing left, type 6 has.
    const auto energy_after = [](Form form, double size, bool loop) {
        ScalarElement element;
        const auto brick = [](Vec3(&corner)[8], double out, int seed) { // three lengths of its own
            distorted_cube(corner, out, seed);
            for (Vec3& place : corner) place = {place.x, 1.4 * place.y, 0.7 * place.z};
        };
        brick(element.position, 0, 5);
        element.constants[inverse_volume_constant] = 1 / (1.4 * 0.7);
        element.start_total();
        if (form != Form::total_strain) std::fill_n(element.history + hourglass_history, 12, 0.0);
        Vec3 way[3][8];
        brick(way[0], size, 11);
        brick(way[1], size, 12);
        for (int i = 0; i < 8; ++i) {
            way[0][i] -= element.position[i];
            way[1][i] -= element.position[i];
            way[2][i] = -(way[0][i] + way[1][i]);
        }
        const int steps = 20, legs = loop ? 3 : 1;
        for (int leg = 0; leg < legs; ++leg) {
            for (int n = 0; n < steps; ++n) {
                for (int i = 0; i < 8; ++i) {
                    element.velocity[i] = (1.0 / steps) * way[leg][i];
                    element.position[i] += element.velocity[i];
                }
                element.step<SolidGradientRule::mean>(steel_parameters(form, true), 1.0);
            }
        }
        double left = 0;
        for (int i = 0; form != Form::total_strain && i < 12; ++i)
            left = std::max(left, std::abs(element.history[hourglass_history + i]));
        return std::array{element.history[hourglass_energy_history], left};
    };
    const double seven = energy_after(Form::total_strain, 1e-5, false)[0];
    EXPECT_GT(seven, 0);
    EXPECT_NEAR(energy_after(Form::assumed_strain, 1e-5, false)[0], seven, 1e-4 * seven);
    const double high = energy_after(Form::total_strain, 0.1, false)[0];
    EXPECT_LT(energy_after(Form::total_strain, 0.1, true)[0], 1e-25 * high);
    EXPECT_GT(energy_after(Form::assumed_strain, 0.1, true)[1], 1); // of forces of about 1e3
}

TEST(SolidStep, LanesEqualTheScalarReference)
{
    for (Form form : {Form::none, Form::viscous, Form::stiffness, Form::assumed_strain, Form::total_strain,
                      Form::assumed_rate}) {
        const auto check = [&](auto rule) {
            constexpr SolidGradientRule gradient_rule = decltype(rule)::value;
            ScalarElement element[lane_count];
            Vector3<Lanes> position[8], velocity[8];
            Lanes history[point_history], constants[point_constants + total_hourglass_constants];
            std::mt19937 random(9);
            for (int lane = 0; lane < lane_count; ++lane) {
                ScalarElement& one = element[lane];
                distorted_cube(one.position, 0.2, lane + 1);
                distorted_cube(one.velocity, 100, lane + 50);
                for (double& value : one.history) value = random() / 1e7;
                one.constants[0] = 0.9 + 0.05 * lane;
                if (form == Form::total_strain) one.start_total();
                for (int i = 0; i < 8; ++i) {
                    set_lane(position[i].x, lane, one.position[i].x);
                    set_lane(position[i].y, lane, one.position[i].y);
                    set_lane(position[i].z, lane, one.position[i].z);
                    set_lane(velocity[i].x, lane, one.velocity[i].x);
                    set_lane(velocity[i].y, lane, one.velocity[i].y);
                    set_lane(velocity[i].z, lane, one.velocity[i].z);
                }
                for (int i = 0; i < point_history; ++i) history[i][lane] = one.history[i];
                for (int i = 0; i < point_constants + total_hourglass_constants; ++i)
                    constants[i][lane] = one.constants[i];
            }
            const SolidParameters parameters = steel_parameters(form, true);
            const double h = 1e-4;
            const auto lanes = solid_step<gradient_rule>(steel_point, parameters, modes_of(position),
                                                         modes_of(velocity), h, history, constants);
            for (int lane = 0; lane < lane_count; ++lane) {
                const auto one = element[lane].template step<gradient_rule>(parameters, h);
                // The same operations up to fused multiply-adds: round-off of values up to 1e5.
                for (int i = 0; i < point_history; ++i) {
                    EXPECT_NEAR(history[i][lane], element[lane].history[i], 1e-9) << i;
                }
                EXPECT_NEAR(lanes.vote.stable_step[lane], one.vote.stable_step, 1e-13 * one.vote.stable_step);
                for (int i = 0; i < 3; ++i)
                    EXPECT_NEAR(lanes.force.linear[i].y[lane], one.force.linear[i].y, 1e-9);
                for (int i = 0; i < 4; ++i) {
                    EXPECT_NEAR(lanes.force.hourglass[i].z[lane], one.force.hourglass[i].z, 1e-9);
                }
            }
        };
        check(std::integral_constant<SolidGradientRule, SolidGradientRule::centre>{});
        check(std::integral_constant<SolidGradientRule, SolidGradientRule::mean>{});
    }
}

TEST(LaneRoots, InverseCubeRootIsExactToRoundOff)
{
    for (double a : {1e-30, 2e-7, 0.3, 1.0, 2.0, 8.0, 5e5, 1e20}) {
        EXPECT_NEAR(inverse_cube_root(a) * std::cbrt(a), 1, 1e-15 * 4);
        EXPECT_EQ(inverse_cube_root(broadcast<Lanes>(a))[3], inverse_cube_root(a));
    }
}

} // namespace plash

#include "elements/solid_eight_step.h"
#include "elements/solid_points.h"
#include "materials/plastic_kinematic.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace plash {

namespace {

using EightPointLaw = PlasticKinematic<false>;
using EightPoint = RatePoint<EightPointLaw>;
constexpr int history_size = first_gauss_point + solid_gauss_points * eight_point_size<EightPoint>;

EightPoint plastic_steel(double yield)
{
    return {EightPointLaw::from_record(
        make_record("MAT_PLASTIC_KINEMATIC",
                    {{"RO", 2}, {"E", 100}, {"PR", 0.3}, {"SIGY", yield}, {"ETAN", 5}, {"BETA", 1}}),
        Model{})};
}

struct Element {
    Vec3 corner[8], velocity[8];

    /// A flat box with corners moved at random, and random velocities of the given size.
    explicit Element(int seed, double speed)
    {
        std::mt19937 random(seed);
        const auto wave = [&](double size) { return size * (random() / 2147483648.0 - 1.0); };
        const double a[] = {0, 1, 1, 0, 0, 1, 1, 0}, b[] = {0, 0, 1, 1, 0, 0, 1, 1},
                     c[] = {0, 0, 0, 0, 1, 1, 1, 1};
        for (int i = 0; i < 8; ++i) {
            corner[i] = {4 * a[i] + wave(0.3), 2 * b[i] + wave(0.3), c[i] + wave(0.2)};
            velocity[i] = {wave(speed), wave(speed), wave(speed)};
        }
    }
};

SolidModes<double> modes(const Vec3 (&vectors)[8])
{
    return modes_of<double>(vectors);
}

SolidParameters parameters()
{
    SolidParameters p;
    p.density = 2;
    p.viscosity = {0, 0};
    return p;
}

std::vector<double> constants_of(const Element& element)
{
    const double volume = gradient_of<SolidGradientRule::mean>(modes(element.corner)).volume;
    return {1 / volume, 2 * volume};
}

} // namespace

class EightPointStep : public ::testing::TestWithParam<SolidShear> {};

TEST_P(EightPointStep, ForcesDoTheWorkThatTheEnergyShows)
{
    // A step so small that the geometry stays: the stress grows from zero, so its work is half of the end's
    // forces times the way. Holds only if forces are the transpose of the strains, with mean pressure and
    // all.
    for (int seed = 1; seed <= 5; ++seed) {
        const Element element(seed, 1e-8);
        std::vector<double> history(history_size), constants = constants_of(element);
        const auto result =
            eight_point_step(plastic_steel(1e9), parameters(), GetParam(), modes(element.corner),
                             modes(element.velocity), 1.0, history.data(), constants.data());
        double power = 0;
        Vec3 sum{}, moment{};
        for_corners(result.force, [&](int corner, const Vec3& force) {
            power += dot(force, element.velocity[corner]);
            sum += force;
            moment += cross(element.corner[corner], force);
        });
        EXPECT_NEAR(-0.5 * power, history[internal_energy_history], 1e-6 * history[internal_energy_history]);
        // In balance, on any shape.
        EXPECT_LT(norm(sum), 1e-13);
        EXPECT_LT(norm(moment), 1e-13);
    }
}

TEST_P(EightPointStep, LanesEqualTheScalarReference)
{
    Vector3<Lanes> corner[8], velocity[8];
    std::vector<Lanes> history(history_size), constants(2);
    std::vector<Element> elements;
    for (int lane = 0; lane < lane_count; ++lane) {
        elements.emplace_back(10 + lane, 0.01);
        const auto own = constants_of(elements.back());
        for (int i = 0; i < 2; ++i) constants[i][lane] = own[i];
        for (int i = 0; i < 8; ++i) {
            const auto put = [&](Vector3<Lanes>& to, const Vec3& from) {
                to.x[lane] = from.x;
                to.y[lane] = from.y;
                to.z[lane] = from.z;
            };
            put(corner[i], elements.back().corner[i]);
            put(velocity[i], elements.back().velocity[i]);
        }
    }
    SolidParameters settings = parameters();
    settings.viscosity = {1.5, 0.06};
    const auto batch = eight_point_step(plastic_steel(0.3), settings, GetParam(), modes_of<Lanes>(corner),
                                        modes_of<Lanes>(velocity), 1.0, history.data(), constants.data());
    bool plastic = false;
    for (int lane = 0; lane < lane_count; ++lane) {
        std::vector<double> own(history_size), own_constants = constants_of(elements[lane]);
        const auto single =
            eight_point_step(plastic_steel(0.3), settings, GetParam(), modes(elements[lane].corner),
                             modes(elements[lane].velocity), 1.0, own.data(), own_constants.data());
        EXPECT_NEAR(batch.force.linear[0].x[lane], single.force.linear[0].x, 1e-12);
        EXPECT_NEAR(batch.force.hourglass[3].z[lane], single.force.hourglass[3].z, 1e-12);
        EXPECT_NEAR(batch.vote.stable_step[lane], single.vote.stable_step, 1e-13);
        for (int i = 0; i < history_size; ++i) EXPECT_NEAR(history[i][lane], own[i], 1e-12) << i;
        plastic = plastic || own[point_history] > 0;
    }
    EXPECT_TRUE(plastic) << "the test never reaches the yield surface";
}

INSTANTIATE_TEST_SUITE_P(Shears, EightPointStep,
                         ::testing::Values(SolidShear::full, SolidShear::scaled, SolidShear::cancelled));

} // namespace plash

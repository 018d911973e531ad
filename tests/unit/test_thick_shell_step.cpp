#include "elements/shell_settings.h"
#include "elements/thick_shell_step.h"
#include "materials/elastic.h"
#include "materials/plastic_kinematic.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace plash {

namespace {

using ThickLaw = PlasticKinematic<false>;

ThickLaw thick_steel(double yield)
{
    return ThickLaw::from_record(
        make_record("MAT_PLASTIC_KINEMATIC",
                    {{"RO", 2}, {"E", 100}, {"PR", 0.3}, {"SIGY", yield}, {"ETAN", 5}, {"BETA", 1}}),
        Model{});
}

ThickShellSettings thick_settings(int columns, bool solid)
{
    ThickShellSettings settings;
    settings.rule = gauss_rule(3);
    settings.shear_share.assign(3, 1.0);
    settings.columns = columns;
    settings.shear_factor = 5.0 / 6;
    settings.hourglass =
        columns == 1 ? ThickShellSettings::Hourglass::stiffness : ThickShellSettings::Hourglass::none;
    settings.young_modulus = 100;
    settings.poisson_ratio = 0.3;
    settings.shear_modulus = 100 / 2.6;
    settings.wave_speed = 8;
    settings.bulk_viscosity = solid;
    return settings;
}

/// A flat box with corners moved at random, and random velocities of the given size.
struct ThickElement {
    Vec3 corner[8], velocity[8];

    explicit ThickElement(int seed, double speed)
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
    SolidModes<double> place() const { return modes_of<double>(corner); }
    SolidModes<double> motion() const { return modes_of<double>(velocity); }
    std::vector<double> constants() const
    {
        const double volume = gradient_of<SolidGradientRule::mean>(place()).volume;
        return {1 / volume, 2 * volume};
    }
};

template <class Lane>
SolidResult<Lane> thick_step(bool solid, const ThickLaw& law, const ThickShellSettings& settings,
                             const SolidModes<Lane>& place, const SolidModes<Lane>& motion, double step,
                             std::vector<Lane>& history, const std::vector<Lane>& constants)
{
    SolidParameters parameters;
    parameters.density = 2;
    parameters.viscosity = {0, 0};
    if (solid) {
        return thick_shell_step<ThickShellStress::solid>(law, settings, parameters, place, motion, step,
                                                         history.data(), constants.data());
    }
    return thick_shell_step<ThickShellStress::plane>(law, settings, parameters, place, motion, step,
                                                     history.data(), constants.data());
}

int thick_history(const ThickShellSettings& settings)
{
    return first_thick_point + settings.columns * settings.rule.size() * thick_point_size<ThickLaw>;
}

} // namespace

/// Columns of points, and whether stresses are those of solids.
class ThickShellStep : public ::testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(ThickShellStep, ForcesDoTheWorkThatTheEnergyShows)
{
    // A step so small that the geometry stays: the stress grows from zero, so its work is half of the end's
    // forces times the way. Holds only if forces are the transpose of the strains.
    const auto [columns, solid] = GetParam();
    const ThickShellSettings settings = thick_settings(columns, solid);
    for (int seed = 1; seed <= 5; ++seed) {
        const ThickElement element(seed, 1e-8);
        std::vector<double> history(thick_history(settings));
        const auto result = thick_step<double>(solid, thick_steel(1e9), settings, element.place(),
                                               element.motion(), 1.0, history, element.constants());
        double power = 0;
        Vec3 sum{}, moment{};
        for_corners(result.force, [&](int corner, const Vec3& force) {
            power += dot(force, element.velocity[corner]);
            sum += force;
            moment += cross(element.corner[corner], force);
        });
        const double energy = history[internal_energy_history] + history[hourglass_energy_history];
        EXPECT_GT(energy, 0);
        EXPECT_NEAR(-0.5 * power, energy, 2e-7 * energy);
        EXPECT_LT(norm(sum), 1e-12);
        EXPECT_LT(norm(moment), 1e-12);
    }
}

TEST_P(ThickShellStep, RigidMotionStrainsNothing)
{
    const auto [columns, solid] = GetParam();
    const ThickShellSettings settings = thick_settings(columns, solid);
    ThickElement element(3, 0);
    // A turn by 0.4 about (1, 2, 2) / 3 with mid-step velocities that carry every corner exactly.
    const double half = std::tan(0.2);
    const Vec3 axis{half / 3, 2 * half / 3, 2 * half / 3};
    const Tensor3<double> turn = incremental_rotation(axis);
    std::vector<double> history(thick_history(settings));
    for (int i = 0; i < 8; ++i) {
        const Vec3 after = turn * element.corner[i] + Vec3{5, 6, 7};
        element.velocity[i] = after - element.corner[i];
        element.corner[i] = after;
    }
    const auto result = thick_step<double>(solid, thick_steel(1e9), settings, element.place(),
                                           element.motion(), 1.0, history, element.constants());
    for_corners(result.force, [](int, const Vec3& force) { EXPECT_LT(norm(force), 1e-12); });
    EXPECT_NEAR(history[internal_energy_history], 0, 1e-24);
}

TEST_P(ThickShellStep, LinearMotionGivesOneStressOnAnyShape)
{
    const auto [columns, solid] = GetParam();
    const ThickShellSettings settings = thick_settings(columns, solid);
    ThickElement element(4, 0);
    const Tensor3<double> gradient{1, 2, -1, 0.5, -2, 3, 1, -1, 0.7};
    for (int i = 0; i < 8; ++i) element.velocity[i] = 1e-9 * (gradient * element.corner[i]);
    std::vector<double> history(thick_history(settings));
    thick_step<double>(solid, thick_steel(1e9), settings, element.place(), element.motion(), 1.0, history,
                       element.constants());
    EXPECT_NEAR(history[hourglass_energy_history], 0, 1e-28);
    const double* first = history.data() + first_thick_point;
    for (int point = 1; point < columns * settings.rule.size(); ++point) {
        const double* other = first + point * thick_point_size<ThickLaw>;
        for (int i = 0; i < 6; ++i) EXPECT_NEAR(first[i], other[i], 1e-14) << i; // of 1e-7
    }
}

/// Fibres across the thickness that lean to one side at one end of the element and to the other side at the
/// other are held by nothing but bending, 4 / 3 E (h / L)^2: pressure through the thickness may not push
/// them.
TEST_P(ThickShellStep, PressureThroughTheThicknessTurnsNoFibres)
{
    const auto [columns, solid] = GetParam();
    const ThickShellSettings settings = thick_settings(columns, solid);
    ThickElement element(1, 0);
    constexpr double a[] = {0, 1, 1, 0, 0, 1, 1, 0}, b[] = {0, 0, 1, 1, 0, 0, 1, 1},
                     c[] = {0, 0, 0, 0, 1, 1, 1, 1};
    for (int i = 0; i < 8; ++i) {
        const double lean = (2 * b[i] - 1) * (2 * c[i] - 1);
        element.corner[i] = {4 * a[i], 2 * b[i] + 0.02 * lean, 0.04 * c[i]};
        element.velocity[i] = {};
    }
    std::vector<double> history(thick_history(settings));
    for (int point = 0; point < columns * settings.rule.size(); ++point)
        history[first_thick_point + point * thick_point_size<ThickLaw> + 2] = -1;
    const auto result = thick_step<double>(solid, thick_steel(1e9), settings, element.place(),
                                           element.motion(), 1e-9, history, element.constants());
    double across = 0;
    for_corners(result.force, [&](int corner, const Vec3& force) {
        EXPECT_NEAR(force.y, 0, 1e-12) << corner;
        across += (2 * c[corner] - 1) * force.z;
    });
    EXPECT_NEAR(across, 2 * 4 * 2, 1e-9); // the pressure on both faces
}

TEST_P(ThickShellStep, LanesEqualTheScalarReference)
{
    const auto [columns, solid] = GetParam();
    const ThickShellSettings settings = thick_settings(columns, solid);
    Vector3<Lanes> corner[8], velocity[8];
    std::vector<Lanes> history(thick_history(settings)), constants(2);
    std::vector<ThickElement> elements;
    for (int lane = 0; lane < lane_count; ++lane) {
        elements.emplace_back(10 + lane, 0.01);
        const auto own = elements.back().constants();
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
    const auto batch = thick_step<Lanes>(solid, thick_steel(0.3), settings, modes_of<Lanes>(corner),
                                         modes_of<Lanes>(velocity), 1.0, history, constants);
    bool plastic = false;
    for (int lane = 0; lane < lane_count; ++lane) {
        std::vector<double> own(thick_history(settings));
        const auto single = thick_step<double>(solid, thick_steel(0.3), settings, elements[lane].place(),
                                               elements[lane].motion(), 1.0, own, elements[lane].constants());
        EXPECT_NEAR(batch.force.linear[0].x[lane], single.force.linear[0].x, 1e-12);
        EXPECT_NEAR(batch.force.hourglass[3].z[lane], single.force.hourglass[3].z, 1e-12);
        EXPECT_NEAR(batch.vote.stable_step[lane], single.vote.stable_step, 1e-13);
        for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NEAR(history[i][lane], own[i], 1e-12) << i;
        plastic = plastic || own[point_history] > 0;
    }
    EXPECT_TRUE(plastic) << "the test never reaches the yield surface";
}

INSTANTIATE_TEST_SUITE_P(Kinds, ThickShellStep,
                         ::testing::Combine(::testing::Values(1, 4), ::testing::Bool()));

} // namespace plash

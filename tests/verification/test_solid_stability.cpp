#include "elements/solid_stability.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

using testing::record_of;
using testing::SolidBlock;

namespace {

constexpr double young = 210e9, cube_density = 7850, side = 0.01;

Record steel(double poisson)
{
    return record_of("MAT_ELASTIC", 1, {{"RO", cube_density}, {"E", young}, {"PR", poisson}});
}

double wave_speed(double poisson)
{
    return std::sqrt(young * (1 - poisson) / (cube_density * (1 + poisson) * (1 - 2 * poisson)));
}

/// First step of a block of cubes over side / wave speed.
double first_step(std::array<int, 3> cubes, double poisson, int formulation = 1)
{
    SolidBlock block(cubes, {side * cubes[0], side * cubes[1], side * cubes[2]}, steel(poisson));
    block.model.sections[0].fields[0].value = formulation;
    block.set_viscosity(1e-20, 1e-20);
    block.set_hourglass(4, 1e-9);
    State state = block.state();
    Clock clock;
    auto groups = make_solid_groups(block.model, state);
    groups[0]->add_forces(clock, state);
    return groups[0]->stable_step().step * wave_speed(poisson) / side;
}

struct Vibration {
    Outcome outcome;
    double growth = 0; ///< energy at the end over that at the start
};

/// A free block of cubes with random velocities of its nodes, at the default TSSFAC of 0.9.
Vibration vibrate(std::array<int, 3> cubes, double poisson, int formulation, double viscosity, long cycles)
{
    SolidBlock block(cubes, {side * cubes[0], side * cubes[1], side * cubes[2]}, steel(poisson));
    block.model.sections[0].fields[0].value = formulation;
    block.set_viscosity(viscosity, viscosity);
    std::mt19937 random(3);
    const auto number = [&] { return 1e-8 * wave_speed(poisson) * (random() / 2147483648.0 - 1.0); };
    block.set_velocity([&](const Vec3&) {
        const double x = number(), y = number(), z = number();
        return Vec3{x, y, z};
    });
    block.model.controls.time.end_cycle = cycles;
    Scene scene = make_scene(block.model);
    double start = 0;
    for (std::size_t n = 0; n < scene.state.size(); ++n)
        start += 0.5 * scene.state.mass[n] * dot(scene.state.velocity[n], scene.state.velocity[n]);
    Recorders recorders;
    Vibration result;
    result.outcome = run(scene, recorders);
    result.growth = std::abs(scene.ledger.kinetic + scene.ledger.internal) / start;
    return result;
}

} // namespace

TEST(SolidStability, LoneCubeHasItsClosedFormFrequency)
{
    // Uniform dilatation, corners moving by (+-1, +-1, +-1) L e / 2: V 9 K e^2 / 2 against
    // rho V 3 L^2 / 4 e'^2 / 2, so omega^2 = 12 K / (rho L^2).
    LinearSolid cube;
    const double signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    for (int i = 0; i < 8; ++i) {
        cube.node[i] = i;
        cube.gradient[i] = 0.25 * Vec3{signs[i][0], signs[i][1], signs[i][2]};
    }
    cube.volume = 1;
    cube.bulk = 2.5;
    cube.shear = 0.5;
    const std::vector<Vec3> inverse_mass(8, {8, 8, 8});
    EXPECT_NEAR(lone_frequency_squared(cube, 0.125), 30, 1e-9);
    EXPECT_NEAR(largest_eigenvalue({&cube, 1}, inverse_mass, 1e30), 30, 1e-6);
}

TEST(SolidStability, BlocksThatHoldTogetherKeepTheStepOfAWave)
{
    // Largest frequency over 2 c / L at nu = 0.3, by power iteration on the assembled matrices: 7 x 7 x 7
    // cubes 1.027, 3 x 3 x 3 1.074; both bear 0.9 L / c.
    EXPECT_NEAR(first_step({7, 7, 7}, 0.3), 1, 1e-12);
    EXPECT_NEAR(first_step({3, 3, 3}, 0.3), 1, 1e-12);
    EXPECT_NEAR(first_step({1, 1, 1}, 0), 1, 1e-12);
}

TEST(SolidStability, FullyIntegratedPlatesCountTheViscosityOverTheirHeightAtRest)
{
    // LS-DYNA: L / (c (Q2 + sqrt(Q2^2 + 1))) with L = volume / largest face; of the flange of its preloaded
    // bolt, 3 x 3 x 1.5, to the last digit.
    SolidBlock plate({6, 6, 2}, {18, 18, 3}, steel(0.3));
    plate.model.sections[0].fields[0].value = -1;
    State state = plate.state();
    Clock clock;
    auto groups = make_solid_groups(plate.model, state);
    groups[0]->add_forces(clock, state);
    EXPECT_NEAR(groups[0]->stable_step().step * wave_speed(0.3), 1.5 / (0.06 + std::sqrt(1.0036)), 1e-12);
}

TEST(SolidStability, LooseElementsGetAShorterStep)
{
    // Likewise: one cube 1.363 (nu 0.3), 1.624 (0.45); a row of ten 1.232 and 1.438; 2 x 2 x 1 1.144
    // and 1.332. TSSFAC 0.9, two hundredths below the bound; Lanczos' frequencies are within 1e-3.
    const double whole = 0.98 / 0.9;
    EXPECT_NEAR(first_step({1, 1, 1}, 0.3), whole / 1.363, 1e-3);
    EXPECT_NEAR(first_step({1, 1, 1}, 0.45), whole / 1.624, 1e-3);
    EXPECT_NEAR(first_step({10, 1, 1}, 0.3), whole / 1.232, 1e-3);
    EXPECT_NEAR(first_step({10, 1, 1}, 0.45), whole / 1.438, 1e-3);
    EXPECT_NEAR(first_step({2, 2, 1}, 0.3), whole / 1.144, 1e-3);
    EXPECT_NEAR(first_step({2, 2, 1}, 0.45), whole / 1.332, 1e-3);
}

TEST(SolidStability, DampedBlocksVibrateWithoutGain)
{
    // At LS-DYNA's step each of these gains ten orders of magnitude in 5,000 cycles. Small vibrations: the
    // step follows the element, and what it changes in a swing feeds or starves the vibration.
    for (int formulation : {1, 2}) {
        for (std::array<int, 3> cubes : {std::array{4, 1, 1}, {4, 4, 1}, {3, 3, 3}, {6, 6, 6}}) {
            for (double poisson : {0.3, 0.45, 0.49}) {
                for (double viscosity : {0.06, 1e-20}) {
                    const Vibration block = vibrate(cubes, poisson, formulation, viscosity, 2000);
                    EXPECT_LT(block.growth, 1.001) << formulation << ' ' << cubes[0] << 'x' << cubes[2] << ' '
                                                   << poisson << ' ' << viscosity;
                }
            }
        }
    }
}

TEST(SolidStability, ALoneCubeVibratesWithoutEndAndWithoutGain)
{
    for (int formulation : {1, 2, -1}) {
        for (double poisson : {0.0, 0.3, 0.45}) {
            for (double viscosity : {0.06, 1e-20}) {
                const Vibration cube = vibrate({1, 1, 1}, poisson, formulation, viscosity, 100000);
                EXPECT_EQ(cube.outcome.termination, Outcome::Termination::normal) << cube.outcome.message;
                EXPECT_EQ(cube.outcome.clock.cycle, 100000);
                EXPECT_LT(cube.growth, 1.001) << formulation << ' ' << poisson << ' ' << viscosity;
            }
        }
    }
}

} // namespace plash

#include "tests/support/ale_samples.h"

#include <gtest/gtest.h>
#include <numbers>

namespace plash {

namespace {

constexpr double fall = 9.81;

/// Water with a soft spring, so that a case of milliseconds of sound becomes one of seconds; flow speeds stay
/// below a tenth of the sound speed.
FluidGroup soft_water(double speed_of_sound)
{
    FluidGroup water = linear_liquid(1000, speed_of_sound);
    water.tension_limit = -1e4;
    return water;
}

/// A sheet one cell thick in a closed box, filled up to level(x) and in hydrostatic equilibrium below it: in
/// the cell of the surface, pressure is half of what the water in it weighs by area.
BoxFluid filled_sheet(double length, double height, int cells_x, int cells_z, double speed_of_sound,
                      const std::function<double(double)>& level)
{
    const double thickness = length / cells_x;
    LagrangeSettings settings;
    settings.void_allowed = true;
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {length, thickness, height}, {cells_x, 1, cells_z}),
                   {soft_water(speed_of_sound)}, settings);
    fluid.held = walls_of_box(fluid.grid);
    fluid.gravity = {0, 0, -fall};
    for_cells(fluid.grid, [&](int i, int j, int k) {
        const double low = fluid.grid.planes(2)[k], width = fluid.grid.width(2, k);
        const double surface = level(fluid.grid.centre(0, i));
        const double fraction = std::clamp((surface - low) / width, 0.0, 1.0);
        if (fraction == 0) return;
        const double depth = fraction < 1 ? 0.5 * width : surface - low - 0.5 * width;
        const double square = speed_of_sound * speed_of_sound;
        fluid.fill_cell(i, j, k, 0, fraction, 1000 + 1000 * fall * depth / square, 0);
    });
    fluid.start();
    return fluid;
}

double fastest(const BoxFluid& fluid)
{
    double largest = 0;
    for (const auto& component : fluid.fields.velocity) {
        for (const double v : component) largest = std::max(largest, std::abs(v));
    }
    return largest;
}

} // namespace

// Still water whose surface lies anywhere in a cell stays still. It starts with the densities of the
// continuous hydrostatic column, which differ from equilibrium by the weight of the compression itself, rho g
// H / K = 1e-4 here.
TEST(AleFreeSurface, StillWaterStaysStill)
{
    for (const double level : {0.205, 0.21, 0.2199}) {
        BoxFluid fluid = filled_sheet(0.32, 0.32, 16, 16, 150, [&](double) { return level; });
        const double first = 0.67 * fluid.stable_step();
        fluid.advance(first);
        EXPECT_LT(fastest(fluid) / first, 1e-4 * fall) << "first acceleration, surface at " << level;
        double time = first;
        while (time < 1) {
            const double step = 0.67 * fluid.stable_step();
            fluid.advance(step);
            time += step;
        }
        EXPECT_LT(fastest(fluid), 1e-5 * std::sqrt(fall * level)) << "surface at " << level;
        for (int k = 0; k < 9; ++k) {
            const double pressure = fluid.fields.pressure[fluid.grid.at(5, 0, k)];
            EXPECT_NEAR(pressure, 1000 * fall * (level - fluid.grid.centre(2, k)),
                        1e-3 * 1000 * fall * level);
        }
    }
}

// A tank at rest for 10 s. The water, softer than above, sinks by rho g H / K / 2 of its depth as it finds
// its weight, and comes to rest. Nothing feeds its motion.
TEST(AleFreeSurface, TankRestsForTenSeconds)
{
    constexpr double level = 0.21, sound = 30;
    BoxFluid fluid = filled_sheet(0.32, 0.32, 16, 16, sound, [&](double) { return level; });
    const double mass = fluid.total_mass(0);
    double half_way = 0;
    for (double time = 0; time < 10;) {
        const double step = 0.67 * fluid.stable_step();
        fluid.advance(step);
        time += step;
        if (half_way == 0 && time > 5) half_way = fluid.energies().kinetic;
    }
    EXPECT_LT(fastest(fluid), 1e-5 * std::sqrt(fall * level));
    EXPECT_LE(fluid.energies().kinetic, half_way + 1e-20);
    EXPECT_NEAR(fluid.total_mass(0), mass, 1e-12 * mass);
    for (int k = 0; k < 9; ++k)
        EXPECT_NEAR(fluid.fields.pressure[fluid.grid.at(5, 0, k)],
                    1000 * fall * (level - fluid.grid.centre(2, k)), 5e-3 * 1000 * fall * level);
}

// First sloshing mode: omega^2 = g k tanh(k h) (Lamb 1932, article 228); amplitude of a third of a cell.
TEST(AleFreeSurface, SloshingHasTheLinearPeriod)
{
    const double wave_number = std::numbers::pi, depth = 0.5;
    const double period =
        2 * std::numbers::pi / std::sqrt(fall * wave_number * std::tanh(wave_number * depth));
    double errors[2];
    for (int mesh = 0; mesh < 2; ++mesh) {
        const int cells = mesh == 0 ? 16 : 32;
        BoxFluid fluid = filled_sheet(1, 0.75, cells, cells * 3 / 4, 30, [&](double x) {
            return depth + 0.01 * std::cos(std::numbers::pi * x);
        });
        const auto mode = [&] {
            double sum = 0;
            for (int i = 0; i < cells; ++i) {
                double column = 0;
                for (int k = 0; k < fluid.grid.cells(2); ++k) {
                    column += fluid.fields.groups[0].fraction[fluid.grid.at(i, 0, k)] / cells;
                }
                sum += (column - depth) * std::cos(std::numbers::pi * fluid.grid.centre(0, i)) * 2 / cells;
            }
            return sum;
        };
        double time = 0, before = mode(), largest = 0;
        std::vector<double> crossings;
        while (crossings.size() < 4) {
            const double step = 0.67 * fluid.stable_step();
            fluid.advance(step);
            const double now = mode();
            largest = std::max(largest, std::abs(now));
            if (before * now < 0) crossings.push_back(time + step * before / (before - now));
            before = now;
            time += step;
        }
        errors[mesh] = std::abs((crossings[3] - crossings[0]) / 1.5 / period - 1);
        EXPECT_LT(largest, 0.0104); // nothing feeds the wave, within 4 %
        EXPECT_GT(largest, 0.0098);
    }
    EXPECT_LT(errors[1], 0.004); // measured 0.0028
    EXPECT_LT(errors[1], errors[0]);
}

// Collapse of a column 0.15 x 0.25 m in a box 0.6 m long; until the front arrives at the far wall nothing may
// take energy from the water. Gravity has done 1.18 J by t = 0.2 (the same in a mesh twice as fine).
TEST(AleFreeSurface, DamBreakKeepsItsEnergy)
{
    LagrangeSettings settings;
    settings.void_allowed = true;
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {0.6, 0.05, 0.4}, {60, 1, 40}), {soft_water(100)}, settings);
    fluid.held = walls_of_box(fluid.grid);
    fluid.gravity = {0, 0, -fall};
    for_cells(fluid.grid, [&](int i, int j, int k) {
        if (i < 15 && k < 25) fluid.fill_cell(i, j, k, 0, 1, 1000, 0);
    });
    fluid.start();
    const double mass = fluid.total_mass(0), volume = mass / 1000, energy = fluid.energies().internal;
    for (double time = 0; time < 0.2;) {
        const double step = 0.67 * fluid.stable_step();
        fluid.advance(step);
        time += step;
    }
    const FluidEnergies& now = fluid.energies();
    EXPECT_NEAR(fluid.total_mass(0), mass, 1e-12 * mass);
    EXPECT_NEAR(now.kinetic + now.internal - energy + now.advection_loss, now.outside_work,
                1e-11 * now.kinetic);
    EXPECT_LT(now.advection_loss, 0.003 * now.outside_work);
    EXPECT_GT(now.kinetic, 0.995 * now.outside_work);
    // The water neither swells nor hides: volume of all fractions, pressure 2 kPa on a bulk modulus of 10
    // MPa.
    double filled = 0, highest = 0, lowest = 0;
    int front = 0;
    for_cells(fluid.grid, [&](int i, int j, int k) {
        const std::ptrdiff_t place = fluid.grid.at(i, j, k);
        const double fraction = fluid.fields.groups[0].fraction[place];
        filled += fraction * fluid.grid.volume(i, j, k);
        if (k == 0 && fraction > 0.5) front = std::max(front, i + 1);
        highest = std::max(highest, fluid.fields.pressure[place]);
        lowest = std::min(lowest, fluid.fields.pressure[place]);
    });
    EXPECT_NEAR(filled, volume, 3e-4 * volume);
    EXPECT_LT(highest, 3000);
    EXPECT_GT(lowest, -300);
    // Front 0.45 m from the wall at t = 0.2, within two cells (here and in a mesh twice as fine).
    EXPECT_NEAR(front, 45, 2);
}

// Growth of a small wave on the interface of two liquids, heavy above light: sigma^2 = A g k tanh(k h)
// (Taylor 1950). The velocity is continuous over the cells of the interface, and such a layer of thickness h
// slows the growth as sigma^-2 = sigma0^-2 (1 + c k h): two meshes give sigma0.
TEST(AleMixture, RayleighTaylorGrowsAsItShould)
{
    const Threads one(1);
    constexpr double light = 1, heavy = 2, speed = 10, height = 2, base = 1, amplitude = 0.004;
    double inverse_square[2];
    for (int mesh = 0; mesh < 2; ++mesh) {
        const int cells = mesh == 0 ? 24 : 48; // a wave length; half of it is in the box
        BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {0.5, 1.0 / cells, height}, {cells / 2, 1, 2 * cells}),
                       {linear_liquid(light, speed), linear_liquid(heavy, speed)}, {});
        fluid.held = walls_of_box(fluid.grid);
        fluid.gravity = {0, 0, -1};
        for_cells(fluid.grid, [&](int i, int j, int k) {
            const double surface = 1 + amplitude * std::cos(2 * std::numbers::pi * fluid.grid.centre(0, i));
            const double below = std::clamp((surface - fluid.grid.planes(2)[k]) * cells, 0.0, 1.0);
            const double z = fluid.grid.centre(2, k);
            const double pressure = base + (z > 1 ? heavy * (height - z) : heavy + light * (1 - z));
            const double gain = pressure / (speed * speed);
            if (below > 0) fluid.fill_cell(i, j, k, 0, below, light + gain, 0);
            if (below < 1) fluid.fill_cell(i, j, k, 1, 1 - below, heavy + gain, 0);
        });
        fluid.start();
        const double masses[2] = {fluid.total_mass(0), fluid.total_mass(1)};
        const double energy = fluid.energies().internal;
        const auto mode = [&] {
            double sum = 0;
            for_cells(fluid.grid, [&](int i, int j, int k) {
                sum += fluid.fields.groups[0].fraction[fluid.grid.at(i, j, k)] *
                       std::cos(2 * std::numbers::pi * fluid.grid.centre(0, i)) * 4 / cells / cells;
            });
            return sum;
        };
        const auto run = [&](double span) {
            for (double time = 0; time < span;) {
                const double step = std::min(0.67 * fluid.stable_step(), span - time);
                fluid.advance(step);
                time = span - time - step < 1e-12 ? span : time + step;
            }
        };
        // a(t) = a0 cosh(sigma t): the second difference over equal spans gives cosh(sigma span).
        run(0.8);
        const double first = mode();
        run(0.6);
        const double second = mode();
        run(0.6);
        const double third = mode();
        const double sigma = std::acosh(0.5 * (first + third) / second) / 0.6;
        inverse_square[mesh] = 1 / (sigma * sigma);
        for (int group = 0; group < 2; ++group) {
            EXPECT_NEAR(fluid.total_mass(group), masses[group], 1e-12 * masses[group]);
        }
        const FluidEnergies& now = fluid.energies();
        EXPECT_NEAR(now.kinetic + now.internal + now.advection_loss - now.outside_work, energy, 1e-12);
    }
    const double at_interface = (base + heavy) / (speed * speed);
    const double atwood = (heavy - light) / (heavy + light + 2 * at_interface);
    const double expected = std::sqrt(atwood * 2 * std::numbers::pi * std::tanh(2 * std::numbers::pi));
    const double extrapolated = 1 / std::sqrt(2 * inverse_square[1] - inverse_square[0]);
    EXPECT_NEAR(1 / std::sqrt(inverse_square[1]) / expected, 1, 0.10);
    EXPECT_NEAR(extrapolated / expected, 1, 0.03);
}

} // namespace plash

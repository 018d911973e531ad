#include "ale/cell_flux.h"
#include "tests/support/ale_samples.h"

#include <gtest/gtest.h>

/// Viscous flow on the Eulerian mesh.
namespace plash {

namespace {

/// A cavity of side 1 with a lid that slides at speed 1; sound 10, density 1. Its corners stand still.
BoxFluid cavity(int side, double viscosity, double smooth)
{
    FluidGroup water = linear_liquid(1, 10);
    water.viscosity = viscosity;
    water.tension_limit = -1e9;
    LagrangeSettings settings;
    settings.quadratic_viscosity = settings.linear_viscosity = 0;
    settings.viscous = true;
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {1, 1.0 / side, 1}, {side, 1, side}), {water}, settings);
    for (int k = 0; k <= side; ++k) {
        for (int i = 0; i <= side; ++i) {
            const bool wall = i == 0 || i == side || k == 0 || k == side;
            HeldNode node;
            node.axes = wall ? 7 : 2; // the flow is plane
            if (k == side && i > 0 && i < side) node.before[0] = node.after[0] = 1;
            for (int j = 0; j < 2; ++j) {
                node.place = fluid.grid.at(i, j, k);
                fluid.held.push_back(node);
            }
        }
    }
    for_cells(fluid.grid, [&](int i, int j, int k) { fluid.fill_cell(i, j, k, 0, 1, 1, 0); });
    if (smooth > 0) fluid.keep_smooth_slopes(smooth);
    fluid.start();
    return fluid;
}

/// Largest error of the velocity along the lid on the vertical centre line after `turns`.
/// Reference at Re 100: finite differences (psi-omega, second order, 129^2 and 257^2 extrapolated), which
/// Ghia, Ghia & Shin (1982) confirm to 0.006.
double error_of_cavity(int side, double smooth, double turns)
{
    BoxFluid fluid = cavity(side, 0.01, smooth);
    double time = 0;
    while (time < turns) {
        const double step = 0.67 * fluid.stable_step();
        fluid.advance(step);
        time += step;
    }
    constexpr double reference[][2] = {
        {0.9531, 0.69101},  {0.8516, 0.23654},  {0.7344, 0.00418},  {0.6172, -0.13880}, {0.5, -0.20914},
        {0.4531, -0.21397}, {0.2813, -0.15767}, {0.1719, -0.10174}, {0.1016, -0.06443}, {0.0703, -0.04662}};
    double largest = 0;
    for (const auto& [height, speed] : reference) {
        const int k = static_cast<int>(height * side);
        const auto at = [&](int row) { return fluid.fields.velocity[0][fluid.grid.at(side / 2, 0, row)]; };
        const double measured = at(k) + (height * side - k) * (at(k + 1) - at(k));
        largest = std::max(largest, std::abs(measured - speed));
    }
    return largest;
}

/// Kinetic energy that is left of a vortex without viscosity in a box of side 1 with slipping walls, speed 1,
/// after a time.
double vortex_left(int side, double smooth, double end)
{
    LagrangeSettings settings;
    settings.quadratic_viscosity = settings.linear_viscosity = 0;
    FluidGroup water = linear_liquid(1, 10);
    water.tension_limit = -1e9;
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {1, 1.0 / side, 1}, {side, 1, side}), {water}, settings);
    fluid.held = walls_of_box(fluid.grid);
    for_cells(fluid.grid, [&](int i, int j, int k) {
        const double x = fluid.grid.centre(0, i), z = fluid.grid.centre(2, k);
        const double pressure = 0.25 * (std::cos(2 * M_PI * x) + std::cos(2 * M_PI * z));
        fluid.fill_cell(i, j, k, 0, 1, 1 + pressure / 100, 0);
    });
    for (int k = 0; k <= side; ++k) {
        for (int i = 0; i <= side; ++i) {
            const double x = M_PI * i / side, z = M_PI * k / side;
            for (int j = 0; j < 2; ++j) {
                const std::ptrdiff_t place = fluid.grid.at(i, j, k);
                fluid.fields.velocity[0][place] = std::sin(x) * std::cos(z);
                fluid.fields.velocity[2][place] = -std::cos(x) * std::sin(z);
            }
        }
    }
    if (smooth > 0) fluid.keep_smooth_slopes(smooth);
    fluid.start();
    const double first = fluid.energies().kinetic;
    double time = 0;
    while (time < end) {
        const double step = 0.67 * fluid.stable_step();
        fluid.advance(step);
        time += step;
    }
    return fluid.energies().kinetic / first;
}

/// A layer of shear that a stream carries across itself: velocity +-0.025 along x, a jump between two nodes
/// at the start, stream 0.03 or 0.3 along z, sound 1. Largest velocity after 100 or 83 units of time, over
/// 0.025.
double peak_of_shear(double stream, double smooth)
{
    constexpr int wide = 240, high = 60; // what starts at the ends does not reach the middle
    BoxFluid fluid(BoxGrid::uniform({0, 0, 0}, {wide, 1, high}, {wide, 1, high}), {linear_liquid(1, 1)}, {});
    fluid.held = walls_of_box(fluid.grid);
    for_cells(fluid.grid, [&](int i, int j, int k) { fluid.fill_cell(i, j, k, 0, 1, 1, 0); });
    for (int k = 0; k <= high; ++k) {
        for (int i = 0; i <= wide; ++i) {
            for (int j = 0; j < 2; ++j) {
                const std::ptrdiff_t place = fluid.grid.at(i, j, k);
                fluid.fields.velocity[0][place] = k <= 15 ? 0.025 : -0.025;
                fluid.fields.velocity[2][place] = stream;
            }
        }
    }
    for (HeldNode& node : fluid.held) {
        node.axes &= ~1u;
        if (node.axes & 4) node.before[2] = node.after[2] = stream;
    }
    if (smooth > 0) fluid.keep_smooth_slopes(smooth);
    fluid.start();
    const double end = stream > 0.1 ? 25 / stream : 100;
    for (double time = 0; time < end;) {
        const double step = 0.67 * fluid.stable_step();
        fluid.advance(step);
        time += step;
    }
    double largest = 0;
    for (int k = 1; k < high; ++k)
        largest = std::max(largest, std::abs(fluid.fields.velocity[0][fluid.grid.at(wide / 2, 0, k)]));
    return largest / 0.025;
}

} // namespace

/// Slopes that van Leer's limiter cuts make no new extremum where velocities jump.
TEST(AleViscous, LayerOfShearKeepsItsBounds)
{
    const Threads one(1);
    for (const double stream : {0.03, 0.3}) EXPECT_LT(peak_of_shear(stream, 0), 1.0001) << stream;
}

/// Measured 1.110 and 1.158: why SMOOTH is not the default. Wanted: within 1 %.
TEST(AleViscous, DISABLED_LayerOfShearKeepsItsBoundsWithSmoothSlopes)
{
    const Threads one(1);
    for (const double stream : {0.03, 0.3}) EXPECT_LT(peak_of_shear(stream, 0.2), 1.01) << stream;
}

/// Nothing but the remap takes the energy of this vortex: 4.0 and 2.8 % on 16 cells a side, 0.52 and 0.36
/// on 32.
TEST(AleViscous, VortexTurnsOnWhereSlopesAreSmooth)
{
    const Threads one(1);
    const double limited = 1 - vortex_left(16, 0, 4), smooth = 1 - vortex_left(16, 0.2, 4);
    const double fine_limited = 1 - vortex_left(32, 0, 4), fine_smooth = 1 - vortex_left(32, 0.2, 4);
    EXPECT_LT(smooth, 0.75 * limited);
    EXPECT_LT(fine_smooth, 0.75 * fine_limited);
    EXPECT_LT(fine_smooth, smooth / 7); // of third order
}

/// 0.96 % with van Leer's limiter, 0.76 % without where the flow is smooth (at Re 3200 on 64 cells a side 9.5
/// and 2.4 %, docs/results/lid_driven_cavity.md).
TEST(AleViscous, LidDrivenCavityHasItsProfile)
{
    const Threads one(1);
    EXPECT_LT(error_of_cavity(32, 0, 12), 0.0105);
    EXPECT_LT(error_of_cavity(32, 0.2, 12), 0.0085);
}

/// A share of a speed of sound that no velocity comes near leaves nothing limited; a tiny one, all.
TEST(AleViscous, SmoothSlopesGoOverIntoLimitedOnes)
{
    const Line<double> line[3] = {{0, 1, 1.5, 1.6}, {0, 0, 2, 2}, {1, 3, 2, 1}};
    const LineWeights<double> even{0.5, 0.5, 0.5, 0.5};
    double limited[3], tiny[3], wide[3];
    carried_velocities<true>(line, true, 0.25, even, 0, limited);
    carried_velocities<true>(line, true, 0.25, even, 1e-12, tiny);
    carried_velocities<true>(line, true, 0.25, even, 1e12, wide);
    for (int axis = 0; axis < 3; ++axis) {
        const Line<double>& v = line[axis];
        EXPECT_NEAR(tiny[axis], limited[axis], 1e-11);
        EXPECT_NEAR(wide[axis], v.below + 0.5 * 0.75 * 0.5 * (v.above - v.far_below), 1e-11);
    }
}

} // namespace plash

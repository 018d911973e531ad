#include "elements/shell_groups.h"
#include "solver/explicit_loop.h"
#include "tests/support/history.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plash {

namespace {

constexpr double plate_side = 100, plate_thickness = 1, plate_density = 7.8e-6, plate_young_modulus = 210,
                 plate_poisson_ratio = 0.3;

/// First frequency of a simply supported square plate of n x n elements, cut into triangles if asked,
/// relative to that of Kirchhoff's plate, f = pi / a^2 sqrt(D / (rho t)).
double relative_frequency(int formulation, int n, bool triangles)
{
    Model model = shell_model(
        make_record("MAT_ELASTIC",
                    {{"RO", plate_density}, {"E", plate_young_modulus}, {"PR", plate_poisson_ratio}}),
        {{"ELFORM", formulation}, {"NIP", 2}, {"SHRF", 5.0 / 6}, {"T1", plate_thickness}});
    add_grid(model, n, n, [&](int i, int j) { return Vec3{plate_side * i / n, plate_side * j / n, 0}; });
    if (triangles) cut_into_triangles(model);
    // Hard support: no slope along an edge (the soft one would let the edges twist, 0.2 % at t / a = 0.01).
    std::vector<Index> edge, edge_along_y, edge_along_x;
    for (Index node = 0; node < static_cast<Index>(model.nodes.size()); ++node) {
        const Vec3& x = model.nodes.position[node];
        if (x.x == 0 || x.y == 0 || x.x == plate_side || x.y == plate_side) edge.push_back(node);
        if (x.x == 0 || x.x == plate_side) edge_along_y.push_back(node);
        if (x.y == 0 || x.y == plate_side) edge_along_x.push_back(node);
    }
    hold(model, edge, 4);
    hold(model, edge_along_y, 8);
    hold(model, edge_along_x, 16);
    const double bending = plate_young_modulus * plate_thickness * plate_thickness * plate_thickness /
                           (12 * (1 - plate_poisson_ratio * plate_poisson_ratio));
    const double frequency =
        std::numbers::pi / (plate_side * plate_side) * std::sqrt(bending / (plate_density * plate_thickness));
    model.controls.time.end_time = 2.3 / frequency;
    Scene scene = make_scene(model);
    const double k = std::numbers::pi / plate_side, size = 1e-3;
    for (std::size_t node = 0; node < scene.state.size(); ++node) {
        const Vec3& x = model.nodes.position[node];
        scene.state.velocity[node].z = -size * std::sin(k * x.x) * std::sin(k * x.y);
        scene.state.angular_velocity[node].x = -size * k * std::sin(k * x.x) * std::cos(k * x.y);
        scene.state.angular_velocity[node].y = size * k * std::cos(k * x.x) * std::sin(k * x.y);
    }
    std::vector<double> time, middle;
    const std::size_t centre = (n / 2) * (n + 1) + n / 2;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        time.push_back(clock.time);
        middle.push_back(state.position[centre].z);
    }));
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    return 1 / (period_of(time, middle) * frequency);
}

} // namespace

TEST(ShellPlate, SimplySupportedFrequencyConverges)
{
    const double coarse = relative_frequency(2, 8, false), fine = relative_frequency(2, 16, false);
    // At n = 16 rotary inertia of the nodes (A / 8) lowers it by k^2 A / 16 = 0.48 % with k^2 = 2 (pi / a)^2,
    // one-point gradients of sine waves by (pi / n)^2 / 12 = 0.32 %, and shear by k^2 D / (2 kappa G t) =
    // 0.03 %.
    EXPECT_NEAR(fine, 1 - 0.0083, 3e-4);
    EXPECT_NEAR((coarse - 1) / (fine - 1), 4, 0.2);
}

TEST(ShellPlate, FullyIntegratedElementsHaveTheFrequencyOfTheirLattice)
{
    // The discrete mode is w = sin sin with slopes C = (2/h) tan(a), a = k h / 2, by the shear sampled at the
    // sides; curvatures are those of bilinear slopes, s = (2/h) sin(a), integrated exactly; rotary inertia A
    // / 8 at the nodes.
    const auto of_lattice = [](int n) {
        const double k = std::numbers::pi / plate_side, h = plate_side / n, a = 0.5 * k * h;
        const double s = 2 / h * std::sin(a), C = 2 / h * std::tan(a), c = std::cos(a);
        const double bending =
            (3 - plate_poisson_ratio) * (2 + std::cos(2 * a)) / 3 + (1 + plate_poisson_ratio) * c * c;
        return s * C / (2 * k * k) * std::sqrt(bending / (1 + 0.25 * h * h * C * C));
    };
    for (const int n : {6, 12}) {
        // Shear lowers it by k^2 D / (2 kappa G t) = 0.03 %.
        EXPECT_NEAR(relative_frequency(16, n, false), of_lattice(n) - 3e-4, 1e-4) << n;
    }
}

TEST(ShellPlate, TrianglesConverge)
{
    const double coarse = relative_frequency(4, 12, true), fine = relative_frequency(4, 24, true);
    EXPECT_NEAR(fine, 1, 0.004) << coarse;
    EXPECT_LT(std::abs(fine - 1), 0.3 * std::abs(coarse - 1)) << coarse << " " << fine;
}

} // namespace plash

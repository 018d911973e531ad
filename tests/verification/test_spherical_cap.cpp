#include "elements/shell_groups.h"
#include "solver/explicit_loop.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plash {

namespace {

/// Largest deflection at the top of a clamped spherical cap (radius 22.27 in, half angle 26.67 degrees, 0.41
/// in thick, E = 1.05e7 psi, nu = 0.3, rho = 2.45e-4) under a sudden pressure of 600 psi (Belytschko, Lin &
/// Tsay 1984, Comput. Methods Appl. Mech. Engng 42, 225-251); a quarter with 3 n^2 elements [in].
double cap_deflection(double formulation, int n)
{
    constexpr double radius = 22.27, thickness = 0.41;
    const double half_angle = 26.67 * std::numbers::pi / 180;
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 2.45e-4}, {"E", 1.05e7}, {"PR", 0.3}}),
                              {{"ELFORM", formulation}, {"NIP", 2}, {"SHRF", 5.0 / 6}, {"T1", thickness}});
    model.controls.elements.warping = 1;
    // A quarter disk of three squares: corner 0, middles of the edges, point inside; then onto the sphere.
    const auto lift = [&](double u, double v) { // u, v in the unit quarter disk
        const double r = std::hypot(u, v), angle = half_angle * r;
        const double across = r > 0 ? radius * std::sin(angle) / r : 0;
        return Vec3{across * u, across * v, radius * std::cos(angle)};
    };
    const auto at = [&](double u, double v) {
        const Vec3 place = lift(u, v);
        for (Index i = 0; i < static_cast<Index>(model.nodes.size()); ++i)
            if (norm(model.nodes.position[i] - place) < 1e-6) return i;
        return add_node(model, place);
    };
    const double inner = 0.5, corner = 0.42, arc = std::sqrt(0.5);
    const double squares[3][4][2] = {{{0, 0}, {inner, 0}, {corner, corner}, {0, inner}},
                                     {{inner, 0}, {1, 0}, {arc, arc}, {corner, corner}},
                                     {{0, inner}, {corner, corner}, {arc, arc}, {0, 1}}};
    for (int square = 0; square < 3; ++square) {
        const auto point = [&](int i, int j) {
            const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
            const auto& c = squares[square];
            double uv[2];
            for (int k = 0; k < 2; ++k)
                uv[k] = (1 - a) * (1 - b) * c[0][k] + a * (1 - b) * c[1][k] + a * b * c[2][k] +
                        (1 - a) * b * c[3][k];
            // The outer edges are arcs: blend the radius with that of the rim.
            if (square == 0) return at(uv[0], uv[1]);
            const bool first = square == 1;
            const double share = first ? a : b, along = first ? b : a;
            const double angle = std::numbers::pi / 4 * (first ? b : 2 - a);
            const auto& start = c[first ? 1 : 3];
            const double rim[2] = {std::cos(angle), std::sin(angle)};
            const double straight[2] = {(1 - along) * start[0] + along * c[2][0],
                                        (1 - along) * start[1] + along * c[2][1]};
            return at(uv[0] + share * (rim[0] - straight[0]), uv[1] + share * (rim[1] - straight[1]));
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                add_shell(model, {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
    }
    std::vector<Index> on_x, on_y, rim;
    PressureLoad load;
    load.curve = 0;
    for (Index i = 0; i < static_cast<Index>(model.nodes.size()); ++i) {
        const Vec3& x = model.nodes.position[i];
        if (x.z < radius * std::cos(half_angle) + 1e-6) rim.push_back(i);
        if (std::abs(x.x) < 1e-9) on_x.push_back(i);
        if (std::abs(x.y) < 1e-9) on_y.push_back(i);
    }
    hold(model, rim, 63);
    hold(model, on_x, 1 | 16 | 32);
    hold(model, on_y, 2 | 8 | 32);
    model.curves.push_back({1, "", {}, Curve{{0, 1}, {600, 600}}});
    for (const auto& nodes : model.shells.nodes) load.segments.push_back(nodes);
    model.pressure_loads.push_back(load);
    model.controls.time.end_time = 1e-3;
    Scene scene = make_scene(model);
    double largest = 0;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock&, const State& state) {
        largest = std::max(largest, std::abs(radius - state.position[0].z));
    }));
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_LT(scene.ledger.balance_error(), 5e-3);
    return largest;
}

} // namespace

/// No published number was at hand: both formulations and two meshes have to agree.
TEST(SphericalCap, FormulationsAndMeshesAgree)
{
    const double fine = cap_deflection(16, 16);
    EXPECT_NEAR(cap_deflection(16, 8), fine, 0.02 * fine);
    EXPECT_NEAR(cap_deflection(2, 16), fine, 0.02 * fine);
}

} // namespace plash

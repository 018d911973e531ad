#include "materials/honeycomb.h"
#include "tests/support/law_driver.h"
#include "tests/support/records.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// mm, ms, kg, GPa; an aluminium honeycomb, strong along a.
constexpr double solid_modulus = 69, solid_poisson = 0.33, solid_yield = 0.3, compacted = 0.2;

Model with_curves()
{
    Model model;
    const auto add = [&](Id id, std::vector<double> x, std::vector<double> y) {
        model.curves.push_back({id, "", {}, {std::move(x), std::move(y)}});
    };
    add(1, {0, 0.5, 0.8}, {1e-3, 2e-3, 5e-3});   // along a, over 1 - V
    add(2, {0, 0.8}, {2e-4, 2e-4});              // across
    add(3, {0, 0.8}, {5e-4, 5e-4});              // shear
    add(4, {0.2, 0.5, 1.0}, {5e-3, 2e-3, 1e-3}); // 1 over V
    add(5, {0, 1e3}, {1, 2});                    // rate
    return model;
}

std::vector<std::pair<const char*, double>> honeycomb_card(std::vector<std::pair<const char*, double>> more)
{
    std::vector<std::pair<const char*, double>> fields{{"RO", 5e-8},
                                                       {"E", solid_modulus},
                                                       {"PR", solid_poisson},
                                                       {"SIGY", solid_yield},
                                                       {"VF", compacted},
                                                       {"LCA", 1},
                                                       {"LCB", 2},
                                                       {"LCC", 2},
                                                       {"LCS", 3},
                                                       {"EAAU", 1.0},
                                                       {"EBBU", 0.2},
                                                       {"ECCU", 0.2},
                                                       {"GABU", 0.4},
                                                       {"GBCU", 0.1},
                                                       {"GCAU", 0.3}};
    fields.insert(fields.begin(), more.begin(), more.end());
    return fields;
}

Honeycomb honeycomb(std::vector<std::pair<const char*, double>> more = {})
{
    return Honeycomb::from_record(make_record("MAT_HONEYCOMB", honeycomb_card(std::move(more))),
                                  with_curves());
}

/// A point whose axes are turned by an angle about z.
testing::DrivenPoint<Honeycomb> point_of(const Honeycomb& law, double angle = 0)
{
    testing::DrivenPoint<Honeycomb> point(law);
    point.history[0] = std::cos(angle);
    point.history[1] = std::sin(angle);
    point.history[3] = -std::sin(angle);
    point.history[4] = std::cos(angle);
    return point;
}

} // namespace

/// Crushed along a: elastic with the modulus of the closure (its mean over a small step), on the curve
/// afterwards; the other directions feel nothing. Back: elastic with the modulus there.
TEST(Honeycomb, CrushesAlongItsCurveInOneDirectionAlone)
{
    const Honeycomb law = honeycomb();
    auto point = point_of(law);
    point.strain({-5e-4, 0, 0, 0, 0, 0}, 100);
    const double share = 5e-4 / 0.8;
    EXPECT_NEAR(point.stress.xx, -5e-4 * (1 + 0.5 * share * (solid_modulus - 1)), 5e-4 * 1e-3);
    EXPECT_EQ(point.stress.yy, 0);
    point.strain({std::log(0.7) + 5e-4, 0, 0, 0, 0, 0}, 1000); // to V = 0.7
    EXPECT_NEAR(point.stress.xx, -(1e-3 + 0.3 * 2e-3), 1e-15);
    EXPECT_EQ(point.stress.yy, 0);
    const double before = point.stress.xx, modulus = 1 + 0.3 / 0.8 * (solid_modulus - 1);
    point.strain({1e-5, 0, 0, 0, 0, 0});
    EXPECT_NEAR(point.stress.xx - before, 1e-5 * modulus, 1e-5 * modulus * 1e-4); // the modulus moves with V
}

TEST(Honeycomb, ShearsWithItsOwnModuliAndStrengths)
{
    const Honeycomb law = honeycomb();
    auto point = point_of(law);
    point.strain({0, 0, 0, 2e-4, 1e-4, 3e-4}, 5);
    EXPECT_NEAR(point.stress.xy, 2 * 0.4 * 2e-4, 1e-15);
    EXPECT_NEAR(point.stress.yz, 2 * 0.1 * 1e-4, 1e-15);
    EXPECT_NEAR(point.stress.zx, 2 * 0.3 * 3e-4, 1e-15);
    point.strain({0, 0, 0, -0.1, 0.1, 0.1}, 50);
    EXPECT_NEAR(point.stress.xy, -5e-4, 1e-15);
    EXPECT_NEAR(point.stress.yz, 5e-4, 1e-15);
}

/// Pressed together beyond VF it is a solid: yield stress SIGY, bulk modulus of E and PR.
TEST(Honeycomb, IsASolidWhenCompacted)
{
    const Honeycomb law = honeycomb();
    auto point = point_of(law);
    const double third = std::log(compacted) / 3;
    point.strain({third, third, third, 0, 0, 0}, 4000);
    point.strain({-1e-3, -1e-3, -1e-3, 0, 0, 0}, 10);
    const double pressure = -trace(point.stress) / 3;
    point.strain({-1e-3, -1e-3, -1e-3, 0, 0, 0}, 10);
    const double bulk = solid_modulus / (3 * (1 - 2 * solid_poisson));
    EXPECT_NEAR(-trace(point.stress) / 3 - pressure, 3e-3 * bulk, 1e-13);
    point.strain({0, 0, 0, 0.02, 0, 0}, 50);
    EXPECT_NEAR(von_mises_stress(point.stress), solid_yield, 1e-12);
}

/// Axes that are turned by 30 degrees see the strain along themselves.
TEST(Honeycomb, WorksAlongItsOwnAxes)
{
    const Honeycomb law = honeycomb();
    const double angle = 0.5235987755982988, c = std::cos(angle), s = std::sin(angle), e = -3e-4;
    auto point = point_of(law, angle);
    point.strain({e * c * c, e * s * s, 0, e * c * s, 0, 0}, 10); // e along a
    auto straight = point_of(law);
    straight.strain({e, 0, 0, 0, 0, 0}, 10);
    const double stress = straight.stress.xx;
    EXPECT_NEAR(point.stress.xx, stress * c * c, 1e-15);
    EXPECT_NEAR(point.stress.yy, stress * s * s, 1e-15);
    EXPECT_NEAR(point.stress.xy, stress * c * s, 1e-15);
}

TEST(Honeycomb, ReadsCurvesOverVolumeAndScalesWithTheRate)
{
    const Honeycomb over_volume = honeycomb({{"LCA", 4}});
    auto point = point_of(over_volume);
    point.strain({std::log(0.7), 0, 0, 0, 0, 0}, 500);
    EXPECT_NEAR(point.stress.xx, -(1e-3 + 0.3 * 2e-3), 1e-15);
    // Uniaxial: rate sqrt(2/3 e' : e') is 2/3 of the strain rate.
    const Honeycomb quick = honeycomb({{"LCSR", 5}});
    auto fast = point_of(quick);
    fast.strain({std::log(0.7), 0, 0, 0, 0, 0}, 500, -std::log(0.7) / 300);
    EXPECT_NEAR(fast.stress.xx, -(1e-3 + 0.3 * 2e-3) * 1.2, 1e-14);
}

TEST(Honeycomb, FailsAtItsStrains)
{
    const Honeycomb law = honeycomb({{"TSEF", 0.1}, {"SSEF", 0.2}});
    auto point = point_of(law);
    const auto failed = [&] { return law.failed(HistoryView<double>{point.history.data()}); };
    point.strain({0.0999, 0, 0, 0.0999, 0, 0}, 10);
    EXPECT_FALSE(failed());
    point.strain({0, 0, 0, 2e-4, 0, 0});
    EXPECT_TRUE(failed());
}

/// In an element whose side 1-2 points along y (AOPT 0), and that turns by 90 degrees: the axes follow.
TEST(Honeycomb, AxesComeFromTheNodesAndTurnWithTheElement)
{
    testing::SolidBlock block({1, 1, 1}, {1, 1, 1}, make_record("MAT_HONEYCOMB", honeycomb_card({})));
    block.model.curves = with_curves().curves;
    auto& nodes = block.model.solids.nodes[0];
    nodes = {nodes[1], nodes[2], nodes[3], nodes[0], nodes[5], nodes[6], nodes[7], nodes[4]};
    block.set_viscosity(1e-30, 1e-30);
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1;
    const auto move = [&](auto&& to) {
        for (std::size_t n = 0; n < state.size(); ++n) {
            const Vec3 next = to(n);
            state.velocity[n] = next - state.position[n];
            state.position[n] = next;
        }
        state.clear_forces();
        groups[0]->add_forces(clock, state);
    };
    const double strain = 2e-4;
    move([&](std::size_t n) {
        Vec3 x = block.model.nodes.position[n];
        x.y *= 1 + strain;
        return x;
    });
    const double modulus = testing::solid_results(block.model, state, groups).solid_stress[0].yy / strain;
    EXPECT_NEAR(modulus, 1.0, 2e-4); // EAAU along y; the strain of mid-step
    const auto stretched = state.position;
    const int steps = 400;
    for (int i = 1; i <= steps; ++i) {
        const double angle = 1.5707963267948966 * i / steps, c = std::cos(angle), s = std::sin(angle);
        move([&](std::size_t n) {
            const Vec3& x = stretched[n];
            return Vec3{c * x.x - s * x.y, s * x.x + c * x.y, x.z};
        });
    }
    const auto turned = testing::solid_results(block.model, state, groups).solid_stress[0];
    EXPECT_NEAR(turned.xx / strain, modulus, 1e-4); // the turn of a step is exact to its third power
    EXPECT_NEAR(turned.yy, 0, 1e-8);
}

} // namespace plash

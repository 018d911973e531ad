#include "elements/shell_groups.h"
#include "solver/explicit_loop.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

/// Plastic shells thrown by an impulse, that is by an initial velocity.
namespace plash {

namespace {

constexpr double alloy_density = 2.5e-4, alloy_young = 1.05e7, alloy_yield = 44000; // 6061-T6, lbf-in-s

Record ideally_plastic(const char* law)
{
    return make_record(law, {{"RO", alloy_density},
                             {"E", alloy_young},
                             {"PR", 0.33},
                             {"SIGY", alloy_yield},
                             {"BETA", 1},
                             {"ETAN", 0}});
}

struct Throw {
    double largest = 0, last = 0; ///< displacement of the watched node along its own velocity
};

/// Runs to `end_time` with initial velocities; watches one node, and the mean over the last third.
Throw thrown(Model& model, const std::vector<Vec3>& velocity, Index watched, double end_time)
{
    for (Index node = 0; node < static_cast<Index>(velocity.size()); ++node) {
        InitialVelocity initial;
        initial.nodes = {node};
        initial.translation = velocity[node];
        model.initial_velocities.push_back(initial);
    }
    model.controls.time.end_time = end_time;
    Scene scene = make_scene(model);
    const Vec3 start = model.nodes.position[watched], along = unit(velocity[watched]);
    Throw result;
    double sum = 0;
    int count = 0;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        const double way = dot(state.position[watched] - start, along);
        result.largest = std::max(result.largest, way);
        if (clock.time < end_time / 1.5) return;
        sum += way;
        ++count;
    }));
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_LT(scene.ledger.balance_error(), 2e-3);
    result.last = sum / count;
    return result;
}

/// Largest hoop strain ln(r / R) of a narrow ring with free edges thrown outwards at 5650 in/s. Its hoop
/// stress alone works: rho v^2 / 2 = sigma_y (strain - sigma_y / E) + sigma_y^2 / (2 E).
double ring_strain(const char* law, double formulation)
{
    constexpr double radius = 2.9375, thickness = 0.03, width = 0.1, speed = 5650;
    constexpr int across = 18; // of a quarter
    Model model = shell_model(ideally_plastic(law),
                              {{"ELFORM", formulation}, {"NIP", 3}, {"SHRF", 5.0 / 6}, {"T1", thickness}});
    model.controls.elements.thickness_change = 1;
    const auto angle = [](int i) { return 0.5 * std::numbers::pi * i / across; };
    add_grid(model, across, 1, [&](int i, int j) {
        return Vec3{radius * std::cos(angle(i)), radius * std::sin(angle(i)), width * j};
    });
    std::vector<Vec3> velocity;
    for (const Vec3& x : model.nodes.position) velocity.push_back((speed / radius) * Vec3{x.x, x.y, 0});
    hold(model, {0, across + 1}, 2 | 8 | 32);
    hold(model, {across, 2 * across + 1}, 1 | 16 | 32);
    const double way = thrown(model, velocity, across / 2, 2e-4).largest;
    return std::log(1 + way / radius);
}

/// Half of a panel of 120 degrees whose middle 60 degrees are thrown inwards over 10.205 of 12.56 in from one
/// end; sides clamped, ends free to move along the axis and to turn (Balmer & Witmer 1964, as retold).
Throw panel(double formulation, int across, int along)
{
    constexpr double radius = 2.9375, thickness = 0.125, length = 12.56, speed = 5650;
    Model model = shell_model(ideally_plastic("MAT_PIECEWISE_LINEAR_PLASTICITY"),
                              {{"ELFORM", formulation}, {"NIP", 5}, {"SHRF", 5.0 / 6}, {"T1", thickness}});
    model.controls.elements.warping = 1;
    const auto angle = [across](int i) { return std::numbers::pi / 3 * i / across; };
    add_grid(model, across, along, [&](int i, int j) {
        return Vec3{radius * std::sin(angle(i)), length * j / along, radius * std::cos(angle(i))};
    });
    std::vector<Vec3> velocity(model.nodes.size());
    std::vector<Index> crown, sides, ends;
    for (int j = 0; j <= along; ++j) {
        for (int i = 0; i <= across; ++i) {
            const Index node = j * (across + 1) + i;
            const Vec3& x = model.nodes.position[node];
            if (2 * i <= across && x.y < 10.21) velocity[node] = (-speed / radius) * Vec3{x.x, 0, x.z};
            if (i == 0) crown.push_back(node);
            if (i == across) sides.push_back(node);
            if (j == 0 || j == along) ends.push_back(node);
        }
    }
    hold(model, crown, 1 | 16 | 32);
    hold(model, sides, 63);
    hold(model, ends, 1 | 4);
    return thrown(model, velocity, along / 2 * (across + 1), 1e-3);
}

} // namespace

TEST(ImpulsiveShells, ARingStopsAtTheStrainOfItsEnergy)
{
    const double energy = 0.5 * alloy_density * 5650 * 5650;
    const double exact = energy / alloy_yield + 0.5 * alloy_yield / alloy_young;
    for (const char* law : {"MAT_PIECEWISE_LINEAR_PLASTICITY", "MAT_PLASTIC_KINEMATIC"}) {
        for (double formulation : {2, 16})
            EXPECT_NEAR(ring_strain(law, formulation), exact, 0.003 * exact) << law << ' ' << formulation;
    }
}

/// 1.25 in are retold of the experiment and 1.18 to 1.28 in of other programs' shells, at the middle of the
/// crown. A patch of 90 degrees, as it is retold too, gives 0.28 in on the coarse mesh and 0.57 on the fine
/// one.
TEST(ImpulsiveShells, ACylindricalPanelGivesWayAsMeasured)
{
    for (const auto& [across, along] : {std::pair(8, 16), std::pair(16, 32)}) {
        const Throw one_point = panel(2, across, along), full = panel(16, across, along);
        EXPECT_NEAR(one_point.largest, 1.25, 0.06 * 1.25) << across;
        EXPECT_NEAR(full.largest, one_point.largest, 0.01 * one_point.largest) << across;
        EXPECT_NEAR(full.last, one_point.last, 0.03 * one_point.last) << across;
    }
}

} // namespace plash

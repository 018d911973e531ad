#include "output/model_summary.h"
#include "tests/support/point_masses.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// Two blocks of 2 x 1 x 1 cells side by side are one of 4 x 1 x 1, whose cells shrink along x.
testing::SolidBlock graded_block()
{
    testing::SolidBlock block({4, 1, 1}, {4, 1, 1},
                              testing::record_of("MAT_ELASTIC", 1, {{"RO", 2}, {"E", 1e4}, {"PR", 0}}));
    const double x[] = {0, 1, 1.8, 2.4, 2.8};
    for (Vec3& place : block.model.nodes.position) place.x = x[static_cast<int>(place.x + 0.5)];
    return block;
}

ElementResults summary_of(const Scene& scene)
{
    ElementResults results;
    results.steps_wanted = true;
    results.part_motion.resize(scene.model.parts.size());
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    return results;
}

} // namespace

TEST(ModelSummary, WeighsTheModelAndFindsItsCentre)
{
    const testing::SolidBlock block = graded_block();
    const Scene scene = make_scene(block.model);
    EXPECT_NEAR(scene.masses.mass, 2 * 2.8, 1e-13);
    // Lumping moves the mass of a cell to its ends, not its centre of mass.
    EXPECT_NEAR(scene.masses.center.x, 1.4, 1e-13);
    EXPECT_NEAR(scene.masses.center.y, 0.5, 1e-13);
}

TEST(ModelSummary, ListsTheSmallestStepsFirst)
{
    const testing::SolidBlock block = graded_block();
    const Scene scene = make_scene(block.model);
    ElementResults results = summary_of(scene);
    ASSERT_EQ(results.steps.size(), 4u);
    const std::string text = format_d3hsp(block.model, scene.masses, results.steps);
    // The step of a cell is its length over sqrt(E / rho): cell 4 has 0.4, cell 1 has 1.
    const double speed = std::sqrt(1e4 / 2.0);
    std::vector<double> steps;
    for (const auto& step : results.steps) steps.push_back(step.step);
    EXPECT_NEAR(steps[3], 0.4 / speed, 1e-12);
    EXPECT_NEAR(steps[0], 1.0 / speed, 1e-12);
    const auto at = [&](const char* line) { return text.find(line); };
    const auto first = at("solid              4         1"), last = at("solid              1         1");
    ASSERT_NE(first, std::string::npos) << text;
    ASSERT_NE(last, std::string::npos) << text;
    EXPECT_LT(first, last);
    EXPECT_NE(at("4 smallest timesteps"), std::string::npos);
    EXPECT_NE(at("number of solid elements"), std::string::npos);
}

TEST(ModelSummary, SaysWhatMassScalingAddsToWhom)
{
    testing::SolidBlock block = graded_block();
    block.model.controls.time.mass_scaled_step = -0.8 / std::sqrt(1e4 / 2.0);
    const Scene scene = make_scene(block.model);
    ASSERT_EQ(scene.masses.added.size(), 1u);
    // Cells of 0.6 and 0.4 take the mass that stretches their step to that of 0.8: 2 l (0.8^2 / l^2 - 1).
    const double expected = 1.2 * (0.64 / 0.36 - 1) + 0.8 * (0.64 / 0.16 - 1);
    EXPECT_NEAR(scene.masses.added[0].second, expected, 1e-12);
    EXPECT_NEAR(scene.added_mass_ratio, expected / 5.6, 1e-12);
    const std::string text = format_d3hsp(block.model, scene.masses, summary_of(scene).steps);
    EXPECT_NE(text.find("mass scaling adds"), std::string::npos);
}

} // namespace plash

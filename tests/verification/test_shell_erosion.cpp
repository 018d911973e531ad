#include "elements/shell_groups.h"
#include "solver/explicit_loop.h"
#include "tests/support/bare_state.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// A strip of ten elements, pulled apart at its ends with 2 x 10 m/s; the middle is a little narrower.
Model pulled_strip(std::vector<std::pair<const char*, double>> more)
{
    std::vector<std::pair<const char*, double>> fields{
        {"RO", 7.8e-6}, {"E", 210}, {"PR", 0.3}, {"SIGY", 0.3}, {"ETAN", 1}};
    fields.insert(fields.end(), more.begin(), more.end());
    Model model = shell_model(make_record("MAT_PIECEWISE_LINEAR_PLASTICITY", std::move(fields)),
                              {{"ELFORM", 2}, {"NIP", 3}, {"T1", 1}});
    model.controls.elements.thickness_change = 1;
    add_grid(model, 10, 2, [&](int i, int j) {
        const double width = i == 5 ? 0.9 : 1;
        return Vec3{5.0 * i, 5 * width * (j - 1), 0};
    });
    model.curves.push_back({1, "", {}, Curve{{0, 1}, {10, 10}}});
    for (int end = 0; end < 2; ++end) {
        PrescribedMotion motion;
        motion.nodes = {static_cast<Index>(10 * end), static_cast<Index>(11 + 10 * end),
                        static_cast<Index>(22 + 10 * end)};
        motion.direction = {end ? 1.0 : -1.0, 0, 0};
        motion.curve = 0;
        model.prescribed_motions.push_back(motion);
    }
    model.controls.time.end_time = 0.8;
    return model;
}

} // namespace

TEST(ShellErosion, AStripThatTearsKeepsItsEnergyBook)
{
    const Model model = pulled_strip({{"FAIL", 0.2}});
    Scene scene = make_scene(model);
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    const auto gone = std::count(scene.state.deleted_shells.begin(), scene.state.deleted_shells.end(), 1);
    EXPECT_GE(gone, 2); // one row across tears
    EXPECT_LE(gone, 8);
    EXPECT_EQ(gone, scene.state.deletions);
    EXPECT_GT(scene.ledger.eroded_internal, 0);
    EXPECT_GT(scene.ledger.internal, 0);
    // An element that goes takes its force with it in the middle of a step: its last half step of work.
    EXPECT_LT(scene.ledger.balance_error(), 5e-4);

    ElementResults results;
    results.shell_deleted.resize(model.shells.size());
    results.part_motion.resize(1);
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    EXPECT_EQ(results.shell_deleted, scene.state.deleted_shells);
    EXPECT_DOUBLE_EQ(results.part_motion[0].eroded_internal, scene.ledger.eroded_internal);
}

TEST(ShellErosion, WithoutFailureNothingGoes)
{
    const Model model = pulled_strip({});
    Scene scene = make_scene(model);
    Recorders recorders;
    ASSERT_EQ(run(scene, recorders).termination, Outcome::Termination::normal);
    EXPECT_EQ(scene.state.deletions, 0);
    EXPECT_EQ(scene.ledger.eroded_internal, 0);
    EXPECT_LT(scene.ledger.balance_error(), 1e-4);
}

TEST(ShellErosion, ElementsBelowTheSmallestStepAreDeleted)
{
    // The ends are driven together: the step falls with the elements' length.
    Model model = pulled_strip({{"TDEL", 7e-4}});
    std::swap(model.prescribed_motions[0].direction, model.prescribed_motions[1].direction);
    hold(
        model,
        [&] {
            std::vector<Index> all(model.nodes.size());
            for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
            return all;
        }(),
        4 + 8 + 16);
    Scene scene = make_scene(model);
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_GT(scene.state.deletions, 0);
    EXPECT_GE(outcome.last_step, 0.9 * 7e-4);
}

/// *CONTROL_TIMESTEP ERODE = 10 and 11: a shell goes when its step falls below DTMIN times the first step,
/// and does not hold up the run any more.
TEST(ShellErosion, ShellsGoWhenTheirStepFallsBelowDtmin)
{
    for (const bool erode : {false, true}) {
        Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 1}, {"PR", 0}}),
                                  {{"ELFORM", 2}, {"NIP", 2}, {"T1", 0.1}});
        add_grid(model, 2, 1, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
        model.controls.time.smallest_step_factor = 0.2;
        model.controls.time.erode_small_shells = erode;
        State state = bare_state(model);
        auto groups = make_shell_groups(model, state);
        ASSERT_EQ(groups.size(), 1u);
        Clock clock;
        groups[0]->add_forces(clock, state);
        clock.cycle = 1;
        clock.last_step = 0.9 * groups[0]->stable_step().step; // the first step of the run
        for (const double width : {0.21, 0.19}) {
            for (Index node : {0, 3}) state.position[node].x = 1 - width; // the first shell is squashed
            groups[0]->add_forces(clock, state);
            ++clock.cycle;
            const bool gone = erode && width < 0.2;
            EXPECT_EQ(state.deletions, gone ? 1 : 0) << width;
            EXPECT_NEAR(groups[0]->stable_step().step, gone ? 1 : width, 1e-12);
        }
        const std::vector<std::uint8_t> expected =
            erode ? std::vector<std::uint8_t>{1, 0} : std::vector<std::uint8_t>{};
        EXPECT_EQ(state.deleted_shells, expected);
    }
}

} // namespace plash

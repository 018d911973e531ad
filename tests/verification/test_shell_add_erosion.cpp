#include "elements/beam_groups.h"
#include "elements/shell_groups.h"
#include "solver/explicit_loop.h"
#include "tests/support/bare_state.h"
#include "tests/support/beam_model.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

using Criteria = std::initializer_list<std::pair<const char*, double>>;

void add_erosion(Model& model, Criteria criteria)
{
    Record erosion = make_record("MAT_ADD_EROSION", {});
    for (const auto& [name, value] : criteria) erosion.fields.push_back({name, value, "", true, false, {}});
    erosion.fields.push_back({"MID", 1, "", true, false, {}});
    model.others.push_back(erosion);
}

Model square(double formulation, Criteria criteria)
{
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 100}, {"PR", 0}}),
                              {{"ELFORM", formulation}, {"NIP", 4}, {"T1", 0.1}});
    add_grid(model, 1, 1, [](int i, int j) { return Vec3{double(i), double(j), 0}; });
    add_erosion(model, criteria);
    return model;
}

/// Cycles that a square lives under a constant velocity field, or bent by a curvature of `bend` a
/// cycle; -1: to the end.
int cycles_until_lost(double formulation, Criteria criteria, const std::function<Vec3(const Vec3&)>& velocity,
                      double bend = 0)
{
    const Model model = square(formulation, criteria);
    State state = bare_state(model);
    auto groups = make_shell_groups(model, state);
    Clock clock;
    clock.last_step = 1;
    for (int cycle = 1; cycle <= 100; ++cycle) {
        clock.time = cycle;
        for (std::size_t n = 0; n < state.size(); ++n) {
            state.velocity[n] = velocity(model.nodes.position[n]);
            state.position[n] += state.velocity[n];
            state.angular_velocity[n] = {0, bend * (model.nodes.position[n].x - 0.5), 0};
        }
        state.clear_forces();
        for (auto& group : groups) group->add_forces(clock, state);
        if (!state.deleted_shells.empty()) return cycle;
    }
    return -1;
}

const auto stretch = [](const Vec3& p) { return Vec3{0.01 * p.x, 0, 0}; };
const auto squeeze = [](const Vec3& p) { return Vec3{-0.002 * p.x, 0, 0}; };
const auto shear = [](const Vec3& p) { return Vec3{0.01 * p.y, 0, 0}; };

/// First cycle at which the logarithmic strain of the stretch has reached a value.
int stretch_cycle(double strain)
{
    return static_cast<int>(std::ceil((std::exp(strain) - 1) / 0.01));
}

} // namespace

/// Stretch 1 + 0.01 n of a material with nu = 0: strain ln(1 + 0.01 n) (the increments of mid-step are
/// smaller by a twelfth of their cube), stress 100 times that.
TEST(ShellAddErosion, CriteriaHoldAtTheirLimits)
{
    for (double formulation : {2, 16}) {
        const auto pulled = [&](Criteria criteria) {
            return cycles_until_lost(formulation, criteria, stretch);
        };
        EXPECT_EQ(pulled({{"MXEPS", 0.205}}), stretch_cycle(0.205));
        EXPECT_EQ(pulled({{"SIGP1", 20.5}}), stretch_cycle(0.205));
        EXPECT_EQ(pulled({{"SIGVM", 20.5}}), stretch_cycle(0.205));
        EXPECT_EQ(pulled({{"VOLEPS", 0.205}}), stretch_cycle(0.205));
        EXPECT_EQ(pulled({{"EFFEPS", 0.14}}), stretch_cycle(0.21)); // 2/3 of the strain
        EXPECT_EQ(pulled({{"EPSSH", 0.1025}}), stretch_cycle(0.205));
        EXPECT_EQ(pulled({{"MNPRES", -6.9}}), stretch_cycle(0.207));
        EXPECT_EQ(pulled({{"MXPRES", 1}}), -1);
        EXPECT_EQ(pulled({{"FAILTM", 7}}), 7);
        EXPECT_EQ(pulled({{"NCS", 2}, {"MXEPS", 0.1}, {"SIGP1", 20.5}}), stretch_cycle(0.205));
        // Sum over cycles of (100 ln(1 + 0.01 n) - 10)^2 while positive reaches 100.
        double sum = 0;
        int cycle = 0;
        while (sum < 100) {
            ++cycle;
            const double above = std::max(0.0, 100 * std::log1p(0.01 * cycle) - 10);
            sum += above * above;
        }
        EXPECT_EQ(pulled({{"IMPULSE", 100}, {"SIGTH", 10}}), cycle);
        // ln(1 - 0.002 n).
        EXPECT_EQ(cycles_until_lost(formulation, {{"MNEPS", -0.0305}}, squeeze), 16);
        EXPECT_EQ(cycles_until_lost(formulation, {{"MXPRES", 1.017}}, squeeze), 16);
        // Simple shear of 0.01 n: largest shear 0.005 n while the element's axes follow side 1-2, which
        // stays.
        EXPECT_EQ(cycles_until_lost(formulation, {{"EPSSH", 0.0499}}, shear), 10);
    }
}

/// Curvature 0.1 n over a thickness of 0.1 without stretch: the outer Gauss points of four stand at 0.8611 of
/// half the thickness and have the strain 0.0043057 n; the inner ones at 0.33998.
TEST(ShellAddErosion, BendingLosesPointsOneByOne)
{
    const auto still = [](const Vec3&) { return Vec3{}; };
    const auto bent = [&](Criteria criteria) { return cycles_until_lost(2, criteria, still, 0.1); };
    EXPECT_EQ(bent({{"MXEPS", 0.043}}), 10);
    EXPECT_EQ(bent({{"MXEPS", 0.043}, {"NUMFIP", 2}}), 26); // 0.0016999 n
    EXPECT_EQ(bent({{"MXEPS", 0.043}, {"NUMFIP", -25}}), 10);
    EXPECT_EQ(bent({{"MXEPS", 0.043}, {"NUMFIP", -50}}), 26);
    EXPECT_EQ(bent({{"MXEPS", 0.043}, {"NUMFIP", 3}}), -1); // the lower half is pressed
}

/// A plate that is pulled flows without change of volume: its thickness strain is half the plastic strain.
TEST(ShellAddErosion, ThinningBeyondTheLimitTakesAnElement)
{
    Model model = square(2, {{"EPSTHIN", 0.05}});
    model.materials[0] =
        make_record("MAT_PLASTIC_KINEMATIC", {{"RO", 1}, {"E", 1e5}, {"PR", 0.3}, {"SIGY", 1}});
    State state = bare_state(model);
    auto groups = make_shell_groups(model, state);
    Clock clock;
    clock.last_step = 1;
    int cycle = 0;
    while (state.deleted_shells.empty() && cycle < 100) { // equibiaxial: thickness strain twice the stretch's
        ++cycle;
        for (std::size_t n = 0; n < state.size(); ++n) {
            state.velocity[n] = 0.001 * model.nodes.position[n];
            state.position[n] += state.velocity[n];
        }
        state.clear_forces();
        for (auto& group : groups) group->add_forces(clock, state);
    }
    EXPECT_EQ(cycle, static_cast<int>(std::ceil((std::exp(0.025) - 1) / 0.001)));
}

/// A truss and an integrated beam, stretched as the square is.
TEST(BeamAddErosion, CriteriaHoldAtTheirLimits)
{
    for (double formulation : {1, 3}) {
        const auto pulled = [&](Criteria criteria) {
            Model model = beam_model(
                make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 100}, {"PR", 0}}),
                {{"ELFORM", formulation}, {"QR/IRID", 2}, {"TS1", 0.1}, {"TT1", 0.1}, {"A", 0.01}}, 1, 1);
            add_erosion(model, criteria);
            State state = bare_state(model);
            auto groups = make_beam_groups(model, state);
            Clock clock;
            clock.last_step = 1;
            for (int cycle = 1; cycle <= 100; ++cycle) {
                clock.time = cycle;
                state.velocity[1] = {0.01, 0, 0};
                state.position[1] += state.velocity[1];
                state.clear_forces();
                groups[0]->add_forces(clock, state);
                if (!state.deleted_beams.empty()) return cycle;
            }
            return -1;
        };
        EXPECT_EQ(pulled({{"MXEPS", 0.205}}), stretch_cycle(0.205));
        EXPECT_EQ(pulled({{"SIGP1", 20.5}}), stretch_cycle(0.205));
        EXPECT_EQ(pulled({{"EFFEPS", 0.14}, {"NUMFIP", 4}}), stretch_cycle(0.21));
        EXPECT_EQ(pulled({{"FAILTM", 7}}), 7);
        EXPECT_EQ(pulled({{"MXPRES", 1}}), -1);
    }
}

namespace {

/// Largest error of the energy balance of a strip or a row of beams that is stretched, bent and twisted and
/// whose elements all go after some five steps.
double balance_of_loss(Model model)
{
    add_erosion(model, {{"FAILTM", 8e-4}});
    model.controls.time.end_time = 1.2e-3;
    Scene scene = make_scene(model);
    for (std::size_t n = 0; n < scene.state.size(); ++n) {
        const Vec3& x = scene.state.position[n];
        scene.state.velocity[n] = {0.1 * x.x, 0.02 * x.x, 0.05 * x.y};
        if (scene.state.rotational()) scene.state.angular_velocity[n] = {0.05 * x.x, 0.1 * x.x, 0.02 * x.y};
    }
    Recorders recorders;
    const Outcome outcome = run(scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_EQ(static_cast<std::size_t>(scene.state.deletions), model.shells.size() + model.beams.size());
    // Of either sign: the product of the displacements before and after the last step.
    EXPECT_GT(std::abs(scene.ledger.eroded_internal), 0.05 * scene.ledger.kinetic);
    return scene.ledger.balance_error();
}

const Record steel = make_record("MAT_ELASTIC", {{"RO", 7.8e-6}, {"E", 210}, {"PR", 0.3}});

} // namespace

/// Forces that end with their elements leave half a step's work in the book, unless it knows
/// (elements/element_loss.h). Bound as for solids.
TEST(ShellAddErosion, ElementsUnderLoadGoWithoutAGapInTheBook)
{
    for (const double formulation : {2, 4, 16}) {
        Model model = shell_model(steel, {{"ELFORM", formulation}, {"NIP", 3}, {"T1", 0.5}});
        add_grid(model, 5, 2, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
        if (formulation == 4) {
            cut_into_triangles(model);
            model.controls.elements.sort_triangles = 1;
        }
        EXPECT_LT(balance_of_loss(model), 1e-3) << formulation;
    }
}

TEST(BeamAddErosion, ElementsUnderLoadGoWithoutAGapInTheBook)
{
    for (const double formulation : {1, 3}) {
        const Model model = beam_model(
            steel, {{"ELFORM", formulation}, {"QR/IRID", 2}, {"TS1", 0.5}, {"TT1", 0.5}, {"A", 0.25}}, 5, 5);
        EXPECT_LT(balance_of_loss(model), 1e-3) << formulation;
    }
}

TEST(ShellAddErosion, PliesRefuseIt)
{
    Model model = square(2, {{"MXEPS", 0.1}});
    model.materials[0] = make_record(
        "MAT_ORTHOTROPIC_ELASTIC", {{"RO", 1}, {"EA", 100}, {"EB", 10}, {"GAB", 5}, {"GBC", 5}, {"GCA", 5}});
    State state = bare_state(model);
    EXPECT_THROW(make_shell_groups(model, state), DeckError);
}

} // namespace plash

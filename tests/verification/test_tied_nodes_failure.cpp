// Nodes at one place that hold together until the elements around them have yielded enough.

#include "solver/explicit_loop.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

constexpr int length = 10, width = 2;

Vec3 place(int i, int j)
{
    return {5.0 * i, 5 * (i == 5 ? 0.9 : 1.0) * (j - 1), 0.3 * std::sin(0.7 * i + j)};
}

/// A strip pulled apart at its ends with 2 x `speed`, narrower in its middle.
Model strip(double speed, double end_time)
{
    Model model =
        shell_model(make_record("MAT_PIECEWISE_LINEAR_PLASTICITY",
                                {{"RO", 7.8e-6}, {"E", 210}, {"PR", 0.3}, {"SIGY", 0.3}, {"ETAN", 1}}),
                    {{"ELFORM", 2}, {"NIP", 3}, {"T1", 1}});
    model.curves.push_back({1, "", {}, Curve{{0, 1}, {speed, speed}}});
    model.controls.time.end_time = end_time;
    model.controls.time.step_scale = 0.8; // at 0.9 elements without common nodes have shorter steps
    return model;
}

void pull(Model& model)
{
    for (int end = 0; end < 2; ++end) {
        PrescribedMotion motion;
        for (Index node = 0; node < static_cast<Index>(model.nodes.size()); ++node)
            if (model.nodes.position[node].x == 50.0 * end) motion.nodes.push_back(node);
        motion.direction = {end ? 1.0 : -1.0, 0, 0};
        motion.curve = 0;
        model.prescribed_motions.push_back(motion);
    }
}

Model merged_strip(double speed, double end_time)
{
    Model model = strip(speed, end_time);
    add_grid(model, length, width, place);
    pull(model);
    return model;
}

/// Every element has its own nodes, all in one set.
Model tied_strip(double speed, double end_time, double plastic_strain_at_failure)
{
    Model model = strip(speed, end_time);
    NodeSet all;
    all.id = 7;
    for (int j = 0; j < width; ++j) {
        for (int i = 0; i < length; ++i) {
            std::array<Index, 4> nodes;
            for (int k = 0; k < 4; ++k) {
                nodes[k] = add_node(model, place(i + (k == 1 || k == 2), j + (k >= 2)));
                all.nodes.push_back(nodes[k]);
            }
            add_shell(model, nodes);
        }
    }
    model.node_sets.push_back(all);
    model.others.push_back(
        make_record("CONSTRAINED_TIED_NODES_FAILURE", {{"NSID", 7}, {"EPPF", plastic_strain_at_failure}}));
    pull(model);
    return model;
}

/// Largest distance between nodes that began at one place.
double widest_gap(const Model& model, const State& state)
{
    double widest = 0;
    for (std::size_t a = 0; a < model.nodes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (norm(model.nodes.position[a] - model.nodes.position[b]) < 1e-9)
                widest = std::max(widest, norm(state.position[a] - state.position[b]));
    return widest;
}

} // namespace

/// The same motion as of a mesh whose elements share their nodes, through yielding: masses and forces are
/// the same sums, so that only round-off differs.
TEST(TiedNodesFailure, HoldLikeOneNode)
{
    const Model shared = merged_strip(2, 0.2), tied = tied_strip(2, 0.2, 10);
    Scene one = make_scene(shared), many = make_scene(tied);
    Recorders none_one, none_many;
    ASSERT_EQ(run(one, none_one).termination, Outcome::Termination::normal);
    ASSERT_EQ(run(many, none_many).termination, Outcome::Termination::normal);
    EXPECT_LT(widest_gap(tied, many.state), 1e-9);
    for (std::size_t element = 0; element < shared.shells.size(); ++element) {
        for (int k = 0; k < 4; ++k) {
            const Vec3 a = one.state.position[shared.shells.nodes[element][k]];
            const Vec3 b = many.state.position[tied.shells.nodes[element][k]];
            ASSERT_LT(norm(a - b), 1e-7) << "element " << element << " corner " << k;
        }
    }
    EXPECT_GT(one.ledger.internal, 0);
    EXPECT_NEAR(many.ledger.internal, one.ledger.internal, 1e-7 * one.ledger.internal);
    EXPECT_LT(many.ledger.balance_error(), 1e-5);
}

/// The strip tears where it is narrow, once the plastic strain there has passed the limit, and the halves
/// fly apart; nothing is deleted and the book stays balanced.
TEST(TiedNodesFailure, TearsWhereItYields)
{
    const double limit = 0.2;
    const Model model = tied_strip(10, 1.2, limit);
    Scene scene = make_scene(model);
    double strain_before = 0, gap_seen = -1;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        if (gap_seen >= 0) return;
        if (widest_gap(model, state) > 1e-6) {
            gap_seen = clock.time;
            return;
        }
        ElementResults results;
        results.shell_layers = 3;
        results.shell_plastic_strain.resize(3 * model.shells.size());
        for (const auto& term : scene.terms) term->collect(state, results);
        strain_before =
            *std::max_element(results.shell_plastic_strain.begin(), results.shell_plastic_strain.end());
    }));
    const Outcome outcome = run(scene, recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    ASSERT_GT(gap_seen, 0);
    // Elements at the crack are about equally strained: the limit of the mean is passed when the largest is
    // somewhat above it.
    EXPECT_GT(strain_before, limit);
    EXPECT_LT(strain_before, 1.5 * limit);
    EXPECT_GT(widest_gap(model, scene.state), 5);
    EXPECT_EQ(scene.state.deletions, 0);
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
}

TEST(TiedNodesFailure, SetWithoutPairsIsAnError)
{
    Model model = merged_strip(2, 0.2);
    NodeSet all;
    all.id = 7;
    for (Index node = 0; node < static_cast<Index>(model.nodes.size()); ++node) all.nodes.push_back(node);
    model.node_sets.push_back(all);
    model.others.push_back(make_record("CONSTRAINED_TIED_NODES_FAILURE", {{"NSID", 7}, {"EPPF", 0.1}}));
    EXPECT_THROW(make_scene(model), DeckError);
}

} // namespace plash

#include "parser/read_model.h"
#include "tests/decks/shared_decks.h"

#include <gtest/gtest.h>

namespace plash {
namespace {

class ReadTargets : public ::testing::Test {
protected:
    void SetUp() override
    {
        if (shared_decks().empty()) GTEST_SKIP() << "no decks of other people at hand: set PLASH_SHARED";
    }
};

std::string faults(const ReadResult& result)
{
    std::string text;
    for (const Message& message : result.report.errors) text += to_text(message, result.model) + "\n";
    return text;
}

} // namespace

TEST_F(ReadTargets, ShellCantilever)
{
    const ReadResult result = read_model(shared_decks() + "/targets/shell_cantilever_nip3/01_Shell.dyn");
    ASSERT_TRUE(result.ok) << faults(result);
    EXPECT_TRUE(unsupported_keywords(result.report).empty());
    const Model& model = result.model;
    EXPECT_EQ(model.nodes.size(), 124u);
    EXPECT_EQ(model.shells.size(), 90u);
    ASSERT_EQ(model.parts.size(), 1u);
    EXPECT_EQ(model.parts[0].title, "Sheet");
    EXPECT_EQ(model.sections[0].integer("NIP"), 3);
    EXPECT_EQ(model.sections[0].real("SHRF"), 0.833333);
    EXPECT_EQ(model.materials[0].keyword, "MAT_PIECEWISE_LINEAR_PLASTICITY");
    EXPECT_EQ(model.materials[0].real("RO"), 7.8e-6);
    ASSERT_EQ(model.fixed_nodes.size(), 1u);
    EXPECT_EQ(model.fixed_nodes[0].nodes.size(), 4u);
    EXPECT_EQ(model.fixed_nodes[0].freedoms, 7u);
    ASSERT_EQ(model.nodal_loads.size(), 1u);
    EXPECT_EQ(model.nodal_loads[0].direction.z, 1);
    EXPECT_EQ(model.curves[model.nodal_loads[0].curve].curve(5), -0.005);
    ASSERT_EQ(model.body_loads.size(), 1u);
    EXPECT_EQ(model.body_loads[0].scale, 0.00981);
    EXPECT_EQ(model.controls.time.end_time, 10);
    EXPECT_EQ(model.controls.output.history_nodes.size(), 4u);
    EXPECT_EQ(model.controls.output.ascii.at("nodout").interval, 0.1);
}

TEST_F(ReadTargets, BouncingBall)
{
    for (const char* name : {"bouncyball_v1.k", "bouncyball_v2.k"}) {
        const ReadResult result = read_model(shared_decks() + "/targets/bouncing_ball_rigidwall/" + name);
        ASSERT_TRUE(result.ok) << faults(result);
        EXPECT_TRUE(unsupported_keywords(result.report).empty());
        const Model& model = result.model;
        EXPECT_EQ(model.nodes.size(), 976u);
        EXPECT_EQ(model.solids.size(), 875u);
        ASSERT_EQ(model.initial_velocities.size(), 1u);
        EXPECT_EQ(model.initial_velocities[0].nodes.size(), 976u);
        EXPECT_EQ(model.initial_velocities[0].translation.y, -30);
        ASSERT_EQ(model.rigid_walls.size(), 1u);
        EXPECT_NEAR(norm(model.rigid_walls[0].normal), 1, 1e-15);
        EXPECT_EQ(model.materials[0].real("A"), 5.4e-4);
        EXPECT_EQ(model.parts[0].hourglass, 0);
    }
}

} // namespace plash

#include "output/recorders.h"
#include "tests/support/deck_run.h"

namespace plash {

/// A step that a curve holds at nothing ends the run in the first cycle, before any energy is booked: the
/// recorders of all files still come to their end.
TEST(FirstCycle, ErrorLeavesReadableFiles)
{
    testing::DeckRun run("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*CONTROL_TIMESTEP\n0,0,0,0,0,1\n"
                         "*DEFINE_CURVE\n1\n0.0,0.0\n10.0,0.0\n*DATABASE_BINARY_D3PLOT\n0.1\n"
                         "*DATABASE_GLSTAT\n0.1\n*DATABASE_MATSUM\n0.1\n"
                         "*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0,0.3\n*PART\na\n1,1,1\n"
                         "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
                         "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n*END\n");
    ASSERT_TRUE(run.scene);
    const testing::TemporaryFolder folder;
    Recorders recorders = make_recorders(run.read->model, folder / "", {});
    const Outcome outcome = plash::run(*run.scene, recorders);
    EXPECT_EQ(outcome.termination, Outcome::Termination::error);
    EXPECT_NE(outcome.message.find("curve 1, LCTM"), std::string::npos) << outcome.message;
    EXPECT_TRUE(std::filesystem::exists(folder / "d3plot"));
}

} // namespace plash

#include "output/history_reader.h"

#include <gtest/gtest.h>

namespace plash {

TEST(HistoryReader, ReadsStatesAndLeavesABrokenOneOut)
{
    const std::string text = " dt of cycle       1 is controlled by shell             91 of part         1\n"
                             "\n"
                             " time...........................   0.00000E+00\n"
                             " kinetic energy.................   1.50000E+00\n"
                             " stonewall energy...............   2.00000E+00 wall#  1\n"
                             " stonewall energy...............   3.00000E+00 wall#  2\n"
                             " time...........................   1.00000E-01\r\n"
                             " kinetic energy.................  -1.25000E+02\r\n"
                             " stonewall energy...............   4.00000E+00 wall#  1\r\n"
                             " stonewall energy...............   5.00000E+00 wall#  2\r\n"
                             " time...........................   2.00000E-01\n"
                             " kinetic ene";
    const History history = read_glstat_history(text);
    ASSERT_EQ(history.time, (std::vector<double>{0, 0.1}));
    ASSERT_EQ(history.columns.size(), 3u);
    EXPECT_EQ(history.find("kinetic energy")->values, (std::vector<double>{1.5, -125}));
    EXPECT_EQ(history.find("stonewall energy wall#  2")->values, (std::vector<double>{3, 5}));
    EXPECT_EQ(history.find("internal energy"), nullptr);
}

TEST(HistoryReader, GivesNothingForAnotherFile)
{
    EXPECT_TRUE(read_glstat_history("just\nsome text..\n").time.empty());
}

TEST(HistoryReader, FindsForcesOfWallsAndContacts)
{
    const History walls =
        read_rwforc_history("    time       wall#   normal-force    x-force        y-force\n"
                            " 0.00000E+00       1   0.000000E+00   0.000000E+00   0.000000E+00\n"
                            " 0.00000E+00       3   2.500000E+00   0.000000E+00   0.000000E+00\n"
                            " 1.00000E-01       1   4.000000E+00   0.000000E+00   0.000000E+00\n"
                            " 1.00000E-01       3   5.000000E+00   0.000000E+00");
    ASSERT_EQ(walls.time, (std::vector<double>{0, 0.1}));
    ASSERT_NE(walls.find("wall 1"), nullptr);
    EXPECT_EQ(walls.find("wall 1")->values, (std::vector<double>{0, 4}));
    EXPECT_EQ(walls.find("wall 3")->values, (std::vector<double>{2.5, 0})); // its last line broke off

    const History contacts = read_rcforc_history(
        "  slave           7 time 1.00000E+00  x  3.00000E+00  y  0.00000E+00  z -4.00000E+00 mass  1\n"
        "  master          7 time 1.00000E+00  x -3.00000E+00  y  0.00000E+00  z  4.00000E+00 mass  1\n");
    ASSERT_NE(contacts.find("contact 7"), nullptr);
    EXPECT_EQ(contacts.find("contact 7")->values, std::vector<double>{5});
}

} // namespace plash

#include "assess/signals.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace plash {

namespace {

const TimeCurve* find(const std::vector<Signal>& signals, const std::string& name)
{
    for (const Signal& signal : signals) {
        if (signal.name == name) return &signal.curve;
    }
    return nullptr;
}

void write(const std::filesystem::path& path, const std::string& text)
{
    std::ofstream(path) << text;
}

std::string fault_of(const std::function<void()>& call)
{
    try {
        call();
    } catch (const SignalError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(Signals, OfRcforcAreThoseOfBothSides)
{
    const auto signals = read_signals(
        "rcforc",
        " heading\n interface number,     10001,is single surface-resultants are undefined\n"
        "  slave           2 time 0.00000E+00  x  1.00000E+00  y -2.00000E+00  z  0.00000E+00 mass  "
        "0.00000E+00  mx  0.00000E+00  my  0.00000E+00  mz  5.00000E+00\n"
        "  master          2 time 0.00000E+00  x -1.00000E+00  y  2.00000E+00  z  0.00000E+00 mass  "
        "0.00000E+00  mx  0.00000E+00  my  0.00000E+00  mz  0.00000E+00\n"
        "  slave           2 time 1.50000E-01  x  3.00000E+00  y -2.00000E+00  z  0.00000E+00 mass  "
        "0.00000E+00  mx  0.00000E+00  my  0.00000E+00  mz  6.00000E+00\n"
        "  master          2 time 1.50000E-01  x  3.0");
    const TimeCurve* x = find(signals, "rcforc/2/slave_x");
    ASSERT_NE(x, nullptr);
    EXPECT_EQ(x->time, (std::vector<double>{0, 0.15}));
    EXPECT_EQ(x->value, (std::vector<double>{1, 3}));
    ASSERT_NE(find(signals, "rcforc/2/master_y"), nullptr);
    EXPECT_EQ(find(signals, "rcforc/2/master_y")->value, (std::vector<double>{2}))
        << "the last line breaks off";
    EXPECT_EQ(find(signals, "rcforc/2/slave_mz")->value, (std::vector<double>{5, 6}));
}

TEST(Signals, OfNodoutMayTouchEachOther)
{
    const auto signals = read_signals(
        "nodout",
        "{BEGIN LEGEND}\n Entity #        Title\n        5      a node\n{END LEGEND}\n\n"
        " n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       7                              ( at "
        "time 2.5000000E-01 )\n\n nodal point  x-disp     y-disp\n"
        "        5  0.00000E+00-1.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00 4.00000E+00 0.00000E+00 "
        "0.00000E+00-9.81000E-03 3.00000E+02 3.00000E+01 0.00000E+00\n");
    ASSERT_NE(find(signals, "nodout/5/y-disp"), nullptr);
    EXPECT_EQ(find(signals, "nodout/5/y-disp")->value, (std::vector<double>{-1}));
    EXPECT_EQ(find(signals, "nodout/5/z-accl")->value, (std::vector<double>{-9.81e-3}));
    EXPECT_EQ(find(signals, "nodout/5/z-vel")->time, (std::vector<double>{0.25}));
}

TEST(Signals, OfACsvFileAreItsColumns)
{
    const testing::TemporaryFolder folder;
    write(folder / "a.csv", "# a rig\ntime,force,depth\n0,1,2\n\n0.5,3,\n1, 5 ,6");
    EXPECT_EQ(csv_signal(folder / "a.csv", "").value, (std::vector<double>{1, 3, 5}));
    EXPECT_EQ(csv_signal(folder / "a.csv", "depth").time, (std::vector<double>{0, 1}));
    EXPECT_EQ(csv_signal(folder / "a.csv", "3").value, (std::vector<double>{2, 6}));
    write(folder / "b.csv", "0,1\n1,2\n");
    EXPECT_EQ(csv_signal(folder / "b.csv", "").value, (std::vector<double>{1, 2}));
}

TEST(Signals, SayWhatIsThereWhenTheyAreNot)
{
    const testing::TemporaryFolder folder;
    const std::string here = folder / "";
    write(folder / "a.csv", "time,force\n0,1\n1,x\n");
    write(folder / "b.csv", "time,force\n0,1\n-1,2\n");
    write(folder / "rwforc",
          "    time       wall#   normal-force\n 0.00000E+00       1   1.000000E+00   0.000000E+00   "
          "0.000000E+00   1.000000E+00\n");
    EXPECT_NE(fault_of([&] { csv_signal(folder / "a.csv", ""); }).find("a.csv:3: 'x' is not a number"),
              std::string::npos);
    EXPECT_NE(fault_of([&] { csv_signal(folder / "b.csv", ""); }).find("b.csv:3: time goes back to -1"),
              std::string::npos);
    EXPECT_NE(fault_of([&] { run_signal(here, "rwforc/2/normal"); }).find("it has rwforc/1/normal"),
              std::string::npos);
    EXPECT_NE(fault_of([&] { run_signal(here, "glstat/kinetic energy"); }).find("*DATABASE_glstat"),
              std::string::npos);
    EXPECT_NE(fault_of([&] { run_signal(here, "elephant/1"); }).find("begins with one of the files"),
              std::string::npos);
    EXPECT_EQ(run_signal(here, "rwforc/1/normal").value, (std::vector<double>{1}));
}

} // namespace plash

#include "picture/diagram_file.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace plash {

namespace {

/// Diagrams of a file with this text.
std::vector<Plot> diagrams_of(const std::string& text)
{
    const testing::TemporaryFolder folder;
    const std::string path = folder / "diagrams.txt";
    std::ofstream(path) << text;
    return read_diagrams(path);
}

} // namespace

TEST(DiagramFile, ANameHasTheSameColourInEveryDiagram)
{
    const auto plots =
        diagrams_of("plot\tforce\tt\tF\nline\treference\n0\t1\n1\t2\nline\tone\n0\t3\nline\ttwo\n0\t4\n"
                    "plot\terror\ts\t%\nline\ttwo\tmarkers\n5\t6\nline\tone\tmarkers\n7\t8\n");
    ASSERT_EQ(plots.size(), 2u);
    ASSERT_EQ(plots[0].lines.size(), 3u);
    ASSERT_EQ(plots[1].lines.size(), 2u);
    EXPECT_EQ(plots[1].lines[0].colour, plots[0].lines[2].colour);
    EXPECT_EQ(plots[1].lines[1].colour, plots[0].lines[1].colour);
    EXPECT_NE(plots[0].lines[0].colour, plots[0].lines[1].colour);
    EXPECT_NE(plots[0].lines[1].colour, plots[0].lines[2].colour);
    EXPECT_TRUE(plots[1].lines[0].markers && !plots[0].lines[0].markers);
    EXPECT_EQ(plots[0].lines[0].y, (std::vector<double>{1, 2}));
}

TEST(DiagramFile, SaysWhichLineDoesNotFit)
{
    try {
        diagrams_of("plot\tforce\tt\tF\nline\tone\n0\tzero\n");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(":3: '0\tzero' is no line"), std::string::npos)
            << error.what();
    }
}

} // namespace plash

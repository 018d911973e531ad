// `plash study` as a user calls it.

#include "tests/paths.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"
#include "tests/support/water_deck.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace plash {

/// One deck in three forms of its water: each runs with what became of the water told on its screen, the runs
/// are judged together, and a second call does nothing again.
TEST(Study, RunsADeckInSeveralFormsOfItsWater)
{
    const testing::TemporaryFolder folder;
    testing::WaterDeck water;
    water.end = 1e-3;
    water.more = "*DATABASE_GLSTAT\n1e-5\n";
    std::ofstream(folder / "deck.k") << water.text();
    const auto study = [&] {
        return std::system(fmt::format("'{}' study '{}' --fluid deck,ale,sph -j 1 -s glstat/kinetic_energy "
                                       "-o '{}' > '{}'",
                                       PLASH_PROGRAM, folder / "deck.k", folder / "study", folder / "screen")
                               .c_str());
    };
    ASSERT_EQ(study(), 0);
    const std::string first = testing::text_of(folder / "screen");
    for (const char* form : {"fluid=deck", "fluid=ale", "fluid=sph"}) {
        EXPECT_NE(first.find(std::string(form) + ": normal termination"), std::string::npos) << first;
        const std::string screen = testing::text_of(folder / (std::string("study/") + form + "/screen.txt"));
        EXPECT_EQ(screen.find("particles") != std::string::npos, std::string(form) == "fluid=sph") << screen;
    }
    EXPECT_NE(testing::text_of(folder / "study/compare.csv").find("fluid=ale"), std::string::npos);
    ASSERT_EQ(study(), 0);
    const std::string second = testing::text_of(folder / "screen");
    EXPECT_NE(second.find("fluid=ale: done before; normal"), std::string::npos) << second;
}

TEST(Study, WithoutAnythingToVaryIsAMistake)
{
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "deck.k") << testing::WaterDeck().text();
    EXPECT_NE(std::system(
                  fmt::format("'{}' study '{}' > /dev/null 2>&1", PLASH_PROGRAM, folder / "deck.k").c_str()),
              0);
}

} // namespace plash

#include "tests/paths.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace plash {

/// The page of a real run is whole in itself and shows its plots.
TEST(Report, MakesOneSelfContainedPageOfARun)
{
    namespace fs = std::filesystem;
    const testing::TemporaryFolder folder;
    const fs::path directory = folder / "run";
    const std::string deck = std::string(PLASH_SOURCE_DIR) + "/examples/first_drop/first_drop.k";
    const auto shell = [](const std::string& command) {
        return std::system((command + " > /dev/null").c_str());
    };
    ASSERT_EQ(
        shell(fmt::format("'{}' run '{}' --until 5e-4 -o '{}'", PLASH_PROGRAM, deck, directory.string())), 0);
    ASSERT_EQ(shell(fmt::format("'{}' report '{}'", PLASH_PROGRAM, directory.string())), 0);
    std::ifstream file(directory / "report.html", std::ios::binary);
    const std::string page(std::istreambuf_iterator<char>(file), {});
    for (const char* wanted :
         {"<title>first_drop.k</title>", "Normal termination", "\"Energies\"", "\"kinetic energy\"",
          "\"total energy / initial energy\"", "solids of part 1", "The MIT License", "</html>"}) {
        EXPECT_NE(page.find(wanted), std::string::npos) << wanted;
    }
    EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "the page loads something from elsewhere";
    fs::remove_all(directory);
    EXPECT_NE(shell(fmt::format("'{}' report '{}' 2>&1", PLASH_PROGRAM, directory.string())), 0);
}

} // namespace plash

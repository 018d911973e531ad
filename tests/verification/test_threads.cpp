#include "tests/paths.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace plash {

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs a deck with 1, 2 and 4 threads and compares every state of d3plot byte by byte.
void expect_same_bits(const fs::path& deck)
{
    const testing::TemporaryFolder folder;
    const fs::path& root = folder.path();
    std::string first;
    for (int threads : {1, 2, 4}) {
        const fs::path directory = root / std::to_string(threads);
        const std::string command = fmt::format("'{}' run '{}' -j {} -o '{}' > /dev/null", PLASH_PROGRAM,
                                                deck.string(), threads, directory.string());
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
        std::string states;
        for (const auto& entry : fs::directory_iterator(directory)) {
            if (entry.path().filename().string().starts_with("d3plot")) states += bytes_of(entry.path());
        }
        ASSERT_GT(states.size(), 10000u);
        if (first.empty()) first = states;
        EXPECT_TRUE(states == first) << threads << " threads give other bits than one";
    }
}

/// A clamped elastic plate of n x n shells that is hit by its own initial velocity, several patches large.
void write_plate_deck(const fs::path& path, int n)
{
    std::ofstream deck(path);
    deck << "*KEYWORD\n*CONTROL_TERMINATION\n2.0e-4\n*DATABASE_BINARY_D3PLOT\n5.0e-5\n"
            "*PART\nplate\n1,1,1\n*SECTION_SHELL\n1,2,0.833,3\n1.0,1.0,1.0,1.0\n"
            "*MAT_ELASTIC\n1,7.85e-9,2.1e5,0.3\n*INITIAL_VELOCITY\n0\n0.0,0.0,-1.0e4\n*NODE\n";
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const bool edge = i == 0 || j == 0 || i == n || j == n;
            deck << fmt::format("{},{},{},0.0,{},{}\n", 1 + i + (n + 1) * j, 5.0 * i, 5.0 * j, edge ? 7 : 0,
                                edge ? 7 : 0);
        }
    }
    deck << "*ELEMENT_SHELL\n";
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int a = 1 + i + (n + 1) * j;
            deck << fmt::format("{},1,{},{},{},{}\n", 1 + i + n * j, a, a + 1, a + n + 2, a + n + 1);
        }
    }
    deck << "*END\n";
}

} // namespace

TEST(Threads, OneTwoAndFourGiveTheSameBitsForSolidsOnAWall)
{
    expect_same_bits(fs::path(PLASH_SOURCE_DIR) / "examples/first_drop/first_drop.k");
}

TEST(Threads, OneTwoAndFourGiveTheSameBitsForShells)
{
    const testing::TemporaryFolder folder;
    const fs::path deck = folder / "plate.k";
    write_plate_deck(deck, 40);
    expect_same_bits(deck);
}

} // namespace plash

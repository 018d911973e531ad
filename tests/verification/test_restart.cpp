#include "core/archive.h"
#include "core/run_error.h"
#include "tests/paths.h"
#include "tests/support/adaptive_deck.h"
#include "tests/support/ale_deck.h"
#include "tests/support/crash_deck.h"
#include "tests/support/joined_deck.h"
#include "tests/support/splash_deck.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace plash {

namespace {

namespace fs = std::filesystem;
using plash::testing::TemporaryFolder;

/// A run under way in a process of its own.
class Process {
public:
    explicit Process(std::vector<std::string> arguments)
    {
        id_ = fork();
        if (id_ != 0) return;
        std::vector<char*> words;
        for (std::string& argument : arguments) words.push_back(argument.data());
        words.push_back(nullptr);
        if (!std::freopen("/dev/null", "w", stdout)) _exit(127);
        execv(words[0], words.data());
        _exit(127);
    }
    /// Kills it after some time; says whether it was still running.
    bool kill_after(double seconds)
    {
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        ::kill(id_, SIGKILL);
        return !WIFEXITED(wait());
    }
    /// Sends a signal and returns at once.
    void signal(int number) { ::kill(id_, number); }
    int exit_code() { return WEXITSTATUS(wait()); }

private:
    pid_t id_;

    int wait()
    {
        int status = 0;
        waitpid(id_, &status, 0);
        return status;
    }
};

std::vector<std::string> run_command(const fs::path& deck, const fs::path& directory, bool restart)
{
    std::vector<std::string> words{PLASH_PROGRAM, "run", deck, "-o", directory, "-j", "2", "--vtk"};
    if (restart) words.insert(words.end(), {"--restart", directory});
    return words;
}

bool has_restart_file(const fs::path& directory)
{
    if (!fs::exists(directory)) return false;
    for (const auto& entry : fs::directory_iterator(directory)) {
        const std::string name = entry.path().filename().string();
        if ((name.starts_with("runrsf") || name.starts_with("d3dump")) && !name.ends_with(".new"))
            return true;
    }
    return false;
}

/// All result files that show physics, with their bytes. The summary and the restart files hold wall times,
/// and messag tells of every start.
std::map<std::string, std::string> results_in(const fs::path& directory)
{
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
        const std::string name = fs::relative(entry.path(), directory).string();
        const bool timed = name == "summary.json" || name == "messag" || name.starts_with("runrsf") ||
                           name.starts_with("d3dump");
        if (entry.is_directory() || timed) continue;
        std::ifstream file(entry.path(), std::ios::binary);
        files[name] = {std::istreambuf_iterator<char>(file), {}};
    }
    return files;
}

void expect_same_files(const std::map<std::string, std::string>& expected, const fs::path& directory)
{
    const auto found = results_in(directory);
    for (const auto& [name, bytes] : expected) {
        const auto file = found.find(name);
        ASSERT_NE(file, found.end()) << name << " is missing";
        EXPECT_TRUE(file->second == bytes)
            << name << " differs: " << file->second.size() << " bytes instead of " << bytes.size();
    }
    EXPECT_EQ(found.size(), expected.size());
}

} // namespace

class RestartOf : public ::testing::TestWithParam<const char*> {
protected:
    const TemporaryFolder folder;
    const fs::path deck = folder / "deck.k";

    void SetUp() override
    {
        const std::string name = GetParam();
        if (name == "crash") {
            testing::write_crash_deck(deck);
        } else if (name == "splash") {
            testing::write_splash_deck(deck);
        } else {
            std::ofstream(deck) << testing::joined_deck();
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Decks, RestartOf, ::testing::Values("crash", "joined", "splash"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(RestartOf, EndsBitIdenticalThoughKilledTwentyTimes)
{
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(Process(run_command(deck, folder / "whole", false)).exit_code(), 0);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto whole = results_in(folder / "whole");
    ASSERT_GE(whole.size(), 20u);

    std::mt19937 random(20240607);
    std::uniform_real_distribution<double> moment(0, 0.35 * seconds);
    const fs::path broken = folder / "broken";
    // How many kills fall before the first restart file depends on the machine's load: some more of them,
    // then.
    int restarts = 0;
    for (int kills = 0; kills < 20 || (restarts <= 5 && kills < 200);) {
        const bool restart = has_restart_file(broken);
        restarts += restart;
        if (Process(run_command(deck, broken, restart)).kill_after(moment(random))) {
            ++kills;
            continue;
        }
        expect_same_files(whole, broken); // it came to its end before it was killed: once more
        fs::remove_all(broken);
    }
    ASSERT_EQ(Process(run_command(deck, broken, has_restart_file(broken))).exit_code(), 0);
    expect_same_files(whole, broken);
    EXPECT_GT(restarts, 5);
}

TEST_P(RestartOf, EveryRestartFileOfARunLeadsToTheSameEnd)
{
    ASSERT_EQ(Process(run_command(deck, folder / "run", false)).exit_code(), 0);
    const auto whole = results_in(folder / "run");
    int count = 0;
    for (const char* name : {"d3dump01", "d3dump02", "runrsf01", "runrsf02"}) {
        const fs::path file = fs::path(folder / "run") / name;
        ASSERT_TRUE(fs::exists(file)) << file;
        const fs::path kept = folder / name;
        fs::copy(file, kept);
        std::vector<std::string> words = run_command(deck, folder / "run", false);
        words.insert(words.end(), {"--restart", kept});
        ASSERT_EQ(Process(words).exit_code(), 0) << name;
        expect_same_files(whole, folder / "run");
        ++count;
    }
    EXPECT_EQ(count, 4);
}

namespace {

/// A run of 0.15 s with bodies that cut cells of a plane tank, as a whole and from two of its restart files
/// on.
void expect_cutters_to_go_on(const std::string& body, const std::string& filling)
{
    const TemporaryFolder folder;
    const fs::path deck = folder / "box.k";
    std::ofstream(deck)
        << "*KEYWORD\n"
        << testing::structured_mesh({0, 0, 0}, {0.2, 0.05, 0.4}, {8, 1, 16})
        << testing::liquid_and_void(1000, 20) << filling
        << "*PART\nbox\n20,20,20\n*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n"
           "*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,2,4,1,1\n\n*PLASH_ALE_FORMULATION\n0,1\n"
           "*DATABASE_GLSTAT\n1e-3\n*DATABASE_BINARY_D3PLOT\n0.02\n*DATABASE_BINARY_D3DUMP\n60\n"
        << body << testing::gravity(9.81) << testing::closed(0.15);
    ASSERT_EQ(Process(run_command(deck, folder / "run", false)).exit_code(), 0);
    const auto whole = results_in(folder / "run");
    for (const char* name : {"d3dump01", "d3dump03"}) {
        fs::copy(fs::path(folder / "run") / name, folder / name);
        std::vector<std::string> words = run_command(deck, folder / "run", false);
        words.insert(words.end(), {"--restart", folder / name});
        ASSERT_EQ(Process(words).exit_code(), 0) << name;
        expect_same_files(whole, folder / "run");
    }
}

} // namespace

// A box that floats in water that it cuts, before and while its floor passes from a layer of cells to the
// next.
TEST(Restart, BodiesThatCutCellsGoOn)
{
    int first = 100000;
    const Vec3 corner{0, 0, 0.17}, along{0, 0.05, 0}, floor{0.08, 0, 0}, up{0, 0, 0.2};
    std::string box = "*MAT_RIGID\n20,2000,2e11,0.3\n1,4,7\n\n";
    box += testing::shell_patch(20, first, corner, along, floor, 1, 4);
    box += testing::shell_patch(20, first, corner + floor, along, up, 1, 8);
    expect_cutters_to_go_on(box,
                            testing::liquid_in_box({0, 0, 0}, {0.2, 1, 0.26}) + "5,0,2\n0,0,0.17,0.08,1,1\n");
}

// A rubber sheet across the tank, held at both ends, that sinks 5 mm through the surface of a layer of cells
// and bends on the water.
TEST(Restart, BodiesThatBendInCutCellsGoOn)
{
    int first = 100000;
    std::string sheet = "*MAT_ELASTIC\n20,2000,1e6,0.3\n";
    sheet += testing::shell_patch(20, first, {0, 0, 0.23}, {0, 0.05, 0}, {0.2, 0, 0}, 1, 12);
    sheet += fmt::format("*SET_NODE_LIST\n1\n100000,100001,{},{}\n*BOUNDARY_SPC_SET\n1,0,1,0,1,0,0,0\n",
                         first - 2, first - 1);
    sheet += "*SET_NODE_LIST_GENERATE\n2\n100000," + std::to_string(first - 1) +
             "\n*BOUNDARY_SPC_SET\n2,0,0,1,0,1,0,1\n";
    expect_cutters_to_go_on(sheet, testing::liquid_in_box({0, 0, 0}, {0.2, 1, 0.22}));
}

TEST(Restart, ParticlesThatWaitInSolidsComeOutAgain)
{
    const TemporaryFolder folder;
    const fs::path deck = folder / "bar.k";
    std::ofstream(deck) << testing::pulled_bar("1,1", 6e-3, 0.03,
                                               "*DATABASE_GLSTAT\n1e-3\n*DATABASE_BINARY_D3PLOT\n0.01\n"
                                               "*DATABASE_BINARY_D3DUMP\n30\n");
    ASSERT_EQ(Process(run_command(deck, folder / "run", false)).exit_code(), 0);
    const auto whole = results_in(folder / "run");
    for (const char* name : {"d3dump01", "d3dump03"}) { // before and after the loss, in cycle 42
        fs::copy(fs::path(folder / "run") / name, folder / name);
        std::vector<std::string> words = run_command(deck, folder / "run", false);
        words.insert(words.end(), {"--restart", folder / name});
        ASSERT_EQ(Process(words).exit_code(), 0) << name;
        expect_same_files(whole, folder / "run");
    }
}

TEST(Restart, CtrlCAndTheFileD3kilLeaveARestartFile)
{
    const TemporaryFolder folder;
    const fs::path deck = folder / "crash.k";
    testing::write_crash_deck(deck);
    ASSERT_EQ(Process(run_command(deck, folder / "whole", false)).exit_code(), 0);
    const fs::path broken = folder / "broken";
    fs::create_directories(broken);
    std::ofstream(broken / "D3KIL") << "sw1\n";
    EXPECT_EQ(Process(run_command(deck, broken, false)).exit_code(), 3); // ended early
    EXPECT_FALSE(fs::exists(broken / "D3KIL"));
    ASSERT_TRUE(fs::exists(broken / "d3dump01"));
    ASSERT_EQ(Process(run_command(deck, broken, true)).exit_code(), 0);
    expect_same_files(results_in(folder / "whole"), broken);
}

TEST(Restart, RefusesDamagedFilesAndOtherDecks)
{
    const TemporaryFolder folder;
    const std::string path = folder / "d3dump01";
    std::vector<double> values{1, 2, 3};
    {
        Archive archive(path, Archive::Mode::save);
        archive.section("shells");
        archive(values);
        archive.close();
    }
    std::vector<double> loaded;
    {
        Archive archive(path, Archive::Mode::load);
        archive.section("shells");
        archive(loaded);
        archive.close();
    }
    EXPECT_EQ(loaded, values);
    {
        Archive archive(path, Archive::Mode::load);
        EXPECT_THROW(archive.section("solids"), RunError);
    }
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-12, std::ios::end); // within the last number
    file.put('x');
    file.close();
    Archive archive(path, Archive::Mode::load);
    archive.section("shells");
    archive(loaded);
    EXPECT_THROW(archive.close(), RunError);
    fs::resize_file(path, fs::file_size(path) - 8);
    Archive shorter(path, Archive::Mode::load);
    shorter.section("shells");
    EXPECT_THROW(shorter(loaded), RunError);
}

} // namespace plash

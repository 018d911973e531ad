#include "output/result_file.h"
#include "output/summary.h"
#include "tests/support/shared_files.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace plash {

TEST(Summary, HoldsEveryPromisedField)
{
    RunSummary summary;
    summary.deck = "a\xe9.k"; // Latin-1 as old decks have it
    summary.version = "0.1.0";
    summary.threads = 2;
    summary.termination = RunSummary::Termination::stopped;
    summary.message = "stopped on request";
    summary.time = 0.1;
    summary.end_time = std::numeric_limits<double>::infinity();
    summary.cycles = 7;
    summary.wall_seconds = 1.5;
    summary.cpu_seconds = 3;
    summary.peak_memory_bytes = 1u << 30;
    summary.time_step_first = 1e-3;
    summary.time_step_last = 2e-3;
    summary.added_mass_ratio = 0.01;
    summary.energy.kinetic = 1;
    summary.energy.internal = 2;
    summary.energy.eroded_internal = 4;
    summary.energy.eroded_kinetic = 8;
    summary.energy.rigid_wall = 16;
    summary.energy.largest_error = 1;
    summary.energy.largest_turnover = 8;
    summary.terms = {{"shells", 0.75, 100, 700}};

    testing::TemporaryFolder folder;
    write_summary(summary, folder.path().string());
    const auto json = nlohmann::json::parse(testing::text_of(folder / "summary.json"));

    std::vector<std::string> names;
    for (const auto& [name, value] : json.items()) names.push_back(name);
    const std::vector<std::string> promised = {
        "added_mass_ratio", "cpu_seconds",       "cycles",      "deck",        "end_time", "energy",
        "message",          "peak_memory_bytes", "termination", "terms",       "threads",  "time",
        "time_step_first",  "time_step_last",    "version",     "wall_seconds"};
    EXPECT_EQ(names, promised); // the parser sorts them
    EXPECT_EQ(json["termination"], "stopped");
    EXPECT_EQ(json["time"].get<double>(), 0.1);
    EXPECT_TRUE(json["end_time"].is_null());
    EXPECT_EQ(json["peak_memory_bytes"].get<std::uint64_t>(), 1u << 30);
    std::vector<std::string> energies;
    for (const auto& [name, value] : json["energy"].items()) energies.push_back(name);
    const std::vector<std::string> promised_energies = {
        "balance_error_max", "damping", "eroded",    "external_work", "hourglass",
        "internal",          "kinetic", "rigidwall", "sliding",       "total"};
    EXPECT_EQ(energies, promised_energies);
    EXPECT_EQ(json["energy"]["eroded"].get<double>(), 12);
    EXPECT_EQ(json["energy"]["total"].get<double>(), 31);
    EXPECT_EQ(json["energy"]["balance_error_max"].get<double>(), 0.125);
    EXPECT_EQ(json["terms"][0]["name"], "shells");
    EXPECT_EQ(json["terms"][0]["item_steps"].get<int>(), 700);
}

TEST(Summary, ReplacesTheOldFileInOneMove)
{
    testing::TemporaryFolder folder;
    write_summary({}, folder.path().string());
    write_summary({}, folder.path().string());
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        names.push_back(entry.path().filename());
    }
    EXPECT_EQ(names, std::vector<std::string>{"summary.json"});
}

TEST(ResultFile, SaysWhichFileCannotBeWritten)
{
    EXPECT_THROW(ResultFile("/nowhere/glstat"), std::runtime_error);
    ResultFile full("/dev/full"); // every write to this device fails as on a full disk
    try {
        full.write("x");
        full.flush();
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "result file /dev/full cannot be written: No space left on device");
    }
}

} // namespace plash

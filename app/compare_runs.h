#pragma once

#include "app/comparison.h"

#include <CLI/CLI.hpp>

#include <limits>
#include <string>
#include <vector>

namespace plash {

/// Which signals of which runs are judged against what.
struct CompareOptions {
    std::vector<std::string> directories;
    std::vector<std::string> signals; ///< names as run_signal() takes them
    std::vector<std::string>
        references; ///< FILE.csv, FILE.csv:COLUMN, a directory; empty: the first directory
    std::vector<double> reference_scale = {1, 1}; ///< of the reference's times and values
    std::string output = "results/compare";
    std::string ranking = "comprehensive"; ///< as ranking_error() takes it
    double factor = 1;                     ///< of the runs' values
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity(); ///< [time]
    std::size_t samples = 1001;
    bool json = false, picture = true;
};

/// Adds the options that compare and study share: everything but the directories.
void add_compare_options(CLI::App& command, CompareOptions& options);

/// One comparison for each signal. Throws SignalError.
std::vector<SignalComparison> compare_runs(const CompareOptions& options);

/// Prints the tables and writes compare.csv, .json, .html and .png into the output folder. Throws SignalError
/// or std::filesystem::filesystem_error.
void write_comparison(const CompareOptions& options, const std::vector<SignalComparison>& comparisons);

} // namespace plash

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace plash {

/// What a run took and how well its energies balance, from its summary.json (docs/summary_json.md).
struct RunCost {
    std::string deck;
    std::string termination; ///< "normal", "error", "stopped"
    double cpu_seconds = 0;  ///< summed over threads
    double wall_seconds = 0;
    double item_steps = 0;    ///< elements, cells and particles worked on, summed over the cycles
    double memory = 0;        ///< peak resident [bytes]
    double balance_error = 0; ///< [-]
    long cycles = 0;
};

/// Nothing when the directory holds no readable summary.json (another code's results).
std::optional<RunCost> run_cost(const std::string& directory);

/// Which of these runs nobody beats: no other has at most the same error and at most the same cost, and less
/// of one. Entries that are not finite never belong to the front.
std::vector<bool> pareto_front(const std::vector<double>& error, const std::vector<double>& cost);

} // namespace plash

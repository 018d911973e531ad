#pragma once

#include "core/energy_ledger.h"

#include <cstdint>
#include <string>
#include <vector>

namespace plash {

/// What every run leaves in summary.json (docs/summary_json.md): a promise to other programs.
struct RunSummary {
    /// Time spent in one Term.
    struct TermTime {
        std::string name;
        double seconds = 0;           ///< wall clock
        std::uint64_t items = 0;      ///< elements, nodes, particles worked on each cycle
        std::uint64_t item_steps = 0; ///< summed over the cycles
    };
    enum class Termination { normal, error, stopped };

    std::string deck;
    std::string version;
    int threads = 1;
    Termination termination = Termination::normal;
    std::string message;
    double time = 0;     ///< reached [time]
    double end_time = 0; ///< asked for [time]
    long cycles = 0;
    double wall_seconds = 0;
    double cpu_seconds = 0;
    std::uint64_t peak_memory_bytes = 0;
    double time_step_first = 0;
    double time_step_last = 0;
    double added_mass_ratio = 0; ///< mass added by mass scaling over the mass of the model [-]
    EnergyLedger energy;
    std::vector<TermTime> terms;
};

/// The text of summary.json. Numbers have the digits that give the same double when read back; JSON knows no
/// infinity and no not-a-number: null stands for them.
std::string summary_json(const RunSummary&);

/// Writes DIR/summary.json in one move. Throws RunError.
void write_summary(const RunSummary&, const std::string& directory);

} // namespace plash

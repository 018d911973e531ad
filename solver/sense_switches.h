#pragma once

#include <atomic>
#include <chrono>
#include <string>

namespace plash {

/// LS-DYNA's sense switches: what a person asks of a run under way, by a line in a file D3KIL in the results'
/// directory or in the directory where the program was started; or by Ctrl-C, which means sw1.
enum class SenseSwitch {
    none,
    end_with_restart_file, ///< sw1: write a restart file and end
    tell_time,             ///< sw2: print cycle, time and step
    restart_file,          ///< sw3: write a restart file and go on
    plot_state,            ///< sw4: write a plot state and go on
    end_with_plot_state,   ///< stop: write a plot state and end
};

/// The switch that a word names; none for any other word.
SenseSwitch sense_switch_of(std::string word);

/// Looks for switches; the file is looked for at most five times a second, so that every cycle can ask.
class SenseSwitches {
public:
    /// stop_requested  set by Ctrl-C; may be null
    SenseSwitches(std::string directory, const std::atomic<bool>* stop_requested);

    /// The switch that has come since the last call; its file is removed.
    SenseSwitch poll();

private:
    using WallClock = std::chrono::steady_clock;
    std::string directory_;
    const std::atomic<bool>* stop_requested_;
    WallClock::time_point next_look_ = WallClock::now();
};

} // namespace plash

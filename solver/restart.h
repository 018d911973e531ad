#pragma once

#include "solver/explicit_loop.h"
#include "solver/step_control.h"
#include "solver/terminations.h"

#include <chrono>
#include <string>

namespace plash {

/// Everything that a run carries from one cycle to the next.
struct RunParts {
    Scene& scene;
    StepControl& step_control;
    Terminations& terminations;
    Outcome& outcome;
    Recorders& recorders;
};

/// Brings a run that has just been set up from the same deck to where the restart file was written: between
/// two cycles, positions at n and velocities at n - 1/2. RunError when the file does not fit; result files
/// are cut back only when the file has been found whole. Returns the number of the last d3dump file that was
/// there.
int load_run(const std::string& path, const RunParts& run);

/// The restart files of a run: d3dump01, d3dump02 ... every so many cycles (*DATABASE_BINARY_D3DUMP) and on
/// request; runrsf, one or several that overwrite each other in turn (*DATABASE_BINARY_RUNRSF), or one every
/// so many minutes where the deck says nothing. A file that is there is complete, whenever the process ends.
class RestartFiles {
public:
    /// last_dump  number of the last d3dump file, which the next one follows
    RestartFiles(const RestartOptions& options, const RestartRequest& request, int last_dump);

    /// Between two cycles: writes what falls due.
    void write_due(const RunParts& run);
    /// Between two cycles: writes the next d3dump file, whatever is due; its path (empty when none are
    /// written).
    std::string write_dump(const RunParts& run);

    /// Whether files are written at all.
    bool on() const { return !options_.directory.empty(); }
    /// The file written last; empty when there is none.
    const std::string& last_written() const { return last_written_; }

private:
    using WallClock = std::chrono::steady_clock;
    RestartOptions options_;
    RestartRequest request_;
    int last_dump_;
    int running_files_ = 0; ///< runrsf files written so far
    WallClock::time_point last_time_ = WallClock::now();
    std::string last_written_;

    void write(const std::string& name, const RunParts& run);
    void write_running(const RunParts& run);
};

/// The restart file in a directory that was written last, or the path itself if it is a file. RunError when
/// there is none.
std::string find_restart_file(const std::string& path);

} // namespace plash

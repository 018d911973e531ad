#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <string>
#include <vector>

namespace plash {

/// What one state of glstat shows; energies as LS-DYNA counts them, with what eroded inside `kinetic`,
/// `internal` and `hourglass`.
struct GlobalStatistics {
    long cycle = 1; ///< LS-DYNA counts from 1
    StepVote owner;
    double time = 0;
    double step = 0;
    double kinetic = 0;
    double internal = 0;
    std::vector<double> stonewall; ///< by rigid wall
    double spring_and_damper = 0;
    double hourglass = 0;
    double damping = 0;
    double sliding = 0;
    double external_work = 0;
    double eroded_kinetic = 0;
    double eroded_internal = 0;
    double eroded_hourglass = 0;
    double advection_loss = 0; ///< of Eulerian meshes; its row is there where it is not zero
    double total = 0;
    double energy_ratio = 1; ///< total / (initial + external work)
    double energy_ratio_without_eroded = 1;
    Vec3 velocity{}; ///< of the model as one rigid body
};

/// Everything glstat shows, from a snapshot.
GlobalStatistics global_statistics(const Snapshot&);

/// One state as LS-DYNA R13 prints it (*CONTROL_ENERGY with all flags on). `with_hourglass` false leaves the
/// hourglass line out, as LS-DYNA does with HGEN = 1.
std::string format_glstat(const GlobalStatistics&, bool with_hourglass = true);

/// *DATABASE_GLSTAT.
class GlstatRecorder final : public ScheduledRecorder {
public:
    GlstatRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>

namespace plash {

/// The block of one state of rbdout, as LS-DYNA prints it: global motion of each body's center, its axes, and
/// the same motion along these axes.
std::string format_rbdout(long cycle, double time, std::span<const ElementResults::RigidMotion> bodies);

/// *DATABASE_RBDOUT: motion of all rigid bodies at n.
class RbdoutRecorder final : public ScheduledRecorder {
public:
    RbdoutRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>

namespace plash {

/// The block of one state of jntforc.
std::string format_jntforc(double time, std::span<const ElementResults::JointForce> joints);

/// *DATABASE_JNTFORC: force and moment of each joint on its second body at n, along the global axes, and the
/// energy that it has put in (motors).
class JntforcRecorder final : public ScheduledRecorder {
public:
    JntforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

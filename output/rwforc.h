#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <string>

namespace plash {

/// *DATABASE_RWFORC: forces of the nodes on each planar wall at n.
class RwforcRecorder final : public ScheduledRecorder {
public:
    RwforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// What matsum shows of one part.
struct PartStatistics {
    Id id = 0;
    double internal = 0;
    double kinetic = 0;
    double eroded_internal = 0;
    double eroded_kinetic = 0;
    Vec3 momentum{};
    Vec3 rigid_body_velocity{}; ///< momentum over mass
    double hourglass = 0;
    double mass = 0; ///< of what is not eroded
};

/// All parts of the Model.
std::vector<PartStatistics> part_statistics(const Snapshot&);

/// One state as LS-DYNA R13 prints it.
std::string format_matsum(double time, std::span<const PartStatistics>);

/// *DATABASE_MATSUM.
class MatsumRecorder final : public ScheduledRecorder {
public:
    MatsumRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

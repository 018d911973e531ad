#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// One row of nodout's first table.
struct NodeRow {
    Id id = 0;
    Vec3 displacement{}, velocity{}, acceleration{}, position{};
};

/// One row of its second table: angle of rotation (components of the integral of the angular velocity).
struct RotationRow {
    Id id = 0;
    Vec3 rotation{}, angular_velocity{}, angular_acceleration{};
};

/// The tables of one state as LS-DYNA prints them; `cycle` counts from 1.
std::string format_nodout(long cycle, double time, std::span<const NodeRow>);
std::string format_nodout(long cycle, double time, std::span<const RotationRow>);

/// *DATABASE_NODOUT: the nodes of *DATABASE_HISTORY_NODE. What is written when: see NodalMotion.
class NodoutRecorder final : public ScheduledRecorder {
public:
    NodoutRecorder(const Model&, Schedule, const ResultPath& path);

    /// Sums the angles of rotation.
    void follow(const Clock&, const State&) override;

private:
    std::vector<Index> nodes_;
    std::vector<Vec3> rotation_; ///< of `nodes_` since the start
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_, rotation_); }
};

} // namespace plash

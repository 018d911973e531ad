#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <vector>

namespace plash {

/// A group of nodfor at one state.
struct NodalForceRows {
    const NodalForceGroup* group;
    std::vector<ElementResults::NodalForce> nodes; ///< like group->nodes
    Vec3 sum{}, local_sum{};                       ///< global axes; those of the group's system
    double energy = 0;
};

std::vector<NodalForceRows> nodal_force_rows(const Snapshot&);

/// *DATABASE_NODFOR: external forces on the nodes of each *DATABASE_NODAL_FORCE_GROUP, with the work that
/// they have done.
class NodforRecorder final : public ScheduledRecorder {
public:
    NodforRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

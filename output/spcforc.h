#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// What spcforc shows of one held node.
struct SupportRow {
    Id node = 0;
    bool translations = false, rotations = false; ///< which lines there are
    Vec3 force{}, moment{};                       ///< of the support on the node
};

/// One state as LS-DYNA prints it: rows in the order given, and the sum of the forces.
std::string format_spcforc(double time, std::span<const SupportRow>);

/// *DATABASE_SPCFORC: reaction forces of all held nodes at n, by rising node number.
class SpcforcRecorder final : public ScheduledRecorder {
public:
    SpcforcRecorder(const Model&, Schedule, const std::string& path);

private:
    std::vector<SupportRow> rows_; ///< without forces
    std::vector<Index> row_of_node_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
};

} // namespace plash

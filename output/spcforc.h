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

/// The held nodes of a Model by rising number, and their reactions.
class SupportTable {
public:
    explicit SupportTable(const Model&);

    const std::vector<SupportRow>& rows() const { return rows_; } ///< without forces
    std::vector<SupportRow> filled(const Snapshot&) const;

private:
    std::vector<SupportRow> rows_;
    std::vector<Index> row_of_node_;
};

/// *DATABASE_SPCFORC: reaction forces of all held nodes at n, by rising node number.
class SpcforcRecorder final : public ScheduledRecorder {
public:
    SpcforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    SupportTable table_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>

namespace plash {

/// The springs and dampers that deforc shows: those without PF = 1.
std::vector<Index> shown_springs(const Model&);

/// States of these springs now, in their order.
std::vector<ElementResults::SpringState> spring_states(const Snapshot&, std::span<const Index> springs);

/// The block of one state of deforc.
std::string format_deforc(double time, const Model&, std::span<const ElementResults::SpringState> springs);

/// *DATABASE_DEFORC: force of each spring and damper on its first node, its size (tension positive) and its
/// change in length; moments and rotations for torsional ones.
class DeforcRecorder final : public ScheduledRecorder {
public:
    DeforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    std::vector<Index> springs_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// What secforc shows of one cross section.
struct SectionRow {
    Id id = 0;
    Vec3 force{}, moment{}; ///< of the section's elements on its nodes; about the centroid
    Vec3 centroid{};        ///< mean place of the section's nodes [length]
    double area = 0;        ///< of the cut at the start [length^2]
};

/// All cross sections of the Model now.
std::vector<SectionRow> section_rows(const Snapshot&);

/// One state, three lines a section, in LS-DYNA's columns.
std::string format_secforc(double time, std::span<const SectionRow>);

/// *DATABASE_SECFORC.
class SecforcRecorder final : public ScheduledRecorder {
public:
    SecforcRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

#pragma once

#include "output/binout.h"
#include "output/result_file.h"
#include "output/schedule.h"

#include <memory>

namespace plash {

/// *DATABASE_ABSTAT: volume, gauge pressure, energy, flows, mass and temperature of the airbags at n.
class AbstatRecorder final : public ScheduledRecorder {
public:
    AbstatRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// The same as arrays, by the names of LS-DYNA's binout.
std::unique_ptr<BinoutSection> make_abstat_section(const Model&);

} // namespace plash

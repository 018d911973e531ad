#pragma once

#include "output/binout.h"
#include "output/result_file.h"
#include "output/schedule.h"

namespace plash {

/// Tracers of a scene at n, those in structures with the state of their element.
std::vector<ElementResults::Tracer> tracer_states(const Snapshot& snapshot);

/// *DATABASE_TRHIST: the tracers of *DATABASE_TRACER. As LS-DYNA has it: three lines that name the sixteen
/// columns, then by time three lines a tracer. One that is not active has zeros besides its place and
/// velocity.
class TrhistRecorder final : public ScheduledRecorder {
public:
    TrhistRecorder(const Model&, Schedule, const ResultPath& path);

private:
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// The same as arrays, under the names of the columns.
std::unique_ptr<BinoutSection> make_trhist_section();

} // namespace plash

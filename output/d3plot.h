#pragma once

#include "output/d3plot_family.h"
#include "output/d3plot_layout.h"
#include "output/d3plot_values.h"
#include "output/schedule.h"

namespace plash {

/// *DATABASE_BINARY_D3PLOT: the binary state database that LS-PrePost, ParaView (vtkLSDynaReader) and others
/// read. Single precision. The state at the end of the run is always written.
class D3plotRecorder final : public ScheduledRecorder {
public:
    D3plotRecorder(const Model&, Schedule, const ResultPath& path,
                   std::size_t words_per_file = D3plotFamily::usual_words_per_file);

    void write_on_request(const Snapshot& snapshot) override { write(snapshot); }
    void finish(const Snapshot& snapshot) override { write(snapshot); }

private:
    D3plotLayout layout_;
    D3plotFamily family_;
    D3plotValues values_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(family_); }
    void put_particles(const Model&);
};

} // namespace plash

#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <string>
#include <utility>
#include <vector>

namespace plash {

/// *DATABASE_BINARY_INTFOR: what contacts do to their surfaces, as a time series for ParaView in place of
/// LS-DYNA's binary file: DIRECTORY/interface.pvd names DIRECTORY/vtk/interface_0000.vtu ... with their
/// times.
///
/// A cell for each exposed segment of each contact: contact_id, surface (1 first, 2 second, 3 both), part_id,
/// pressure, shear (friction per area, a vector), shear_size, penetration. By node: node_id, displacement.
class InterfaceSeries final : public ScheduledRecorder {
public:
    /// With `resume` (path: the directory) the states of an earlier run stay.
    InterfaceSeries(const Model&, Schedule, const ResultPath& directory);

    void finish(const Snapshot& snapshot) override { write(snapshot); }

private:
    std::string directory_;
    std::vector<std::pair<double, std::string>> files_; ///< time and name of what has been written

    void write_state(const Snapshot&) override;
    void serialise_files(Archive&) override;
    void write_index() const;
};

} // namespace plash

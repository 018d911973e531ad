#pragma once

#include "output/cell_shape.h"
#include "output/result_file.h"
#include "output/schedule.h"

#include <string>
#include <utility>
#include <vector>

namespace plash {

/// A time series for ParaView: DIRECTORY/result.pvd names the files DIRECTORY/vtk/result_0000.vtu ... with
/// their times. Both are written in one move, so the series can be opened while the run goes on and after it
/// was killed. The state at the end of the run is always written.
///
/// By node: node_id, displacement, velocity (of n-1/2, see NodalMotion). By element, shells before solids
/// before particles (vertices that have the numbers of their nodes):
/// element_id, part_id, eroded (ParaView hides those through vtkGhostType), stress (six components in global
/// axes; shells: the middle layer), stress_inner and stress_outer when there are shells (solids: as stress),
/// von_mises and plastic_strain (the largest of a shell's layers), thickness (solids: 0); with particles also
/// pressure, density, smoothing_length, internal_energy (of the whole particle) and neighbours; with an
/// Eulerian mesh pressure, density and volume_fraction_1 ... of each group of the deck; zero for other
/// elements.
class VtkSeries final : public ScheduledRecorder {
public:
    /// With `resume` (path: the directory) the states of an earlier run stay.
    VtkSeries(const Model&, Schedule, const ResultPath& directory);

    void write_on_request(const Snapshot& snapshot) override { write(snapshot); }
    void finish(const Snapshot& snapshot) override { write(snapshot); }

private:
    std::string directory_;
    std::vector<Cell> cells_;
    std::vector<std::pair<double, std::string>> files_; ///< time and name of what has been written
    bool walls_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive&) override;
    void write_index() const;
};

/// Writes DIRECTORY/walls.vtu, a square for each planar wall as large as the model, for pictures. Does
/// nothing for a model without walls.
void write_walls(const Model&, const std::string& directory);

} // namespace plash

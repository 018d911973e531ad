#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <string>
#include <vector>

namespace plash {

/// *DATABASE_FSI: force of Eulerian fluids on surfaces of the structure, in the file dbfsi. A line a surface
/// and time: its number, mean pressure (force against the normals over the area; 0 where the surface is not a
/// flat one of shells), the three components of the force [force].
class DbfsiRecorder final : public ScheduledRecorder {
public:
    DbfsiRecorder(const Model&, Schedule, const ResultPath& path);

private:
    struct Surface {
        Id id = 0;
        std::vector<Index> nodes;                   ///< each once
        std::vector<std::array<Index, 4>> segments; ///< for the area
    };
    std::vector<Surface> surfaces_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// The deck asks for dbfsi.
bool has_fluid_surfaces(const Model&);
/// Interval of the first *DATABASE_FSI.
Schedule fluid_surface_schedule(const Model&);

} // namespace plash

#pragma once

#include "output/binout.h"
#include "output/result_file.h"
#include "output/schedule.h"

#include <string>
#include <vector>

namespace plash {

/// *DATABASE_FSI: force of Eulerian fluids on surfaces of the structure.
class FluidSurfaces {
public:
    explicit FluidSurfaces(const Model&);

    struct Row {
        Id id = 0;
        double pressure = 0; ///< mean: force against the normals over the area; 0 where the surface is not a
                             ///< flat one of shells [pressure]
        Vec3 force{};        ///< in the axes of CID [force]
    };
    std::vector<Row> rows(const Snapshot&) const;
    std::size_t size() const { return surfaces_.size(); }
    std::vector<Id> ids() const;

private:
    struct Surface {
        Id id = 0;
        Index system = none;                        ///< CID
        std::vector<Index> nodes;                   ///< each once
        std::vector<std::array<Index, 4>> segments; ///< for the area
    };
    std::vector<Surface> surfaces_;
};

/// File dbfsi: a line a surface and time with its number, mean pressure and the components of the force.
class DbfsiRecorder final : public ScheduledRecorder {
public:
    DbfsiRecorder(const Model&, Schedule, const ResultPath& path);

private:
    FluidSurfaces surfaces_;
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

/// The same as arrays.
std::unique_ptr<BinoutSection> make_dbfsi_section(const Model&);

/// The deck asks for dbfsi.
bool has_fluid_surfaces(const Model&);
/// Interval of the first *DATABASE_FSI.
Schedule fluid_surface_schedule(const Model&);
/// Its field BINARY: 1 text, 2 binout, 3 both.
int fluid_surface_form(const Model&);

} // namespace plash

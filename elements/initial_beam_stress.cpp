#include "elements/initial_beam_stress.h"

#include "materials/parameters.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

InitialBeamStress beam_stress_of(const Record& record)
{
    InitialBeamStress stress;
    stress.where = record.where;
    const Id points = record.integer("NPTS");
    if (points == 0) {
        stress.axial = record.real("F11");
        stress.torsion = record.real("T11");
        for (const char* field : {"M12", "M13", "M22", "M23"}) {
            if (record.real(field) != 0)
                reject_field(record, field, "bending at the start needs the stresses of points (NPTS)");
        }
        return stress;
    }
    if (record.integer("LOCAL") != 1)
        reject_field(record, "LOCAL", "only stresses in the axes of the beam (LOCAL = 1) are supported");
    if (record.integer("NAXES") != 0)
        reject_field(record, "NAXES", "axes at the start are those of the nodes; leave it at 0");
    const Table* rows = record.table("SIG11");
    if (!rows || rows->rows() != static_cast<std::size_t>(points))
        reject_field(record, "NPTS", "the card does not give so many points");
    const auto column = [&](std::string_view name) {
        const auto found = std::find(rows->columns.begin(), rows->columns.end(), name);
        return static_cast<std::size_t>(found - rows->columns.begin());
    };
    for (std::size_t row = 0; row < rows->rows(); ++row) {
        for (const char* name : {"SIG22", "SIG33", "SIG23"}) {
            if (rows->at(row, column(name)) == 0) continue;
            throw DeckError({record.where.file, rows->lines[row]},
                            fmt::format("*INITIAL_STRESS_BEAM, field {}: beams have no such stress", name));
        }
        stress.points.push_back({rows->at(row, column("SIG11")), rows->at(row, column("SIG12")),
                                 rows->at(row, column("SIG31")), rows->at(row, column("EPS"))});
    }
    return stress;
}

} // namespace

std::map<Index, InitialBeamStress> initial_beam_stresses(const Model& model)
{
    std::map<Index, InitialBeamStress> stresses;
    for (const Record& record : model.others) {
        if (record.keyword != "INITIAL_STRESS_BEAM") continue;
        const Id id = record.integer("EID");
        const auto found = std::find(model.beams.id.begin(), model.beams.id.end(), id);
        if (found == model.beams.id.end())
            reject_field(record, "EID", fmt::format("there is no beam {}", id));
        stresses[static_cast<Index>(found - model.beams.id.begin())] = beam_stress_of(record);
    }
    return stresses;
}

} // namespace plash

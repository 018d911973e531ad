#include "output/dbfsi.h"

#include "core/local_axes.h"
#include "model/eulerian.h"
#include "output/ascii_text.h"
#include "output/binout_arrays.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

template <class Visit>
void for_requests(const Model& model, Visit&& visit)
{
    for (const Record& record : model.others)
        if (record.keyword == "DATABASE_FSI" && record.real("DTOUT") > 0) visit(record);
}

/// Segments of a row's surface: SIDTYPE 0 part set, 1 part, 2 segment set.
std::vector<std::array<Index, 4>> segments_of(const Model& model, const Record& record, Id id, Id type,
                                              std::vector<Index>& nodes)
{
    std::vector<std::array<Index, 4>> segments;
    if (type == 2) {
        for (const SegmentSet& set : model.segment_sets)
            if (set.id == id) segments = set.segments;
        if (segments.empty())
            throw DeckError(record.where,
                            fmt::format("*DATABASE_FSI, field SID: there is no segment set {}", id));
    } else {
        std::vector<bool> wanted(model.parts.size());
        const PartSet* set = type == 0 ? find_part_set(model, id) : nullptr;
        const Index part = type == 1 ? find_part(model, id) : none;
        if (set)
            for (Index member : set->parts) wanted[member] = true;
        else if (part != none)
            wanted[part] = true;
        else
            throw DeckError(record.where, fmt::format("*DATABASE_FSI, field SID: there is no {} {}",
                                                      type == 0 ? "part set" : "part", id));
        for (std::size_t shell = 0; shell < model.shells.size(); ++shell)
            if (wanted[model.shells.part[shell]]) segments.push_back(model.shells.nodes[shell]);
        for (std::size_t solid = 0; solid < model.solids.size(); ++solid)
            if (wanted[model.solids.part[solid]])
                nodes.insert(nodes.end(), model.solids.nodes[solid].begin(), model.solids.nodes[solid].end());
    }
    for (const auto& segment : segments) nodes.insert(nodes.end(), segment.begin(), segment.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return segments;
}

class DbfsiSection final : public BinoutSection {
public:
    explicit DbfsiSection(const Model& model) : surfaces_(model) {}

private:
    FluidSurfaces surfaces_;

    void write_metadata(ArrayFile& file) const override { file.put("ids", surfaces_.ids()); }
    void write_state(const Snapshot& snapshot, ArrayFile& file, const std::string&) override
    {
        std::vector<double> pressures;
        std::vector<Vec3> forces;
        for (const FluidSurfaces::Row& row : surfaces_.rows(snapshot)) {
            pressures.push_back(row.pressure);
            forces.push_back(row.force);
        }
        file.put_whole("cycle", Id{snapshot.clock.cycle + 1});
        file.put("pres", pressures);
        put_vectors(file, forces, "fx", "fy", "fz");
    }
};

/// Half the cross product of the diagonals.
Vec3 area_vector(const std::array<Index, 4>& nodes, const std::vector<Vec3>& position)
{
    return 0.5 * cross(position[nodes[2]] - position[nodes[0]], position[nodes[3]] - position[nodes[1]]);
}

} // namespace

bool has_fluid_surfaces(const Model& model)
{
    bool found = false;
    for_requests(model, [&](const Record& record) { found = found || record.table("DBFSI_ID") != nullptr; });
    return found;
}

Schedule fluid_surface_schedule(const Model& model)
{
    double interval = 0;
    for_requests(model, [&](const Record& record) {
        if (interval == 0) interval = record.real("DTOUT");
    });
    return Schedule(interval);
}

int fluid_surface_form(const Model& model)
{
    int form = 0;
    for_requests(model, [&](const Record& record) {
        if (form == 0) form = static_cast<int>(record.integer("BINARY"));
    });
    return form;
}

FluidSurfaces::FluidSurfaces(const Model& model)
{
    for_requests(model, [&](const Record& record) {
        const Table* table = record.table("DBFSI_ID");
        for (std::size_t row = 0; table && row < table->rows(); ++row) {
            Surface surface;
            surface.id = std::llround(table->at(row, 0));
            surface.segments = segments_of(model, record, std::llround(table->at(row, 1)),
                                           std::llround(table->at(row, 2)), surface.nodes);
            if (const Id system = std::llround(table->at(row, 6)); system != 0) {
                const auto& systems = model.coordinate_systems;
                const auto found = std::find_if(systems.begin(), systems.end(),
                                                [&](const auto& known) { return known.id == system; });
                if (found == systems.end())
                    throw DeckError(
                        record.where,
                        fmt::format("*DATABASE_FSI, field CID: there is no coordinate system {}", system));
                surface.system = static_cast<Index>(found - systems.begin());
            }
            surfaces_.push_back(std::move(surface));
        }
    });
}

std::vector<Id> FluidSurfaces::ids() const
{
    std::vector<Id> ids;
    for (const Surface& surface : surfaces_) ids.push_back(surface.id);
    return ids;
}

std::vector<FluidSurfaces::Row> FluidSurfaces::rows(const Snapshot& snapshot) const
{
    ElementResults results;
    results.coupling_force.resize(snapshot.state.size());
    snapshot.collect(results);
    std::vector<Row> rows;
    for (const Surface& surface : surfaces_) {
        Vec3 force{}, areas{};
        double area = 0;
        for (Index node : surface.nodes) force += results.coupling_force[node];
        for (const auto& segment : surface.segments) {
            const Vec3 vector = area_vector(segment, snapshot.state.position);
            areas += vector;
            area += norm(vector);
        }
        Row row{surface.id, 0, force};
        // Of a flat surface; closed ones have no mean normal.
        const double flat = norm(areas);
        if (area > 0 && flat > 0.5 * area) row.pressure = -dot(force, areas) / (flat * flat);
        if (surface.system != none) {
            const auto axes = axes_at(snapshot.model.coordinate_systems[surface.system], snapshot.state);
            row.force = {dot(force, axes[0]), dot(force, axes[1]), dot(force, axes[2])};
        }
        rows.push_back(row);
    }
    return rows;
}

DbfsiRecorder::DbfsiRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), surfaces_(model), file_(path)
{
    file_.write(ascii_heading(model) +
                fmt::format("\n Fluid-structure interaction: {} surfaces\n", surfaces_.size()));
}

void DbfsiRecorder::write_state(const Snapshot& snapshot)
{
    std::string text = "\n time =";
    append_scientific(text, snapshot.clock.time, 13, 5);
    text += "\n        id     pressure           fx           fy           fz\n";
    for (const FluidSurfaces::Row& row : surfaces_.rows(snapshot)) {
        text += fmt::format("{:10}", row.id);
        for (double value : {row.pressure, row.force.x, row.force.y, row.force.z})
            append_scientific(text, value, 13, 5);
        text += '\n';
    }
    file_.write(text);
    file_.flush();
}

std::unique_ptr<BinoutSection> make_dbfsi_section(const Model& model)
{
    return std::make_unique<DbfsiSection>(model);
}

} // namespace plash

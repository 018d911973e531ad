#include "output/dbfsi.h"

#include "model/eulerian.h"
#include "output/ascii_text.h"

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

DbfsiRecorder::DbfsiRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    for_requests(model, [&](const Record& record) {
        const Table* table = record.table("DBFSI_ID");
        for (std::size_t row = 0; table && row < table->rows(); ++row) {
            Surface surface;
            surface.id = std::llround(table->at(row, 0));
            surface.segments = segments_of(model, record, std::llround(table->at(row, 1)),
                                           std::llround(table->at(row, 2)), surface.nodes);
            surfaces_.push_back(std::move(surface));
        }
    });
    file_.write(ascii_heading(model) +
                fmt::format("\n Fluid-structure interaction: {} surfaces\n", surfaces_.size()));
}

void DbfsiRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    results.coupling_force.resize(snapshot.state.size());
    snapshot.collect(results);
    std::string text = "\n time =";
    append_scientific(text, snapshot.clock.time, 13, 5);
    text += "\n        id     pressure           fx           fy           fz\n";
    for (const Surface& surface : surfaces_) {
        Vec3 force{}, areas{};
        double area = 0;
        for (Index node : surface.nodes) force += results.coupling_force[node];
        for (const auto& segment : surface.segments) {
            const Vec3 vector = area_vector(segment, snapshot.state.position);
            areas += vector;
            area += norm(vector);
        }
        // Of a flat surface; closed ones have no mean normal.
        const double flat = norm(areas);
        const double pressure = area > 0 && flat > 0.5 * area ? -dot(force, areas) / (flat * flat) : 0;
        text += fmt::format("{:10}", surface.id);
        for (double value : {pressure, force.x, force.y, force.z}) append_scientific(text, value, 13, 5);
        text += '\n';
    }
    file_.write(text);
    file_.flush();
}

} // namespace plash

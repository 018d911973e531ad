#include "output/secforc.h"

#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

namespace {

void append_resultant(std::string& text, const Vec3& vector, double last)
{
    for (double value : {vector.x, vector.y, vector.z, last}) append_scientific(text, value, 12, 4);
    text += '\n';
}

} // namespace

std::vector<SectionRow> section_rows(const Snapshot& snapshot)
{
    const Model& model = snapshot.model;
    ElementResults results;
    results.sections.resize(model.cross_sections.size());
    for (std::size_t i = 0; i < results.sections.size(); ++i) {
        const std::vector<Index>& nodes = model.cross_sections[i].nodes;
        for (Index node : nodes)
            results.sections[i].centroid +=
                (1.0 / static_cast<double>(nodes.size())) * snapshot.state.position[node];
    }
    snapshot.collect(results);
    std::vector<SectionRow> rows;
    for (std::size_t i = 0; i < results.sections.size(); ++i) {
        const auto& section = results.sections[i];
        rows.push_back({model.cross_sections[i].id, section.force, section.moment, section.centroid,
                        model.cross_sections[i].area});
    }
    return rows;
}

std::string format_secforc(double time, std::span<const SectionRow> rows)
{
    std::string text;
    for (const SectionRow& row : rows) {
        fmt::format_to(std::back_inserter(text), "{:12}", row.id);
        append_scientific(text, time, 15, 5);
        append_resultant(text, row.force, norm(row.force));
        text += std::string(27, ' ');
        append_resultant(text, row.moment, norm(row.moment));
        text += std::string(27, ' ');
        append_resultant(text, row.centroid, row.area);
        text += '\n';
    }
    return text;
}

SecforcRecorder::SecforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    std::string entries;
    for (const CrossSection& section : model.cross_sections) {
        if (!section.title.empty()) entries += legend_entry(section.id, section.title, 70);
    }
    file_.write(ascii_heading(model) + (entries.empty() ? "\n\n" : ascii_legend(entries)) +
                "\n   line#1  section#     time         x-force     y-force     z-force   magnitude\n"
                "   line#2  resultant  moments      x-moment    y-moment    z-moment   magnitude\n"
                "   line#3  centroids                      x           y           z        area\n\n");
}

void SecforcRecorder::write_state(const Snapshot& snapshot)
{
    file_.write(format_secforc(snapshot.clock.time, section_rows(snapshot)));
    file_.flush();
}

} // namespace plash

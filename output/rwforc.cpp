#include "output/rwforc.h"

#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

RwforcRecorder::RwforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    std::string entries;
    for (const RigidWall& wall : model.rigid_walls) {
        if (!wall.title.empty()) entries += legend_entry(wall.id, wall.title, 80);
    }
    file_.write(ascii_heading(model) + (entries.empty() ? "\n\n" : ascii_legend(entries)) +
                "\n\n    time       wall#   normal-force    x-force        y-force        z-force\n");
}

void RwforcRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    snapshot.collect(results);
    std::string text;
    for (const auto& wall : results.walls) {
        append_scientific(text, snapshot.clock.time, 12, 5);
        fmt::format_to(std::back_inserter(text), "{:8}", wall.wall);
        for (double force : {wall.normal, wall.force.x, wall.force.y, wall.force.z}) {
            append_scientific(text, force, 15, 6);
        }
        text += '\n';
    }
    file_.write(text);
    file_.flush();
}

} // namespace plash

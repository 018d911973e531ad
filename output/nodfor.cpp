#include "output/nodfor.h"

#include "core/local_axes.h"
#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

namespace {

void append_field(std::string& text, std::string_view name, double value)
{
    text += name;
    append_scientific(text, value, 13, 4);
}

} // namespace

std::vector<NodalForceRows> nodal_force_rows(const Snapshot& snapshot)
{
    ElementResults results;
    results.springs_wanted = true;
    snapshot.collect(results);
    std::vector<NodalForceRows> rows;
    std::size_t next = 0;
    for (const NodalForceGroup& group : snapshot.model.nodal_force_groups) {
        NodalForceRows row{&group, {}, {}, {}, 0};
        for (std::size_t i = 0; i < group.nodes.size(); ++i) {
            const ElementResults::NodalForce force = next < results.nodal_forces.size()
                                                         ? results.nodal_forces[next]
                                                         : ElementResults::NodalForce{};
            ++next;
            row.nodes.push_back(force);
            row.sum += force.force;
            row.energy += force.energy;
        }
        if (group.system != none) {
            const auto axes = axes_at(snapshot.model.coordinate_systems[group.system], snapshot.state);
            row.local_sum = {dot(row.sum, axes[0]), dot(row.sum, axes[1]), dot(row.sum, axes[2])};
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

NodforRecorder::NodforRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    file_.write(ascii_heading(model));
}

void NodforRecorder::write_state(const Snapshot& snapshot)
{
    std::string text = "\n\n\n\n\n n o d a l   f o r c e   g r o u p    o u t p u t   t=";
    append_scientific(text, snapshot.clock.time, 9, 3);
    text += '\n';
    int number = 0;
    for (const NodalForceRows& row : nodal_force_rows(snapshot)) {
        fmt::format_to(std::back_inserter(text), "\n\n\n\n\n nodal group output number {:2}\n\n", ++number);
        for (std::size_t i = 0; i < row.nodes.size(); ++i) {
            fmt::format_to(std::back_inserter(text), " nd#{:8}",
                           snapshot.model.nodes.id[row.group->nodes[i]]);
            append_field(text, "  xforce=", row.nodes[i].force.x);
            append_field(text, "   yforce=", row.nodes[i].force.y);
            append_field(text, "  zforce=", row.nodes[i].force.z);
            append_field(text, "   energy=", row.nodes[i].energy);
            text += '\n';
        }
        append_field(text, "              xtotal=", row.sum.x);
        append_field(text, "   ytotal=", row.sum.y);
        append_field(text, "  ztotal=", row.sum.z);
        append_field(text, "   etotal=", row.energy);
        text += '\n';
        if (row.group->system == none) continue;
        append_field(text, "              xlocal=", row.local_sum.x);
        append_field(text, "   ylocal=", row.local_sum.y);
        append_field(text, "  zlocal=", row.local_sum.z);
        text += '\n';
    }
    file_.write(text);
    file_.flush();
}

} // namespace plash

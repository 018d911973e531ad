#include "output/jntforc.h"

#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

namespace {

void append_line(std::string& text, std::string_view name, double value)
{
    fmt::format_to(std::back_inserter(text), " {:.<29}", name);
    append_scientific(text, value, 14, 5);
    text += '\n';
}

} // namespace

std::string format_jntforc(double time, std::span<const ElementResults::JointForce> joints)
{
    std::string text = "\n";
    append_line(text, "time", time);
    for (const auto& joint : joints) {
        fmt::format_to(std::back_inserter(text), " {:.<29}{:14}\n", "joint ID", joint.joint);
        append_line(text, "x-force", joint.force.x);
        append_line(text, "y-force", joint.force.y);
        append_line(text, "z-force", joint.force.z);
        append_line(text, "x-moment", joint.moment.x);
        append_line(text, "y-moment", joint.moment.y);
        append_line(text, "z-moment", joint.moment.z);
        append_line(text, "resultant force", norm(joint.force));
        append_line(text, "resultant moment", norm(joint.moment));
        append_line(text, "energy", joint.energy);
    }
    return text;
}

JntforcRecorder::JntforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    std::string entries;
    for (const Joint& joint : model.joints)
        if (!joint.title.empty()) entries += legend_entry(joint.id, joint.title, 80);
    file_.write(ascii_heading(model) + (entries.empty() ? "\n" : ascii_legend(entries)));
}

void JntforcRecorder::write_state(const Snapshot& snapshot)
{
    ElementResults results;
    results.rigid_motions_wanted = true;
    snapshot.collect(results);
    file_.write(format_jntforc(snapshot.clock.time, results.joints));
    file_.flush();
}

} // namespace plash

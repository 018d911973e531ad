#include "output/matsum.h"

#include "output/ascii_text.h"

#include <fmt/format.h>
#include <vector>

namespace plash {

namespace {

void append_entry(std::string& text, std::string_view name, double value)
{
    text += name;
    append_scientific(text, value, 13, 4);
}

void append_entry(std::string& text, std::string_view name, const Vec3& value)
{
    append_entry(text, fmt::format(" x-{}=", name), value.x);
    append_entry(text, fmt::format("     y-{}=", name), value.y);
    append_entry(text, fmt::format("     z-{}=", name), value.z);
    text += '\n';
}

} // namespace

std::string format_matsum(double time, std::span<const PartStatistics> parts)
{
    std::string text;
    append_entry(text, "\n\n time =", time);
    text += '\n';
    for (const PartStatistics& part : parts) {
        // Five columns and three blanks, or eight columns where the number needs them.
        text +=
            part.id < 100000 ? fmt::format(" mat.#={:5}   ", part.id) : fmt::format(" mat.#={:8}", part.id);
        append_entry(text, "          inten=", part.internal);
        append_entry(text, "     kinen=", part.kinetic);
        append_entry(text, "     eroded_ie=", part.eroded_internal);
        append_entry(text, "     eroded_ke=", part.eroded_kinetic);
        text += '\n';
        append_entry(text, "mom", part.momentum);
        append_entry(text, "rbv", part.rigid_body_velocity);
        append_entry(text, "                         hgeng=", part.hourglass);
        text += "\n\n\n";
    }
    return text;
}

MatsumRecorder::MatsumRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    std::string entries;
    for (const Part& part : model.parts) entries += legend_entry(part.id, part.title, 72);
    file_.write(ascii_heading(model) + ascii_legend(entries));
}

std::vector<PartStatistics> part_statistics(const Snapshot& snapshot)
{
    const std::size_t part_count = snapshot.model.parts.size();
    ElementResults results;
    results.part_motion.resize(part_count);
    snapshot.collect(results);

    std::vector<PartStatistics> parts(part_count);
    for (std::size_t i = 0; i < part_count; ++i) {
        const ElementResults::PartMotion& motion = results.part_motion[i];
        parts[i].id = snapshot.model.parts[i].id;
        parts[i].internal = snapshot.ledger.part_internal[i];
        parts[i].kinetic = motion.kinetic;
        parts[i].eroded_internal = motion.eroded_internal;
        parts[i].eroded_kinetic = motion.eroded_kinetic;
        parts[i].momentum = {motion.momentum[0], motion.momentum[1], motion.momentum[2]};
        if (motion.mass > 0) parts[i].rigid_body_velocity = (1 / motion.mass) * parts[i].momentum;
        parts[i].hourglass = snapshot.ledger.part_hourglass[i];
        parts[i].mass = motion.mass;
    }
    return parts;
}

void MatsumRecorder::write_state(const Snapshot& snapshot)
{
    file_.write(format_matsum(snapshot.clock.time, part_statistics(snapshot)));
    file_.flush();
}

} // namespace plash

#include "output/binout.h"

#include "output/ascii_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace plash {

void BinoutRecorder::add(std::string name, Schedule schedule, std::unique_ptr<BinoutSection> section,
                         const Model& model)
{
    file_->folder("/" + name + "/metadata");
    file_->put("title", std::string_view(fmt::format("{:<80.80}", model.title)));
    file_->put("version", std::string_view(fmt::format("{:<10}", "plash")));
    file_->put("revision", std::string_view(fmt::format("{:<10}", plash_version())));
    section->write_metadata(*file_);
    file_->commit();
    sections_.push_back({std::move(name), std::move(schedule), std::move(section)});
}

double BinoutRecorder::next_time() const
{
    double next = std::numeric_limits<double>::infinity();
    for (const Part& part : sections_) next = std::min(next, part.schedule.next());
    return next;
}

void BinoutRecorder::write(const Snapshot& snapshot)
{
    const Clock& clock = snapshot.clock;
    for (Part& part : sections_) {
        if (clock.time + clock.step <= part.schedule.next() || clock.cycle == part.last_cycle) continue;
        part.last_cycle = clock.cycle;
        const std::string folder = fmt::format("/{}/d{:06}", part.name, ++part.states);
        file_->folder(folder);
        if (!part.section->has_folders()) file_->put_number("time", clock.time);
        part.section->write_state(snapshot, *file_, folder);
        part.schedule.advance(clock);
    }
    file_->commit();
}

void BinoutRecorder::follow(const Clock& clock, const State& state)
{
    for (Part& part : sections_) part.section->follow(clock, state);
}

void BinoutRecorder::serialise(Archive& archive)
{
    archive(*file_);
    for (Part& part : sections_) archive(part);
}

} // namespace plash

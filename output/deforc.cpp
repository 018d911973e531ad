#include "output/deforc.h"

#include "output/ascii_text.h"

#include <fmt/format.h>

namespace plash {

std::vector<Index> shown_springs(const Model& model)
{
    const DiscreteElements& springs = model.discretes;
    std::vector<Index> shown;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        if (springs.silent.empty() || !springs.silent[i]) shown.push_back(static_cast<Index>(i));
    }
    return shown;
}

std::vector<ElementResults::SpringState> spring_states(const Snapshot& snapshot,
                                                       std::span<const Index> springs)
{
    ElementResults results;
    results.springs_wanted = true;
    snapshot.collect(results);
    std::vector<const ElementResults::SpringState*> by_element(snapshot.model.discretes.size());
    for (const auto& spring : results.springs) by_element[spring.element] = &spring;
    std::vector<ElementResults::SpringState> states;
    for (Index spring : springs) {
        const auto* state = by_element[spring];
        states.push_back(state ? *state : ElementResults::SpringState{spring});
    }
    return states;
}

std::string format_deforc(double time, const Model& model,
                          std::span<const ElementResults::SpringState> springs)
{
    std::string text = "\n";
    const auto line = [&](std::string_view name, double value) {
        fmt::format_to(std::back_inserter(text), " {:.<29}", name);
        append_scientific(text, value, 14, 5);
        text += '\n';
    };
    line("time", time);
    for (const auto& spring : springs) {
        fmt::format_to(std::back_inserter(text), " {:.<29}{:10}\n", "spring/damper number",
                       model.discretes.id[spring.element]);
        const std::string_view kind = spring.torsional ? "moment" : "force";
        line(fmt::format("x-{}", kind), spring.force.x);
        line(fmt::format("y-{}", kind), spring.force.y);
        line(fmt::format("z-{}", kind), spring.force.z);
        line(fmt::format("resultant {}", kind), spring.magnitude);
        line(spring.torsional ? "relative rotation" : "change in length", spring.deflection);
    }
    return text;
}

DeforcRecorder::DeforcRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), springs_(shown_springs(model)), file_(path)
{
    file_.write(ascii_heading(model) + "\n");
}

void DeforcRecorder::write_state(const Snapshot& snapshot)
{
    file_.write(format_deforc(snapshot.clock.time, snapshot.model, spring_states(snapshot, springs_)));
    file_.flush();
}

} // namespace plash

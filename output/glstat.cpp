#include "output/glstat.h"

#include "output/ascii_text.h"
#include "output/nodal_motion.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// a / b, and 1 where nothing has happened yet.
double ratio(double a, double b)
{
    return b != 0 ? a / b : 1;
}

} // namespace

GlobalStatistics global_statistics(const Snapshot& snapshot)
{
    const EnergyLedger& ledger = snapshot.ledger;
    GlobalStatistics result;
    result.cycle = snapshot.clock.cycle + 1;
    result.owner = snapshot.step_owner;
    result.time = snapshot.clock.time;
    result.step = snapshot.clock.step;
    result.kinetic = ledger.kinetic + ledger.eroded_kinetic;
    result.internal = ledger.internal + ledger.eroded_internal;
    result.hourglass = ledger.hourglass + ledger.eroded_hourglass;
    result.spring_and_damper = ledger.springs;
    result.damping = ledger.damping;
    result.sliding = ledger.sliding;
    result.external_work = ledger.external_work;
    result.eroded_kinetic = ledger.eroded_kinetic;
    result.eroded_internal = ledger.eroded_internal;
    result.eroded_hourglass = ledger.eroded_hourglass;
    result.advection_loss = ledger.advection_loss;
    result.total = ledger.total();
    const double expected = ledger.initial_total + ledger.external_work;
    const double eroded = ledger.eroded_kinetic + ledger.eroded_internal + ledger.eroded_hourglass;
    result.energy_ratio = ratio(result.total, expected);
    result.energy_ratio_without_eroded = ratio(result.total - eroded, expected);

    ElementResults sums;
    sums.part_motion.resize(snapshot.model.parts.size());
    snapshot.collect(sums);
    for (const auto& wall : sums.walls) result.stonewall.push_back(wall.energy);
    result.velocity = global_velocity(snapshot, NodalMotion(snapshot, false), sums);
    return result;
}

std::string format_glstat(const GlobalStatistics& state, bool with_hourglass)
{
    std::string text = fmt::format("\n\n dt of cycle{:8} is controlled by ", state.cycle);
    if (state.owner.kind.empty()) {
        text += "load curve\n\n";
    } else {
        fmt::format_to(std::back_inserter(text), "{:<10}{:>10} of part{:>10}\n\n", state.owner.kind,
                       state.owner.element, state.owner.part);
    }
    const auto line = [&](std::string_view name, double value) {
        fmt::format_to(std::back_inserter(text), " {}", name);
        append_scientific(text, value, 14, 5);
        text += '\n';
    };
    line("time...........................", state.time);
    line("time step......................", state.step);
    line("kinetic energy.................", state.kinetic);
    line("internal energy................", state.internal);
    for (std::size_t wall = 0; wall < state.stonewall.size(); ++wall) {
        line("stonewall energy...............", state.stonewall[wall]);
        text.pop_back();
        fmt::format_to(std::back_inserter(text), " wall#{:2}\n", wall + 1);
    }
    line("spring and damper energy.......", state.spring_and_damper);
    if (with_hourglass) line("hourglass energy ..............", state.hourglass);
    line("system damping energy..........", state.damping);
    line("sliding interface energy.......", state.sliding);
    line("external work..................", state.external_work);
    line("eroded kinetic energy..........", state.eroded_kinetic);
    line("eroded internal energy.........", state.eroded_internal);
    line("eroded hourglass energy........", state.eroded_hourglass);
    if (state.advection_loss != 0) line("advection loss.................", state.advection_loss);
    line("total energy...................", state.total);
    line("total energy / initial energy..", state.energy_ratio);
    line("energy ratio w/o eroded energy.", state.energy_ratio_without_eroded);
    line("global x velocity..............", state.velocity.x);
    line("global y velocity..............", state.velocity.y);
    line("global z velocity..............", state.velocity.z);
    // Zero here as in LS-DYNA's own files: the same deck writes the same bytes, and summary.json has the
    // times.
    fmt::format_to(std::back_inserter(text), " time per zone cycle.(nanosec)..{:14}\n", 0);
    return text;
}

GlstatRecorder::GlstatRecorder(const Model& model, Schedule schedule, const ResultPath& path)
    : ScheduledRecorder(std::move(schedule)), file_(path)
{
    file_.write(ascii_heading(model));
}

void GlstatRecorder::write_state(const Snapshot& snapshot)
{
    file_.write(format_glstat(global_statistics(snapshot)));
    file_.flush();
}

} // namespace plash

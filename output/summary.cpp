#include "output/summary.h"

#include "output/result_file.h"

#include <nlohmann/json.hpp>

namespace plash {

namespace {

std::string_view name_of(RunSummary::Termination termination)
{
    switch (termination) {
    case RunSummary::Termination::normal:
        return "normal";
    case RunSummary::Termination::error:
        return "error";
    case RunSummary::Termination::stopped:
        return "stopped";
    }
    return "";
}

} // namespace

std::string summary_json(const RunSummary& summary)
{
    using Json = nlohmann::ordered_json;
    const EnergyLedger& energy = summary.energy;
    Json terms = Json::array();
    for (const RunSummary::TermTime& term : summary.terms) {
        terms.push_back({{"name", term.name},
                         {"seconds", term.seconds},
                         {"items", term.items},
                         {"item_steps", term.item_steps}});
    }
    const Json json = {
        {"deck", summary.deck},
        {"version", summary.version},
        {"threads", summary.threads},
        {"termination", name_of(summary.termination)},
        {"message", summary.message},
        {"time", summary.time},
        {"end_time", summary.end_time},
        {"cycles", summary.cycles},
        {"wall_seconds", summary.wall_seconds},
        {"cpu_seconds", summary.cpu_seconds},
        {"peak_memory_bytes", summary.peak_memory_bytes},
        {"time_step_first", summary.time_step_first},
        {"time_step_last", summary.time_step_last},
        {"added_mass_ratio", summary.added_mass_ratio},
        {"energy",
         {{"kinetic", energy.kinetic},
          {"internal", energy.internal},
          {"hourglass", energy.hourglass},
          {"sliding", energy.sliding},
          {"rigidwall", energy.rigid_wall},
          {"damping", energy.damping},
          {"eroded", energy.eroded_kinetic + energy.eroded_internal + energy.eroded_hourglass},
          {"external_work", energy.external_work},
          {"total", energy.total()},
          {"balance_error_max", energy.balance_error()}}},
        {"terms", terms},
    };
    // Bytes that are no UTF-8 (paths, titles of old decks) become the replacement character.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const RunSummary& summary, const std::string& directory)
{
    replace_file(directory + "/summary.json", summary_json(summary));
}

} // namespace plash

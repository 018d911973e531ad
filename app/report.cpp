#include "app/commands.h"
#include "app/report_page.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

namespace plash {

namespace {

namespace fs = std::filesystem;

double number(const nlohmann::json& value)
{
    return value.is_number() ? value.get<double>() : 0.0;
}

/// The columns of those names that are there and not zero throughout.
ReportPlot plot_of(std::string title, std::string note, const History& history,
                   std::initializer_list<std::string_view> names)
{
    ReportPlot plot{std::move(title), std::move(note), history.time, {}};
    for (const History::Column& column : history.columns) {
        const bool wanted = std::any_of(names.begin(), names.end(), [&](std::string_view name) {
            return column.name.starts_with(name) && (column.name.find('/') == name.find('/'));
        });
        const bool silent =
            std::all_of(column.values.begin(), column.values.end(), [](double v) { return v == 0; });
        if (wanted && !silent) plot.curves.push_back(column);
    }
    return plot;
}

void add_plots(ReportPage& page, const History& history)
{
    const auto add = [&](ReportPlot plot) {
        if (!plot.curves.empty()) page.plots.push_back(std::move(plot));
    };
    add(plot_of("Energies",
                "What the deck's energy became; total should stay at its start plus the external work.",
                history,
                {"kinetic energy", "internal energy", "stonewall energy", "spring and damper energy",
                 "hourglass energy", "system damping energy", "sliding interface energy", "external work",
                 "total energy", "eroded"}));
    add(plot_of("Energy ratio", "Total energy over what it should be: 1 is a perfect balance.", history,
                {"total energy / initial energy"}));
    add(plot_of("Step", "The step that the loop took.", history, {"time step"}));
    add(plot_of("Mean velocity", "Momentum of the model over its mass.", history, {"global"}));
}

/// Forces of walls and contacts, where the deck asks for rwforc and rcforc.
void add_forces(ReportPage& page, const fs::path& run)
{
    const auto add = [&](const char* title, const char* note, History history) {
        std::erase_if(history.columns, [](const History::Column& column) {
            return std::all_of(column.values.begin(), column.values.end(), [](double v) { return v == 0; });
        });
        if (history.columns.empty()) return;
        page.plots.push_back({title, note, std::move(history.time), std::move(history.columns)});
    };
    if (fs::exists(run / "rwforc")) {
        add("Wall forces", "Normal force of the nodes on each rigid wall.",
            read_rwforc_history(bytes_of(run / "rwforc")));
    }
    if (fs::exists(run / "rcforc")) {
        add("Contact forces", "Size of the resultant on the slave side of each contact.",
            read_rcforc_history(bytes_of(run / "rcforc")));
    }
}

void add_facts(ReportPage& page, const nlohmann::json& summary)
{
    const auto fact = [&](const char* name, std::string value) {
        page.facts.emplace_back(name, std::move(value));
    };
    const auto& energy = summary.at("energy");
    fact("deck", summary.at("deck").get<std::string>());
    fact("end time",
         fmt::format("{:.6g} of {:.6g}", number(summary.at("time")), number(summary.at("end_time"))));
    fact("cycles", fmt::format("{}", summary.at("cycles").get<long>()));
    fact("first and last step", fmt::format("{:.4g}, {:.4g}", number(summary.at("time_step_first")),
                                            number(summary.at("time_step_last"))));
    fact("added mass", fmt::format("{:.3f} %", 100 * number(summary.at("added_mass_ratio"))));
    fact("energy balance error", fmt::format("{:.3f} %", 100 * number(energy.at("balance_error_max"))));
    fact("threads", fmt::format("{}", summary.at("threads").get<int>()));
    fact("wall clock and CPU", fmt::format("{:.2f} s, {:.2f} s", number(summary.at("wall_seconds")),
                                           number(summary.at("cpu_seconds"))));
    fact("largest memory", fmt::format("{:.1f} MB", number(summary.at("peak_memory_bytes")) / 1e6));
    fact("Plash", summary.at("version").get<std::string>());
}

void add_timings(ReportPage& page, const nlohmann::json& summary)
{
    page.timings.push_back({"term", "items", "seconds", "share", "microseconds per item and cycle"});
    const double wall = number(summary.at("wall_seconds"));
    for (const auto& term : summary.at("terms")) {
        const double seconds = number(term.at("seconds")), steps = number(term.at("item_steps"));
        page.timings.push_back(
            {term.at("name").get<std::string>(), fmt::format("{:.0f}", number(term.at("items"))),
             fmt::format("{:.3f}", seconds), fmt::format("{:.1f} %", wall > 0 ? 100 * seconds / wall : 0.0),
             steps > 0 ? fmt::format("{:.3f}", 1e6 * seconds / steps) : ""});
    }
}

int write_report(const std::string& directory, std::string output)
{
    const fs::path run(directory);
    if (!fs::exists(run / "summary.json")) {
        fmt::print(stderr, "{} holds no summary.json: it is not the result directory of a run\n", directory);
        return 1;
    }
    nlohmann::json summary;
    ReportPage page;
    try {
        summary = nlohmann::json::parse(bytes_of(run / "summary.json"));
        const std::string ending = summary.at("termination").get<std::string>();
        const double balance = number(summary.at("energy").at("balance_error_max"));
        page.title = fs::path(summary.at("deck").get<std::string>()).filename().string();
        page.trouble = ending != "normal" || balance > 0.02;
        page.verdict = fmt::format("{} termination{}; the energy balance is within {:.2f} %{}",
                                   ending == "normal" ? "Normal" : "Early",
                                   summary.at("message").get<std::string>().empty()
                                       ? ""
                                       : ": " + summary.at("message").get<std::string>(),
                                   100 * balance, balance > 0.02 ? ": do not trust this run." : ".");
        add_facts(page, summary);
        add_timings(page, summary);
    } catch (const nlohmann::json::exception& fault) {
        fmt::print(stderr, "{}: {}\n", (run / "summary.json").string(), fault.what());
        return 1;
    }
    if (fs::exists(run / "glstat")) add_plots(page, read_glstat_history(bytes_of(run / "glstat")));
    add_forces(page, run);
    if (fs::exists(run / "picture.png")) page.picture_png = bytes_of(run / "picture.png");
    if (output.empty()) output = (run / "report.html").string();
    std::ofstream(output, std::ios::binary) << to_html(page);
    fmt::print("{}\n", output);
    if (page.plots.empty()) {
        fmt::print(
            "without plots: the deck asks for no *DATABASE_GLSTAT, so the run has no energy history\n");
    }
    return 0;
}

} // namespace

void add_report(CLI::App& program, int& exit_code)
{
    auto directory = std::make_shared<std::string>();
    auto output = std::make_shared<std::string>();
    CLI::App* command =
        program.add_subcommand("report", "Write one HTML page about a run: energies, steps, pictures");
    command->add_option("directory", *directory, "Result directory of the run")->required();
    command->add_option("-o,--output", *output, "The page (default: DIRECTORY/report.html)");
    command->callback([=, &exit_code] { exit_code = write_report(*directory, *output); });
}

} // namespace plash

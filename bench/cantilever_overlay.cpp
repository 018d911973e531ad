#include "picture/plots.h"
#include "picture/virtual_display.h"
#include "tests/support/ascii_reader.h"
#include "tests/support/text_of.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <stdexcept>

/// Compares nodout and glstat of two runs of the cantilever (ours and LS-DYNA's): a picture of the histories
/// laid over each other and a table of the largest differences.
///
///     cantilever_overlay OUR_FOLDER THEIR_FOLDER PICTURE.png PAGE.md
namespace plash {

namespace {

constexpr Id tip = 5; ///< node whose history is compared

struct History {
    std::vector<double> time, value;

    /// Linear interpolation; the end values beyond the ends.
    double at(double t) const
    {
        const auto next = std::upper_bound(time.begin(), time.end(), t) - time.begin();
        if (next == 0) return value.front();
        if (next == static_cast<std::ptrdiff_t>(time.size())) return value.back();
        const double share = (t - time[next - 1]) / (time[next] - time[next - 1]);
        return value[next - 1] + share * (value[next] - value[next - 1]);
    }
};

struct Run {
    testing::NodoutFile nodout;
    testing::GlstatFile glstat;

    explicit Run(const std::string& folder)
        : nodout(testing::read_nodout(testing::text_of(folder + "/nodout"))),
          glstat(testing::read_glstat(testing::text_of(folder + "/glstat")))
    {}

    History of_node(const std::function<double(const NodeRow&)>& value) const
    {
        History history;
        for (const auto& table : nodout.tables) {
            for (const NodeRow& row : table.motion) {
                if (row.id != tip) continue;
                history.time.push_back(table.time);
                history.value.push_back(value(row));
            }
        }
        if (history.time.empty()) throw std::runtime_error(fmt::format("no node {} in nodout", tip));
        return history;
    }

    History of_model(const std::function<double(const GlobalStatistics&)>& value) const
    {
        History history;
        for (const GlobalStatistics& state : glstat.states) {
            history.time.push_back(state.time);
            history.value.push_back(value(state));
        }
        return history;
    }
};

struct Comparison {
    std::string name, unit;
    History ours, theirs;
};

std::vector<Comparison> compare(const Run& ours, const Run& theirs)
{
    std::vector<Comparison> all;
    const auto node = [&](const char* name, const char* unit,
                          const std::function<double(const NodeRow&)>& value) {
        all.push_back(
            {fmt::format("node {} {}", tip, name), unit, ours.of_node(value), theirs.of_node(value)});
    };
    const auto model = [&](const char* name, const std::function<double(const GlobalStatistics&)>& value) {
        all.push_back({name, "kN mm", ours.of_model(value), theirs.of_model(value)});
    };
    node("x displacement", "mm", [](const NodeRow& row) { return row.displacement.x; });
    node("z displacement", "mm", [](const NodeRow& row) { return row.displacement.z; });
    node("x velocity", "mm/ms", [](const NodeRow& row) { return row.velocity.x; });
    node("z velocity", "mm/ms", [](const NodeRow& row) { return row.velocity.z; });
    node("x acceleration", "mm/ms2", [](const NodeRow& row) { return row.acceleration.x; });
    node("z acceleration", "mm/ms2", [](const NodeRow& row) { return row.acceleration.z; });
    model("kinetic energy", [](const GlobalStatistics& s) { return s.kinetic; });
    model("internal energy", [](const GlobalStatistics& s) { return s.internal; });
    model("external work", [](const GlobalStatistics& s) { return s.external_work; });
    return all;
}

constexpr const char* page_head = R"(# The cantilever against LS-DYNA

A strip of 90 Belytschko-Tsay shells (MAT_024, three points), clamped at one end, under gravity and a tip load:
shell_cantilever_nip3 of the real decks, with the nodout and glstat of LS-DYNA R10.1 (single precision) beside it.
Made by

    ./plash run ../shared/decks/targets/shell_cantilever_nip3/01_Shell.dyn -o results/cantilever
    cmake --build --preset release --target cantilever_overlay
    build/release/cantilever_overlay results/cantilever ../shared/decks/targets/shell_cantilever_nip3 \
        docs/results/cantilever.png docs/results/cantilever.md

![Histories of node 5 and of the energies](cantilever.png)

)";

std::string table_of(const std::vector<Comparison>& all)
{
    const double times[] = {4.9986, 9.99864}; // of ../shared/decks/RESULTS.md
    std::string text =
        "| quantity | at | Plash | LS-DYNA | difference | largest difference over the run, of the peak |\n"
        "|---|---|---|---|---|---|\n";
    for (const Comparison& c : all) {
        double largest = 0, peak = 0;
        for (std::size_t i = 0; i < c.theirs.time.size(); ++i) {
            peak = std::max(peak, std::abs(c.theirs.value[i]));
            largest = std::max(largest, std::abs(c.ours.at(c.theirs.time[i]) - c.theirs.value[i]));
        }
        for (double time : times) {
            const double a = c.ours.at(time), b = c.theirs.at(time);
            text += fmt::format("| {} [{}] | {:g} ms | {:.6g} | {:.6g} | {:+.4f} % | {:.4f} % |\n", c.name,
                                c.unit, time, a, b, 100 * (a - b) / std::abs(b), 100 * largest / peak);
        }
    }
    return text;
}

} // namespace

} // namespace plash

int main(int argument_count, char** arguments)
{
    using namespace plash;
    if (argument_count != 5) {
        fmt::print(stderr, "usage: cantilever_overlay OUR_FOLDER THEIR_FOLDER PICTURE.png PAGE.md\n");
        return 2;
    }
    try {
        const std::vector<Comparison> all = compare(Run(arguments[1]), Run(arguments[2]));
        std::vector<Plot> plots;
        for (const Comparison& c : all) {
            plots.push_back({c.name,
                             "time [ms]",
                             "[" + c.unit + "]",
                             {{"LS-DYNA R10", c.theirs.time, c.theirs.value, {0.85, 0.35, 0.10}, true},
                              {"Plash", c.ours.time, c.ours.value}}});
            PlotLine& markers = plots.back().lines[0]; // every fourth, so that the line stays visible
            for (auto* values : {&markers.x, &markers.y}) {
                for (std::size_t i = 0; 4 * i < values->size(); ++i) (*values)[i] = (*values)[4 * i];
                values->resize((values->size() + 3) / 4);
            }
        }
        const VirtualDisplay display;
        draw_plots(plots, 3, 1800, arguments[3]);
        const std::string table = table_of(all);
        std::ofstream(arguments[4]) << page_head << table;
        fmt::print("{}", table);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "cantilever_overlay: {}\n", error.what());
        return 1;
    }
}

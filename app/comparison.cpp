#include "app/comparison.h"

#include "app/report_page.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace plash {

namespace {

std::string percent(double value)
{
    return std::isfinite(value) ? fmt::format("{:.2f}", 100 * value) : "-";
}

std::vector<std::string> headings()
{
    return {"run",   "peak",       "peak error %", "peak time diff.", "impulse error %",
            "rms %", "S&G mag %",  "phase",        "S&G compr. %",    "ISO 18571",
            "CPU s", "item-steps", "MB",           "energy balance %"};
}

std::vector<std::string> cells(const ComparedRun& run)
{
    const CurveErrors& e = run.errors;
    std::vector<std::string> row = {run.name + (run.is_reference ? " (reference)" : "") +
                                        (run.on_front ? " *" : ""),
                                    fmt::format("{:.5g}", run.peak.value)};
    if (run.is_reference) {
        row.insert(row.end(), 8, "");
    } else {
        row.insert(row.end(),
                   {percent(e.peak), fmt::format("{:.4g}", e.peak_time), percent(e.impulse), percent(e.rms),
                    percent(e.sprague_geers.magnitude), fmt::format("{:.4f}", e.sprague_geers.phase),
                    percent(e.sprague_geers.comprehensive),
                    fmt::format("{:.3f} {}", run.rating.overall, run.rating.grade())});
    }
    if (run.cost) {
        row.insert(row.end(),
                   {fmt::format("{:.2f}", run.cost->cpu_seconds), fmt::format("{:.3g}", run.cost->item_steps),
                    fmt::format("{:.0f}", run.cost->memory / 1e6), percent(run.cost->balance_error)});
    } else {
        row.insert(row.end(), 4, "");
    }
    return row;
}

std::vector<std::vector<std::string>> rows_of(const SignalComparison& comparison)
{
    std::vector<std::vector<std::string>> rows = {headings()};
    for (const ComparedRun& run : comparison.runs) rows.push_back(cells(run));
    return rows;
}

nlohmann::json json_number(double value)
{
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json json_of(const ComparedRun& run)
{
    const CurveErrors& e = run.errors;
    nlohmann::json json = {{"run", run.name},
                           {"reference", run.is_reference},
                           {"peak", json_number(run.peak.value)},
                           {"peak_time", json_number(run.peak.time)},
                           {"impulse", json_number(run.impulse)},
                           {"errors",
                            {{"peak", json_number(e.peak)},
                             {"peak_time", json_number(e.peak_time)},
                             {"impulse", json_number(e.impulse)},
                             {"rms", json_number(e.rms)},
                             {"sprague_geers",
                              {{"magnitude", json_number(e.sprague_geers.magnitude)},
                               {"phase", json_number(e.sprague_geers.phase)},
                               {"comprehensive", json_number(e.sprague_geers.comprehensive)}}}}},
                           {"iso_18571",
                            {{"corridor", run.rating.corridor},
                             {"phase", run.rating.phase},
                             {"magnitude", run.rating.magnitude},
                             {"slope", run.rating.slope},
                             {"overall", run.rating.overall},
                             {"grade", run.rating.grade()}}},
                           {"on_front", run.on_front}};
    if (run.cost) {
        json["cost"] = {{"cpu_seconds", json_number(run.cost->cpu_seconds)},
                        {"wall_seconds", json_number(run.cost->wall_seconds)},
                        {"item_steps", json_number(run.cost->item_steps)},
                        {"peak_memory_bytes", json_number(run.cost->memory)},
                        {"cycles", run.cost->cycles},
                        {"balance_error", json_number(run.cost->balance_error)},
                        {"termination", run.cost->termination}};
    }
    return json;
}

void append_line(std::string& text, const std::string& name, const TimeCurve& curve)
{
    text += "line\t" + name + "\n";
    for (std::size_t i = 0; i < curve.size(); ++i)
        fmt::format_to(std::back_inserter(text), "{:.9g}\t{:.9g}\n", curve.time[i], curve.value[i]);
}

} // namespace

double ranking_error(const ComparedRun& run, const std::string& kind)
{
    if (kind == "peak") return std::abs(run.errors.peak);
    if (kind == "impulse") return std::abs(run.errors.impulse);
    if (kind == "rms") return run.errors.rms;
    if (kind == "iso") return 1 - run.rating.overall;
    return run.errors.sprague_geers.comprehensive;
}

std::string comparison_text(const SignalComparison& comparison)
{
    const auto rows = rows_of(comparison);
    std::vector<std::size_t> width(rows.front().size());
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    std::string text = fmt::format("{} against {}\n", comparison.signal, comparison.reference);
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            text +=
                i == 0 ? fmt::format("{:<{}}", row[i], width[i]) : fmt::format("  {:>{}}", row[i], width[i]);
        }
        text += '\n';
    }
    return text;
}

std::string comparison_csv(const std::vector<SignalComparison>& comparisons)
{
    std::string text = "signal,reference," + fmt::format("{}\n", fmt::join(headings(), ","));
    for (const SignalComparison& comparison : comparisons) {
        for (const ComparedRun& run : comparison.runs)
            text += fmt::format("{},{},{}\n", comparison.signal, comparison.reference,
                                fmt::join(cells(run), ","));
    }
    return text;
}

std::string comparison_json(const std::vector<SignalComparison>& comparisons)
{
    nlohmann::json all = nlohmann::json::array();
    for (const SignalComparison& comparison : comparisons) {
        nlohmann::json runs = nlohmann::json::array();
        for (const ComparedRun& run : comparison.runs) runs.push_back(json_of(run));
        all.push_back(
            {{"signal", comparison.signal}, {"reference", comparison.reference}, {"runs", std::move(runs)}});
    }
    return all.dump(2) + "\n";
}

std::string comparison_html(const std::vector<SignalComparison>& comparisons, std::string png)
{
    ReportPage page;
    page.title = "Runs compared";
    page.verdict = "A star marks runs that no other beats in both error and CPU seconds.";
    page.picture_title = "All curves, and error against cost";
    page.picture_png = std::move(png);
    page.timings_title = "Errors and costs";
    for (const SignalComparison& comparison : comparisons) {
        Span span{comparison.reference_curve.time.front(), comparison.reference_curve.time.back()};
        for (const ComparedRun& run : comparison.runs) {
            span.from = std::min(span.from, run.curve.time.front());
            span.to = std::max(span.to, run.curve.time.back());
        }
        constexpr std::size_t points = 2001;
        ReportPlot plot{comparison.signal, "reference: " + comparison.reference, {}, {}};
        plot.time = resampled(comparison.reference_curve, span.from, span.to, points).time;
        const auto add = [&](const std::string& name, const TimeCurve& curve) {
            plot.curves.push_back({name, resampled(curve, span.from, span.to, points).value});
        };
        add("reference", comparison.reference_curve);
        for (const ComparedRun& run : comparison.runs) {
            if (!run.is_reference) add(run.name, run.curve);
        }
        page.plots.push_back(std::move(plot));
        auto rows = rows_of(comparison);
        if (comparisons.size() > 1) {
            for (std::size_t i = 1; i < rows.size(); ++i) rows[i][0] = comparison.signal + ": " + rows[i][0];
        }
        if (!page.timings.empty()) rows.erase(rows.begin());
        page.timings.insert(page.timings.end(), rows.begin(), rows.end());
    }
    return to_html(page);
}

std::string comparison_diagrams(const std::vector<SignalComparison>& comparisons, const std::string& ranking)
{
    std::string text;
    for (const SignalComparison& comparison : comparisons) {
        text += fmt::format("plot\t{0}\ttime\t{0}\n", comparison.signal);
        append_line(text, "reference", comparison.reference_curve);
        std::vector<const ComparedRun*> costed;
        for (const ComparedRun& run : comparison.runs) {
            if (run.is_reference) continue;
            append_line(text, run.name, run.curve);
            if (run.cost) costed.push_back(&run);
        }
        if (costed.empty()) continue;
        text += fmt::format("plot\terror against cost: {}\tCPU seconds\t{} error, %\n", comparison.signal,
                            ranking);
        for (const ComparedRun* run : costed)
            text += fmt::format("line\t{}\tmarkers\n{:.9g}\t{:.9g}\n", run->name, run->cost->cpu_seconds,
                                100 * ranking_error(*run, ranking));
        std::erase_if(costed, [](const ComparedRun* run) { return !run->on_front; });
        std::sort(costed.begin(), costed.end(), [](const ComparedRun* a, const ComparedRun* b) {
            return a->cost->cpu_seconds < b->cost->cpu_seconds;
        });
        if (costed.size() > 1) {
            text += "line\tfront\n";
            for (const ComparedRun* run : costed)
                text += fmt::format("{:.9g}\t{:.9g}\n", run->cost->cpu_seconds,
                                    100 * ranking_error(*run, ranking));
        }
    }
    return text;
}

} // namespace plash

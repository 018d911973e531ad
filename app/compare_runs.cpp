#include "app/compare_runs.h"

#include "app/picture.h"
#include "assess/signals.h"
#include "output/history_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace plash {

namespace {

namespace fs = std::filesystem;

std::string name_of(const std::string& directory)
{
    return fs::weakly_canonical(directory).filename().string();
}

/// The part of a curve between two times, with interpolated ends.
TimeCurve between(const TimeCurve& curve, double from, double to)
{
    TimeCurve part;
    const auto add = [&](double time, double value) {
        part.time.push_back(time);
        part.value.push_back(value);
    };
    if (from > curve.time.front() && from < curve.time.back()) add(from, value_at(curve, from));
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (curve.time[i] > from && curve.time[i] < to)
            add(curve.time[i], curve.value[i]);
        else if (curve.time[i] == from || curve.time[i] == to)
            add(curve.time[i], curve.value[i]);
    }
    if (to < curve.time.back() && to > curve.time.front() && (part.empty() || part.time.back() < to))
        add(to, value_at(curve, to));
    return part;
}

void scale(TimeCurve& curve, double time_factor, double value_factor)
{
    for (double& time : curve.time) time *= time_factor;
    for (double& value : curve.value) value *= value_factor;
}

/// "file.csv", "file.csv:column" or the directory of a run.
TimeCurve reference_curve(const std::string& reference, const std::string& signal)
{
    if (fs::is_directory(reference)) return run_signal(reference, signal);
    if (fs::is_regular_file(reference)) return csv_signal(reference, "");
    const auto colon = reference.rfind(':');
    if (colon == std::string::npos) throw SignalError(reference + " is neither a file nor a directory");
    return csv_signal(reference.substr(0, colon), reference.substr(colon + 1));
}

SignalComparison compare_signal(const CompareOptions& options, std::size_t which)
{
    const std::string& signal = options.signals[which];
    SignalComparison comparison;
    comparison.signal = signal;
    const auto window = [&](TimeCurve curve) { return between(curve, options.from, options.to); };
    if (options.references.empty()) {
        comparison.reference = name_of(options.directories.front());
    } else {
        comparison.reference = options.references[std::min(which, options.references.size() - 1)];
        TimeCurve curve = reference_curve(comparison.reference, signal);
        scale(curve, options.reference_scale[0], options.reference_scale[1]);
        comparison.reference_curve = window(std::move(curve));
    }
    for (const std::string& directory : options.directories) {
        ComparedRun run;
        run.name = name_of(directory);
        TimeCurve curve = run_signal(directory, signal);
        scale(curve, 1, options.factor);
        run.curve = window(std::move(curve));
        run.is_reference = options.references.empty() && comparison.runs.empty();
        if (run.is_reference) comparison.reference_curve = run.curve;
        if (run.curve.empty() || comparison.reference_curve.empty())
            throw SignalError(
                fmt::format("{} has no value of {} in the wanted span of time", directory, signal));
        const Span span = common_span(comparison.reference_curve, run.curve);
        if (!(span.to > span.from))
            throw SignalError(
                fmt::format("{} and the reference of {} have no time in common", directory, signal));
        run.peak = peak(run.curve);
        run.impulse = impulse(run.curve);
        run.errors = curve_errors(comparison.reference_curve, run.curve, options.samples);
        run.rating = iso_rating(comparison.reference_curve, run.curve, options.samples);
        run.cost = run_cost(directory);
        comparison.runs.push_back(std::move(run));
    }
    std::vector<double> errors, costs;
    for (const ComparedRun& run : comparison.runs) {
        errors.push_back(run.is_reference ? NAN : ranking_error(run, options.ranking));
        costs.push_back(run.cost ? run.cost->cpu_seconds : NAN);
    }
    const std::vector<bool> front = pareto_front(errors, costs);
    for (std::size_t i = 0; i < front.size(); ++i) comparison.runs[i].on_front = front[i];
    return comparison;
}

void write_file(const fs::path& path, const std::string& text)
{
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file) throw SignalError(path.string() + " cannot be written");
}

} // namespace

void add_compare_options(CLI::App& command, CompareOptions& options)
{
    command
        .add_option("-s,--signal", options.signals,
                    "What to compare, e.g. rcforc/1/slave_z, nodout/5/z-disp, glstat/kinetic_energy")
        ->required();
    command.add_option("-r,--reference", options.references,
                       "FILE.csv, FILE.csv:COLUMN or a directory, one for each signal or one for all "
                       "(default: the first directory)");
    command
        .add_option("--reference-scale", options.reference_scale,
                    "Factors for the reference's times and values")
        ->expected(2);
    command.add_option("--factor", options.factor, "Factor for the runs' values, 2 for half models");
    command.add_option("--from", options.from, "Compare from this time on");
    command.add_option("--to", options.to, "Compare up to this time");
    command.add_option("--error", options.ranking, "The error that ranks runs")
        ->check(CLI::IsMember({"comprehensive", "peak", "impulse", "rms", "iso"}))
        ->capture_default_str();
    command.add_option("--samples", options.samples, "Even samples that curves are compared at")
        ->check(CLI::Range(21, 20001))
        ->capture_default_str();
    command.add_option("-o,--output", options.output, "Folder for compare.csv, .json, .html and .png")
        ->capture_default_str();
    command.add_flag("--json", options.json, "Print JSON instead of tables");
    command.add_flag("!--no-picture", options.picture, "Do not draw compare.png");
}

std::vector<SignalComparison> compare_runs(const CompareOptions& options)
{
    std::vector<SignalComparison> comparisons;
    for (std::size_t i = 0; i < options.signals.size(); ++i)
        comparisons.push_back(compare_signal(options, i));
    return comparisons;
}

void write_comparison(const CompareOptions& options, const std::vector<SignalComparison>& comparisons)
{
    const fs::path folder(options.output);
    fs::create_directories(folder);
    if (options.json) {
        fmt::print("{}", comparison_json(comparisons));
    } else {
        for (const SignalComparison& comparison : comparisons)
            fmt::print("{}\n", comparison_text(comparison));
    }
    write_file(folder / "compare.csv", comparison_csv(comparisons));
    write_file(folder / "compare.json", comparison_json(comparisons));
    std::string png;
    if (options.picture) {
        write_file(folder / "diagrams.txt", comparison_diagrams(comparisons, options.ranking));
        std::fflush(stdout);
        if (draw_diagrams((folder / "diagrams.txt").string(), (folder / "compare.png").string()))
            png = bytes_of(folder / "compare.png");
    }
    write_file(folder / "compare.html", comparison_html(comparisons, std::move(png)));
    if (!options.json) fmt::print("{}\n", (folder / "compare.html").string());
}

} // namespace plash

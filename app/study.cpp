#include "app/commands.h"
#include "app/compare_runs.h"
#include "app/variants.h"
#include "assess/grid_convergence.h"
#include "assess/signals.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace plash {

namespace {

namespace fs = std::filesystem;

struct StudyOptions {
    CompareOptions compare;
    std::string deck, mesh;
    std::vector<std::string> vary;
    std::string fluids; ///< forms of the water, separated by commas; empty: as the deck says
    int threads = 0;
    bool again = false;
};

/// Name under which the form of the water is varied.
constexpr std::string_view fluid_setting = "fluid";
/// The form that the deck has.
constexpr std::string_view as_it_is = "deck";

/// Done already, with a deck that has not changed since.
bool is_done(const fs::path& directory, const std::string& deck)
{
    const auto cost = run_cost(directory.string());
    return cost && cost->termination == "normal" &&
           fs::last_write_time(directory / "summary.json") > fs::last_write_time(deck);
}

/// `plash run` in a process of its own, its screen in DIR/screen.txt; its exit code.
int run_variant(const StudyOptions& options, const Variant& variant, const fs::path& directory)
{
    std::vector<std::string> words = {"/proc/self/exe", "run", options.deck, "-o", directory.string()};
    if (options.threads > 0) words.insert(words.end(), {"-j", std::to_string(options.threads)});
    for (const auto& [name, value] : variant.settings) {
        if (!options.fluids.empty() && name == fluid_setting) {
            if (value != as_it_is) words.insert(words.end(), {"--fluid", value});
        } else {
            words.insert(words.end(), {"--set", name + "=" + value});
        }
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string screen = (directory / "screen.txt").string();
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, screen.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0644);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t child = 0;
    const std::string program = fs::read_symlink("/proc/self/exe").string();
    const int fault = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (fault != 0) return 2;
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 3;
}

std::string outcome_line(const fs::path& directory, int exit_code)
{
    const auto cost = run_cost(directory.string());
    if (exit_code == 1 || exit_code == 2 || !cost)
        return fmt::format("did not start; see {}", (directory / "screen.txt").string());
    return fmt::format("{} termination, {} cycles, {:.1f} s of CPU, energy balance {:.2f} %",
                       cost->termination, cost->cycles, cost->cpu_seconds, 100 * cost->balance_error);
}

/// Runs what is not done yet, a line each; the variants that ended normally.
std::vector<Variant> run_all(const StudyOptions& options, const std::vector<Variant>& variants)
{
    std::vector<Variant> done;
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const fs::path directory = fs::path(options.compare.output) / variants[i].name();
        fmt::print("[{}/{}] {}: ", i + 1, variants.size(), variants[i].name());
        std::fflush(stdout);
        if (!options.again && is_done(directory, options.deck)) {
            fmt::print("done before; {}\n", outcome_line(directory, 0));
            done.push_back(variants[i]);
            continue;
        }
        fs::create_directories(directory);
        fs::remove(directory / "summary.json");
        const int exit_code = run_variant(options, variants[i], directory);
        fmt::print("{}\n", outcome_line(directory, exit_code));
        if (exit_code == 0) done.push_back(variants[i]);
    }
    return done;
}

double size_of(const Variant& variant, const std::string& mesh)
{
    return std::strtod(variant.value(mesh).c_str(), nullptr);
}

/// The finest mesh first, so that it is the reference when no other is named.
void sort_by_mesh(std::vector<Variant>& variants, const std::string& mesh)
{
    std::stable_sort(variants.begin(), variants.end(),
                     [&](const Variant& a, const Variant& b) { return size_of(a, mesh) < size_of(b, mesh); });
}

std::string convergence_row(const std::string& what, const GridConvergence& c)
{
    return fmt::format(
        "    {:<14} order {:6.3f}{}  at size zero {:12.6g}  GCI fine {:7.3f} %  coarse {:7.3f} %\n", what,
        c.order, c.oscillating ? " (oscillating)" : "", c.extrapolated, 100 * c.index_fine,
        100 * c.index_coarse);
}

/// Observed order and grid convergence index of every three neighbouring meshes, for each signal and each set
/// of the other parameters.
std::string convergence_text(const StudyOptions& options, const std::vector<Variant>& variants,
                             const std::vector<SignalComparison>& comparisons)
{
    std::map<std::string, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < variants.size(); ++i)
        groups[variants[i].name_without(options.mesh)].push_back(i);
    std::string text = "Grid convergence (Celik et al. 2008)\n";
    for (const SignalComparison& comparison : comparisons) {
        for (const auto& [group, members] : groups) {
            for (std::size_t i = 0; i + 2 < members.size(); ++i) {
                double size[3], peaks[3], impulses[3];
                const TimeCurve* curves[3];
                for (int k = 0; k < 3; ++k) {
                    const ComparedRun& run = comparison.runs[members[i + k]];
                    size[k] = size_of(variants[members[i + k]], options.mesh);
                    peaks[k] = run.peak.value;
                    impulses[k] = run.impulse;
                    curves[k] = &run.curve;
                }
                text += fmt::format("  {}, {}, {} = {}, {}, {}\n", comparison.signal, group, options.mesh,
                                    size[0], size[1], size[2]);
                text += convergence_row("peak", grid_convergence(size, peaks));
                text += convergence_row("impulse", grid_convergence(size, impulses));
                const AveragedConvergence mean =
                    averaged_convergence(size, {curves[0], curves[1], curves[2]}, options.compare.samples);
                text += fmt::format(
                    "    {:<14} order {:6.3f}  over {} times  GCI fine {:7.3f} %  coarse {:7.3f} %\n",
                    "mean over time", mean.order, mean.points, 100 * mean.index_fine,
                    100 * mean.index_coarse);
            }
        }
    }
    return text;
}

int study(StudyOptions options)
{
    try {
        if (!options.fluids.empty())
            options.vary.insert(options.vary.begin(), std::string(fluid_setting) + "=" + options.fluids);
        if (options.vary.empty()) throw std::invalid_argument("nothing varies: give --vary or --fluid");
        std::vector<Variant> variants = variants_of(options.vary);
        if (!options.mesh.empty()) {
            for (const Variant& variant : variants) {
                if (!(size_of(variant, options.mesh) > 0))
                    throw std::invalid_argument("--mesh " + options.mesh +
                                                ": --vary must give it cell sizes above zero");
            }
            sort_by_mesh(variants, options.mesh);
        }
        if (options.compare.output.empty())
            options.compare.output =
                (fs::path("results") / ("study_" + fs::path(options.deck).stem().string())).string();
        const std::vector<Variant> done = run_all(options, variants);
        if (!options.compare.signals.empty() && !done.empty()) {
            for (const Variant& variant : done)
                options.compare.directories.push_back(
                    (fs::path(options.compare.output) / variant.name()).string());
            const std::vector<SignalComparison> comparisons = compare_runs(options.compare);
            write_comparison(options.compare, comparisons);
            if (!options.mesh.empty()) {
                const std::string text = convergence_text(options, done, comparisons);
                fmt::print("{}", text);
                std::ofstream(fs::path(options.compare.output) / "convergence.txt") << text;
            }
        }
        return done.size() == variants.size() ? 0 : 3;
    } catch (const std::invalid_argument& fault) {
        fmt::print(stderr, "plash study: {}\n", fault.what());
        return 2;
    } catch (const std::runtime_error& fault) { // SignalError, filesystem_error
        fmt::print(stderr, "plash study: {}\n", fault.what());
        return 1;
    }
}

} // namespace

void add_study(CLI::App& program, int& exit_code)
{
    auto options = std::make_shared<StudyOptions>();
    options->compare.output.clear();
    CLI::App* command = program.add_subcommand(
        "study",
        "Run a deck over values of its *PARAMETERs, and judge the runs; goes on where it was stopped");
    command->add_option("deck", options->deck, "The keyword deck")->required()->check(CLI::ExistingFile);
    command->add_option("--vary", options->vary,
                        "NAME=VALUE,VALUE,...: a *PARAMETER of the deck; several combine");
    command->add_option("--fluid", options->fluids,
                        "Forms of the water to run, as deck,ale,sph,lagrange (deck: its own); combines with "
                        "--vary");
    command->add_option(
        "--mesh", options->mesh,
        "The varied parameter that is the cell size: observed order and grid convergence index");
    command->add_option("-j,--threads", options->threads, "Threads of each run")->check(CLI::PositiveNumber);
    command->add_flag("--again", options->again, "Run everything again");
    add_compare_options(*command, options->compare);
    command->get_option("--signal")->required(false);
    command->callback([options, &exit_code] { exit_code = study(*options); });
}

} // namespace plash

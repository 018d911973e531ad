#include "app/commands.h"
#include "app/picture.h"
#include "app/progress.h"
#include "app/run_log.h"
#include "contact/move_penetrating.h"
#include "core/run_error.h"
#include "output/recorders.h"
#include "output/summary.h"
#include "parser/nodal_displacements.h"
#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/fluids/translate.h"
#include "solver/hourglass_share.h"
#include "solver/restart.h"
#include "solver/scene.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <malloc.h>
#include <memory>
#include <omp.h>
#include <sys/resource.h>

namespace plash {

namespace {

struct RunArguments {
    std::string deck;
    std::string directory;
    std::vector<std::string> settings;
    int threads = 0;
    double until = std::numeric_limits<double>::infinity();
    std::string restart;         ///< restart file, or directory with some
    double restart_minutes = 15; ///< between restart files that the deck does not ask for
    std::string fluid;           ///< form of the water; empty: as the deck says
    std::string geometry;        ///< file of a prescribed geometry; empty: none
    bool allow_unsupported = false;
    bool picture = false;
    bool vtk = false;
};

std::atomic<bool> stop_requested = false;

void request_stop(int)
{
    stop_requested = true;
    std::signal(SIGINT, SIG_DFL); // a second one ends the program at once
}

/// Prints errors and warnings; false when the deck cannot run.
bool judge(const ReadResult& read, bool allow_unsupported, RunLog& log)
{
    for (const Message& warning : read.report.warnings) {
        log.say("warning: " + to_text(warning, read.model));
    }
    for (const Message& error : read.report.errors) log.warn(to_text(error, read.model));
    const std::vector<Message> unsupported = unsupported_keywords(read.report);
    for (const Message& message : unsupported) {
        log.warn((allow_unsupported ? "WARNING, runs without: " : "") + to_text(message, read.model));
    }
    if (!read.ok) {
        log.warn(fmt::format("the deck has {} error{}; nothing was run", read.report.errors.size(),
                             read.report.errors.size() == 1 ? "" : "s"));
        return false;
    }
    if (!unsupported.empty() && !allow_unsupported) {
        log.warn(
            "the deck asks for physics that Plash does not run; nothing was run (--allow-unsupported runs "
            "without it)");
        return false;
    }
    return true;
}

void print_ignored(const ReadResult& read, RunLog& log)
{
    for (const auto& [name, use] : read.report.keywords) {
        if (use.status == KeywordStatus::ignored) {
            log.say(fmt::format("ignored: {}: *{}: {}", read.model.place(use.first), name, use.reason));
        }
    }
    for (const IgnoredField& field : read.report.ignored) {
        log.say(fmt::format("ignored: {}: *{}, field {} = {}: {}", read.model.place(field.where),
                            field.keyword, field.field, field.value, field.reason));
    }
}

RunSummary::Termination termination_of(const Outcome& outcome)
{
    switch (outcome.termination) {
    case Outcome::Termination::normal:
        return RunSummary::Termination::normal;
    case Outcome::Termination::stopped:
        return RunSummary::Termination::stopped;
    case Outcome::Termination::error:
        break;
    }
    return RunSummary::Termination::error;
}

RunSummary summarise(const RunArguments& arguments, const Scene& scene, const Outcome& outcome)
{
    RunSummary summary;
    summary.deck = arguments.deck;
    summary.version = PLASH_VERSION;
    summary.threads = omp_get_max_threads();
    summary.termination = termination_of(outcome);
    summary.message = outcome.message;
    summary.time = outcome.clock.time;
    summary.end_time = outcome.end_time;
    summary.cycles = outcome.clock.cycle;
    summary.wall_seconds = outcome.wall_seconds;
    summary.cpu_seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    summary.peak_memory_bytes = 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
    summary.time_step_first = outcome.first_step;
    summary.time_step_last = outcome.last_step;
    summary.added_mass_ratio = scene.added_mass_ratio;
    summary.energy = scene.ledger;
    for (std::size_t i = 0; i < scene.terms.size(); ++i) {
        const std::uint64_t items = scene.terms[i]->items();
        summary.terms.push_back({std::string(scene.terms[i]->name()), outcome.term_seconds[i], items,
                                 items * static_cast<std::uint64_t>(outcome.clock.cycle + 1)});
    }
    return summary;
}

void print_end(const RunSummary& summary, RunLog& log)
{
    for (const auto& term : summary.terms) {
        if (term.item_steps == 0 || term.seconds < 0.01 * summary.wall_seconds) continue;
        log.say(fmt::format("  {:<40} {:8.2f} s  {:7.3f} microseconds per item and cycle", term.name,
                            term.seconds, 1e6 * term.seconds / static_cast<double>(term.item_steps)));
    }
    const double error = summary.energy.balance_error();
    log.say(
        fmt::format("{} termination at t = {:.6e} after {} cycles, {:.2f} s; energy balance error {:.3f} %{}",
                    summary.termination == RunSummary::Termination::normal ? "Normal" : "Early", summary.time,
                    summary.cycles, summary.wall_seconds, 100 * error,
                    error > 0.02 ? " - THE ENERGY BALANCE IS OFF: do not trust this run" : ""));
    if (!summary.message.empty()) log.warn(summary.message);
}

/// Writes d3hsp.
void summarise_model(const Scene& scene, const std::string& directory)
{
    MassSummary masses = scene.masses;
    ElementResults results;
    results.steps_wanted = true;
    results.part_motion.resize(scene.model.parts.size());
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    masses.parts = std::move(results.part_motion);
    write_d3hsp(directory, scene.model, masses, std::move(results.steps));
}

/// "1452 nodes, 100 shells, 2 parts": what there is of each kind.
std::string sizes_of(const Model& model)
{
    std::string text;
    const auto add = [&](std::size_t count, std::string_view kind) {
        if (count == 0) return;
        text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, kind, count == 1 ? "" : "s");
    };
    add(model.nodes.size(), "node");
    add(model.shells.size(), "shell");
    add(model.thick_shells.size(), "thick shell");
    add(model.solids.size(), "solid");
    add(model.beams.size(), "beam");
    add(model.discretes.size(), "discrete element");
    add(model.particles.size(), "particle");
    add(model.parts.size(), "part");
    return text;
}

/// As asked for, or where the restart file lies, or results/DECK.
std::string results_directory(const RunArguments& arguments, const std::filesystem::path& restart_from)
{
    if (!arguments.directory.empty()) return arguments.directory;
    if (!restart_from.empty())
        return restart_from.has_parent_path() ? restart_from.parent_path().string() : ".";
    return (std::filesystem::path("results") / std::filesystem::path(arguments.deck).stem()).string();
}

/// The allocator keeps what reading and setting up have let go: a tenth of the run's memory.
void give_back_free_memory()
{
    ::malloc_trim(0);
}

int run_deck(const RunArguments& arguments)
{
    RunLog log;
    if (arguments.threads > 0) omp_set_num_threads(arguments.threads);
    ReadOptions options;
    for (const std::string& setting : arguments.settings) {
        const auto sign = setting.find('=');
        options.parameters.emplace_back(setting.substr(0, sign), setting.substr(sign + 1));
    }
    ReadResult read = read_model(arguments.deck, options);
    if (!judge(read, arguments.allow_unsupported, log)) return 1;
    std::vector<NodeDisplacement> geometry = read_prescribed_geometry(arguments.geometry, read.model);
    give_back_free_memory();

    const Model& model = read.model;
    std::unique_ptr<Scene> scene;
    std::vector<MovedNode> moved;
    try {
        for (const std::string& line : translate_fluid(read.model, fluid_choice_of(model, arguments.fluid)))
            log.say(line);
        moved = move_penetrating_nodes(read.model);
        scene = std::make_unique<Scene>(make_scene(model));
    } catch (const DeckError& error) {
        log.warn(fmt::format("{}: {}", model.place(error.where), error.what()));
        return 1;
    }
    give_back_free_memory();
    list_unread_fields(model, read.report);
    print_ignored(read, log);

    const std::string restart_from = arguments.restart.empty() ? "" : find_restart_file(arguments.restart);
    const std::string directory = results_directory(arguments, restart_from);
    std::filesystem::create_directories(directory);
    log.open(directory, !restart_from.empty());
    log.say(fmt::format("Plash {}: {}, {} thread{}", PLASH_VERSION, arguments.deck, omp_get_max_threads(),
                        omp_get_max_threads() == 1 ? "" : "s"));
    log.say(fmt::format("  {}; results in {}", sizes_of(model), directory));
    for (const auto& [name, added] : scene->masses.added) {
        log.say(fmt::format("  mass scaling adds {:.4g} to {}", added, name));
    }
    if (scene->added_mass_ratio > 0) {
        log.say(fmt::format("  mass scaling adds {:.3f} % of the mass", 100 * scene->added_mass_ratio));
    }
    if (restart_from.empty()) summarise_model(*scene, directory);

    for (const std::string& line : describe(moved, model)) log.say(fmt::format("  {}", line));
    for (const auto& term : scene->terms) {
        for (const std::string& line : term->notices(scene->state)) log.say(fmt::format("  {}", line));
    }

    Recorders recorders =
        make_recorders(model, directory, {.vtk = arguments.vtk, .resume = !restart_from.empty()});
    give_back_free_memory();
    const double end_time = std::min(arguments.until, model.controls.time.end_time);
    recorders.push_back(std::make_unique<Progress>(end_time));
    std::signal(SIGINT, request_stop);
    if (!restart_from.empty()) log.say(fmt::format("  goes on from {}", restart_from));
    const std::size_t moved_nodes = geometry.size();
    const Outcome outcome = run(*scene, recorders,
                                {end_time,
                                 &stop_requested,
                                 {directory, arguments.restart_minutes},
                                 restart_from,
                                 std::move(geometry)});
    if (const RelaxationOutcome& relaxation = outcome.relaxation; relaxation.statics) {
        log.say(
            fmt::format("static start {}: largest acceleration {:.2e} of {:.4g}, {:.2e} before; {} sums of "
                        "forces",
                        relaxation.converged ? "found" : "not found", relaxation.last_acceleration,
                        relaxation.reference, relaxation.first_acceleration, relaxation.cycles));
        if (relaxation.fluid_acceleration > RelaxationOutcome::allowed_unrest)
            log.warn(fmt::format(
                "static start: Eulerian water is not at rest: it begins with {:.2e} of {:.4g} near "
                "({:g}, {:g}, {:g}); {:.0e} would count as rest",
                relaxation.fluid_acceleration, relaxation.reference, relaxation.fluid_place.x,
                relaxation.fluid_place.y, relaxation.fluid_place.z, RelaxationOutcome::allowed_unrest));
        else if (relaxation.fluid_acceleration > 0)
            log.say(fmt::format("  its Eulerian water: {:.2e}", relaxation.fluid_acceleration));
    } else if (relaxation.geometry) {
        log.say(fmt::format("{} nodes went to the prescribed geometry in {} cycles", moved_nodes,
                            relaxation.cycles));
    } else if (relaxation.ran) {
        log.say(
            fmt::format("dynamic relaxation {} after {} cycles at t = {:.6e}: kinetic energy {:.3e} of its "
                        "peak, {:.4e} thrown away; energy balance error {:.3f} %",
                        relaxation.converged ? "converged" : "was ended", relaxation.cycles, relaxation.time,
                        relaxation.ratio, relaxation.lost_kinetic, 100 * relaxation.balance_error));
    }
    const RunSummary summary = summarise(arguments, *scene, outcome);
    write_summary(summary, directory);
    print_end(summary, log);
    for (const std::string& line : hourglass_warnings(summary.energy, scene->model)) log.warn(line);
    std::fflush(stdout); // so that what the drawing program says comes behind it
    if (arguments.picture) draw_picture(directory);
    return outcome.termination == Outcome::Termination::normal ? 0 : 3;
}

} // namespace

void add_run(CLI::App& program, int& exit_code)
{
    auto arguments = std::make_shared<RunArguments>();
    CLI::App* command = program.add_subcommand("run", "Run a keyword deck to its termination time");
    command->add_option("deck", arguments->deck, "The keyword deck")->required();
    command->add_option("-o,--output", arguments->directory, "Where results go (default: results/DECK)");
    command
        ->add_option("-j,--threads", arguments->threads,
                     "Threads (default: all; results do not depend on it)")
        ->check(CLI::PositiveNumber);
    command->add_option("--set", arguments->settings, "NAME=VALUE: replaces a *PARAMETER of the deck")
        ->check([](const std::string& text) {
            return text.find('=') == std::string::npos ? "must be NAME=VALUE" : "";
        });
    command
        ->add_option("--fluid", arguments->fluid,
                     "Runs the deck's water as an Eulerian mesh (ale), particles (sph) or solids (lagrange)")
        ->check(CLI::IsMember({"ale", "sph", "lagrange"}));
    command->add_option("--geometry", arguments->geometry,
                        "Displacements of nodes with which the run begins (IDRFLG = 2; LS-DYNA's m=)");
    command->add_option("--until", arguments->until, "Stop at this time if the deck would run longer");
    command->add_option("--restart", arguments->restart,
                        "Go on from a restart file (d3dump01, runrsf), or from the last one in a directory");
    command
        ->add_option("--restart-every", arguments->restart_minutes,
                     "Minutes between restart files (runrsf) where the deck asks for none; 0: never")
        ->capture_default_str();
    command->add_flag("--allow-unsupported", arguments->allow_unsupported,
                      "Run without the keywords that Plash does not support, with a warning for each");
    command->add_flag("--vtk", arguments->vtk, "Also write result.pvd and vtk/ for ParaView");
    command->add_flag("--picture", arguments->picture, "Draw picture.png at the end");
    command->callback([arguments, &exit_code] {
        try {
            exit_code = run_deck(*arguments);
        } catch (const RunError& error) { // before the first cycle: a restart file or a directory is at fault
            fmt::print(stderr, "{}\n", error.what());
            exit_code = 1;
        }
    });
}

} // namespace plash

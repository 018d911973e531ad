#include "solver/restart.h"

#include "core/archive.h"
#include "core/run_error.h"

#include <filesystem>
#include <fmt/format.h>

namespace plash {

namespace {

namespace fs = std::filesystem;

/// Sizes by which a restart file belongs to a deck.
void check_sizes(Archive& archive, const Scene& scene, const Recorders& recorders)
{
    const Model& model = scene.model;
    const std::pair<const char*, std::size_t> sizes[] = {
        {"nodes", model.nodes.size()},      {"shells", model.shells.size()},
        {"solids", model.solids.size()},    {"thick shells", model.thick_shells.size()},
        {"parts", model.parts.size()},      {"terms", scene.terms.size()},
        {"result files", recorders.size()},
    };
    for (const auto& [what, size] : sizes) {
        std::uint64_t stored = size;
        archive(stored);
        if (stored != size) {
            archive.fail(fmt::format("it was written with {} {}, and now there are {}", stored, what, size));
        }
    }
}

void serialise_run(Archive& archive, const RunParts& run, int& last_dump)
{
    Scene& scene = run.scene;
    check_sizes(archive, scene, run.recorders);
    Outcome& outcome = run.outcome;
    archive(outcome.clock, run.step_control, run.terminations, scene.ledger, outcome.wall_seconds,
            outcome.term_seconds, last_dump);
    archive(scene.state);
    for (auto& term : scene.terms) {
        archive.section(term->name());
        term->serialise(archive);
    }
    archive.checkpoint();
    for (auto& recorder : run.recorders) {
        archive.section("result file");
        recorder->serialise(archive);
    }
    archive.close();
}

} // namespace

int load_run(const std::string& path, const RunParts& run)
{
    Archive archive(path, Archive::Mode::load);
    int last_dump = 0;
    serialise_run(archive, run, last_dump);
    return last_dump;
}

RestartFiles::RestartFiles(const RestartOptions& options, const RestartRequest& request, int last_dump)
    : options_(options), request_(request), last_dump_(last_dump)
{}

void RestartFiles::write(const std::string& name, const RunParts& run)
{
    if (!on()) return;
    const std::string path = options_.directory + "/" + name;
    Archive archive(path, Archive::Mode::save);
    serialise_run(archive, run, last_dump_);
    last_written_ = path;
    last_time_ = WallClock::now();
}

std::string RestartFiles::write_dump(const RunParts& run)
{
    if (!on()) return {};
    ++last_dump_;
    write(fmt::format("d3dump{:02}", last_dump_), run);
    return last_written_;
}

void RestartFiles::write_running(const RunParts& run)
{
    const int files = std::max(1, request_.running_files);
    write(files == 1 ? "runrsf" : fmt::format("runrsf{:02}", running_files_ % files + 1), run);
    ++running_files_;
}

void RestartFiles::write_due(const RunParts& run)
{
    if (options_.directory.empty()) return;
    const long cycle = run.outcome.clock.cycle;
    if (request_.dump_cycles > 0 && cycle % request_.dump_cycles == 0) write_dump(run);
    if (request_.running_cycles > 0) {
        if (cycle % request_.running_cycles == 0) write_running(run);
        return;
    }
    if (options_.minutes <= 0) return;
    const std::chrono::duration<double, std::ratio<60>> since = WallClock::now() - last_time_;
    if (since.count() >= options_.minutes) write_running(run);
}

std::string find_restart_file(const std::string& path)
{
    if (!fs::is_directory(path)) return path;
    std::string newest;
    fs::file_time_type time{};
    for (const auto& entry : fs::directory_iterator(path)) {
        const std::string name = entry.path().filename().string();
        const bool restart = name.starts_with("d3dump") || name.starts_with("runrsf");
        if (!restart || name.ends_with(".new")) continue;
        if (!newest.empty() && entry.last_write_time() <= time) continue;
        newest = entry.path().string();
        time = entry.last_write_time();
    }
    if (newest.empty()) throw RunError(fmt::format("there is no restart file (d3dump, runrsf) in {}", path));
    return newest;
}

} // namespace plash

// How fast a deck becomes a Model: read_bench DECK [REPEATS] prints one row of the table in
// docs/results/reading.md (nodes, solids, MB, seconds, MB/s, ns per node, times wc -l, peak memory in MB,
// times the mesh arrays).

#include "parser/read_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <sys/resource.h>

namespace plash {
namespace {

/// Processor time of this process and of the programs it has called: other work on the machine does not
/// count.
double processor_seconds()
{
    double seconds = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime})
            seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
    return seconds;
}

double seconds_of(const std::function<void()>& work)
{
    const double start = processor_seconds();
    work();
    return processor_seconds() - start;
}

/// What the arrays of the mesh take.
std::size_t model_bytes(const Model& model)
{
    std::size_t bytes = model.nodes.size() * (sizeof(Id) + sizeof(Vec3));
    for_each_topology(model, [&](const auto& elements) {
        bytes += elements.size() * (sizeof(Id) + sizeof(Index) + sizeof(elements.nodes[0]));
    });
    return bytes;
}

int run(const std::string& path, int repeats)
{
    const std::string count_lines = fmt::format("wc -l '{}' > /dev/null", path);
    double best = 1e30, best_count = 1e30;
    std::size_t bytes = 0, arrays = 0, nodes = 0, solids = 0;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        best_count = std::min(best_count, seconds_of([&] {
                                  if (std::system(count_lines.c_str()) != 0)
                                      fmt::print(stderr, "wc failed\n");
                              }));
        ReadResult result;
        best = std::min(best, seconds_of([&] { result = read_model(path); }));
        if (!result.ok) {
            fmt::print(stderr, "{}\n", to_text(result.report.errors.front(), result.model));
            return 1;
        }
        bytes = result.bytes;
        arrays = model_bytes(result.model);
        nodes = result.model.nodes.size();
        solids = result.model.solids.size();
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double peak = 1024.0 * static_cast<double>(usage.ru_maxrss);
    fmt::print("| {} | {} | {:.1f} | {:.3f} | {:.0f} | {:.0f} | {:.1f} | {:.0f} | {:.2f} |\n", nodes, solids,
               bytes / 1e6, best, bytes / 1e6 / best, 1e9 * best / static_cast<double>(nodes),
               best / best_count, peak / 1e6, peak / static_cast<double>(arrays));
    return 0;
}

} // namespace
} // namespace plash

int main(int argument_count, char** arguments)
{
    if (argument_count < 2) {
        fmt::print(stderr, "usage: read_bench DECK [REPEATS]\n");
        return 2;
    }
    return plash::run(arguments[1], argument_count > 2 ? std::atoi(arguments[2]) : 3);
}

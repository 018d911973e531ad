#include "app/commands.h"
#include "app/compare_runs.h"
#include "assess/signals.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace plash {

namespace {

int compare(const CompareOptions& options)
{
    try {
        write_comparison(options, compare_runs(options));
        return 0;
    } catch (const SignalError& fault) {
        fmt::print(stderr, "plash compare: {}\n", fault.what());
    } catch (const std::filesystem::filesystem_error& fault) {
        fmt::print(stderr, "plash compare: {}\n", fault.what());
    }
    return 1;
}

} // namespace

void add_compare(CLI::App& program, int& exit_code)
{
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand(
        "compare", "Judge runs by their curves: errors to a reference, costs, and error against cost");
    command->add_option("directories", options->directories, "Result directories, Plash's or LS-DYNA's")
        ->required()
        ->check(CLI::ExistingDirectory);
    add_compare_options(*command, *options);
    command->callback([options, &exit_code] { exit_code = compare(*options); });
}

} // namespace plash

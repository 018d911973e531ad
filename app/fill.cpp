#include "app/commands.h"

#include "core/run_error.h"
#include "sph/graded_fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>

namespace plash {
namespace {

struct FillOptions {
    std::string output;
    std::vector<double> box, fine_box;
    double density = 0;
    Id part = 1, first_node = 1;
    GradedFill fill;
};

Box box_of(const std::vector<double>& corners)
{
    return {{corners[0], corners[1], corners[2]}, {corners[3], corners[4], corners[5]}};
}

/// What is wrong with the numbers, if anything.
std::string complaint_about(const FillOptions& options)
{
    const GradedFill& fill = options.fill;
    const Vec3 edges = fill.box.high - fill.box.low;
    if (!(std::min({edges.x, edges.y, edges.z}) > 0))
        return "--box: the second corner must lie above the first";
    if (!(fill.fine > 0) || !(fill.coarse >= fill.fine))
        return "--coarse must be at least --fine, and that above 0";
    if (!(fill.growth > 0)) return "--growth must be above 0";
    if (!(options.density > 0)) return "--density must be above 0";
    return {};
}

void write_particles(const FillOptions& options, const GradedParticles& particles)
{
    std::ofstream file(options.output);
    file << fmt::format("$ {} particles, spacing {:g} to {:g}; written by plash fill\n*NODE\n",
                        particles.position.size(), options.fill.fine, options.fill.coarse);
    for (std::size_t i = 0; i < particles.position.size(); ++i) {
        const Vec3& p = particles.position[i];
        file << fmt::format("{},{:.9g},{:.9g},{:.9g}\n", options.first_node + static_cast<Id>(i), p.x, p.y,
                            p.z);
    }
    file << "*ELEMENT_SPH\n";
    for (std::size_t i = 0; i < particles.volume.size(); ++i) {
        file << fmt::format("{},{},{:.9g}\n", options.first_node + static_cast<Id>(i), options.part,
                            options.density * particles.volume[i]);
    }
    if (!file.flush()) throw RunError(fmt::format("cannot write {}", options.output));
}

/// Counts, and how evenly neighbours stand: quantiles of the eigenvalue ratios.
void print_distribution(const FillOptions& options, const GradedParticles& particles)
{
    std::vector<double> ratio = eigenvalue_ratios(options.fill, particles);
    std::sort(ratio.begin(), ratio.end());
    const auto [least, largest] = std::minmax_element(particles.volume.begin(), particles.volume.end());
    fmt::print("{}: {} particles, spacings {:.4g} to {:.4g}\n", options.output, ratio.size(),
               std::cbrt(*least), std::cbrt(*largest));
    fmt::print("largest over smallest eigenvalue of the neighbours' inertia tensor (1: as in a lattice)\n");
    for (int percent : {50, 75, 90, 95, 99, 100}) {
        const std::size_t place = std::min(ratio.size() - 1, ratio.size() * percent / 100);
        fmt::print("  {:3d} % of the particles below {:.3f}\n", percent, ratio[place]);
    }
}

int run_fill(FillOptions& options)
{
    options.fill.box = box_of(options.box);
    options.fill.fine_box = options.fine_box.empty() ? options.fill.box : box_of(options.fine_box);
    const std::string complaint = complaint_about(options);
    if (!complaint.empty()) {
        fmt::print(stderr, "plash fill: {}\n", complaint);
        return 2;
    }
    try {
        const GradedParticles particles = fill_graded(options.fill);
        write_particles(options, particles);
        print_distribution(options, particles);
    } catch (const RunError& error) {
        fmt::print(stderr, "plash fill: {}\n", error.what());
        return 1;
    }
    return 0;
}

} // namespace

void add_fill(CLI::App& program, int& exit_code)
{
    CLI::App* command = program.add_subcommand(
        "fill", "Fill a box with particles, fine in one place and coarse elsewhere, for *INCLUDE in a deck");
    auto options = std::make_shared<FillOptions>();
    command->add_option("output", options->output, "Keyword file to write: *NODE and *ELEMENT_SPH")
        ->required();
    command->add_option("--box", options->box, "Lower and upper corner: x y z x y z")
        ->expected(6)
        ->required();
    command->add_option("--fine-box", options->fine_box, "Where the particles are fine (default: everywhere)")
        ->expected(6);
    command->add_option("--fine", options->fill.fine, "Their spacing there")->required();
    command->add_option("--coarse", options->fill.coarse, "The largest spacing")->required();
    command->add_option("--growth", options->fill.growth, "Of the spacing by the distance from the fine box")
        ->capture_default_str();
    command->add_option("--density", options->density, "Of the water")->required();
    command->add_option("--part", options->part, "Its part")->capture_default_str();
    command->add_option("--first-node", options->first_node, "Number of the first particle")
        ->capture_default_str();
    command->add_option("--iterations", options->fill.iterations, "Of the tessellation")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->callback([options, &exit_code] { exit_code = run_fill(*options); });
}

} // namespace plash

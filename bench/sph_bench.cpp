// Speed of whole runs with particles: a 3D dam break in a tank of symmetry planes. The loop runs as in
// `plash run`, without output files.
// Usage: plash_sph_bench [particles] [threads] [cycles in a window] [h over spacing] [end of the fall, s]
//        [options]
//
// Options are letters: d density diffusion (delta 0.1), x XSPH (0.5), s shifting, t repulsion in tension, c
// the cubic spline in place of Wendland C2. Two windows are timed: from the lattice at rest, and when the
// water has run down the tank and up its far wall. Times are processor time of the process over the number of
// threads.

#include "conditions/body_loads.h"
#include "core/release.h"
#include "eos/murnaghan.h"
#include "tests/support/particle_setup.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <omp.h>
#include <string>
#include <sys/resource.h>

using namespace plash;

namespace {

double processor_seconds(int threads)
{
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)) / threads;
}

double wall_seconds()
{
    timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double peak_bytes()
{
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

struct Window {
    double seconds, wall;
    long cycles, searches;
    double neighbours;
};

/// Runs on from the state of the scene for some cycles, or up to a time.
Window timed(Scene& scene, Model& model, ParticleBody& body, int threads, long cycles, double end_time)
{
    model.controls.time.end_time = end_time;
    model.controls.time.end_cycle = cycles;
    const double start = processor_seconds(threads), start_wall = wall_seconds();
    const long searches = body.searches();
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    return {processor_seconds(threads) - start, wall_seconds() - start_wall, outcome.clock.cycle + 1,
            body.searches() - searches, body.mean_neighbours()};
}

void show(const char* name, const Window& window, std::size_t particles, int threads)
{
    const double steps = static_cast<double>(particles) * static_cast<double>(window.cycles);
    std::printf("%-10s %9zu %2d %7ld %7ld %8.1f %10.3f %10.3f %10.1f\n", name, particles, threads,
                window.cycles, window.searches, window.neighbours, 1e-6 * steps / window.seconds / threads,
                1e-6 * steps / window.wall, 1e-6 * steps * window.neighbours / window.seconds / threads);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
    const double wanted = argc > 1 ? std::atof(argv[1]) : 170000;
    const int threads = argc > 2 ? std::atoi(argv[2]) : 1;
    const long cycles = argc > 3 ? std::atol(argv[3]) : 50;
    const double ratio = argc > 4 ? std::atof(argv[4]) : 1.3;
    const double fall = argc > 5 ? std::atof(argv[5]) : 0;
    const std::string options = argc > 6 ? argv[6] : "";
    const auto has = [&](char letter) { return options.find(letter) != std::string::npos; };
    omp_set_num_threads(threads);

    // A column of 1.2 x 0.67 x 0.55 m (Kleefsman's) in a tank of 3.2 m.
    const double spacing = std::cbrt(1.2 * 0.67 * 0.55 / wanted);
    const int nx = std::lround(1.2 / spacing), ny = std::lround(0.67 / spacing),
              nz = std::lround(0.55 / spacing);
    const double density = 1000, gravity = 9.81, sound = 10 * std::sqrt(gravity * 0.55 * 2);
    const double bytes_before = peak_bytes();
    ParticleWorld world;
    Murnaghan water;
    water.stiffness = density * sound * sound / 7;
    water.bulk_modulus = 7 * water.stiffness;
    NullFluid fluid;
    fluid.density = density;
    world.options.kernel = has('c') ? Kernel::cubic_spline : Kernel::wendland_c2;
    world.options.density_diffusion = has('d') ? 0.1 : 0;
    world.options.velocity_blend = has('x') ? 0.5 : 0;
    world.options.shifting = has('s') ? 1 : 0;
    world.options.tensile_repulsion = has('t') ? 0.2 : 0;
    world.options.viscosity = {0, 0.1};
    world.options.mirrors = {{{0, 0, 0}, {1, 0, 0}, false, {}},
                             {{3.2, 0, 0}, {-1, 0, 0}, false, {}},
                             {{0, 0, 0}, {0, 1, 0}, false, {}},
                             {{0, ny * spacing, 0}, {0, -1, 0}, false, {}},
                             {{0, 0, 0}, {0, 0, 1}, false, {}}};
    auto positions = lattice({0, 0, 0}, nx, ny, nz, spacing);
    const std::size_t count = positions.size();
    world.add_part(std::make_shared<FluidLaw<Murnaghan>>(fluid, water), density, positions,
                   density * spacing * spacing * spacing, ratio * spacing);
    release(positions);
    world.open_state();
    world.model.controls.time.step_scale = 0.3;
    BodyLoad weight;
    weight.direction = {0, 0, 1};
    weight.scale = gravity;
    world.model.body_loads.push_back(weight);
    for (ParticlePart& part : world.parts) part.constants.viscosity = world.options.viscosity;
    auto term =
        std::make_unique<ParticleBody>(std::move(world.parts), world.options, world.model, world.state);
    world.body = term.get();
    Scene scene{world.model, std::move(world.state), {}, {}, 0, {}}; // nothing twice: memory is measured
    scene.terms.push_back(std::move(term));
    scene.terms.push_back(std::make_unique<BodyLoads>(scene.model, scene.state));

    std::printf("%s, h = %.2f spacings, continuity, Monaghan viscosity, options '%s', double precision\n",
                has('c') ? "cubic spline" : "Wendland C2", ratio, options.c_str());
    std::printf("%-10s %9s %2s %7s %7s %8s %10s %10s %10s\n", "window", "particles", "th", "cycles",
                "searches", "neighb.", "Mps/s/thr", "Mps/s wall", "Mpairs/thr");
    show("lattice", timed(scene, world.model, *world.body, threads, cycles, 1e9), count, threads);
    if (fall > 0) {
        timed(scene, world.model, *world.body, threads, 0, fall);
        show("developed", timed(scene, world.model, *world.body, threads, cycles, 1e9), count, threads);
    }
    double lists = 0;
    for (const NeighbourRun& run : world.body->runs()) {
        lists += static_cast<double>(run.counts.size() * 4 + run.inside.size() * 2 + run.outside.size() * 2 +
                                     run.halo.size() * 4);
    }
    std::printf("neighbour lists: %.0f bytes a particle, %.3f images a particle\n",
                lists / static_cast<double>(count),
                static_cast<double>(world.body->arrays().size()) / static_cast<double>(count) - 1);
    const double state_bytes = 32 + 80; // the Model's nodes and the nodal arrays that every scene has
    const double bytes = (peak_bytes() - bytes_before) / static_cast<double>(count);
    std::printf("memory at the peak: %.0f bytes a particle, of which %.0f are nodes\n", bytes, state_bytes);
}

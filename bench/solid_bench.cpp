// Microseconds per element-cycle of solid groups alone (no nodal integration): forces of a 3D block that
// deforms a little. Usage: plash_solid_bench [cells along an edge] [cycles]

#include "tests/support/solid_block.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace plash;
using plash::testing::record_of;
using plash::testing::SolidBlock;

namespace {

/// Processor time of the whole process over the number of threads [s]: other work on the machine counts less
/// than with a wall clock.
double now(int threads)
{
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)) / threads;
}

double microseconds_per_element(const Record& material, int hourglass_type, int cells, int cycles,
                                int threads)
{
    omp_set_num_threads(threads);
    SolidBlock block({cells, cells, cells}, {1, 1, 1}, material);
    block.distort(0.1 / cells);
    block.set_hourglass(hourglass_type);
    State state = block.state();
    for (std::size_t n = 0; n < state.size(); ++n) {
        const Vec3& x = state.position[n];
        state.velocity[n] = {30 * x.y - 40 * x.x, 20 * x.z * x.x - 10 * x.y, 15 * x.x - 60 * x.z};
    }
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1e-7;
    groups.front()->add_forces(clock, state);
    double best = 1e30;
    for (int repeat = 0; repeat < 5; ++repeat) {
        const double start = now(threads);
        for (int cycle = 0; cycle < cycles; ++cycle) groups.front()->add_forces(clock, state);
        const double spent = now(threads) - start;
        best = std::min(best, spent);
    }
    return best * 1e6 / cycles / static_cast<double>(block.model.solids.size());
}

} // namespace

int main(int argc, char** argv)
{
    const int cells = argc > 1 ? std::atoi(argv[1]) : 46;
    const int cycles = argc > 2 ? std::atoi(argv[2]) : 20;
    const Record elastic = record_of("MAT_ELASTIC", 1, {{"RO", 8930}, {"E", 117e9}, {"PR", 0.35}});
    const auto plastic = [](double beta) {
        return record_of(
            "MAT_PLASTIC_KINEMATIC", 1,
            {{"RO", 8930}, {"E", 117e9}, {"PR", 0.35}, {"SIGY", 4e8}, {"ETAN", 1e8}, {"BETA", beta}});
    };
    std::printf("%d elements, microseconds per element-cycle of add_forces\n", cells * cells * cells);
    std::printf("%-28s %4s %10s %10s\n", "law", "IHQ", "1 thread", "2 threads");
    for (int type = 1; type <= 6; ++type) {
        const auto show = [&](const char* name, const Record& material) {
            std::printf("%-28s %4d %10.4f %10.4f\n", name, type,
                        microseconds_per_element(material, type, cells, cycles, 1),
                        microseconds_per_element(material, type, cells, cycles, 2));
        };
        show("001 elastic", elastic);
        show("003 isotropic", plastic(1));
        show("003 kinematic", plastic(0));
    }
}

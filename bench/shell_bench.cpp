// Cost of the shell group alone: microseconds of CPU time per element-cycle on one thread, with the bytes
// that a cycle moves and the floating-point operations that it does, for a mesh in cache and one that is not.
//
//     plash_shell_bench [cycles of the large mesh, default 50]

#include "elements/shell_belytschko_tsay.h"
#include "elements/shell_fully_integrated.h"
#include "elements/shell_group.h"
#include "elements/shell_settings.h"
#include "materials/piecewise_linear_plasticity.h"
#include "tests/support/bare_state.h"

#include <cstdlib>
#include <fmt/format.h>
#include <random>
#include <time.h>

using namespace plash;

namespace {

/// n x n squares of 1 mm steel with a little waviness.
Model plate(int n)
{
    Model model;
    std::mt19937 random(1);
    const auto wave = [&] { return 0.1 * (random() / 4294967296.0 - 0.5); };
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            model.nodes.id.push_back(static_cast<Id>(model.nodes.size()) + 1);
            model.nodes.position.push_back({i + wave(), j + wave(), wave()});
        }
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) {
            const Index first = j * (n + 1) + i;
            model.shells.id.push_back(static_cast<Id>(model.shells.size()) + 1);
            model.shells.part.push_back(0);
            model.shells.nodes.push_back({first, first + 1, first + n + 2, first + n + 1});
        }
    Record section, material;
    section.keyword = "SECTION_SHELL";
    section.fields.push_back({"T1", 1.0, "", true, false, {}});
    material.keyword = "MAT_PIECEWISE_LINEAR_PLASTICITY";
    material.fields.push_back({"RO", 7.85e-9, "", true, false, {}});
    model.sections.push_back(section);
    model.materials.push_back(material);
    Part part;
    part.id = 1;
    part.section = part.material = 0;
    model.parts.push_back(part);
    return model;
}

PiecewiseLinearPlasticity steel()
{
    PiecewiseLinearPlasticity law;
    law.density = 7.85e-9;
    law.young_modulus = 2.1e5;
    law.poisson_ratio = 0.3;
    law.hardening = Hardening::curve({{0, 0.05, 0.2, 1}, {250, 320, 400, 500}});
    return law;
}

double cpu_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Best of a few repetitions of `cycles` cycles [microseconds per element-cycle].
/// speed  of the nodes' random motion [mm/s]: decides whether points yield
template <class Formulation>
double measure(int n, int points, int cycles, double speed)
{
    const Model model = plate(n);
    State state = bare_state(model);
    state.need_rotation();
    const PiecewiseLinearPlasticity law = steel();
    ShellSettings settings;
    settings.rule = gauss_rule(points);
    settings.shear_factor = 5.0 / 6;
    settings.density = law.density;
    settings.wave_speed = 5.4e6;
    settings.poisson_ratio = law.poisson_ratio;
    settings.stiffness = {law.young_modulus, law.shear_modulus(), 5.0 / 6, law.density * 5.4e6};
    ShellPart part{model, 0, {}};
    for (Index element = 0; element < n * n; ++element) part.elements.push_back(element);
    ShellGroup<Formulation, PiecewiseLinearPlasticity> group(part, state, settings, law);

    std::mt19937 random(2);
    const auto any_speed = [&] { return speed * (random() / 2147483648.0 - 1); };
    for (Vec3& v : state.velocity) v = {any_speed(), any_speed(), any_speed()};
    Clock clock;
    clock.last_step = 1e-7;
    double best = 1e300;
    for (int repetition = 0; repetition < 7; ++repetition) {
        const double start = cpu_seconds();
        for (int cycle = 0; cycle < cycles; ++cycle) {
            // Back and forth, so that strains stay where they are.
            for (Vec3& v : state.velocity) v = -v;
            group.add_forces(clock, state);
        }
        best = std::min(best, cpu_seconds() - start);
    }
    return 1e6 * best / (static_cast<double>(cycles) * n * n);
}

} // namespace

int main(int argc, char** argv)
{
    const int cycles = argc > 1 ? std::atoi(argv[1]) : 50;
    omp_set_num_threads(1);
    fmt::print("MAT_024, one thread, us of CPU per element-cycle\n");
    fmt::print("ELFORM  points  elastic, in cache  elastic, 102,400 elements  yielding, in cache\n");
    const auto row = [&]<class Formulation>(int number, int points, Formulation) {
        fmt::print("{:6d}  {:6d}  {:17.4f}  {:25.4f}  {:18.4f}\n", number, points,
                   measure<Formulation>(32, points, 20 * cycles, 10),
                   measure<Formulation>(320, points, cycles, 10),
                   measure<Formulation>(32, points, 4 * cycles, 3e4));
    };
    for (const int points : {3, 5}) row(2, points, BelytschkoTsay{});
    for (const int points : {3, 5}) row(16, points, FullyIntegratedShell{});
}

// How far element kernels are from what the machine allows: floating-point operations of one element-cycle,
// counted by running the kernels with a scalar that counts; bytes that a cycle has to move to and from memory
// where the mesh does not fit into caches; and the machine's own speed, measured here.
//
//     plash_roofline [--json]
//
// bench/speed.py puts the two together with the times of whole runs.

#include "elements/shell_belytschko_tsay.h"
#include "elements/shell_fully_integrated.h"
#include "elements/shell_settings.h"
#include "elements/solid_points.h"
#include "elements/solid_step.h"
#include "materials/piecewise_linear_plasticity.h"
#include "materials/plastic_kinematic.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <random>
#include <time.h>

namespace plash {

/// Operations so far: sums and products; quotients and roots.
struct Operations {
    long simple = 0, slow = 0;
};
Operations counted;

/// One double that counts what is done with it. Comparisons, choices and signs do not count.
struct Counted {
    double value; // no start of its own: bits of trivial types alone may be copied

    Counted() = default;
    Counted(double v) : value(v) {} // what is read from tables

    static Counted simple(double value)
    {
        ++counted.simple;
        return value;
    }
    static Counted slow(double value)
    {
        ++counted.slow;
        return value;
    }
    friend Counted operator+(Counted a, Counted b) { return simple(a.value + b.value); }
    friend Counted operator-(Counted a, Counted b) { return simple(a.value - b.value); }
    friend Counted operator*(Counted a, Counted b) { return simple(a.value * b.value); }
    friend Counted operator/(Counted a, Counted b) { return slow(a.value / b.value); }
    friend Counted operator+(double a, Counted b) { return Counted{a} + b; }
    friend Counted operator-(double a, Counted b) { return Counted{a} - b; }
    friend Counted operator*(double a, Counted b) { return Counted{a} * b; }
    friend Counted operator/(double a, Counted b) { return Counted{a} / b; }
    friend Counted operator+(Counted a, double b) { return a + Counted{b}; }
    friend Counted operator-(Counted a, double b) { return a - Counted{b}; }
    friend Counted operator*(Counted a, double b) { return a * Counted{b}; }
    friend Counted operator/(Counted a, double b) { return a / Counted{b}; }
    Counted operator-() const { return {-value}; }
    Counted& operator+=(Counted b) { return *this = *this + b; }
    Counted& operator-=(Counted b) { return *this = *this - b; }
    Counted& operator*=(Counted b) { return *this = *this * b; }
    Counted& operator*=(double b) { return *this = *this * b; }
    Counted& operator/=(Counted b) { return *this = *this / b; }
    friend auto operator<=>(Counted a, Counted b) { return a.value <=> b.value; }
    friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
    friend auto operator<=>(Counted a, double b) { return a.value <=> b; }
    friend bool operator==(Counted a, double b) { return a.value == b; }
};

inline Counted sqrt(Counted a)
{
    return Counted::slow(std::sqrt(a.value));
}
inline Counted abs(Counted a)
{
    return {std::fabs(a.value)};
}
inline Counted min(Counted a, Counted b)
{
    return a < b ? a : b;
}
inline Counted max(Counted a, Counted b)
{
    return a > b ? a : b;
}
inline double lane_of(Counted a, int)
{
    return a.value;
}
inline void set_lane(Counted& a, int, double value)
{
    a.value = value;
}
template <>
inline Counted broadcast<Counted>(double value)
{
    return {value};
}
inline Counted guess_inverse_cube_root(Counted a)
{
    return Counted::simple(guess_inverse_cube_root(a.value));
}

namespace {

constexpr double time_step = 1e-7;

/// What one element-cycle costs.
struct Cost {
    std::string name;
    Operations elastic, yielding;
    double bytes = 0;
};

/// Bytes of nodes a cycle by element. A patch reads place and velocity of its nodes and adds forces; the loop
/// then reads force, velocity, place, mass and writes the first three. Shells do so with rotations too.
/// entries, nodes  of patches and of the mesh, by element
double node_bytes(double entries, double nodes, bool rotations)
{
    const double vector = 24, number = 4, scalar = 8;
    const double kinds = rotations ? 2 : 1;
    const double patch = number + vector * (rotations ? 3 : 2) + kinds * 2 * vector;
    const double loop = kinds * (6 * vector + scalar) - (rotations ? 2 * vector : 0); // angles are not kept
    return entries * patch + nodes * loop;
}

template <class Lane>
using Corners = Vector3<Lane>[8];

/// A cube with every corner moved, and a motion that strains it by about `strain` in the step.
Operations solid_operations(SolidHourglass::Form form, double strain)
{
    PlasticKinematicParameters parameters;
    parameters.density = 8930;
    parameters.young_modulus = 1.17e11;
    parameters.poisson_ratio = 0.35;
    parameters.yield_stress = 4e8;
    parameters.plastic_modulus = 1e8;
    parameters.beta = 1;
    const RatePoint<PlasticKinematic<false>> point{{parameters}};
    SolidParameters solid;
    solid.density = parameters.density;
    solid.hourglass = {form, false, 0.05, 4.3e10, 0.35};
    using Point = RatePoint<PlasticKinematic<false>>;
    Counted history[point_history + Point::history_size]{}, constants[point_constants + 4]{};
    constants[inverse_volume_constant] = {1e9};
    constants[mass_constant] = {8930e-9};
    std::mt19937 random(1);
    const auto any = [&] { return random() / 2147483648.0 - 1; };
    Corners<Counted> place, velocity;
    for (int i = 0; i < 8; ++i) {
        const double sides[3] = {i == 1 || i == 2 || i == 5 || i == 6 ? 1.0 : 0.0,
                                 i == 2 || i == 3 || i == 6 || i == 7 ? 1.0 : 0.0, i > 3 ? 1.0 : 0.0};
        place[i] = {{1e-3 * (sides[0] + 0.1 * any())},
                    {1e-3 * (sides[1] + 0.1 * any())},
                    {1e-3 * (sides[2] + 0.1 * any())}};
        const double speed = 1e-3 * strain / time_step;
        velocity[i] = {{speed * any()}, {speed * any()}, {speed * any()}};
    }
    counted = {};
    const SolidModes<Counted> position = modes_of(place), rates = modes_of(velocity);
    const auto result =
        solid_step<SolidGradientRule::mean>(point, solid, position, rates, time_step, history, constants);
    for_corners(result.force, [](int, const Vector3<Counted>&) {});
    return counted;
}

/// A square with every corner moved, likewise.
template <class Formulation>
Operations shell_operations(int points, double strain)
{
    PiecewiseLinearPlasticity law;
    law.density = 7.85e-9;
    law.young_modulus = 2.1e5;
    law.poisson_ratio = 0.3;
    law.hardening = Hardening::curve({{0, 0.05, 0.2, 1}, {250, 320, 400, 500}});
    ShellSettings settings;
    settings.rule = gauss_rule(points);
    settings.shear_factor = 5.0 / 6;
    settings.density = law.density;
    settings.wave_speed = 5.4e6;
    settings.poisson_ratio = law.poisson_ratio;
    settings.stiffness = {law.young_modulus, law.shear_modulus(), 5.0 / 6, law.density * 5.4e6};
    settings.hourglass.kind = ShellHourglass::Kind::stiffness;
    const auto start = law.initial_history();
    const std::size_t size = shell_record::history + start.size();
    std::vector<Counted> record(shell_record::points + Formulation::plane_points * points * size);
    record[shell_record::thickness] = {1.0};
    record[shell_record::mass_factor] = {1.0};
    for (std::size_t at = shell_record::points; at < record.size(); at += size)
        for (std::size_t i = 0; i < start.size(); ++i) record[at + shell_record::history + i] = {start[i]};
    std::mt19937 random(1);
    const auto any = [&] { return random() / 2147483648.0 - 1; };
    Vector3<Counted> corner[3][4]; // places, velocities, angular velocities
    for (int i = 0; i < 4; ++i) {
        const double speed = strain / time_step;
        corner[0][i] = {{(i == 1 || i == 2) + 0.05 * any()}, {(i > 1) + 0.05 * any()}, {0.05 * any()}};
        corner[1][i] = {{speed * any()}, {speed * any()}, {speed * any()}};
        corner[2][i] = {{speed * any()}, {speed * any()}, {speed * any()}};
    }
    counted = {};
    CornerPattern<Counted> pattern[3];
    for (int kind = 0; kind < 3; ++kind)
        pattern[kind] = pattern_of(corner[kind][0], corner[kind][1], corner[kind][2], corner[kind][3]);
    Formulation::step(settings, law, pattern[0], pattern[1], pattern[2], time_step, record.data());
    return counted;
}

template <class Formulation>
Cost shell_cost(const char* name, int points)
{
    const double values =
        shell_record::points +
        Formulation::plane_points * points *
            (shell_record::history + static_cast<int>(PiecewiseLinearPlasticity::history_size));
    // Patches of 512 quadrilaterals have 1.09 nodes an element, a large mesh 1.
    return {name, shell_operations<Formulation>(points, 1e-6), shell_operations<Formulation>(points, 1e-2),
            16 * values + 4 * 2 + node_bytes(1.09, 1, true)};
}

Cost solid_cost(const char* name, SolidHourglass::Form form)
{
    constexpr int history = point_history + PlasticKinematic<false>::history_size;
    // Patches of 512 hexahedra have 1.42 nodes an element, the block of speed.py 1.07.
    return {name, solid_operations(form, 1e-6), solid_operations(form, 1e-2),
            16 * history + 8 * point_constants + 8 * 2 + node_bytes(1.42, 1.07, false)};
}

/// Processor time of this thread: other work on the machine counts less than with a wall clock [s].
double processor_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double best_seconds(int repetitions, Work&& work)
{
    double best = 1e300;
    for (int i = 0; i < repetitions; ++i) {
        const double start = processor_seconds();
        work();
        best = std::min(best, processor_seconds() - start);
    }
    return best;
}

/// Multiplications and additions of sixteen independent chains [1/s].
double peak_operations()
{
    constexpr int chains = 16;
    constexpr long steps = 5'000'000;
    Lanes sum[chains];
    for (int i = 0; i < chains; ++i) sum[i] = broadcast<Lanes>(1 + 0.01 * i);
    Lanes factor = broadcast<Lanes>(0.999999), more = broadcast<Lanes>(1e-6);
    asm volatile("" : "+v"(factor), "+v"(more));
    const double seconds = best_seconds(9, [&] {
        for (long step = 0; step < steps; ++step)
            for (Lanes& chain : sum) chain = chain * factor + more;
        for (Lanes& chain : sum) asm volatile("" : "+v"(chain));
    });
    return 2.0 * lane_count * chains * steps / seconds;
}

/// a = b + s c over arrays that no cache holds, counting three times eight bytes [bytes/s].
double memory_bandwidth()
{
    constexpr std::size_t size = std::size_t{1} << 24;
    std::vector<double> a(size, 1), b(size, 2), c(size, 3);
    const double seconds = best_seconds(9, [&] {
        for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + 0.5 * c[i];
        asm volatile("" : : "r"(a.data()) : "memory");
    });
    return 24.0 * size / seconds;
}

} // namespace
} // namespace plash

int main(int argc, char** argv)
{
    using namespace plash;
    const bool json = argc > 1 && std::strcmp(argv[1], "--json") == 0;
    const Cost costs[] = {
        shell_cost<BelytschkoTsay>("shell ELFORM 2, MAT_024, 3 points", 3),
        shell_cost<BelytschkoTsay>("shell ELFORM 2, MAT_024, 5 points", 5),
        shell_cost<FullyIntegratedShell>("shell ELFORM 16, MAT_024, 5 points", 5),
        solid_cost("hex ELFORM 1, MAT_003, hourglass 4", SolidHourglass::Form::stiffness),
        solid_cost("hex ELFORM 1, MAT_003, hourglass 6", SolidHourglass::Form::assumed_strain),
    };
    const double peak = peak_operations(), bandwidth = memory_bandwidth();
    if (json) {
        fmt::print("{{\"operations_per_second\": {:.4e}, \"bytes_per_second\": {:.4e}, \"kernels\": [\n",
                   peak, bandwidth);
        for (const Cost& cost : costs) {
            fmt::print("{}{{\"name\": \"{}\", \"elastic\": {}, \"elastic_slow\": {}, \"yielding\": {}, "
                       "\"yielding_slow\": {}, \"bytes\": {:.0f}}}",
                       &cost == costs ? "" : ",\n", cost.name, cost.elastic.simple, cost.elastic.slow,
                       cost.yielding.simple, cost.yielding.slow, cost.bytes);
        }
        fmt::print("\n]}}\n");
        return 0;
    }
    fmt::print("one core: {:.1f} G operations/s, {:.1f} GB/s\n", 1e-9 * peak, 1e-9 * bandwidth);
    fmt::print("{:38} {:>18} {:>18} {:>7}\n", "sums and products, quotients and roots", "elastic", "yielding",
               "bytes");
    for (const Cost& cost : costs) {
        fmt::print("{:38} {:>12} + {:>3} {:>12} + {:>3} {:>7.0f}\n", cost.name, cost.elastic.simple,
                   cost.elastic.slow, cost.yielding.simple, cost.yielding.slow, cost.bytes);
    }
}

// Pressure on a flat wedge that enters water at constant speed, on cells that are flatter than they are wide
// where the root of the spray runs; beside the similarity solution. Usage: plash_flat_wedge [cut] [cells=40]
// [flat=8] [low=0] [high=0.13] [growth=0.15] [shells=2] [sound=300]
//
// Lengths are in half-widths at which the wedge of 10 degrees cuts the undisturbed surface in the end.
// `cells` stand across it; in the band from `low` to `high` above the surface they are 1/`flat` as high as
// wide, and grow by the share `growth` from one to the next beyond it. `shells` stand across a cell. `cut`:
// cut cells in place of springs.

#include "tests/support/ale_deck.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <omp.h>

using namespace plash;
using plash::testing::EulerianRun;

namespace {

constexpr int structure = 20, first_node = 1000000;
constexpr double density = 1000, speed = 1, far = 36, deep = 32, above = 1, fine_width = 2;
// Dobrovol'skaya (1969), computed afresh: F / (rho V^3 t), and the largest pressure over rho V^2 / 2.
constexpr double exact_force = 213.001, exact_pressure = 77.703;
const double slope = std::tan(10 * std::numbers::pi / 180);

using Options = std::map<std::string, double>;

int growing_cells(double length, double first, double growth)
{
    return std::max(1, static_cast<int>(std::log(1 + growth * length / first) / std::log(1 + growth)));
}

std::string mesh(const Options& option)
{
    const double cell = 1 / option.at("cells"), height = cell / option.at("flat"),
                 growth = option.at("growth");
    const double low = option.at("low"), high = option.at("high");
    const int fine = std::lround(fine_width / cell), outer = growing_cells(far - fine_width, cell, 0.1);
    const int below = growing_cells(deep + low, height, growth), band = std::lround((high - low) / height),
              over = growing_cells(above - high, height, growth);
    const std::string points = "*ALE_STRUCTURED_MESH_CONTROL_POINTS\n";
    return "*ALE_STRUCTURED_MESH\n1,10,1,1\n1,2,3\n" + points +
           fmt::format("1\n1,0\n{},{},0.1\n{},{}\n", fine + 1, fine_width, fine + 1 + outer, far) + points +
           fmt::format("2\n1,0\n2,{}\n", cell) + points +
           fmt::format("3\n1,{},{}\n{},{},0\n{},{},{}\n{},{}\n", -deep, -growth, below + 1, low,
                       below + 1 + band, high, growth, below + 1 + band + over, above);
}

std::string wedge(const Options& option, bool by_cut_cells)
{
    constexpr double length = 2;
    int first = first_node;
    const double cell = 1 / option.at("cells");
    const std::string card =
        by_cut_cells ? "2,4,1,1\n\n*PLASH_ALE_FORMULATION\n0,1" : "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.5";
    return fmt::format(
               "*PART\nwedge\n{0},{0},{0}\n*SECTION_SHELL\n{0},2\n0.01,0.01,0.01,0.01\n"
               "*MAT_RIGID\n{0},7800,2e11,0.3\n1,4,7\n\n*CONSTRAINED_LAGRANGE_IN_SOLID\n{0},10,1,1,{1}\n"
               "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{0},3,0,2\n*DEFINE_CURVE\n2\n0,{2}\n10,{2}\n",
               structure, card, -speed) +
           plash::testing::shell_patch(structure, first, {0, 0, 0}, {0, cell, 0}, {length, 0, length * slope},
                                       1, std::lround(length / cell * option.at("shells")));
}

/// Means over time of the pressure in intervals of x / (V t), `per_cell` of them in a cell in the end.
class Profile {
public:
    Profile(double cell, int per_cell) : width_(cell / per_cell) {}

    void add(double place, double pressure, double step)
    {
        const auto interval = static_cast<std::size_t>(place / width_);
        if (interval >= pressure_.size()) {
            pressure_.resize(interval + 1);
            time_.resize(interval + 1);
        }
        pressure_[interval] += step * pressure;
        time_[interval] += step;
    }
    void show(const char* name) const
    {
        double largest = 0, place = 0;
        for (std::size_t n = 0; n < time_.size(); ++n) {
            if (time_[n] == 0 || pressure_[n] / time_[n] <= largest) continue;
            largest = pressure_[n] / time_[n];
            place = (static_cast<double>(n) + 0.5) * width_;
        }
        std::printf("largest pressure, intervals of %s: %.4f at %.3f\n", name,
                    largest / (0.5 * density * speed * speed) / exact_pressure, place);
    }

private:
    double width_;
    std::vector<double> pressure_, time_;
};

} // namespace

int main(int argc, char** argv)
{
    omp_set_num_threads(1);
    Options option{{"cells", 40},    {"flat", 8},   {"low", 0},    {"high", 0.13},
                   {"growth", 0.15}, {"shells", 2}, {"sound", 300}};
    bool by_cut_cells = false;
    for (int n = 1; n < argc; ++n) {
        const std::string word = argv[n];
        const auto equals = word.find('=');
        if (word == "cut") {
            by_cut_cells = true;
        } else if (equals != word.npos && option.contains(word.substr(0, equals))) {
            option[word.substr(0, equals)] = std::stod(word.substr(equals + 1));
        } else {
            std::fprintf(stderr, "what is '%s'?\n", argv[n]);
            return 1;
        }
    }
    const double cell = 1 / option["cells"], shell = cell / option["shells"], end = slope / speed;
    EulerianRun deck(mesh(option) + plash::testing::liquid_and_void(density, option["sound"]) +
                     plash::testing::liquid_in_box({0, -1, -deep}, {far, 1, 0}) +
                     wedge(option, by_cut_cells) + plash::testing::closed(end));
    const auto& coupling = deck.term<SurfaceCoupling>();
    const auto& ids = deck.model().nodes.id;
    const std::size_t apex = std::find(ids.begin(), ids.end(), first_node) - ids.begin();
    const std::size_t rows = std::lround(2 / shell);
    ElementResults results;
    results.coupling_force.resize(ids.size());
    Profile whole(cell, 1), halves(cell, 2), quarters(cell, 4);
    double times = 0, forces = 0; // least squares of a force that grows with time
    deck.run([&](const Clock& clock, const State& state) {
        if (clock.time < 0.5 * end) return;
        times += clock.step * clock.time * clock.time;
        forces += clock.step * clock.time * 2 * coupling.force().z / cell;
        if (clock.time < 0.75 * end) return;
        std::fill(results.coupling_force.begin(), results.coupling_force.end(), Vec3{});
        coupling.collect(state, results);
        for (std::size_t row = 1; row < rows; ++row) {
            const std::size_t node = apex + 2 * row;
            const double force = results.coupling_force[node].z + results.coupling_force[node + 1].z;
            const double place = static_cast<double>(row) * shell * end / clock.time;
            for (Profile* profile : {&whole, &halves, &quarters})
                profile->add(place, force / (shell * cell), clock.step);
        }
    });
    std::printf("force over the similarity solution's: %.4f\n", forces / times / density / exact_force);
    whole.show("a cell");
    halves.show("half a cell");
    quarters.show("a quarter of a cell");
}

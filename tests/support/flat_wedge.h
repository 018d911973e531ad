#pragma once

#include "tests/support/ale_deck.h"

#include <cmath>
#include <numbers>

/// A wedge of 10 degrees that enters water at constant speed, on cells that may be flatter than they are wide
/// where the root of the spray runs.
namespace plash::testing {

/// Lengths are in half-widths at which the wedge cuts the undisturbed surface in the end.
struct FlatWedge {
    double cells = 40;           ///< across that half-width
    double flat = 8;             ///< cells in the band are this much flatter than wide
    double low = 0, high = 0.13; ///< the band, above the undisturbed surface
    double growth = 0.15;        ///< of cells beyond it, from one to the next
    double shells = 2;           ///< across a cell
    double sound = 300;          ///< speed of sound over the wedge's
    bool by_cut_cells = false;   ///< in place of springs

    static constexpr double density = 1000, speed = 1, far = 36, deep = 32, above = 1, fine_width = 2;
    /// Dobrovol'skaya (1969), computed afresh: F / (rho V^3 t), and the largest pressure over rho V^2 / 2.
    static constexpr double exact_force = 213.001, exact_pressure = 77.703;
    static constexpr int structure = 20, first_node = 1000000;
    static double slope() { return std::tan(10 * std::numbers::pi / 180); }

    double cell() const { return 1 / cells; }

    std::string mesh() const
    {
        const double height = cell() / flat;
        const auto growing = [](double length, double first, double share) {
            return std::max(1, static_cast<int>(std::log(1 + share * length / first) / std::log(1 + share)));
        };
        const int fine = std::lround(fine_width * cells), outer = growing(far - fine_width, cell(), 0.1);
        const int below = growing(deep + low, height, growth), band = std::lround((high - low) / height),
                  over = growing(above - high, height, growth);
        const std::string points = "*ALE_STRUCTURED_MESH_CONTROL_POINTS\n";
        return "*ALE_STRUCTURED_MESH\n1,10,1,1\n1,2,3\n" + points +
               fmt::format("1\n1,0\n{},{},0.1\n{},{}\n", fine + 1, fine_width, fine + 1 + outer, far) +
               points + fmt::format("2\n1,0\n2,{}\n", cell()) + points +
               fmt::format("3\n1,{},{}\n{},{},0\n{},{},{}\n{},{}\n", -deep, -growth, below + 1, low,
                           below + 1 + band, high, growth, below + 1 + band + over, above);
    }

    std::string wedge() const
    {
        constexpr double length = 2;
        int first = first_node;
        const std::string card =
            by_cut_cells ? "2,4,1,1\n\n*PLASH_ALE_FORMULATION\n0,1" : "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.5";
        return fmt::format(
                   "*PART\nwedge\n{0},{0},{0}\n*SECTION_SHELL\n{0},2\n0.01,0.01,0.01,0.01\n"
                   "*MAT_RIGID\n{0},7800,2e11,0.3\n1,4,7\n\n*CONSTRAINED_LAGRANGE_IN_SOLID\n{0},10,1,1,{1}\n"
                   "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{0},3,0,2\n*DEFINE_CURVE\n2\n0,{2}\n10,{2}\n",
                   structure, card, -speed) +
               shell_patch(structure, first, {0, 0, 0}, {0, cell(), 0}, {length, 0, length * slope()}, 1,
                           std::lround(length * cells * shells));
    }
};

/// Means over time of the pressure in intervals of x / (V t), `per_cell` of them in a cell in the end.
class FlatWedgeProfile {
public:
    FlatWedgeProfile(double cell, int per_cell) : width_(cell / per_cell) {}

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
    /// The largest one beyond a place over that of the similarity solution, and where it is.
    std::pair<double, double> largest(double from = 0) const
    {
        double largest = 0, place = 0;
        for (std::size_t n = 0; n < time_.size(); ++n) {
            const double here = (static_cast<double>(n) + 0.5) * width_;
            if (here < from || time_[n] == 0 || pressure_[n] / time_[n] <= largest) continue;
            largest = pressure_[n] / time_[n];
            place = here;
        }
        return {largest / (0.5 * FlatWedge::density * FlatWedge::speed * FlatWedge::speed) /
                    FlatWedge::exact_pressure,
                place};
    }

private:
    double width_;
    std::vector<double> pressure_, time_;
};

struct FlatWedgeEntry {
    double force = 0; ///< its slope over the similarity solution's
    FlatWedgeProfile cells, halves, quarters;
};

inline FlatWedgeEntry enter_flat_wedge(const FlatWedge& wedge)
{
    const double cell = wedge.cell(), shell = cell / wedge.shells, end = wedge.slope() / wedge.speed;
    EulerianRun deck(wedge.mesh() + liquid_and_void(wedge.density, wedge.sound) +
                     liquid_in_box({0, -1, -wedge.deep}, {wedge.far, 1, 0}) + wedge.wedge() + closed(end));
    const auto& coupling = deck.term<SurfaceCoupling>();
    const auto& ids = deck.model().nodes.id;
    const std::size_t apex = std::find(ids.begin(), ids.end(), FlatWedge::first_node) - ids.begin();
    const std::size_t rows = std::lround(2 / shell);
    ElementResults results;
    results.coupling_force.resize(ids.size());
    FlatWedgeEntry entry{0, {cell, 1}, {cell, 2}, {cell, 4}};
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
            for (FlatWedgeProfile* profile : {&entry.cells, &entry.halves, &entry.quarters})
                profile->add(place, force / (shell * cell), clock.step);
        }
    });
    entry.force = forces / times / FlatWedge::density / FlatWedge::exact_force;
    return entry;
}

} // namespace plash::testing

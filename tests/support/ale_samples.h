#pragma once

#include "ale/box_fluid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <omp.h>

/// Small helpers of the tests of the Eulerian fluid.
namespace plash {

/// Number of threads for the life of the object. One thread for long tests of small boxes: threads that wait
/// for one another are slow on a busy machine.
struct Threads {
    explicit Threads(int count) : before(omp_get_max_threads()) { omp_set_num_threads(count); }
    ~Threads() { omp_set_num_threads(before); }
    int before;
};

inline FluidGroup ideal_gas(double ratio)
{
    LinearPolynomial law;
    law.c4 = law.c5 = ratio - 1;
    return {law, 1.0};
}

/// Pressure linear in density, and no lower limit of it.
inline FluidGroup linear_liquid(double density, double speed_of_sound)
{
    LinearPolynomial law;
    law.c1 = density * speed_of_sound * speed_of_sound;
    return {law, density};
}

/// Share of a cell in which `inside` holds, over a fine lattice of points.
inline double sampled_fraction(const BoxGrid& grid, int i, int j, int k, int points,
                               const std::function<bool(double, double, double)>& inside)
{
    int hits = 0;
    const auto at = [&](int axis, int cell, int point) {
        return grid.planes(axis)[cell] + grid.width(axis, cell) * (point + 0.5) / points;
    };
    for (int c = 0; c < points; ++c) {
        for (int b = 0; b < points; ++b) {
            for (int a = 0; a < points; ++a) hits += inside(at(0, i, a), at(1, j, b), at(2, k, c));
        }
    }
    return double(hits) / (points * points * points);
}

/// function(i, j, k) for every cell.
template <class Function>
void for_cells(const BoxGrid& grid, Function&& function)
{
    for (int k = 0; k < grid.cells(2); ++k) {
        for (int j = 0; j < grid.cells(1); ++j) {
            for (int i = 0; i < grid.cells(0); ++i) function(i, j, k);
        }
    }
}

/// Moves cells only, with nodal velocities that stay as they are: what is left of a step when pressure and
/// inertia are taken away. Returns the lowest and the highest fraction met on the way.
struct Extremes {
    double lowest = 0, highest = 1;
};

inline Extremes carry(BoxFluid& fluid, double step, int steps)
{
    static constexpr int orders[6][3] = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {0, 2, 1}, {2, 0, 1}, {1, 0, 2}};
    RemapScratch scratch(fluid.grid, static_cast<int>(fluid.groups.size()));
    Extremes extremes;
    fluid.contents.update(fluid.grid, fluid.fields);
    for (int count = 0; count < steps; ++count) {
        for (GroupFields& group : fluid.fields.groups)
            group.share = group.fraction; // all parts of a cell strain alike
        deform(fluid.grid, fluid.fields, fluid.contents, step);
        for (const int axis : orders[count % 6]) {
            find_outflow_shares(fluid.grid, fluid.fields, fluid.contents, axis);
            sweep_cells(fluid.grid, fluid.fields, fluid.contents, scratch, axis, fluid.order);
            fluid.contents.update(fluid.grid, fluid.fields);
        }
        if (fluid.fields.groups[0].fraction.empty()) continue;
        for_cells(fluid.grid, [&](int i, int j, int k) {
            double sum = 0;
            for (const GroupFields& group : fluid.fields.groups) {
                const double fraction = group.fraction[fluid.grid.at(i, j, k)];
                extremes.lowest = std::min(extremes.lowest, fraction);
                sum += fraction;
            }
            extremes.highest = std::max(extremes.highest, sum);
        });
    }
    return extremes;
}

/// Gives all nodes the velocity field.
inline void set_mean_velocity(BoxFluid& fluid,
                              const std::function<std::array<double, 3>(double, double, double)>& field)
{
    const BoxGrid& grid = fluid.grid;
    for (int k = 0; k <= grid.cells(2); ++k) {
        for (int j = 0; j <= grid.cells(1); ++j) {
            for (int i = 0; i <= grid.cells(0); ++i) {
                const auto v = field(grid.planes(0)[i], grid.planes(1)[j], grid.planes(2)[k]);
                for (int axis = 0; axis < 3; ++axis)
                    fluid.fields.mean_velocity[axis][grid.at(i, j, k)] = v[axis];
            }
        }
    }
}

} // namespace plash

#pragma once

#include "core/recorder.h"
#include "output/d3plot_family.h"
#include "output/d3plot_layout.h"

namespace plash {

class NodalMotion;

/// Rows that a recorder wants of each kind of element.
struct ElementRows {
    std::size_t solids = 0, thick_shells = 0, beams = 0, shells = 0, particles = 0;
};

/// Results in the words of d3plot and d3thdt.
class D3plotValues {
public:
    D3plotValues(const D3plotLayout& layout, D3plotFamily& family) : layout_(layout), family_(family) {}

    /// Asks the terms for what the layout shows of so many elements. Which element has which row is said in
    /// `results()` beforehand.
    void collect(const Snapshot&, const ElementRows&);

    ElementResults& results() { return results_; }

    /// Energies, velocity of the whole, sums over parts, walls.
    void put_globals(const Snapshot&, const NodalMotion&);
    void put_solid(Index row);
    void put_thick_shell(Index row);
    void put_beam(Index row);
    void put_shell(Index row);
    void put(const Vec3&);
    void put(const SymmetricTensor<double>&);

private:
    const D3plotLayout& layout_;
    D3plotFamily& family_;
    ElementResults results_; ///< kept between states for its memory

    void put_point(std::size_t place, const std::vector<SymmetricTensor<double>>& stress,
                   const std::vector<double>& strain, const std::vector<double>& history);
};

} // namespace plash

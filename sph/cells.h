#pragma once

#include "core/release.h"
#include "math/vector3.h"
#include "model/record.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plash {

/// Particles, and mirror and periodic copies of them, sorted into cubic cells: all particles first, then all
/// copies. Only cells that hold particles exist, so a splash that flies far costs
/// nothing; cells follow a Morton curve, so that particles that are close in space are mostly close in
/// memory; inside a cell, too. The order is a function of the positions alone: in the same sixty-fourth of a
/// cell particles keep the order in which they were given.
class ParticleCells {
public:
    /// side        edge of a cell [length]
    /// real_count  how many of the given positions, from the first one on, are those of particles; the rest
    ///             are copies
    void sort(std::span<const Vec3> position, double side, std::size_t real_count);
    void sort(std::span<const Vec3> position, double side) { sort(position, side, position.size()); }

    /// Sorted place -> given particle or copy. Copies stand behind all particles.
    const std::vector<Index>& order() const { return order_; }
    void release_order() { release(order_); } ///< when all are in their places
    double side() const { return side_; }     ///< of a cell [length]
    Index cell_count() const { return static_cast<Index>(key_.size()); }
    Index begin(Index cell) const { return first_[cell]; } ///< sorted places begin(cell) .. end(cell) - 1
    Index end(Index cell) const { return first_[cell + 1]; }
    /// Copies stand at the sorted places first_copy(cell) .. first_copy(cell + 1) - 1.
    Index first_copy(Index cell) const { return first_copy_[cell]; }
    /// The cell that holds the particle of a sorted place.
    Index cell_of_place(Index place) const;

    /// Occupied cells among a cell and its 26 neighbours, in rising order. Returns their number.
    int around(Index cell, std::array<Index, 27>& found) const;

private:
    double side_ = 0;
    std::vector<Index> order_;
    std::vector<std::uint64_t> key_; ///< by cell, rising
    std::vector<Index> first_, first_copy_;
    std::vector<Index> table_; ///< open addressing over key_; none = free
    int table_shift_ = 0;

    void list_cells(const std::vector<std::uint64_t>& sorted_keys,
                    const std::vector<std::uint64_t>& sorted_copies);
    void fill_table();
    Index find(std::uint64_t key) const;
};

/// Sorts values by key, stable, keeping `key` and `value` together: radix sort over the low `bits` of the key
/// with the same result for any number of threads.
void sort_by_key(std::vector<std::uint64_t>& key, std::vector<Index>& value, int bits);

} // namespace plash

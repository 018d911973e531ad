#include "sph/cells.h"

#include "core/parallel.h"
#include "core/release.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace plash {

namespace {

constexpr int bits_per_axis = 21;
constexpr std::uint64_t coordinate_limit = (1ULL << bits_per_axis) - 1;
/// Particles are sorted by pieces of a cell, a quarter of its edge wide.
constexpr int piece_bits = 2;

/// Bits of x at every third place.
std::uint64_t spread(std::uint64_t x)
{
    x = (x | x << 32) & 0x1f00000000ffffULL;
    x = (x | x << 16) & 0x1f0000ff0000ffULL;
    x = (x | x << 8) & 0x100f00f00f00f00fULL;
    x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
    return (x | x << 2) & 0x1249249249249249ULL;
}

/// Inverse of spread.
std::uint64_t gather_bits(std::uint64_t x)
{
    x &= 0x1249249249249249ULL;
    x = (x | x >> 2) & 0x10c30c30c30c30c3ULL;
    x = (x | x >> 4) & 0x100f00f00f00f00fULL;
    x = (x | x >> 8) & 0x1f0000ff0000ffULL;
    x = (x | x >> 16) & 0x1f00000000ffffULL;
    return (x | x >> 32) & coordinate_limit;
}

std::uint64_t morton(std::uint64_t x, std::uint64_t y, std::uint64_t z)
{
    return spread(x) | spread(y) << 1 | spread(z) << 2;
}

/// Cell coordinate of a distance from the lowest cell; what is no number or too far goes to the last cell.
std::uint64_t coordinate(double distance, double per_cell)
{
    const double cell = distance * per_cell;
    return cell < static_cast<double>(coordinate_limit) ? static_cast<std::uint64_t>(std::max(cell, 0.0))
                                                        : coordinate_limit;
}

struct Bounds {
    Vec3 lower{INFINITY, INFINITY, INFINITY}, upper{-INFINITY, -INFINITY, -INFINITY};

    void include(const Vec3& a, const Vec3& b)
    {
        lower = {std::min(lower.x, a.x), std::min(lower.y, a.y), std::min(lower.z, a.z)};
        upper = {std::max(upper.x, b.x), std::max(upper.y, b.y), std::max(upper.z, b.z)};
    }
};

Bounds bounds_of(std::span<const Vec3> position)
{
    std::vector<Bounds> partial((position.size() + chunk_length - 1) / chunk_length);
    for_chunks(position.size(), [&](std::size_t begin, std::size_t end) {
        Bounds& bounds = partial[begin / chunk_length];
        for (std::size_t i = begin; i < end; ++i) bounds.include(position[i], position[i]);
    });
    Bounds all;
    for (const Bounds& bounds : partial) all.include(bounds.lower, bounds.upper);
    return all;
}

} // namespace

void sort_by_key(std::vector<std::uint64_t>& key, std::vector<Index>& value, int bits)
{
    constexpr int digit_bits = 9;
    constexpr std::size_t digits = 1 << digit_bits;
    constexpr std::size_t piece_length = 32768;
    const std::size_t count = key.size();
    const auto pieces = static_cast<std::ptrdiff_t>((count + piece_length - 1) / piece_length);
    std::vector<std::uint64_t> other_key(count);
    std::vector<Index> other_value(count);
    std::vector<std::array<Index, digits>> place(pieces); // of each digit in each piece
    for (int shift = 0; shift < bits; shift += digit_bits) {
        const auto digit = [&](std::size_t i) { return (key[i] >> shift) & (digits - 1); };
#pragma omp parallel for schedule(static) if (pieces > 1)
        for (std::ptrdiff_t piece = 0; piece < pieces; ++piece) {
            place[piece].fill(0);
            const std::size_t end = std::min(count, (piece + 1) * piece_length);
            for (std::size_t i = piece * piece_length; i < end; ++i) ++place[piece][digit(i)];
        }
        Index next = 0;
        for (std::size_t d = 0; d < digits; ++d) {
            for (auto& counts : place) {
                const Index here = counts[d];
                counts[d] = next;
                next += here;
            }
        }
#pragma omp parallel for schedule(static) if (pieces > 1)
        for (std::ptrdiff_t piece = 0; piece < pieces; ++piece) {
            const std::size_t end = std::min(count, (piece + 1) * piece_length);
            for (std::size_t i = piece * piece_length; i < end; ++i) {
                const Index to = place[piece][digit(i)]++;
                other_key[to] = key[i];
                other_value[to] = value[i];
            }
        }
        key.swap(other_key);
        value.swap(other_value);
    }
}

void ParticleCells::sort(std::span<const Vec3> position, double side, std::size_t real_count)
{
    side_ = side;
    const Bounds bounds = bounds_of(position);
    const double per_piece = (1 << piece_bits) / side;
    const auto keys_of = [&](std::size_t first, std::size_t last) {
        std::vector<std::uint64_t> key(last - first);
        for_chunks(key.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                // One empty cell below the lowest coordinate, so that every cell has neighbours to ask for.
                const Vec3 distance = position[first + i] - bounds.lower;
                const auto piece = [&](double along) {
                    constexpr std::uint64_t cell = 1 << piece_bits;
                    return cell + coordinate(along, per_piece) % (coordinate_limit - cell + 1);
                };
                key[i] = morton(piece(distance.x), piece(distance.y), piece(distance.z));
            }
        });
        return key;
    };
    const Vec3 extent = bounds.upper - bounds.lower;
    const std::uint64_t widest =
        (1 << piece_bits) + 1 + coordinate(std::max({extent.x, extent.y, extent.z, 0.0}), per_piece);
    const int bits = 3 * std::bit_width(widest);

    std::vector<std::uint64_t> key = keys_of(0, real_count), copy_key = keys_of(real_count, position.size());
    release(order_);
    order_.reserve(position.size());
    order_.resize(real_count);
    std::iota(order_.begin(), order_.end(), 0);
    sort_by_key(key, order_, bits);
    if (!copy_key.empty()) {
        std::vector<Index> copies(copy_key.size());
        std::iota(copies.begin(), copies.end(), static_cast<Index>(real_count));
        sort_by_key(copy_key, copies, bits);
        order_.insert(order_.end(), copies.begin(), copies.end());
    }
    list_cells(key, copy_key);
    fill_table();
}

/// The cells of both sorted lists of keys, and where each of them begins in both.
void ParticleCells::list_cells(const std::vector<std::uint64_t>& sorted_keys,
                               const std::vector<std::uint64_t>& sorted_copies)
{
    key_.clear();
    first_.clear();
    first_copy_.clear();
    const auto cell_of = [](std::uint64_t key) { return key >> (3 * piece_bits); };
    std::size_t i = 0, copy = 0;
    const auto end_cell = [&] {
        first_.push_back(static_cast<Index>(i));
        first_copy_.push_back(static_cast<Index>(sorted_keys.size() + copy));
    };
    while (i < sorted_keys.size() || copy < sorted_copies.size()) {
        const bool of_copy =
            i == sorted_keys.size() || (copy < sorted_copies.size() && sorted_copies[copy] < sorted_keys[i]);
        const std::uint64_t key = cell_of(of_copy ? sorted_copies[copy] : sorted_keys[i]);
        key_.push_back(key);
        end_cell();
        while (i < sorted_keys.size() && cell_of(sorted_keys[i]) == key) ++i;
        while (copy < sorted_copies.size() && cell_of(sorted_copies[copy]) == key) ++copy;
    }
    end_cell();
}

void ParticleCells::fill_table()
{
    const std::size_t size = std::bit_ceil(2 * key_.size() + 2);
    table_shift_ = 64 - std::countr_zero(size);
    table_.assign(size, none);
    for (Index cell = 0; cell < cell_count(); ++cell) {
        std::size_t slot = (key_[cell] * 0x9e3779b97f4a7c15ULL) >> table_shift_;
        while (table_[slot] != none) slot = (slot + 1) & (size - 1);
        table_[slot] = cell;
    }
}

Index ParticleCells::find(std::uint64_t key) const
{
    std::size_t slot = (key * 0x9e3779b97f4a7c15ULL) >> table_shift_;
    while (table_[slot] != none && key_[table_[slot]] != key) slot = (slot + 1) & (table_.size() - 1);
    return table_[slot];
}

Index ParticleCells::cell_of_place(Index place) const
{
    return static_cast<Index>(std::upper_bound(first_.begin(), first_.end(), place) - first_.begin()) - 1;
}

int ParticleCells::around(Index cell, std::array<Index, 27>& found) const
{
    const std::uint64_t key = key_[cell];
    const std::uint64_t x = gather_bits(key), y = gather_bits(key >> 1), z = gather_bits(key >> 2);
    int count = 0;
    for (std::uint64_t k = z - 1; k <= z + 1; ++k) {
        for (std::uint64_t j = y - 1; j <= y + 1; ++j) {
            for (std::uint64_t i = x - 1; i <= x + 1; ++i) {
                const Index neighbour = find(morton(i, j, k));
                if (neighbour != none) found[count++] = neighbour;
            }
        }
    }
    std::sort(found.begin(), found.begin() + count);
    return count;
}

} // namespace plash

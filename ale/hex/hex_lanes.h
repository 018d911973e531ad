#pragma once

#include "ale/cell_flux.h"
#include "math/aligned.h"
#include "math/lanes.h"
#include "model/model.h"

#include <array>
#include <vector>

/// Lists of places in a mesh, laid out for batches of lane_count entries.
namespace plash {

/// Length of a list that batches may run through to their end.
inline std::size_t padded(std::size_t count)
{
    return (count + lane_count - 1) / lane_count * lane_count;
}

/// Places that a batch of entries names, and whether they follow one another in memory: meshes are mostly
/// numbered in rows, and a plain load is worth many gathered ones.
struct Places {
    const Index* entry;
    bool run;
};

inline LaneMask numbers(Places at)
{
    using Eight = Index __attribute__((vector_size(sizeof(Index) * lane_count)));
    Eight eight;
    std::memcpy(&eight, at.entry, sizeof eight);
    return __builtin_convertvector(eight, LaneMask);
}

inline Lanes gather(const double* table, Places at)
{
    return at.run ? load<Lanes>(table + at.entry[0]) : gather(table, numbers(at));
}

inline void scatter(double* table, Places at, Lanes value)
{
    if (at.run) return store(table + at.entry[0], value);
    for (int lane = 0; lane < lane_count; ++lane) table[at.entry[lane]] = value[lane];
}

/// The values below where the mask is set, else those above.
inline Lanes gather_either(const double* table, LaneMask mask, Places below, Places above)
{
    if (below.run && above.run) return mask ? gather(table, below) : gather(table, above);
    return gather(table, mask ? numbers(below) : numbers(above));
}

/// A list of places that batches may run through to its padded end.
struct PlaceList {
    std::vector<Index> place;
    std::vector<std::uint8_t> run; ///< by batch

    /// filler  what entries beyond the last one name
    void pad(Index filler)
    {
        place.resize(padded(place.size()), filler);
        run.assign(place.size() / lane_count, 1);
        for (std::size_t i = 0; i < place.size(); ++i)
            if (place[i] != place[i / lane_count * lane_count] + static_cast<Index>(i % lane_count))
                run[i / lane_count] = 0;
    }
    Places at(std::size_t entry) const { return {&place[entry], run[entry / lane_count] != 0}; }
};

/// A list of entries for each of several owners.
template <class T>
struct Grouped {
    std::vector<std::size_t> first; ///< of each owner; one more entry for the end
    std::vector<T> entries;

    const T* begin(std::size_t owner) const { return entries.data() + first[owner]; }
    const T* end(std::size_t owner) const { return entries.data() + first[owner + 1]; }
};

inline double sum_of(Lanes value)
{
    double sum = 0;
    for (int lane = 0; lane < lane_count; ++lane) sum += value[lane];
    return sum;
}

/// Stores the first `lanes` values of a batch.
inline void store_part(double* address, Lanes value, std::size_t lanes)
{
    if (lanes >= lane_count)
        store(address, value);
    else
        std::memcpy(address, &value, lanes * sizeof(double));
}

/// Lines of four places each; entries beyond the last are there for batches, and name place 0.
struct HexLines {
    std::array<PlaceList, 4> place;       ///< far below, below, above, far above
    std::array<AlignedDoubles, 4> weight; ///< as LineWeights orders them

    std::size_t size = 0;

    void add(const std::array<Index, 4>& places, const LineWeights<double>& weights)
    {
        const double list[4] = {weights.below_lower, weights.below_upper, weights.above_lower,
                                weights.above_upper};
        for (int n = 0; n < 4; ++n) {
            place[n].place.push_back(places[n]);
            weight[n].push_back(list[n]);
        }
        ++size;
    }
    void pad()
    {
        for (int n = 0; n < 4; ++n) {
            place[n].pad(0);
            weight[n].resize(padded(size), 0.5);
        }
    }
    std::array<Places, 4> places_of(std::size_t entry) const
    {
        return {place[0].at(entry), place[1].at(entry), place[2].at(entry), place[3].at(entry)};
    }
    LineWeights<Lanes> weights_of(std::size_t entry) const
    {
        return {load<Lanes>(&weight[0][entry]), load<Lanes>(&weight[1][entry]),
                load<Lanes>(&weight[2][entry]), load<Lanes>(&weight[3][entry])};
    }
};

/// The values of an array at the places of a batch of lines.
inline Line<Lanes> line_of(const double* values, const std::array<Places, 4>& at)
{
    return {gather(values, at[0]), gather(values, at[1]), gather(values, at[2]), gather(values, at[3])};
}

} // namespace plash

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

/// The places that a batch of entries names.
inline LaneMask places(const Index* entry)
{
    using Eight = Index __attribute__((vector_size(sizeof(Index) * lane_count)));
    Eight eight;
    std::memcpy(&eight, entry, sizeof eight);
    return __builtin_convertvector(eight, LaneMask);
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
    std::array<std::vector<Index>, 4> place; ///< far below, below, above, far above
    std::array<AlignedDoubles, 4> weight;    ///< as LineWeights orders them

    std::size_t size = 0;

    void add(const std::array<Index, 4>& places, const LineWeights<double>& weights)
    {
        const double list[4] = {weights.below_lower, weights.below_upper, weights.above_lower,
                                weights.above_upper};
        for (int n = 0; n < 4; ++n) {
            place[n].push_back(places[n]);
            weight[n].push_back(list[n]);
        }
        ++size;
    }
    void pad()
    {
        for (int n = 0; n < 4; ++n) {
            place[n].resize(padded(size), 0);
            weight[n].resize(padded(size), 0.5);
        }
    }
    std::array<LaneMask, 4> places_of(std::size_t entry) const
    {
        return {places(&place[0][entry]), places(&place[1][entry]), places(&place[2][entry]),
                places(&place[3][entry])};
    }
    LineWeights<Lanes> weights_of(std::size_t entry) const
    {
        return {load<Lanes>(&weight[0][entry]), load<Lanes>(&weight[1][entry]),
                load<Lanes>(&weight[2][entry]), load<Lanes>(&weight[3][entry])};
    }
};

/// The values of an array at the places of a batch of lines.
inline Line<Lanes> line_of(const double* values, const std::array<LaneMask, 4>& at)
{
    return {gather(values, at[0]), gather(values, at[1]), gather(values, at[2]), gather(values, at[3])};
}

} // namespace plash

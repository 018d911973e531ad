#pragma once

#include "core/archive.h"
#include "core/parallel.h"
#include "model/record.h"

#include <array>
#include <numeric>
#include <span>
#include <vector>

namespace plash {

/// Sorted places of particles, rising: some, or all from the first one on, which takes no memory.
class PlaceList {
public:
    void take_all(Index count)
    {
        some_.clear();
        all_ = count;
    }
    /// Only to a list that has not taken all.
    void add(Index place) { some_.push_back(place); }
    std::size_t size() const { return all_ > 0 ? static_cast<std::size_t>(all_) : some_.size(); }

    /// visit(places) for the entries begin .. end - 1, at most a chunk of them.
    template <class Visit>
    auto in_chunk(std::size_t begin, std::size_t end, Visit&& visit) const
    {
        if (all_ == 0) return visit(std::span<const Index>(some_).subspan(begin, end - begin));
        std::array<Index, chunk_length> places;
        std::iota(places.begin(), places.begin() + (end - begin), static_cast<Index>(begin));
        return visit(std::span<const Index>(places).first(end - begin));
    }
    template <class Visit>
    void for_each(Visit&& visit) const
    {
        for (Index place = 0; place < all_; ++place) visit(place);
        for (Index place : some_) visit(place);
    }
    void serialise(Archive& archive) { archive(all_, some_); }

private:
    Index all_ = 0;
    std::vector<Index> some_;
};

} // namespace plash

#pragma once

#include "model/record.h"

#include <limits>
#include <vector>

namespace plash {

/// From the numbers of a deck to positions in the Model's arrays. Numbers that lie close together (the usual
/// case) are a plain table; scattered ones are hashed.
class IdTable {
public:
    /// Enters ids[i] -> i; of equal numbers the first one counts. Returns the positions of the later ones.
    std::vector<Index> build(const std::vector<Id>& ids);

    /// Enters one more number; false when it is there already. `index` may be `none`: the number is known,
    /// but nothing stands behind it.
    bool add(Id id, Index index);

    /// Position of a number, or `none`.
    Index find(Id id) const
    {
        const auto offset = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_);
        if (offset < dense_.size()) return dense_[offset];
        if (slots_.empty()) return none;
        const Slot& slot = slots_[slot_of(id)];
        return slot.id == id ? slot.index : none;
    }

    /// The number is there, be it without a position.
    bool contains(Id id) const
    {
        return find(id) != none || (!slots_.empty() && slots_[slot_of(id)].id == id);
    }

private:
    struct Slot {
        Id id = free_slot;
        Index index = none;
    };
    static constexpr Id free_slot = std::numeric_limits<Id>::min(); ///< below every number of a deck

    /// Where a number stands, or the free slot where it would go; at most half of the slots are taken.
    std::size_t slot_of(Id id) const
    {
        // The last step of SplitMix64 (Steele, Lea & Flood 2014): neighbours part ways.
        auto hash = static_cast<std::uint64_t>(id);
        hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
        hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
        std::size_t slot = (hash ^ (hash >> 31)) & (slots_.size() - 1);
        while (slots_[slot].id != id && slots_[slot].id != free_slot) slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    void make_room(std::size_t numbers);

    Id first_ = 0;
    std::vector<Index> dense_;
    std::vector<Slot> slots_; ///< as many as a power of two
    std::size_t taken_ = 0;
};

} // namespace plash

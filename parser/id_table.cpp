#include "parser/id_table.h"

#include "parser/large_pages.h"

#include <algorithm>
#include <bit>

namespace plash {

std::vector<Index> IdTable::build(const std::vector<Id>& ids)
{
    dense_.clear();
    slots_.clear();
    taken_ = 0;
    std::vector<Index> repeated;
    if (ids.empty()) return repeated;
    const auto [lowest, highest] = std::minmax_element(ids.begin(), ids.end());
    const auto span = static_cast<std::uint64_t>(*highest) - static_cast<std::uint64_t>(*lowest);
    if (span < 4 * ids.size() + 1024) {
        first_ = *lowest;
        dense_.reserve(span + 1);
        use_large_pages(dense_);
        dense_.assign(span + 1, none);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            Index& entry = dense_[ids[i] - first_];
            if (entry == none)
                entry = static_cast<Index>(i);
            else
                repeated.push_back(static_cast<Index>(i));
        }
    } else {
        make_room(ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i)
            if (!add(ids[i], static_cast<Index>(i))) repeated.push_back(static_cast<Index>(i));
    }
    return repeated;
}

bool IdTable::add(Id id, Index index)
{
    const auto offset = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(first_);
    if (offset < dense_.size()) {
        if (dense_[offset] != none) return false;
        dense_[offset] = index;
        return true;
    }
    make_room(taken_ + 1);
    Slot& slot = slots_[slot_of(id)];
    if (slot.id == id) return false;
    slot = {id, index};
    ++taken_;
    return true;
}

void IdTable::make_room(std::size_t numbers)
{
    if (2 * numbers <= slots_.size()) return;
    std::vector<Slot> before = std::move(slots_);
    slots_ = {};
    const std::size_t size = std::bit_ceil(std::max<std::size_t>(4 * numbers, 16));
    slots_.reserve(size);
    use_large_pages(slots_);
    slots_.resize(size);
    for (const Slot& slot : before)
        if (slot.id != free_slot) slots_[slot_of(slot.id)] = slot;
}

} // namespace plash

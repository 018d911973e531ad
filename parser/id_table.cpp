#include "parser/id_table.h"

#include <algorithm>

namespace plash {

std::vector<Index> IdTable::build(const std::vector<Id>& ids)
{
    dense_.clear();
    sparse_.clear();
    std::vector<Index> repeated;
    if (ids.empty()) return repeated;
    const auto [lowest, highest] = std::minmax_element(ids.begin(), ids.end());
    const auto span = static_cast<std::uint64_t>(*highest) - static_cast<std::uint64_t>(*lowest);
    if (span < 4 * ids.size() + 1024) {
        first_ = *lowest;
        dense_.assign(span + 1, none);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            Index& entry = dense_[ids[i] - first_];
            if (entry == none)
                entry = static_cast<Index>(i);
            else
                repeated.push_back(static_cast<Index>(i));
        }
    } else {
        sparse_.reserve(ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i)
            if (!sparse_.emplace(ids[i], static_cast<Index>(i)).second)
                repeated.push_back(static_cast<Index>(i));
    }
    return repeated;
}

bool IdTable::add(Id id, Index index)
{
    if (find(id) != none) return false;
    const auto offset = static_cast<std::uint64_t>(id - first_);
    if (offset < dense_.size())
        dense_[offset] = index;
    else
        sparse_.emplace(id, index);
    return true;
}

} // namespace plash

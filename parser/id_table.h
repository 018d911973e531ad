#pragma once

#include "model/record.h"

#include <unordered_map>
#include <vector>

namespace plash {

/// From the numbers of a deck to positions in the Model's arrays. Numbers that lie close together (the usual
/// case) are a plain table; scattered ones are hashed.
class IdTable {
public:
    /// Enters ids[i] -> i; of equal numbers the first one counts. Returns the positions of the later ones.
    std::vector<Index> build(const std::vector<Id>& ids);

    /// Enters one more number; false when it is there already.
    bool add(Id id, Index index);

    /// Position of a number, or `none`.
    Index find(Id id) const
    {
        const auto offset = static_cast<std::uint64_t>(id - first_);
        if (offset < dense_.size()) return dense_[offset];
        if (sparse_.empty()) return none;
        const auto found = sparse_.find(id);
        return found == sparse_.end() ? none : found->second;
    }

    bool empty() const { return dense_.empty() && sparse_.empty(); }

private:
    Id first_ = 0;
    std::vector<Index> dense_;
    std::unordered_map<Id, Index> sparse_;
};

} // namespace plash

#pragma once

#include "model/model.h"

#include <unordered_map>

namespace plash {

/// Node numbers of definitions that stay records (Model::others) to positions.
class DeckNodes {
public:
    explicit DeckNodes(const Model& model);

    /// DeckError at `where` when there is no such node.
    Index find(Id id, const Record& record, int line) const;

private:
    const Model& model_;
    std::unordered_map<Id, Index> position_;
};

/// Members of a node set by its number; DeckError when there is no such set.
const std::vector<Index>& nodes_of_set(const Model& model, const Record& record, std::string_view field,
                                       Id id);

/// Records of a keyword in Model::others.
template <class Visit>
void for_each_record(const Model& model, std::string_view keyword, Visit&& visit)
{
    for (const Record& record : model.others)
        if (record.keyword == keyword) visit(record);
}

} // namespace plash

#include "rigid/deck_nodes.h"

#include <fmt/format.h>

namespace plash {

DeckNodes::DeckNodes(const Model& model) : model_(model)
{
    position_.reserve(model.nodes.size());
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        position_.emplace(model.nodes.id[i], static_cast<Index>(i));
}

Index DeckNodes::find(Id id, const Record& record, int line) const
{
    const auto found = position_.find(id);
    if (found != position_.end()) return found->second;
    throw DeckError({record.where.file, line}, fmt::format("*{}: there is no node {}", record.keyword, id));
}

const std::vector<Index>& nodes_of_set(const Model& model, const Record& record, std::string_view field,
                                       Id id)
{
    for (const NodeSet& set : model.node_sets)
        if (set.id == id) return set.nodes;
    throw DeckError(record.where,
                    fmt::format("*{}, field {}: there is no node set {}", record.keyword, field, id));
}

} // namespace plash

#pragma once

#include "core/term.h"
#include "model/model.h"

#include <vector>

namespace plash {

/// *CONSTRAINED_TIED_NODES_FAILURE: nodes at one place, each of its own elements, that move as one until the
/// plastic strain of these elements, averaged by their volumes, exceeds EPPF. Then the nodes whose own
/// elements exceed it are let go, so that a crack runs between elements. Source: LS-DYNA keyword manual,
/// volume I. Volumes are those at the start; the plastic strain of a shell is the mean of its layers.
///
/// This is the search and the watch; LinearConstraints holds the nodes together.
class TiedNodeGroups {
public:
    struct Group {
        std::vector<Index> nodes; ///< tied now
        double limit = 0;         ///< EPPF [-]
        Location where;

        void serialise(Archive& archive) { archive(nodes); }
    };

    /// elements   the terms that know the plastic strains
    /// DeckError for sets in which no two nodes stand at one place.
    TiedNodeGroups(const Model& model, const State& state, std::vector<const Term*> elements);

    const std::vector<Group>& groups() const { return groups_; }

    /// Groups that lose nodes now, by their place in groups(), after they have lost them. A group that has
    /// one node left has none.
    std::vector<std::size_t> let_go(const State& state);

    void serialise(Archive& archive) { archive(groups_); }

private:
    struct Share {
        bool shell;
        Index row;     ///< in the results asked for
        double volume; ///< [length^3]
    };
    std::vector<const Term*> terms_;
    std::vector<Group> groups_;
    std::vector<Index> first_share_; ///< by node: where its elements begin in shares_; one more than nodes
    std::vector<Share> shares_;
    ElementResults results_; ///< plastic strains of the elements on tied nodes

    void find_groups(const Model& model);
    void find_elements(const Model& model, const State& state);
    double plastic_strain(const Share& share) const;
};

} // namespace plash

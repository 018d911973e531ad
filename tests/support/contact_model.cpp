#include "tests/support/contact_model.h"

#include "contact/part_data.h"

namespace plash::testing {

State ContactModel::state() const
{
    State state;
    state.position = model.nodes.position;
    state.velocity.resize(state.size());
    state.force.resize(state.size());
    state.mass = lumped_masses(model, part_data(model));
    return state;
}

void Springs::add_solids(const Model& model, double stiffness)
{
    std::vector<std::pair<Index, Index>> pairs;
    for (const auto& nodes : model.solids.nodes) {
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < i; ++j) pairs.push_back(std::minmax(nodes[i], nodes[j]));
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [a, b] : pairs) add(model, a, b, stiffness);
}

} // namespace plash::testing

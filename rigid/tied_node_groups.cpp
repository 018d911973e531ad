#include "rigid/tied_node_groups.h"

#include "model/measures.h"
#include "rigid/deck_nodes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace plash {

namespace {

constexpr int layers = 3; // of shells: the middle and both faces

/// Side of the cells by which nodes at one place are found, from the size of all of them.
double place_tolerance(const std::vector<Index>& nodes, const std::vector<Vec3>& position)
{
    double largest = 0;
    for (const Index node : nodes) {
        for (const auto component : vector_component)
            largest = std::max(largest, std::abs(position[node].*component - position[nodes[0]].*component));
    }
    return std::max(1e-6 * largest, std::numeric_limits<double>::min());
}

} // namespace

TiedNodeGroups::TiedNodeGroups(const Model& model, const State& state, std::vector<const Term*> elements)
    : terms_(std::move(elements))
{
    find_groups(model);
    if (!groups_.empty()) find_elements(model, state);
}

/// Nodes of a set sorted along x: those at one place are found among the few that follow.
void TiedNodeGroups::find_groups(const Model& model)
{
    const std::vector<Vec3>& position = model.nodes.position;
    for_each_record(model, "CONSTRAINED_TIED_NODES_FAILURE", [&](const Record& record) {
        std::vector<Index> nodes = nodes_of_set(model, record, "NSID", record.integer("NSID"));
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        if (nodes.empty())
            throw DeckError(record.where, fmt::format("*{}: its set is empty", record.keyword));
        const double tolerance = place_tolerance(nodes, position);
        std::stable_sort(nodes.begin(), nodes.end(),
                         [&](Index a, Index b) { return position[a].x < position[b].x; });
        std::vector<bool> taken(nodes.size(), false);
        const std::size_t before = groups_.size();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (taken[i]) continue;
            Group group{{nodes[i]}, record.real("EPPF"), record.where};
            for (std::size_t j = i + 1; j < nodes.size(); ++j) {
                if (position[nodes[j]].x - position[nodes[i]].x > tolerance) break;
                if (taken[j] || norm(position[nodes[j]] - position[nodes[i]]) > tolerance) continue;
                taken[j] = true;
                group.nodes.push_back(nodes[j]);
            }
            if (group.nodes.size() > 1) groups_.push_back(std::move(group));
        }
        if (groups_.size() == before) {
            throw DeckError(record.where,
                            fmt::format("*{}, field NSID: no two nodes of set {} stand at one place",
                                        record.keyword, record.integer("NSID")));
        }
    });
}

void TiedNodeGroups::find_elements(const Model& model, const State& state)
{
    std::vector<bool> tied(model.nodes.size(), false);
    for (const Group& group : groups_)
        for (const Index node : group.nodes) tied[node] = true;
    std::vector<std::pair<Index, Share>> by_node;
    const auto visit = [&](bool shell, const auto& elements, std::vector<Index>& rows,
                           const auto& volume_of) {
        rows.assign(elements.size(), none);
        Index wanted = 0;
        for (std::size_t element = 0; element < elements.size(); ++element) {
            auto corners = elements.nodes[element];
            std::sort(corners.begin(), corners.end());
            const auto end = std::unique(corners.begin(), corners.end());
            if (std::none_of(corners.begin(), end, [&](Index node) { return tied[node]; })) continue;
            rows[element] = wanted++;
            const double volume = volume_of(elements.nodes[element]);
            for (auto node = corners.begin(); node != end; ++node)
                if (tied[*node]) by_node.push_back({*node, {shell, rows[element], volume}});
        }
        return wanted;
    };
    const Index shells =
        visit(true, model.shells, results_.shell_rows, [&](const std::array<Index, 4>& nodes) {
            return segment_area(nodes, model.nodes.position); // times the thickness, once it is known
        });
    const Index solids =
        visit(false, model.solids, results_.solid_rows,
              [&](const std::array<Index, 8>& nodes) { return solid_volume(nodes, model.nodes.position); });
    results_.shell_layers = layers;
    results_.shell_plastic_strain.resize(static_cast<std::size_t>(shells) * layers);
    results_.solid_plastic_strain.resize(solids);

    results_.shell_thickness.resize(shells);
    for (const Term* term : terms_) term->collect(state, results_);
    for (auto& [node, share] : by_node)
        if (share.shell) share.volume *= results_.shell_thickness[share.row];
    results_.shell_thickness.clear();

    std::stable_sort(by_node.begin(), by_node.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    first_share_.assign(model.nodes.size() + 1, 0);
    for (const auto& [node, share] : by_node) {
        ++first_share_[node + 1];
        shares_.push_back(share);
    }
    for (std::size_t node = 0; node < model.nodes.size(); ++node)
        first_share_[node + 1] += first_share_[node];
}

double TiedNodeGroups::plastic_strain(const Share& share) const
{
    if (!share.shell) return results_.solid_plastic_strain[share.row];
    double sum = 0;
    for (int layer = 0; layer < layers; ++layer)
        sum += results_.shell_plastic_strain[static_cast<std::size_t>(share.row) * layers + layer];
    return sum / layers;
}

std::vector<std::size_t> TiedNodeGroups::let_go(const State& state)
{
    for (const Term* term : terms_) term->collect(state, results_);
    std::vector<std::size_t> changed;
    const auto exceeds = [&](Index node, double limit) {
        for (Index i = first_share_[node]; i < first_share_[node + 1]; ++i)
            if (plastic_strain(shares_[i]) > limit) return true;
        return false;
    };
    for (std::size_t number = 0; number < groups_.size(); ++number) {
        Group& group = groups_[number];
        double strain = 0, volume = 0;
        for (const Index node : group.nodes) {
            for (Index i = first_share_[node]; i < first_share_[node + 1]; ++i) {
                strain += shares_[i].volume * plastic_strain(shares_[i]);
                volume += shares_[i].volume;
            }
        }
        if (!(strain > group.limit * volume)) continue;
        std::erase_if(group.nodes, [&](Index node) { return exceeds(node, group.limit); });
        if (group.nodes.size() < 2) group.nodes.clear();
        changed.push_back(number);
    }
    return changed;
}

} // namespace plash

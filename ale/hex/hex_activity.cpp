#include "ale/hex/hex_activity.h"

#include "core/parallel.h"

#include <algorithm>

namespace plash {

namespace {

/// For each batch of `count` entries, the batches that name(entry, add) adds places of, each once.
template <class Name>
Grouped<Index> batches_near(std::size_t count, Name&& name)
{
    Grouped<Index> lists;
    lists.first.push_back(0);
    std::vector<Index> found;
    const auto add = [&](Index place) {
        const Index batch = place / lane_count;
        if (found.empty() || found.back() != batch) found.push_back(batch);
    };
    for (std::size_t first = 0; first < count; first += lane_count) {
        found.clear();
        for (std::size_t entry = first; entry < std::min<std::size_t>(first + lane_count, count); ++entry)
            name(entry, add);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        lists.entries.insert(lists.entries.end(), found.begin(), found.end());
        lists.first.push_back(lists.entries.size());
    }
    return lists;
}

} // namespace

HexActivity::HexActivity(const HexMesh& mesh, const std::vector<HexSweep>& sweeps, bool mixed)
    : mixed_(mixed), reach_(mesh.directions > 3 ? mesh.directions : 2), cells_(mesh.cells())
{
    const auto around_node = [&](Index node, auto&& add) {
        for (std::size_t i = mesh.first_corner[node]; i < mesh.first_corner[node + 1]; ++i)
            add(mesh.node_corner[i] / 8);
    };
    nodes_ = batches_near(mesh.nodes(),
                          [&](std::size_t node, auto&& add) { around_node(static_cast<Index>(node), add); });
    ring_ = batches_near(mesh.cells(), [&](std::size_t cell, auto&& add) {
        for (const Index node : mesh.corners[cell]) around_node(node, add);
    });
    faces_ = batches_near(mesh.faces.size(), [&](std::size_t face, auto&& add) {
        if (mesh.faces[face].below != none) add(mesh.faces[face].below);
        if (mesh.faces[face].above != none) add(mesh.faces[face].above);
    });
    for (const HexSweep& sweep : sweeps) {
        SweepLists& lists = sweeps_.emplace_back();
        lists.lines = batches_near(sweep.lines.size, [&](std::size_t entry, auto&& add) {
            for (const PlaceList& column : sweep.lines.place) add(column.place[entry]);
        });
        lists.edges = batches_near(sweep.edges.size, [&](std::size_t edge, auto&& add) {
            for (const PlaceList& column : sweep.edges.place) around_node(column.place[edge], add);
        });
        lists.members = batches_near(
            sweep.members.size(), [&](std::size_t member, auto&& add) { add(sweep.members[member].cell); });
        lists.nodes = batches_near(sweep.nodes.place.size(), [&](std::size_t entry, auto&& add) {
            if (sweep.nodes.place[entry] < static_cast<Index>(mesh.nodes())) add(sweep.nodes.place[entry]);
        });
    }
    own_.assign(padded(cells_ + 1) / lane_count, mixed ? 0 : 1);
    around_ = own_;
    reached_.assign(own_.size(), 1);
    reached_nodes_.assign(padded(mesh.nodes() + 1) / lane_count, 1);
}

void HexActivity::look(const FluidFields& fields, bool at_all)
{
    if (!mixed_) return;
    for_chunks(cells_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin; first < end; first += lane_count) {
            if (!at_all && !reaches_cells(first)) continue;
            Mask mask = 0;
            double fullest[lane_count] = {};
            const std::size_t lanes = std::min<std::size_t>(lane_count, cells_ - first);
            for (std::size_t group = 0; group < fields.groups.size(); ++group) {
                const double* fraction = fields.groups[group].fraction.data() + first;
                double sum = 0;
                for (std::size_t lane = 0; lane < lanes; ++lane) {
                    sum += fraction[lane];
                    fullest[lane] = std::max(fullest[lane], fraction[lane]);
                }
                if (sum > 0) mask |= Mask(1u << group);
            }
            for (std::size_t lane = 0; lane < lanes; ++lane)
                if (fullest[lane] != 1) mask |= BoxContents::empty_space;
            own_[first / lane_count] = mask;
        }
    });
}

void HexActivity::spread()
{
    if (!mixed_) return;
    const std::size_t batches = ring_.first.size() - 1;
    for (std::size_t batch = 0; batch < batches; ++batch)
        around_[batch] = of(ring_, batch * lane_count, own_);
    for (std::size_t batch = 0; batch < batches; ++batch)
        reached_[batch] = BoxContents::nothing(around_[batch]) ? 0 : 1;
    std::vector<Mask> before;
    for (int ring = 1; ring < reach_; ++ring) {
        before = reached_;
        for (std::size_t batch = 0; batch < batches; ++batch)
            if (!reached_[batch]) reached_[batch] = of(ring_, batch * lane_count, before);
    }
    for (std::size_t batch = 0; batch + 1 < nodes_.first.size(); ++batch)
        reached_nodes_[batch] = of(nodes_, batch * lane_count, reached_);
}

void HexActivity::serialise(Archive& archive)
{
    archive(own_, around_, reached_, reached_nodes_);
}

} // namespace plash

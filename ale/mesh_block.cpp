#include "ale/mesh_block.h"

#include "model/eulerian.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <unordered_map>

namespace plash {

namespace {

/// Which elements hang together: every element belongs to the root of its first node.
class Connected {
public:
    explicit Connected(std::size_t nodes) : parent_(nodes) { std::iota(parent_.begin(), parent_.end(), 0); }

    Index root(Index node)
    {
        while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
        return node;
    }
    void join(Index a, Index b) { parent_[root(a)] = root(b); }

private:
    std::vector<Index> parent_;
};

/// Values that differ by more than the precision of a deck's columns, ascending.
std::vector<double> distinct(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const double precision = 1e-6 * (values.back() - values.front());
    std::vector<double> planes;
    for (double value : values)
        if (planes.empty() || value - planes.back() > precision) planes.push_back(value);
    return planes;
}

/// Number of the plane that lies closest to a value.
int plane_of(const std::vector<double>& planes, double value)
{
    const auto above = std::lower_bound(planes.begin(), planes.end(), value);
    if (above == planes.begin()) return 0;
    if (above == planes.end()) return static_cast<int>(planes.size()) - 1;
    const int upper = static_cast<int>(above - planes.begin());
    return planes[upper] - value < value - planes[upper - 1] ? upper : upper - 1;
}

/// Says why a mesh is no box.
struct NoBox {
    std::string why;
};

[[noreturn]] void no_box(const Model& model, Index solid, const std::string& why)
{
    const Part& part = model.parts[model.solids.part[solid]];
    throw NoBox{
        fmt::format("element {} of part {} '{}': {}", model.solids.id[solid], part.id, part.title, why)};
}

MeshBlock box_of(const Model& model, const std::vector<Index>& solids)
{
    MeshBlock block;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        values.reserve(8 * solids.size());
        for (Index solid : solids)
            for (Index node : model.solids.nodes[solid])
                values.push_back(model.nodes.position[node].*vector_component[axis]);
        block.planes[axis] = distinct(std::move(values));
        if (block.cells(axis) < 1) no_box(model, solids.front(), "the mesh is flat");
    }
    const std::size_t wanted = std::size_t(block.cells(0)) * block.cells(1) * block.cells(2);
    if (solids.size() != wanted) {
        no_box(model, solids.front(),
               fmt::format("its mesh has {} cells between {} x {} x {} planes, not {}", solids.size(),
                           block.planes[0].size(), block.planes[1].size(), block.planes[2].size(), wanted));
    }
    block.solids.assign(wanted, none);
    block.nodes.assign(block.planes[0].size() * block.planes[1].size() * block.planes[2].size(), none);
    for (Index solid : solids) {
        int corner[8][3], low[3];
        for (int axis = 0; axis < 3; ++axis) {
            for (int n = 0; n < 8; ++n) {
                const Vec3& point = model.nodes.position[model.solids.nodes[solid][n]];
                corner[n][axis] = plane_of(block.planes[axis], point.*vector_component[axis]);
            }
            low[axis] = corner[0][axis];
            for (int n = 1; n < 8; ++n) low[axis] = std::min(low[axis], corner[n][axis]);
        }
        unsigned seen = 0;
        for (int n = 0; n < 8; ++n) {
            unsigned place = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const int offset = corner[n][axis] - low[axis];
                if (offset > 1) no_box(model, solid, "it reaches across a plane of its neighbours");
                place |= unsigned(offset) << axis;
            }
            seen |= 1u << place;
            const Index node = model.solids.nodes[solid][n];
            Index& known = block.nodes[block.node(corner[n][0], corner[n][1], corner[n][2])];
            if (known != none && known != node)
                no_box(model, solid,
                       fmt::format("nodes {} and {} lie at one place", model.nodes.id[known],
                                   model.nodes.id[node]));
            known = node;
        }
        if (seen != 0xff) no_box(model, solid, "its corners are not those of a box");
        Index& cell = block.solids[block.cell(low[0], low[1], low[2])];
        if (cell != none)
            no_box(model, solid, fmt::format("element {} is at the same place", model.solids.id[cell]));
        cell = solid;
    }
    return block;
}

/// The same elements as they are, nodes in the order in which the elements name them first.
MeshBlock hexahedra_of(const Model& model, const std::vector<Index>& solids, std::string why_no_box)
{
    MeshBlock block;
    block.solids = solids;
    block.why_no_box = std::move(why_no_box);
    std::unordered_map<Index, Index> position;
    for (Index solid : solids) {
        // The manual numbers corners around the lower face, then around the upper one.
        static constexpr int around[8] = {0, 1, 3, 2, 4, 5, 7, 6};
        std::array<Index, 8> corners;
        for (int n = 0; n < 8; ++n) {
            const Index node = model.solids.nodes[solid][n];
            const auto [found, added] = position.try_emplace(node, static_cast<Index>(block.nodes.size()));
            if (added) block.nodes.push_back(node);
            corners[around[n]] = found->second;
        }
        block.corners.push_back(corners);
    }
    return block;
}

MeshBlock block_of(const Model& model, const std::vector<Index>& solids, const WhyNoBox& why_no_box)
{
    if (std::string why = why_no_box(solids); !why.empty())
        return hexahedra_of(model, solids, std::move(why));
    try {
        return box_of(model, solids);
    } catch (const NoBox& reason) {
        return hexahedra_of(model, solids, reason.why);
    }
}

} // namespace

std::vector<MeshBlock> find_mesh_blocks(const Model& model, bool boxes_as_hexahedra)
{
    return find_mesh_blocks(model, [&](const std::vector<Index>&) {
        return std::string(boxes_as_hexahedra ? "a test wants it so" : "");
    });
}

std::vector<MeshBlock> find_mesh_blocks(const Model& model, const WhyNoBox& why_no_box)
{
    std::vector<bool> eulerian(model.parts.size());
    for (std::size_t part = 0; part < eulerian.size(); ++part)
        eulerian[part] = is_eulerian(model, static_cast<Index>(part));
    Connected connected(model.nodes.size());
    for (std::size_t solid = 0; solid < model.solids.size(); ++solid) {
        if (!eulerian[model.solids.part[solid]]) continue;
        const auto& nodes = model.solids.nodes[solid];
        for (int n = 1; n < 8; ++n) connected.join(nodes[0], nodes[n]);
    }
    std::map<Index, std::size_t> block_of_root;
    std::vector<std::vector<Index>> members;
    for (std::size_t solid = 0; solid < model.solids.size(); ++solid) {
        if (!eulerian[model.solids.part[solid]]) continue;
        const Index root = connected.root(model.solids.nodes[solid][0]);
        const auto [found, added] = block_of_root.try_emplace(root, members.size());
        if (added) members.emplace_back();
        members[found->second].push_back(static_cast<Index>(solid));
    }
    std::vector<MeshBlock> blocks;
    for (const auto& solids : members) blocks.push_back(block_of(model, solids, why_no_box));
    return blocks;
}

} // namespace plash

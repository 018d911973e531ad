#pragma once

#include "contact/surface.h"

#include <cstdint>
#include <span>

namespace plash {

inline constexpr std::uint8_t slave_bit = 1, master_bit = 2;

/// The nodes and segments of one contact in their own numbering, with the surfaces' connectivity. Nodes stand
/// in the State's order, so that they are loaded in one sweep; facets so that neighbours in space are
/// neighbours in memory.
struct ContactMesh {
    struct Node {
        Index node = none; ///< State index
        Index part = none;
        double half_thickness = 0;
        double stiffness = 0;
        std::uint8_t sides = 0;   ///< slave_bit, master_bit: which sides the node is of
        std::uint8_t acts_on = 0; ///< segments with a common bit in `belongs` may be touched
    };
    /// What the search and the test of pairs read of a facet, in one cache line; the rest is in `segments`.
    struct alignas(64) Facet {
        std::array<Index, 4> corner{}; ///< this mesh's node numbers; a triangle repeats the third
        double half_thickness = 0;
        double depth = 0;
        double size = 0;
        double stiffness = 0;
        Index part = none;
        std::uint8_t belongs = 0;
        bool one_sided = false;
        bool exposed = true;
        bool rigid = false; ///< of a rigid part, whose own nodes never touch it

        bool triangle() const { return corner[3] == corner[2]; }
    };
    /// What forces need of a facet in every cycle, two in a cache line.
    struct alignas(32) Face {
        std::array<Index, 4> corner{};
        double half_thickness = 0;
        double depth = 0;

        bool triangle() const { return corner[3] == corner[2]; }
    };

    std::vector<Node> nodes;
    std::vector<Facet> facets;
    std::vector<Face> faces;            ///< of the facets
    std::vector<double> half_thickness; ///< of the nodes [length]
    Index first_node =
        none; ///< the nodes are those of the State from this one on; none: they are not in a row
    std::vector<Segment> segments; ///< origin of each facet
    std::vector<std::array<Index, 4>>
        facet_edges; ///< edge from corner i to the next; none where there is none

    /// Facets around each edge: edge_facet[edge_begin[e]] .. edge_facet[edge_begin[e + 1]].
    std::vector<Index> edge_begin, edge_facet;
    std::vector<std::array<Index, 2>> edge_corner; ///< the two nodes of an edge
    /// Exposed facets around each node, likewise.
    std::vector<Index> node_begin, node_facet;

    /// Nodes that edges join with each node, likewise; whether one of these edges has one facet only.
    std::vector<Index> ring_begin, ring_node;
    std::vector<std::uint8_t> on_rim;

    std::span<const Index> facets_at_edge(Index edge) const
    {
        return {edge_facet.data() + edge_begin[edge], edge_facet.data() + edge_begin[edge + 1]};
    }
    std::span<const Index> facets_at_node(Index node) const
    {
        return {node_facet.data() + node_begin[node], node_facet.data() + node_begin[node + 1]};
    }

    std::span<const Index> neighbours_of(Index node) const
    {
        return {ring_node.data() + ring_begin[node], ring_node.data() + ring_begin[node + 1]};
    }

    /// Facet size below which the given share of all facets lies [length].
    double typical_size(double share) const;

    /// State index of a node.
    Index state_node(std::size_t node) const
    {
        return first_node == none ? nodes[node].node : first_node + static_cast<Index>(node);
    }

    /// Marks what erosion has changed and connects the facets that are there now.
    void update_exposed(const State& state);

private:
    void join_edges(const State& state);
    void join_rings();
};

/// Numbers 0 .. count - 1 with neighbours in space beside one another, in runs of eight.
std::vector<Index> spatial_order(std::span<const Vec3> place);

/// Joins the two sides of a contact: which nodes act on which facets follows from its kind. Single surface:
/// `master` is empty.
ContactMesh make_contact_mesh(const Contact& contact, const Surface& slave, const Surface& master,
                              std::span<const Vec3> position);

/// The surfaces of a contact by the Model.
ContactMesh make_contact_mesh(const Contact& contact, const Model& model, const std::vector<PartData>& parts);

} // namespace plash

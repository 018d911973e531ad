#include "contact/contact_mesh.h"

#include "contact/solid_faces.h"
#include "math/bisection.h"

#include <algorithm>
#include <numeric>

namespace plash {

namespace {

void join_nodes(std::vector<ContactMesh::Node>& nodes, const Surface& surface, std::uint8_t side,
                std::uint8_t acts_on)
{
    for (const ContactNode& from : surface.nodes) {
        nodes.push_back({from.node, from.part, from.half_thickness, from.stiffness, side, acts_on});
    }
}

/// A segment with the sides that it belongs to.
struct JoinedSegment {
    Segment segment;
    std::uint8_t belongs = 0;
};

void join_segments(std::vector<JoinedSegment>& joined, const Surface& surface, std::uint8_t belongs)
{
    for (const Segment& segment : surface.segments) joined.push_back({segment, belongs});
}

/// A node or facet of both sides becomes one with the bits of both.
template <class Item, class Same, class Join>
void merge_sorted(std::vector<Item>& items, Same&& same, Join&& join)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (kept > 0 && same(items[kept - 1], items[i])) {
            join(items[kept - 1], items[i]);
        } else {
            items[kept++] = items[i];
        }
    }
    items.resize(kept);
}

template <class Item>
void reorder(std::vector<Item>& items, std::span<const Index> order)
{
    std::vector<Item> sorted;
    sorted.reserve(items.size());
    for (Index i : order) sorted.push_back(items[i]);
    items = std::move(sorted);
}

void merge_nodes(std::vector<ContactMesh::Node>& nodes)
{
    std::stable_sort(nodes.begin(), nodes.end(),
                     [](const auto& a, const auto& b) { return a.node < b.node; });
    merge_sorted(
        nodes, [](const auto& a, const auto& b) { return a.node == b.node; },
        [](auto& to, const auto& from) {
            to.sides |= from.sides;
            to.acts_on |= from.acts_on;
            to.half_thickness = std::max(to.half_thickness, from.half_thickness);
            to.stiffness = std::max(to.stiffness, from.stiffness);
        });
}

void merge_segments(std::vector<JoinedSegment>& joined)
{
    const auto key = [](const JoinedSegment& item) {
        const Segment& segment = item.segment;
        return std::pair(face_key(segment.nodes), segment.covered_by == none ? none : segment.solid);
    };
    std::stable_sort(joined.begin(), joined.end(),
                     [&](const auto& a, const auto& b) { return key(a) < key(b); });
    merge_sorted(
        joined, [&](const auto& a, const auto& b) { return key(a) == key(b); },
        [](auto& to, const auto& from) { to.belongs |= from.belongs; });
}

/// Facets in the mesh's own numbering of nodes.
void fill_facets(ContactMesh& mesh, const std::vector<JoinedSegment>& joined, std::size_t state_size)
{
    std::vector<Index> number(state_size, none);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) number[mesh.nodes[i].node] = static_cast<Index>(i);
    for (const JoinedSegment& item : joined) {
        const Segment& segment = item.segment;
        ContactMesh::Facet facet;
        for (int corner = 0; corner < 4; ++corner) facet.corner[corner] = number[segment.nodes[corner]];
        facet.half_thickness = segment.half_thickness;
        facet.depth = segment.depth;
        facet.size = segment.size;
        facet.stiffness = segment.stiffness;
        facet.part = segment.part;
        facet.belongs = item.belongs;
        facet.one_sided = segment.one_sided;
        facet.rigid = segment.rigid;
        mesh.facets.push_back(facet);
        mesh.segments.push_back(segment);
    }
    // A wide floor would look for nodes far from it, as its depth follows from its own size.
    const double deepest = 0.5 * mesh.typical_size(0.9);
    for (auto& facet : mesh.facets)
        facet.depth = std::min(facet.depth, std::max(deepest, facet.half_thickness));
}

/// The copies of what is read in every cycle.
void pack(ContactMesh& mesh)
{
    for (const auto& facet : mesh.facets)
        mesh.faces.push_back({facet.corner, facet.half_thickness, facet.depth});
    for (const auto& node : mesh.nodes) mesh.half_thickness.push_back(node.half_thickness);
    if (mesh.nodes.empty()) return;
    const Index first = mesh.nodes.front().node, last = mesh.nodes.back().node;
    if (static_cast<std::size_t>(last - first) + 1 == mesh.nodes.size()) mesh.first_node = first;
}

} // namespace

std::vector<Index> spatial_order(std::span<const Vec3> place)
{
    constexpr std::size_t run_length = 8; // nodes and facets that are searched together
    std::vector<Index> order(place.size());
    std::iota(order.begin(), order.end(), 0);
    bisect(order, place, run_length);
    return order;
}

ContactMesh make_contact_mesh(const Contact& contact, const Surface& slave, const Surface& master,
                              std::span<const Vec3> position)
{
    ContactMesh mesh;
    const bool single =
        contact.kind == Contact::Kind::single_surface || contact.kind == Contact::Kind::general;
    join_nodes(mesh.nodes, slave, slave_bit, single ? slave_bit : master_bit);
    // Nodes of master segments are in the mesh, but act on nothing unless the contact works both ways.
    join_nodes(mesh.nodes, master, master_bit, contact.kind == Contact::Kind::two_way ? slave_bit : 0);
    std::vector<JoinedSegment> joined;
    const bool slave_is_touched = single || contact.kind == Contact::Kind::two_way;
    if (slave_is_touched || presses_by_segments(contact)) join_segments(joined, slave, slave_bit);
    join_segments(joined, master, master_bit);
    merge_nodes(mesh.nodes);
    merge_segments(joined);

    std::vector<Vec3> center;
    for (const JoinedSegment& item : joined) {
        Vec3 sum{};
        for (Index node : item.segment.nodes) sum += 0.25 * position[node];
        center.push_back(sum);
    }
    reorder(joined, spatial_order(center));
    fill_facets(mesh, joined, position.size());
    pack(mesh);
    mesh.update_exposed(State{});
    return mesh;
}

ContactMesh make_contact_mesh(const Contact& contact, const Model& model, const std::vector<PartData>& parts)
{
    const SurfaceOptions options = surface_options(contact);
    const Surface slave = make_surface(model, parts, contact.slave, options);
    const Surface master = contact.master.kind == ContactSide::Kind::none
                               ? Surface{}
                               : make_surface(model, parts, contact.master, options);
    return make_contact_mesh(contact, slave, master, model.nodes.position);
}

double ContactMesh::typical_size(double share) const
{
    std::vector<double> size;
    for (const Facet& facet : facets) size.push_back(facet.size);
    if (size.empty()) return 0;
    const auto place = size.begin() + static_cast<std::ptrdiff_t>(share * (size.size() - 1));
    std::nth_element(size.begin(), place, size.end());
    return *place;
}

void ContactMesh::update_exposed(const State& state)
{
    join_edges(state);
    join_rings();
    node_facet.resize(node_begin.back());
    std::vector<Index> next(node_begin.begin(), node_begin.end() - 1);
    for (std::size_t i = 0; i < facets.size(); ++i) {
        if (!facets[i].exposed) continue;
        for (int corner = 0; corner < (facets[i].triangle() ? 3 : 4); ++corner) {
            node_facet[next[facets[i].corner[corner]]++] = static_cast<Index>(i);
        }
    }
}

/// Nodes along the edges of each node, by rising edge.
void ContactMesh::join_rings()
{
    ring_begin.assign(nodes.size() + 1, 0);
    on_rim.assign(nodes.size(), 0);
    for (std::size_t edge = 0; edge < edge_corner.size(); ++edge) {
        const bool alone = edge_begin[edge + 1] - edge_begin[edge] < 2;
        for (const Index end : edge_corner[edge]) {
            ++ring_begin[end + 1];
            on_rim[end] |= alone;
        }
    }
    std::partial_sum(ring_begin.begin(), ring_begin.end(), ring_begin.begin());
    ring_node.resize(ring_begin.back());
    std::vector<Index> next(ring_begin.begin(), ring_begin.end() - 1);
    for (const auto& [a, b] : edge_corner) {
        ring_node[next[a]++] = b;
        ring_node[next[b]++] = a;
    }
}

/// Finds the exposed facets, their edges, and how many of them meet at each node.
void ContactMesh::join_edges(const State& state)
{
    struct Side {
        std::array<Index, 2> corner;
        Index facet;
        int number;
        auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    facet_edges.assign(facets.size(), {none, none, none, none});
    node_begin.assign(nodes.size() + 1, 0);
    for (std::size_t i = 0; i < facets.size(); ++i) {
        Facet& facet = facets[i];
        facet.exposed = is_exposed(segments[i], state);
        if (!facet.exposed) continue;
        for (int corner = 0; corner < (facet.triangle() ? 3 : 4); ++corner) {
            ++node_begin[facet.corner[corner] + 1];
            // A triangle a b c c has its third side, c a, as number 3 (from its fourth corner).
            const int side = facet.triangle() && corner == 2 ? 3 : corner;
            const Index from = facet.corner[corner], to = facet.corner[(side + 1) % 4];
            sides.push_back({{std::min(from, to), std::max(from, to)}, static_cast<Index>(i), side});
        }
    }
    std::sort(sides.begin(), sides.end());
    edge_begin.clear();
    edge_facet.clear();
    edge_corner.clear();
    for (const Side& side : sides) {
        if (edge_corner.empty() || edge_corner.back() != side.corner) {
            edge_begin.push_back(static_cast<Index>(edge_facet.size()));
            edge_corner.push_back(side.corner);
        }
        facet_edges[side.facet][side.number] = static_cast<Index>(edge_corner.size()) - 1;
        edge_facet.push_back(side.facet);
    }
    edge_begin.push_back(static_cast<Index>(edge_facet.size()));

    std::partial_sum(node_begin.begin(), node_begin.end(), node_begin.begin());
}

} // namespace plash

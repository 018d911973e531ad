#include "contact/move_penetrating.h"

#include "contact/closest_point.h"
#include "contact/touch.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace plash {

namespace {

/// Share of the shortest edge of the elements at a node by which it may be moved.
constexpr double farthest_share = 0.25;

bool moves_nodes(const Contact& contact)
{
    using Kind = Contact::Kind;
    const bool surfaces = contact.kind == Kind::single_surface || contact.kind == Kind::two_way ||
                          contact.kind == Kind::one_way || contact.kind == Kind::general;
    return surfaces && contact.initial_penetration == 0 && contact.soft != 2 && contact.birth == 0 &&
           !contact.constraint && contact.tie.method == Tie::Method::none;
}

/// By how much each node may be moved; nothing for nodes of rigid parts, particles and what ties hold.
class Room {
public:
    Room(const Model& model, const std::vector<PartData>& parts)
        : left_(model.nodes.size(), std::numeric_limits<double>::infinity())
    {
        // Edges of hexahedra; a repeated corner makes none. Diagonals of quadrilaterals are no edges.
        static constexpr int brick[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                             {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
        static constexpr int sheet[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
        static constexpr int rod[1][2] = {{0, 1}};
        limit(model, parts, model.shells, sheet);
        limit(model, parts, model.solids, brick);
        limit(model, parts, model.thick_shells, brick);
        limit(model, parts, model.beams, rod);
        for (const Index node : model.particles.node) left_[node] = 0;
        for (const Contact& contact : model.contacts)
            if (contact.kind == Contact::Kind::tied)
                for (const ContactSide* side : {&contact.slave, &contact.master}) hold(model, parts, *side);
    }

    double left(Index node) const { return std::isfinite(left_[node]) ? left_[node] : 0; }
    void take(Index node, double path) { left_[node] -= path; }

private:
    std::vector<double> left_;

    template <class Elements, std::size_t count>
    void limit(const Model& model, const std::vector<PartData>& parts, const Elements& elements,
               const int (&edges)[count][2])
    {
        const std::vector<Vec3>& place = model.nodes.position;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const auto& corner = elements.nodes[i];
            const bool rigid = parts[elements.part[i]].rigid;
            for (const auto& [from, to] : edges) {
                const Index a = corner[from], b = corner[to];
                if (a == none || b == none || a == b) continue;
                const double room = rigid ? 0 : farthest_share * norm(place[b] - place[a]);
                left_[a] = std::min(left_[a], room);
                left_[b] = std::min(left_[b], room);
            }
        }
    }

    /// Ties find their points by the places of the deck.
    void hold(const Model& model, const std::vector<PartData>& parts, const ContactSide& side)
    {
        SurfaceOptions options;
        options.with_beams = true;
        for (const ContactNode& node : make_surface(model, parts, side, options).nodes) left_[node.node] = 0;
    }
};

/// Moves the nodes of a contact once; what a node still penetrates follows from what was moved before it.
/// Between two surfaces it is moved away from the one that it touches first.
std::map<Index, MovedNode> move_nodes(Model& model, const Contact& contact, const ContactMesh& mesh,
                                      Room& room)
{
    ContactMotion motion;
    motion.velocity.resize(mesh.nodes.size());
    for (const auto& node : mesh.nodes) motion.position.push_back(model.nodes.position[node.node]);
    PairSearch search(mesh, model.solids.nodes, &model.thick_shells.nodes, &model);
    search.update(mesh, motion);
    TouchTable table;
    table.set_owners(search.pairs().owner);
    TouchFinder::Room finder_room;
    TouchFinder(mesh, motion, contact.square_edges)
        .find(search.pairs(), 0, table.owners(), table, finder_room);
    TouchList touches = table.list(mesh, motion);
    // The first surface gives way, then what is still in the way of the second.
    std::stable_sort(touches.all.begin(), touches.all.end(), [&](const Touch& a, const Touch& b) {
        return (mesh.nodes[a.node].sides & slave_bit) > (mesh.nodes[b.node].sides & slave_bit);
    });
    std::map<Index, MovedNode> moved;
    for (const Touch& touch : touches.all) {
        const auto& facet = mesh.facets[touch.facet];
        const auto share = corner_shares(touch.s, touch.t, facet.triangle());
        Vec3 offset = motion.position[touch.node];
        for (int i = 0; i < 4; ++i) offset -= share[i] * motion.position[facet.corner[i]];
        const double gap = mesh.nodes[touch.node].half_thickness + facet.half_thickness;
        const double depth = gap - dot(offset, touch.normal);
        const Index node = mesh.nodes[touch.node].node;
        if (depth <= 1e-6 * std::max(gap, facet.size) || depth > room.left(node)) continue;
        MovedNode& one = moved[node];
        if (one.node == none) one = {node, none, 0, model.nodes.position[node]};
        if (dot(model.nodes.position[node] - one.from, touch.normal) < 0) continue; // it came from there
        one.depth = std::max(one.depth, depth);
        room.take(node, depth);
        motion.position[touch.node] += depth * touch.normal;
        model.nodes.position[node] = motion.position[touch.node];
    }
    return moved;
}

} // namespace

std::vector<MovedNode> move_penetrating_nodes(Model& model)
{
    std::vector<MovedNode> all;
    if (std::none_of(model.contacts.begin(), model.contacts.end(), moves_nodes)) return all;
    const std::vector<PartData> parts = part_data(model);
    Room room(model, parts);
    for (std::size_t number = 0; number < model.contacts.size(); ++number) {
        const Contact& contact = model.contacts[number];
        if (!moves_nodes(contact)) continue;
        const ContactMesh mesh = make_contact_mesh(contact, model, parts);
        if (mesh.facets.empty()) continue;
        for (auto& [node, one] : move_nodes(model, contact, mesh, room)) {
            one.contact = static_cast<Index>(number);
            all.push_back(one);
        }
    }
    return all;
}

std::vector<std::string> describe(const std::vector<MovedNode>& moved, const Model& model)
{
    constexpr std::size_t most = 10;
    std::vector<std::string> lines;
    for (auto begin = moved.begin(); begin != moved.end();) {
        const Contact& contact = model.contacts[begin->contact];
        const auto end = std::find_if(begin, moved.end(),
                                      [&](const MovedNode& one) { return one.contact != begin->contact; });
        std::vector<MovedNode> own(begin, end);
        std::stable_sort(own.begin(), own.end(),
                         [](const MovedNode& a, const MovedNode& b) { return a.depth > b.depth; });
        lines.push_back(
            fmt::format("contact {}{}: IGNORE = 0 moves {} node{} out of surfaces, the farthest by "
                        "{:.4g}; IGNORE = 1 would leave them",
                        contact.id, contact.title.empty() ? "" : " '" + contact.title + "'", own.size(),
                        own.size() == 1 ? "" : "s", own.front().depth));
        for (std::size_t i = 0; i < std::min(most, own.size()); ++i) {
            const Vec3& from = own[i].from;
            const Vec3& to = model.nodes.position[own[i].node];
            lines.push_back(fmt::format(
                "  node {} by {:.4g} from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})",
                model.nodes.id[own[i].node], norm(to - from), from.x, from.y, from.z, to.x, to.y, to.z));
        }
        if (own.size() > most) lines.push_back(fmt::format("  and {} more", own.size() - most));
        begin = end;
    }
    return lines;
}

} // namespace plash

#include "contact/move_penetrating.h"

#include "contact/closest_point.h"
#include "contact/touch.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace plash {

namespace {

/// Share of the shortest edge of the elements at a node by which it may be moved whatever its neighbours do,
/// and of that of an element by which its nodes may be moved relative to one another otherwise.
constexpr double farthest_share = 0.25;

bool moves_nodes(const Contact& contact)
{
    using Kind = Contact::Kind;
    const bool surfaces = contact.kind == Kind::single_surface || contact.kind == Kind::two_way ||
                          contact.kind == Kind::one_way || contact.kind == Kind::general;
    return surfaces && contact.initial_penetration == 0 && contact.soft != 2 && contact.birth == 0 &&
           !contact.constraint && contact.tie.method == Tie::Method::none;
}

/// How far nodes may be moved: not those of rigid parts, particles and what ties hold; others by a share of
/// the shortest edge at them, or farther along with their neighbours.
class Room {
public:
    Room(const Model& model, const std::vector<PartData>& parts)
        : start_(model.nodes.position),
          alone_(model.nodes.size(), std::numeric_limits<double>::infinity()),
          stays_(model.nodes.size())
    {
        each_edge(model, [&](Index part, Index a, Index b, double) {
            const double room = parts[part].rigid ? 0 : farthest_share * norm(start_[b] - start_[a]);
            alone_[a] = std::min(alone_[a], room);
            alone_[b] = std::min(alone_[b], room);
        });
        for (const Index node : model.particles.node) alone_[node] = 0;
        for (const Contact& contact : model.contacts)
            if (contact.kind == Contact::Kind::tied)
                for (const ContactSide* side : {&contact.slave, &contact.master}) hold(model, parts, *side);
    }

    bool may_move(Index node, const Vec3& to) const
    {
        if (alone_[node] == 0 || !std::isfinite(alone_[node])) return false;
        return !stays_[node] || norm(to - start_[node]) <= alone_[node];
    }
    /// Finds nodes that have been moved too far beside their neighbours: they may not any more. Of two that
    /// were moved far, the one that went farther. Returns whether there are any.
    bool find_spoiled(const Model& model)
    {
        const std::vector<Vec3>& place = model.nodes.position;
        bool any = false;
        each_edge(model, [&](Index, Index a, Index b, double shortest) {
            const Vec3 way_a = place[a] - start_[a], way_b = place[b] - start_[b];
            if (norm(way_a - way_b) <= farthest_share * shortest) return;
            const double farthest = std::max(norm(way_a), norm(way_b));
            const auto stop = [&](Index node, double path) {
                if (stays_[node] || path <= alone_[node] || path < (1 - 1e-9) * farthest) return;
                stays_[node] = any = true;
            };
            stop(a, norm(way_a));
            stop(b, norm(way_b));
        });
        return any;
    }
    /// No node goes farther than it may alone.
    void stop_all() { std::fill(stays_.begin(), stays_.end(), 1); }

private:
    std::vector<Vec3> start_;
    std::vector<double> alone_;       ///< by which a node may be moved in any case [length]
    std::vector<std::uint8_t> stays_; ///< may not be moved by more than that

    /// function(part, a, b, shortest edge of the element at the start) for every edge of every element.
    template <class Function>
    void each_edge(const Model& model, Function&& function) const
    {
        // Edges of hexahedra; a repeated corner makes none. Diagonals of quadrilaterals are no edges.
        static constexpr int brick[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                             {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
        static constexpr int sheet[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
        static constexpr int rod[1][2] = {{0, 1}};
        each_edge_of(model.shells, sheet, function);
        each_edge_of(model.solids, brick, function);
        each_edge_of(model.thick_shells, brick, function);
        each_edge_of(model.beams, rod, function);
    }
    template <class Elements, std::size_t count, class Function>
    void each_edge_of(const Elements& elements, const int (&edges)[count][2], Function& function) const
    {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const auto each = [&](auto&& one) {
                for (const auto& [from, to] : edges) {
                    const Index a = elements.nodes[i][from], b = elements.nodes[i][to];
                    if (a != none && b != none && a != b) one(a, b);
                }
            };
            double shortest = std::numeric_limits<double>::infinity();
            each([&](Index a, Index b) { shortest = std::min(shortest, norm(start_[b] - start_[a])); });
            each([&](Index a, Index b) { function(elements.part[i], a, b, shortest); });
        }
    }

    /// Ties find their points by the places of the deck.
    void hold(const Model& model, const std::vector<PartData>& parts, const ContactSide& side)
    {
        SurfaceOptions options;
        options.with_beams = true;
        for (const ContactNode& node : make_surface(model, parts, side, options).nodes) alone_[node.node] = 0;
    }
};

/// Touches of a contact at the start; the first surface gives way, then what is still in the way of the
/// second.
TouchList touches_at_start(const Model& model, const Contact& contact, const ContactMesh& mesh)
{
    ContactMotion motion;
    motion.velocity.own().resize(mesh.nodes.size());
    for (const auto& node : mesh.nodes) motion.position.own().push_back(model.nodes.position[node.node]);
    PairSearch search(mesh, model.solids.nodes, &model.thick_shells.nodes, &model);
    search.update(mesh, motion);
    TouchTable table;
    table.set_owners(search.pairs().owner);
    TouchFinder::Room finder_room;
    TouchFinder(mesh, motion, contact.square_edges)
        .find(search.pairs(), 0, table.owners(), table, finder_room);
    TouchList touches = table.list(mesh, motion);
    std::stable_sort(touches.all.begin(), touches.all.end(), [&](const Touch& a, const Touch& b) {
        return (mesh.nodes[a.node].sides & slave_bit) > (mesh.nodes[b.node].sides & slave_bit);
    });
    return touches;
}

/// Moves the nodes of a contact once; what a node still penetrates follows from what was moved before it.
/// Between two surfaces it is moved away from the one that it touches first.
std::map<Index, MovedNode> move_once(Model& model, const ContactMesh& mesh, const TouchList& touches,
                                     const Room& room)
{
    std::vector<Vec3>& place = model.nodes.position;
    std::map<Index, MovedNode> moved;
    for (const Touch& touch : touches.all) {
        const auto& facet = mesh.facets[touch.facet];
        const auto share = corner_shares(touch.s, touch.t, facet.triangle());
        const Index node = mesh.nodes[touch.node].node;
        Vec3 offset = place[node];
        for (int i = 0; i < 4; ++i) offset -= share[i] * place[mesh.nodes[facet.corner[i]].node];
        const double gap = mesh.nodes[touch.node].half_thickness + facet.half_thickness;
        const double depth = gap - dot(offset, touch.normal);
        const Vec3 to = place[node] + depth * touch.normal;
        if (depth <= 1e-6 * std::max(gap, facet.size) || !room.may_move(node, to)) continue;
        MovedNode& one = moved[node];
        if (one.node == none) one = {node, none, 0, place[node]};
        if (dot(place[node] - one.from, touch.normal) < 0) continue; // it came from there
        one.depth = std::max(one.depth, depth);
        place[node] = to;
    }
    return moved;
}

/// Moves anew, with less freedom, until no element is spoiled: nodes that have to stay leave the way to
/// others.
std::map<Index, MovedNode> move_nodes(Model& model, const Contact& contact, const ContactMesh& mesh,
                                      Room& room)
{
    constexpr int most_rounds = 30;
    const TouchList touches = touches_at_start(model, contact, mesh);
    const std::vector<Vec3> before = model.nodes.position;
    for (int round = 0;; ++round) {
        auto moved = move_once(model, mesh, touches, room);
        if (round > most_rounds || !room.find_spoiled(model)) return moved;
        model.nodes.position = before;
        if (round == most_rounds) room.stop_all();
    }
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

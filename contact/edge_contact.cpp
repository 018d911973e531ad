#include "contact/edge_contact.h"

#include "contact/bounding_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plash {

namespace {

bool gone(const std::vector<std::uint8_t>& deleted, Index element)
{
    return !deleted.empty() && deleted[element];
}

double shell_thickness(const Model& model, const std::vector<PartData>& parts, Index shell)
{
    if (!model.shells.thickness.empty() && model.shells.thickness[shell][0] > 0) {
        const auto& t = model.shells.thickness[shell];
        return 0.25 * (t[0] + t[1] + t[2] + t[3]);
    }
    return parts[model.shells.part[shell]].thickness;
}

/// The touch of two edges in a list that is sorted by them, or nullptr.
const EdgeTouch* touch_between(const std::vector<EdgeTouch>& touches, Index a, Index b)
{
    const std::pair<Index, Index> key = std::minmax(a, b);
    const auto found =
        std::lower_bound(touches.begin(), touches.end(), key, [](const EdgeTouch& touch, const auto& wanted) {
            return std::pair(touch.first, touch.second) < wanted;
        });
    const bool there = found != touches.end() && std::pair(found->first, found->second) == key;
    return there ? &*found : nullptr;
}

} // namespace

bool ContactEdge::there(const State& state) const
{
    if (shell[0] == none) return true;
    int alive = 0;
    for (Index beside : shell) alive += beside != none && !gone(state.deleted_shells, beside);
    return alive == 1 || (inner && alive == 2);
}

namespace {

/// Collects the edges of the sides of a contact, those of shells by their ends.
struct EdgeCollector {
    const Model& model;
    const std::vector<PartData>& parts;
    const Contact& contact;
    std::vector<ContactEdge> edges{};
    std::map<std::array<Index, 2>, ContactEdge> shell_sides{};

    const Vec3& place(Index node) const { return model.nodes.position[node]; }
    PartContact part_contact(Index part) const
    {
        const auto found = model.part_contacts.find(part);
        return found == model.part_contacts.end() ? PartContact{} : found->second;
    }
    bool inside(const ContactSide& side, std::array<Index, 2> node) const
    {
        return !side.box || (side.box->holds(place(node[0])) && side.box->holds(place(node[1])));
    }
    std::vector<bool> wanted_parts(const ContactSide& side) const
    {
        std::vector<bool> wanted(model.parts.size(), side.kind == ContactSide::Kind::all);
        for (Index part : side.parts) wanted[part] = true;
        return wanted;
    }

    void add_beams(const ContactSide& side, std::uint8_t bit)
    {
        const std::vector<bool> wanted = wanted_parts(side);
        for (std::size_t i = 0; i < model.beams.size(); ++i) {
            const Index beam = static_cast<Index>(i), part = model.beams.part[i];
            if (!wanted[part] || (parts[part].spot_weld && !contact.spot_weld_beams)) continue;
            const auto& nodes = model.beams.nodes[i];
            ContactEdge edge;
            edge.node = {std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1])};
            if (!inside(side, edge.node)) continue;
            edge.beam = beam;
            edge.part = part;
            edge.sides = bit;
            const PartContact own = part_contact(part);
            edge.radius =
                own.thickness > 0 ? 0.5 * own.thickness : own.thickness_scale * parts[part].beam_radius;
            const double length = norm(place(nodes[1]) - place(nodes[0]));
            if (length > 0) {
                edge.stiffness = side.stiffness_scale * own.stiffness_scale * parts[part].bulk_modulus *
                                 parts[part].beam_area / length;
            }
            edges.push_back(edge);
        }
    }

    void add_shells(const ContactSide& side, std::uint8_t bit)
    {
        std::vector<Index> shells = side.shells;
        if (side.kind != ContactSide::Kind::shells) {
            const std::vector<bool> wanted = wanted_parts(side);
            shells.clear();
            for (std::size_t i = 0; i < model.shells.size(); ++i)
                if (wanted[model.shells.part[i]]) shells.push_back(static_cast<Index>(i));
        }
        for (Index shell : shells) add_shell(side, bit, shell);
    }

    void add_shell(const ContactSide& side, std::uint8_t bit, Index shell)
    {
        const auto& nodes = model.shells.nodes[shell];
        const Index part = model.shells.part[shell];
        const PartContact own = part_contact(part);
        const int corners = nodes[3] == nodes[2] ? 3 : 4;
        const double area = segment_area(nodes, model.nodes.position);
        const double longest =
            std::max(norm(place(nodes[2]) - place(nodes[0])), norm(place(nodes[3]) - place(nodes[1])));
        for (int i = 0; i < corners; ++i) {
            const Index from = nodes[i], to = nodes[(i + 1) % corners];
            const std::array<Index, 2> key{std::min(from, to), std::max(from, to)};
            if (!inside(side, key)) continue;
            ContactEdge& edge = shell_sides[key];
            if (edge.shell[0] == none) {
                edge.shell[0] = shell;
            } else if (edge.shell[0] != shell) {
                edge.shell[1] = shell;
            }
            edge.node = key;
            edge.part = part;
            edge.sides |= bit;
            edge.inner = contact.inner_edges;
            double thickness = own.thickness > 0 ? own.thickness
                                                 : own.thickness_scale * shell_thickness(model, parts, shell);
            if (side.thickness > 0 && own.thickness == 0) thickness = side.thickness;
            const double length = norm(place(to) - place(from));
            if (contact.limit_thickness) thickness = std::min(thickness, 0.4 * length);
            edge.radius = std::max(edge.radius, 0.5 * thickness);
            const double scale = side.stiffness_scale * own.stiffness_scale;
            edge.stiffness = std::max(edge.stiffness, scale * parts[part].bulk_modulus * area / longest);
        }
    }
};

} // namespace

std::vector<ContactEdge> contact_edges(const Model& model, const std::vector<PartData>& parts,
                                       const Contact& contact)
{
    EdgeCollector collector{model, parts, contact};
    if (contact.kind == Contact::Kind::general) collector.add_beams(contact.slave, slave_bit);
    collector.add_shells(contact.slave, slave_bit);
    if (contact.kind == Contact::Kind::two_way) collector.add_shells(contact.master, master_bit);
    for (const auto& [key, edge] : collector.shell_sides) collector.edges.push_back(edge);
    return std::move(collector.edges);
}

EdgePoints closest_points(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1)
{
    const Vec3 u = p1 - p0, v = q1 - q0, r = p0 - q0;
    const double a = dot(u, u), e = dot(v, v), f = dot(v, r), c = dot(u, r), b = dot(u, v);
    if (!(a > 0) || !(e > 0)) return {};
    const double determinant = a * e - b * b;
    // Parallel edges touch in the middle of their overlap, so that forces do not jump from end to end.
    double s = 0.5;
    if (determinant > 1e-10 * a * e) {
        s = std::clamp((b * f - c * e) / determinant, 0.0, 1.0);
    } else {
        const double from = -c / a, to = from + b / a;
        s = 0.5 * (std::clamp(std::min(from, to), 0.0, 1.0) + std::clamp(std::max(from, to), 0.0, 1.0));
    }
    double t = (b * s + f) / e;
    if (t < 0) {
        t = 0;
        s = std::clamp(-c / a, 0.0, 1.0);
    } else if (t > 1) {
        t = 1;
        s = std::clamp((b - c) / a, 0.0, 1.0);
    }
    return {s, t};
}

EdgeContact::EdgeContact(const Contact& contact, const Model& model, const std::vector<PartData>& parts)
    : contact_(contact),
      name_(name_of("edge contact", contact)),
      model_(model),
      edges_(contact_edges(model, parts, contact)),
      lumped_(lumped_masses(model, parts))
{
    std::vector<double> length;
    for (const ContactEdge& edge : edges_) {
        nodes_.insert(nodes_.end(), edge.node.begin(), edge.node.end());
        length.push_back(norm(model.nodes.position[edge.node[1]] - model.nodes.position[edge.node[0]]));
    }
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    at_node_.resize(nodes_.size());
    rigid_.resize(nodes_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        std::array<Index, 2> ends{};
        for (int end = 0; end < 2; ++end) {
            const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), edges_[i].node[end]);
            ends[end] = static_cast<Index>(place - nodes_.begin());
            at_node_[ends[end]].push_back(static_cast<Index>(i));
            if (edges_[i].part != none && parts[edges_[i].part].rigid) rigid_[ends[end]] = true;
        }
        ends_.push_back(ends);
    }
    force_now_.resize(nodes_.size());
    force_before_.resize(nodes_.size());
    length_ = length;
    if (length.empty()) return;
    std::nth_element(length.begin(), length.begin() + length.size() / 2, length.end());
    margin_ = 0.5 * length[length.size() / 2];
}

void EdgeContact::take_masses(const State& state)
{
    for (Index node : nodes_) mass_.push_back(state.mass[node] > 0 ? state.mass[node] : lumped_[node]);
    lumped_ = {};
}

/// Pairs hold until two nodes may have come closer by the margin, this step included.
bool EdgeContact::pairs_hold(const Clock& clock, const State& state) const
{
    if (searched_at_.empty() || state.deletions != deletions_seen_) return false;
    Bounds moved, speed;
    for (std::size_t i = 0; i < acting_.size(); ++i) {
        const Index node = nodes_[acting_[i]];
        moved.add(state.position[node] - searched_at_[i]);
        speed.add(state.velocity[node]);
    }
    return norm(moved.high - moved.low) + clock.last_step * norm(speed.high - speed.low) < margin_;
}

bool EdgeContact::may_meet(const ContactEdge& a, const ContactEdge& b) const
{
    if (contact_.exclude_same_part_beams && a.beam != none && b.beam != none && a.part == b.part)
        return false;
    if (contact_.kind == Contact::Kind::two_way && (a.sides | b.sides) != (slave_bit | master_bit))
        return false;
    for (Index node : a.node)
        if (node == b.node[0] || node == b.node[1]) return false;
    for (Index shell : a.shell) // sides of one shell
        if (shell != none && (shell == b.shell[0] || shell == b.shell[1])) return false;
    return true;
}

void EdgeContact::search(const State& state)
{
    deletions_seen_ = state.deletions;
    acting_.clear();
    searched_at_.clear();
    std::vector<Bounds> boxes(edges_.size());
    std::vector<bool> there(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        there[i] = edges_[i].there(state);
        if (!there[i]) continue;
        for (Index node : edges_[i].node) boxes[i].add(state.position[node]);
        boxes[i].grow(edges_[i].radius + 0.5 * margin_);
        acting_.insert(acting_.end(), ends_[i].begin(), ends_[i].end());
    }
    std::sort(acting_.begin(), acting_.end());
    acting_.erase(std::unique(acting_.begin(), acting_.end()), acting_.end());
    for (Index place : acting_) searched_at_.push_back(state.position[nodes_[place]]);
    BoundingTree tree;
    tree.fit(boxes);
    pairs_.clear();
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        if (!there[i]) continue;
        const Index first = static_cast<Index>(i);
        const ContactEdge& a = edges_[i];
        tree.query(boxes[i], [&](Index second) {
            if (second <= first) return;
            if (may_meet(a, edges_[second])) pairs_.push_back({first, second});
        });
    }
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
        return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    });
}

/// Where the closest point is the end of an edge: whether this edge counts there. Others that go on from the
/// end must not lead clearly towards the other edge, else theirs is the closest point.
bool EdgeContact::owns_end(const State& state, Index edge, double along, const Vec3& offset) const
{
    if (along > 0 && along < 1) return true;
    constexpr double clearly = 1e-3; // sine of the angle
    const Index end = ends_[edge][along > 0.5 ? 1 : 0];
    const Vec3& place = state.position[nodes_[end]];
    for (Index other : at_node_[end]) {
        if (other == edge || !edges_[other].there(state)) continue;
        const Index far = ends_[other][0] == end ? ends_[other][1] : ends_[other][0];
        const Vec3 leg = state.position[nodes_[far]] - place;
        if (dot(offset, leg) > clearly * norm(offset) * norm(leg)) return false;
    }
    return true;
}

/// The touch of the last step between edges that go on from those of the pair, held from about the same
/// direction: as nodes pass, a touch moves from edge to edge. Given as the pair has its edges.
bool EdgeContact::beside(const Pair& pair, const Vec3& normal, EdgeTouch& found) const
{
    double nearest = 0.5;
    for_neighbours(pair.first, [&](Index a) {
        for_neighbours(pair.second, [&](Index b) {
            const EdgeTouch* old = touch_between(before_, a, b);
            if (!old) return;
            const double along = dot(old->normal, normal);
            if (std::abs(along) <= nearest) return;
            nearest = std::abs(along);
            found = *old;
            if (a < b) return;
            found.normal = -found.normal;
            found.friction = -found.friction;
        });
    });
    return nearest > 0.5;
}

/// Where two edges go on in one another and both meet a third, from nearly the same direction and at nearly
/// the same place, the deeper touch stands for both: else a beam would be held once more as it bends.
void EdgeContact::drop_repeated(const State& state)
{
    if (now_.size() < 2) return;
    std::vector<Index> order(now_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return std::pair(-now_[a].penetration, a) < std::pair(-now_[b].penetration, b);
    });
    const auto place = [&](Index edge, double along) {
        const auto& node = edges_[edge].node;
        return state.position[node[0]] + along * (state.position[node[1]] - state.position[node[0]]);
    };
    std::vector<bool> kept(now_.size());
    for (Index number : order) {
        const EdgeTouch& touch = now_[number];
        bool repeats = false;
        for_neighbours(touch.first, [&](Index a) {
            for_neighbours(touch.second, [&](Index b) {
                const EdgeTouch* found = touch_between(now_, a, b);
                if (!found || !kept[found - now_.data()]) return;
                const bool turned = a > b;
                if ((turned ? -1 : 1) * dot(found->normal, touch.normal) <= 0.5) return;
                const Vec3 between = place(touch.first, touch.s) - place(a, turned ? found->t : found->s);
                const double near = std::min({edges_[touch.first].radius + edges_[touch.second].radius,
                                              0.45 * length_[touch.first], 0.45 * length_[touch.second],
                                              0.45 * length_[a], 0.45 * length_[b]});
                repeats = repeats || dot(between, between) < near * near;
            });
        });
        kept[number] = !repeats;
    }
    std::size_t number = 0;
    std::erase_if(now_, [&](const EdgeTouch&) { return !kept[number++]; });
}

bool EdgeContact::touch_of(const Clock& clock, const State& state, const Pair& pair, const EdgeTouch* before,
                           EdgeTouch& touch) const
{
    const ContactEdge &a = edges_[pair.first], &b = edges_[pair.second];
    const auto& x = state.position;
    const EdgePoints at = closest_points(x[a.node[0]], x[a.node[1]], x[b.node[0]], x[b.node[1]]);
    const Vec3 on_a = x[a.node[0]] + at.s * (x[a.node[1]] - x[a.node[0]]);
    const Vec3 on_b = x[b.node[0]] + at.t * (x[b.node[1]] - x[b.node[0]]);
    const Vec3 offset = on_a - on_b;
    double distance = norm(offset);
    const double gap = a.radius + b.radius;
    if (distance >= gap && !before) return false;
    EdgeTouch moved_here;
    if (!before && distance > 0 && beside(pair, (1 / distance) * offset, moved_here)) before = &moved_here;
    if (!owns_end(state, pair.first, at.s, -offset) || !owns_end(state, pair.second, at.t, offset))
        return false;
    touch.first = pair.first;
    touch.second = pair.second;
    touch.s = at.s;
    touch.t = at.t;
    touch.normal = distance > 0 ? (1 / distance) * offset : (before ? before->normal : Vec3{0, 0, 1});
    if (before && dot(before->normal, touch.normal) < -0.5) { // the axes have crossed
        touch.normal = -touch.normal;
        distance = -distance;
    }
    touch.penetration = gap - distance;
    if (touch.penetration <= 0) return false;
    if (before) {
        touch.baseline = std::min(before->baseline, touch.penetration);
        touch.rounding = before->rounding;
        touch.stiffness = before->stiffness;
        touch.friction = before->friction;
        return true;
    }
    const auto& v = state.velocity;
    const Vec3 closing =
        (1 - at.t) * v[b.node[0]] + at.t * v[b.node[1]] - (1 - at.s) * v[a.node[0]] - at.s * v[a.node[1]];
    const double approach = std::max(0.0, dot(closing, touch.normal)) * clock.last_step;
    touch.baseline = std::max(0.0, touch.penetration - 1.5 * approach);
    touch.rounding = approach;
    return true;
}

double EdgeContact::stiffness_of(const EdgeTouch& touch) const
{
    const ContactEdge &a = edges_[touch.first], &b = edges_[touch.second];
    const double penalty = contact_.penalty_scale *
                           unscaled_stiffness(1, std::min(a.stiffness, b.stiffness) > 0 ? a.stiffness : 0,
                                              std::max(b.stiffness, b.stiffness > 0 ? 0 : a.stiffness));
    const double scale = contact_.edge_stiffness_scale;
    if (soft_step_ == 0 || (contact_.soft == 0 && penalty > 0)) return scale * penalty;
    double smallest = 1e300;
    for (Index end : ends_[touch.first]) smallest = std::min(smallest, mass_[end]);
    for (Index end : ends_[touch.second]) smallest = std::min(smallest, mass_[end]);
    const double share = contact_.soft == 2 ? contact_.penalty_scale : contact_.soft_scale;
    return scale * std::max(penalty, 0.5 * share * smallest / (soft_step_ * soft_step_));
}

/// The contact's own, or with FS = -1 the mean of the parts' (*PART_CONTACT).
Friction EdgeContact::friction_of(Index first, Index second) const
{
    if (contact_.static_friction != -1) {
        return {contact_.static_friction, contact_.dynamic_friction, contact_.friction_decay, 0};
    }
    Friction mean;
    for (Index part : {first, second}) {
        const auto own = model_.part_contacts.find(part);
        if (own == model_.part_contacts.end()) continue;
        mean.at_rest += 0.5 * own->second.static_friction;
        mean.moving += 0.5 * own->second.dynamic_friction;
        mean.decay += 0.5 * own->second.friction_decay;
    }
    return mean;
}

double EdgeContact::apply_law(const Clock& clock, const State& state, EdgeTouch& touch) const
{
    const auto& v = state.velocity;
    const auto &a = edges_[touch.first].node, &b = edges_[touch.second].node;
    const Vec3 velocity =
        (1 - touch.s) * v[a[0]] + touch.s * v[a[1]] - (1 - touch.t) * v[b[0]] - touch.t * v[b[1]];
    const double closing = -dot(velocity, touch.normal);
    if (touch.stiffness == 0) touch.stiffness = stiffness_of(touch);
    double normal_force = rounded_force(touch.stiffness, touch.penetration - touch.baseline, touch.rounding);
    const auto mass_at = [&](const std::array<Index, 2>& ends, double along) {
        return 1 / ((1 - along) * (1 - along) / mass_[ends[0]] + along * along / mass_[ends[1]]);
    };
    if (normal_force > 0 && contact_.damping > 0) {
        const double damping =
            damping_coefficient(contact_.damping, touch.stiffness, mass_at(ends_[touch.first], touch.s),
                                mass_at(ends_[touch.second], touch.t));
        normal_force = std::max(0.0, normal_force + damping * closing);
    }
    const Friction friction = friction_of(edges_[touch.first].part, edges_[touch.second].part);
    const Vec3 before = touch.friction;
    const Vec3 slip = clock.last_step * (velocity + closing * touch.normal);
    touch.friction = {};
    if (friction.any()) {
        const double speed = clock.last_step > 0 ? norm(slip) / clock.last_step : 0;
        const double limit = contact_.friction_scale * friction.coefficient(speed) * normal_force;
        touch.friction = friction_force(before, touch.normal, slip, touch.stiffness, limit);
    }
    touch.force = normal_force * touch.normal + touch.friction;
    return -0.5 * dot(before + touch.friction, slip);
}

void EdgeContact::add_forces(const Clock& clock, State& state)
{
    if (mass_.empty()) take_masses(state);
    vote_ = StepVote::nothing();
    if (clock.time < contact_.birth || clock.time > contact_.death || edges_.empty()) {
        now_.clear();
        before_.clear();
        return;
    }
    soft_step_ = std::max(soft_step_, contact_.soft_step > 0 ? contact_.soft_step : clock.last_step);
    if (!pairs_hold(clock, state)) search(state);
    std::swap(now_, before_);
    now_.clear();
    auto old = before_.cbegin();
    for (const Pair& pair : pairs_) {
        const auto key = std::pair(pair.first, pair.second);
        while (old != before_.cend() && std::pair(old->first, old->second) < key) ++old;
        const bool known = old != before_.cend() && std::pair(old->first, old->second) == key;
        EdgeTouch touch;
        if (touch_of(clock, state, pair, known ? &*old : nullptr, touch)) now_.push_back(touch);
    }
    drop_repeated(state);
    for (EdgeTouch& touch : now_) friction_energy_ += apply_law(clock, state, touch);
    if (!now_.empty() || !before_.empty()) sum_up(clock, state);
}

/// Forces to the State, work of the last step by the trapezoidal rule, and Gershgorin's bound for the step.
void EdgeContact::sum_up(const Clock& clock, State& state)
{
    std::swap(force_now_, force_before_);
    std::fill(force_now_.begin(), force_now_.end(), Vec3{});
    std::vector<double> stiffness(nodes_.size());
    for (const EdgeTouch& touch : now_) {
        const auto put = [&](const std::array<Index, 2>& ends, double along, double sign) {
            const double share[2] = {1 - along, along};
            for (int end = 0; end < 2; ++end) {
                force_now_[ends[end]] += (sign * share[end]) * touch.force;
                stiffness[ends[end]] += share[end] * touch.stiffness;
            }
        };
        put(ends_[touch.first], touch.s, 1);
        put(ends_[touch.second], touch.t, -1);
    }
    double power = 0, largest = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        power += dot(force_now_[i] + force_before_[i], state.velocity[nodes_[i]]);
        state.force[nodes_[i]] += force_now_[i];
        if (rigid_[i] || !(mass_[i] > 0) || stiffness[i] <= largest * mass_[i]) continue;
        largest = stiffness[i] / mass_[i];
        vote_ = {2 / std::sqrt(2 * largest), "edge contact at node", model_.nodes.id[nodes_[i]], 0};
    }
    energy_ -= 0.5 * clock.last_step * power;
}

void EdgeContact::serialise(Archive& archive)
{
    archive(mass_, pairs_, acting_, searched_at_, now_, force_now_, energy_, friction_energy_, soft_step_,
            deletions_seen_);
    if (archive.loading() && !mass_.empty()) lumped_ = {};
}

void EdgeContact::collect(const State& state, ElementResults& results) const
{
    auto entry = std::find_if(results.contacts.begin(), results.contacts.end(),
                              [&](const auto& other) { return other.contact == contact_.id; });
    if (entry == results.contacts.end()) {
        results.contacts.emplace_back().contact = contact_.id;
        entry = results.contacts.end() - 1;
        entry->two_sides = false;
    }
    entry->slave_energy += energy_;
    entry->friction_energy += friction_energy_;
    if (contact_.kind == Contact::Kind::two_way) {
        for (const EdgeTouch& touch : now_) {
            const auto& node = edges_[touch.first].node;
            const Vec3 place = (1 - touch.s) * state.position[node[0]] + touch.s * state.position[node[1]];
            const Vec3 on_slave = (edges_[touch.first].sides & slave_bit) != 0 ? touch.force : -touch.force;
            const Vec3 moment = cross(place, on_slave);
            entry->slave_force += on_slave;
            entry->master_force -= on_slave;
            entry->slave_moment += moment;
            entry->master_moment -= moment;
        }
    }
    if (results.contact_force.empty() || now_.empty()) return;
    for (std::size_t i = 0; i < nodes_.size(); ++i) results.contact_force[nodes_[i]] += force_now_[i];
}

} // namespace plash

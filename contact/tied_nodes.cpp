#include "contact/tied_nodes.h"

#include "contact/part_data.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plash {

namespace {

/// The velocity at n+1/2 that the loop is about to give a node.
Vec3 next_velocity(const State& state, const Clock& clock, Index node)
{
    if (state.mass[node] == 0) return state.velocity[node];
    return state.velocity[node] + (clock.velocity_step() / state.mass[node]) * state.force[node];
}

Vec3 next_spin(const State& state, const Clock& clock, Index node)
{
    if (state.inertia[node] == 0) return state.angular_velocity[node];
    return state.angular_velocity[node] + (clock.velocity_step() / state.inertia[node]) * state.moment[node];
}

/// Whether a corner of this segment hangs, over whatever chain of ties, on the node.
bool hangs_on(const std::vector<TiedPoint>& points, const std::vector<Index>& tie_of_node,
              const TiedPoint& point, Index node, int depth = 0)
{
    if (depth > 100) return true;
    for (Index corner : point.corner) {
        if (corner == node) return true;
        const Index next = tie_of_node[corner];
        if (next != none && hangs_on(points, tie_of_node, points[next], node, depth + 1)) return true;
    }
    return false;
}

} // namespace

bool ties_by_constraint(const Contact& contact)
{
    return contact.kind == Contact::Kind::tied && (contact.tie.method == Tie::Method::constrained ||
                                                   contact.tie.method == Tie::Method::constrained_offset);
}

TiedNodes::TiedNodes(const Model& model, State& state) : model_(model)
{
    const bool any = std::any_of(model.contacts.begin(), model.contacts.end(), ties_by_constraint);
    if (!any) return;
    const std::vector<PartData> parts = part_data(model);
    std::vector<Index> tie_of_node(state.size(), none);
    for (std::size_t contact = 0; contact < model.contacts.size(); ++contact) {
        if (ties_by_constraint(model.contacts[contact])) find(contact, parts, state, tie_of_node);
    }
    sort(tie_of_node);
    move_masses(state);
}

void TiedNodes::find(std::size_t number, const std::vector<PartData>& parts, const State& state,
                     std::vector<Index>& tie_of_node)
{
    const Contact& contact = model_.contacts[number];
    SurfaceOptions options;
    options.with_beams = true;
    const Surface slave = make_surface(model_, parts, contact.slave, options);
    const Surface master = make_surface(model_, parts, contact.master, options);
    TieSearch search = find_tied_points(slave, master, contact, model_.nodes.position);
    std::vector<TiedPoint> points;
    for (const Tie& tie : ties_) points.push_back(tie.point);
    std::vector<Index> twice;
    for (const TiedPoint& point : search.points) {
        const Index part = slave.nodes[point.slave].part;
        const bool rigid = part != none && parts[part].rigid;
        if (rigid) continue; // springs tie it (make_contacts), as a constraint cannot move it
        if (tie_of_node[point.node] != none || hangs_on(points, tie_of_node, point, point.node)) {
            twice.push_back(point.node);
            continue;
        }
        Tie tie{point, TieShape(point.s, point.t, point.triangle()), false, false, number, 0, {}, {}, {}};
        if (contact.tie.rotations && state.rotational() && state.inertia[point.node] > 0) {
            tie.rotations = true;
            tie.corners_turn = std::all_of(point.corner.begin(), point.corner.end(),
                                           [&](Index corner) { return state.inertia[corner] > 0; });
        }
        tie_of_node[point.node] = static_cast<Index>(ties_.size());
        ties_.push_back(tie);
        points.push_back(point);
    }
    const auto report = [&](const std::vector<Index>& nodes, std::string_view why) {
        if (nodes.empty()) return;
        std::vector<Id> ids;
        for (std::size_t i = 0; i < std::min<std::size_t>(nodes.size(), 10); ++i) {
            ids.push_back(model_.nodes.id[nodes[i]]);
        }
        notices_.push_back(fmt::format("contact {}: {} of {} nodes {}: {}{}", contact.id, nodes.size(),
                                       slave.nodes.size(), why, fmt::join(ids, " "),
                                       nodes.size() > ids.size() ? " ..." : ""));
    };
    report(search.left_out, "are not tied, as they lie over no segment or too far from it");
    report(twice, "are not tied again, as another tie holds them or hangs on them");
}

/// Orders the ties by how many ties lie between a node and what carries it in the end.
void TiedNodes::sort(const std::vector<Index>& tie_of_node)
{
    std::vector<int> depth(ties_.size(), -1);
    const auto depth_of = [&](const auto& self, Index tie) -> int {
        if (depth[tie] >= 0) return depth[tie];
        int deepest = 0;
        for (Index corner : ties_[tie].point.corner) {
            if (tie_of_node[corner] != none) deepest = std::max(deepest, 1 + self(self, tie_of_node[corner]));
        }
        return depth[tie] = deepest;
    };
    std::vector<Index> order(ties_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = static_cast<Index>(i);
        depth_of(depth_of, order[i]);
    }
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return depth[a] > depth[b]; });
    std::vector<Tie> sorted;
    for (Index tie : order) sorted.push_back(ties_[tie]);
    ties_ = std::move(sorted);
}

void TiedNodes::move_masses(State& state)
{
    for (Tie& tie : ties_) {
        const Index node = tie.point.node;
        tie.mass = state.mass[node];
        for (int i = 0; i < 4; ++i) state.mass[tie.point.corner[i]] += tie.shape.value[i] * tie.mass;
        state.mass[node] = 0;
        if (!tie.rotations) continue;
        if (tie.corners_turn) {
            for (int i = 0; i < 4; ++i) {
                state.inertia[tie.point.corner[i]] += tie.shape.value[i] * state.inertia[node];
            }
        }
        state.inertia[node] = 0;
    }
}

void TiedNodes::hand_over_forces(State& state)
{
    for (Tie& tie : ties_) {
        const Index node = tie.point.node;
        tie.force = state.force[node];
        state.force[node] = {};
        Vec3 moment{};
        if (tie.rotations) {
            moment = state.moment[node];
            state.moment[node] = {};
            if (tie.corners_turn) {
                for (int i = 0; i < 4; ++i) {
                    state.moment[tie.point.corner[i]] += tie.shape.value[i] * moment;
                }
                moment = {};
            }
        }
        const TieFrame frame(tie.shape, at_corners(state.position, tie.point));
        const auto corner = spread_to_corners(tie.shape, frame, tie.point.height, tie.force, moment);
        for (int i = 0; i < 4; ++i) state.force[tie.point.corner[i]] += corner[i];
    }
}

void TiedNodes::follow(const Clock& clock, State& state)
{
    for (auto tie = ties_.rbegin(); tie != ties_.rend(); ++tie) {
        const TiedPoint& point = tie->point;
        std::array<Vec3, 4> next, velocity;
        for (int i = 0; i < 4; ++i) {
            velocity[i] = next_velocity(state, clock, point.corner[i]);
            next[i] = state.position[point.corner[i]] + clock.step * velocity[i];
        }
        const TieFrame frame(tie->shape, next);
        const Vec3 target = frame.place + point.height * frame.normal;
        const Vec3 moved = (1 / clock.step) * (target - state.position[point.node]);
        tie->acceleration = (1 / clock.velocity_step()) * (moved - state.velocity[point.node]);
        state.velocity[point.node] = moved;
        if (!tie->rotations) continue;
        Vec3 spin{};
        if (tie->corners_turn) {
            for (int i = 0; i < 4; ++i) {
                spin += tie->shape.value[i] * next_spin(state, clock, point.corner[i]);
            }
        } else {
            const TieFrame now(tie->shape, at_corners(state.position, point));
            spin = tie_rates(tie->shape, now, point.height, velocity).spin;
        }
        tie->spin_rate = (1 / clock.velocity_step()) * (spin - state.angular_velocity[point.node]);
        state.angular_velocity[point.node] = spin;
    }
}

/// Forces with which the segments hold the tied nodes.
void TiedNodes::collect(const State& state, ElementResults& results) const
{
    for (std::size_t number = 0; number < model_.contacts.size(); ++number) {
        if (!ties_by_constraint(model_.contacts[number])) continue;
        const Id id = model_.contacts[number].id;
        auto entry = std::find_if(results.contacts.begin(), results.contacts.end(),
                                  [&](const auto& other) { return other.contact == id; });
        if (entry == results.contacts.end()) {
            results.contacts.emplace_back().contact = id;
            entry = results.contacts.end() - 1;
        }
        ElementResults::ContactForce& sum = *entry;
        for (const Tie& tie : ties_) {
            if (tie.contact != number) continue;
            const Vec3 hold = tie.mass * tie.acceleration - tie.force;
            const Vec3 moment = cross(state.position[tie.point.node], hold);
            sum.slave_force += hold;
            sum.slave_moment += moment;
            sum.master_force -= hold;
            sum.master_moment -= moment;
            sum.slave_mass += tie.mass;
        }
    }
    for (const Tie& tie : ties_) {
        if (!results.acceleration.empty()) results.acceleration[tie.point.node] = tie.acceleration;
        if (tie.rotations && !results.angular_acceleration.empty()) {
            results.angular_acceleration[tie.point.node] = tie.spin_rate;
        }
    }
}

} // namespace plash

#include "contact/surface_contact.h"

#include "contact/closest_point.h"
#include "contact/initial_penetrations.h"
#include "core/parallel.h"

#include <algorithm>
#include <array>

namespace plash {

namespace {

using Facet = ContactMesh::Facet;

/// Shares of a touch's facet corners in its contact point.
std::array<double, 4> shares_of(const ContactMesh& mesh, const Touch& touch)
{
    return corner_shares(touch.s, touch.t, mesh.facets[touch.facet].triangle());
}

/// Friction of every part, and of what has none: the contact's own values unless FS = -1.
std::vector<Friction> frictions_of(const Contact& contact, const Model& model)
{
    const Friction common{contact.static_friction, contact.dynamic_friction, contact.friction_decay,
                          contact.friction_stress};
    std::vector<Friction> frictions(model.parts.size() + 1, common);
    if (contact.static_friction != -1) return frictions;
    for (std::size_t part = 0; part < frictions.size(); ++part) {
        const auto own = model.part_contacts.find(static_cast<Index>(part));
        const PartContact data = own == model.part_contacts.end() ? PartContact{} : own->second;
        frictions[part] = {data.static_friction, data.dynamic_friction, data.friction_decay,
                           data.friction_stress};
    }
    return frictions;
}

ContactMesh mesh_of(const Contact& contact, const Model& model, const std::vector<PartData>& parts)
{
    const SurfaceOptions options = surface_options(contact);
    const Surface slave = make_surface(model, parts, contact.slave, options);
    const Surface master = contact.master.kind == ContactSide::Kind::none
                               ? Surface{}
                               : make_surface(model, parts, contact.master, options);
    return make_contact_mesh(contact, slave, master, model.nodes.position);
}

} // namespace

SurfaceContact::SurfaceContact(const Contact& contact, const Model& model, const std::vector<PartData>& parts)
    : contact_(contact),
      model_(model),
      mesh_(mesh_of(contact, model, parts)),
      search_(mesh_, model.solids.nodes),
      lumped_(lumped_masses(model, parts)),
      frictions_(frictions_of(contact, model)),
      sum_now_(mesh_.nodes.size()),
      sum_before_(mesh_.nodes.size())
{}

/// Nodes of rigid bodies have no mass in the State: there the mass of their elements serves.
void SurfaceContact::take_masses(const State& state)
{
    mass_.resize(mesh_.nodes.size());
    for (std::size_t i = 0; i < mass_.size(); ++i) {
        const Index node = mesh_.nodes[i].node;
        mass_[i] = state.mass[node] > 0 ? state.mass[node] : lumped_[node];
        if (mass_[i] == 0) mesh_.nodes[i].acts_on = 0;
    }
    lumped_ = {};
}

void SurfaceContact::follow_erosion(const State& state)
{
    const bool known = state.deletions == deletions_seen_;
    if (known && !restarted_) return;
    if (!known) search_.forget();
    restarted_ = false;
    deletions_seen_ = state.deletions;
    mesh_.update_exposed(state);
}

void SurfaceContact::find_touches()
{
    PairList& pairs = search_.pairs();
    const std::size_t chunks = (pairs.node.size() + chunk_length - 1) / chunk_length;
    before_.forget();
    std::swap(now_, before_);
    now_.first.resize(mesh_.nodes.size(), nullptr);
    now_.chunks.resize(chunks);
    const TouchFinder finder(mesh_, motion_, before_, contact_.square_edges);
    std::vector<double> friction(chunks);
    for_chunks(pairs.node.size(), [&](std::size_t begin, std::size_t end) {
        const std::size_t chunk = begin / chunk_length;
        std::vector<Touch>& touches = now_.chunks[chunk];
        touches.clear();
        finder.find(pairs, begin, end, touches);
        double loss = 0;
        for (Touch& touch : touches) loss += apply_law(touch);
        now_.index(chunk);
        friction[chunk] = loss;
    });
    for (double loss : friction) energy_.friction += loss;
}

double SurfaceContact::stiffness_of(const Touch& touch) const
{
    const double node = mesh_.nodes[touch.node].stiffness;
    const Facet& facet = mesh_.facets[touch.facet];
    double unscaled = facet.stiffness;
    // PENOPT: 1 the smaller one, 2 the segment's, 3 the node's, 4 the segment's scaled ... as the manual
    // lists.
    if (contact_.penalty_option == 1 && node > 0)
        unscaled = facet.stiffness > 0 ? std::min(node, facet.stiffness) : node;
    if (contact_.penalty_option == 3 && node > 0) unscaled = node;
    const double penalty = contact_.penalty_scale * unscaled;
    if (contact_.soft != 1 || soft_step_ == 0) return penalty;
    double smallest = mass_[touch.node];
    for (Index corner : facet.corner) smallest = std::min(smallest, mass_[corner]);
    return std::max(penalty, 0.5 * contact_.soft_scale * smallest / (soft_step_ * soft_step_));
}

const Friction& SurfaceContact::friction_of(const Touch& touch, Friction& mixed) const
{
    const auto of_part = [&](Index part) -> const Friction& {
        return part == none ? frictions_.back() : frictions_[part];
    };
    const Friction& node = of_part(mesh_.nodes[touch.node].part);
    const Friction& facet = of_part(mesh_.facets[touch.facet].part);
    if (contact_.static_friction != -1) return node;
    mixed = {0.5 * (node.at_rest + facet.at_rest), 0.5 * (node.moving + facet.moving),
             0.5 * (node.decay + facet.decay), 0.5 * (node.shear_cap + facet.shear_cap)};
    return mixed;
}

/// Fills stiffness and forces of a touch; returns what friction takes in the last step.
double SurfaceContact::apply_law(Touch& touch) const
{
    const Facet& facet = mesh_.facets[touch.facet];
    const auto share = shares_of(mesh_, touch);
    Vec3 velocity = motion_.velocity[touch.node];
    double facet_inverse_mass = 0;
    for (int i = 0; i < 4; ++i) {
        const Index corner = facet.corner[i];
        velocity -= share[i] * motion_.velocity[corner];
        if (share[i] != 0 && mass_[corner] > 0) facet_inverse_mass += share[i] * share[i] / mass_[corner];
    }
    const double closing = -dot(velocity, touch.normal);
    if (touch.stiffness == 0 || soft_changed_) touch.stiffness = stiffness_of(touch);
    double normal_force = rounded_force(touch.stiffness, touch.active_penetration(), touch.rounding);
    if (normal_force > 0 && contact_.damping > 0 && facet_inverse_mass > 0) {
        const double damping =
            damping_coefficient(contact_.damping, touch.stiffness, mass_[touch.node], 1 / facet_inverse_mass);
        normal_force = std::max(0.0, normal_force + damping * closing);
    }
    Friction mixed;
    const Friction& friction = friction_of(touch, mixed);
    const Vec3 before = touch.friction;
    const Vec3 slip = motion_.last_step * (velocity + closing * touch.normal);
    touch.friction = {};
    if (friction.any()) {
        const double speed = motion_.last_step > 0 ? norm(slip) / motion_.last_step : 0;
        double limit = contact_.friction_scale * friction.coefficient(speed) * normal_force;
        if (friction.shear_cap > 0) limit = std::min(limit, friction.shear_cap * facet.size * facet.size);
        touch.friction = friction_force(before, touch.normal, slip, touch.stiffness, limit);
    }
    touch.force = normal_force * touch.normal + touch.friction;
    return -0.5 * dot(before + touch.friction, slip);
}

void SurfaceContact::add_forces(const Clock& clock, State& state)
{
    if (mass_.empty()) take_masses(state);
    vote_ = StepVote::nothing();
    if (!active(clock)) {
        now_.clear();
        before_.clear();
        return;
    }
    follow_erosion(state);
    motion_.load(mesh_, clock, state);
    soft_changed_ = contact_.soft == 1 && clock.last_step > soft_step_;
    soft_step_ = std::max(soft_step_, clock.last_step);
    search_.update(mesh_, motion_);
    find_touches();
    if (now_.size() + before_.size() == 0) return;
    sum_up();
    add_to(clock, state);
}

/// One touch after the other, in the order of the list: the sums have the same bits for any number of
/// threads.
void SurfaceContact::sum_up()
{
    std::swap(sum_now_, sum_before_);
    for_chunks(sum_now_.size(), [&](std::size_t begin, std::size_t end) {
        std::fill(sum_now_.begin() + begin, sum_now_.begin() + end, NodeSum{});
    });
    constexpr std::size_t ahead = 8;
    for (const auto& chunk : now_.chunks) {
        for (std::size_t number = 0; number < chunk.size(); ++number) {
            if (number + 2 * ahead < chunk.size()) {
                __builtin_prefetch(&mesh_.facets[chunk[number + 2 * ahead].facet]);
            }
            if (number + ahead < chunk.size()) {
                const auto& corner = mesh_.facets[chunk[number + ahead].facet].corner;
                __builtin_prefetch(&sum_now_[corner[0]]);
                __builtin_prefetch(&sum_now_[corner[2]]);
            }
            const Touch& touch = chunk[number];
            const Facet& facet = mesh_.facets[touch.facet];
            const auto share = corner_shares(touch.s, touch.t, facet.triangle());
            NodeSum& node = sum_now_[touch.node];
            node.force += touch.force;
            node.stiffness += touch.stiffness;
            for (int i = 0; i < 4; ++i) {
                NodeSum& corner = sum_now_[facet.corner[i]];
                corner.force -= share[i] * touch.force;
                corner.stiffness += share[i] * touch.stiffness;
            }
        }
    }
}

/// Forces to the State; work over the last step, half with the forces at n and half with those at n-1; and
/// the stable step by Gershgorin's bound of the largest frequency of the contact springs on the nodes'
/// masses: omega^2 is at most the largest 2 K_i / m_i, where K_i sums the stiffness with which touches hang
/// on node i.
void SurfaceContact::add_to(const Clock& clock, State& state)
{
    struct Partial {
        double slave = 0, master = 0, largest = 0;
        Index at = none;
    };
    const std::size_t count = sum_now_.size();
    std::vector<Partial> partial((count + chunk_length - 1) / chunk_length);
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        Partial part;
        for (std::size_t i = begin; i < end; ++i) {
            const NodeSum& sum = sum_now_[i];
            const double power = dot(sum.force + sum_before_[i].force, motion_.velocity[i]);
            (mesh_.nodes[i].sides & slave_bit ? part.slave : part.master) -= power;
            if (sum.stiffness == 0) continue;
            state.force[mesh_.nodes[i].node] += sum.force;
            const double frequency = mass_[i] > 0 ? sum.stiffness / mass_[i] : 0;
            if (frequency > part.largest) {
                part.largest = frequency;
                part.at = static_cast<Index>(i);
            }
        }
        partial[begin / chunk_length] = part;
    });
    Partial whole;
    for (const Partial& part : partial) {
        energy_.slave += 0.5 * clock.last_step * part.slave;
        energy_.master += 0.5 * clock.last_step * part.master;
        if (part.largest > whole.largest) whole = part;
    }
    if (whole.at == none) return;
    const ContactMesh::Node& node = mesh_.nodes[whole.at];
    vote_ = {2 / std::sqrt(2 * whole.largest), "contact at node", model_.nodes.id[node.node], 0};
    if (node.part != none) vote_.part = model_.parts[node.part].id;
}

std::vector<std::string> SurfaceContact::notices(const State& state) const
{
    if (contact_.birth > 0) return {};
    return describe(initial_penetrations(contact_, mesh_, search_, state), contact_, mesh_, model_);
}

void SurfaceContact::serialise(Archive& archive)
{
    archive(mass_, motion_.travelled, sum_now_, deletions_seen_, soft_step_, energy_);
    search_.serialise(archive);
    now_.serialise(archive);
    if (!archive.loading()) return;
    now_.first.assign(now_.chunks.empty() ? 0 : mesh_.nodes.size(), nullptr);
    for (std::size_t chunk = 0; chunk < now_.chunks.size(); ++chunk) now_.index(chunk);
    before_.clear();
    for (std::size_t i = 0; i < mass_.size(); ++i) {
        if (mass_[i] == 0) mesh_.nodes[i].acts_on = 0;
    }
    restarted_ = deletions_seen_ > 0;
}

/// Resultants of both sides.
void SurfaceContact::collect(const State&, ElementResults& results) const
{
    ElementResults::ContactForce sum;
    sum.contact = contact_.id;
    sum.two_sides = contact_.master.kind != ContactSide::Kind::none;
    sum.slave_energy = energy_.slave;
    sum.master_energy = energy_.master;
    sum.friction_energy = energy_.friction;
    for (std::size_t i = 0; i < mass_.size(); ++i) {
        if (mesh_.nodes[i].sides & slave_bit) sum.slave_mass += mass_[i];
        if (mesh_.nodes[i].sides & master_bit) sum.master_mass += mass_[i];
    }
    now_.for_each([&](const Touch& touch) {
        const Facet& facet = mesh_.facets[touch.facet];
        const auto share = shares_of(mesh_, touch);
        Vec3 facet_moment{};
        for (int c = 0; c < 4; ++c) {
            facet_moment -= share[c] * cross(motion_.position[facet.corner[c]], touch.force);
        }
        const Vec3 node_moment = cross(motion_.position[touch.node], touch.force);
        const bool node_is_slave = (facet.belongs & master_bit) != 0;
        sum.slave_force += node_is_slave ? touch.force : -touch.force;
        sum.master_force += node_is_slave ? -touch.force : touch.force;
        sum.slave_moment += node_is_slave ? node_moment : facet_moment;
        sum.master_moment += node_is_slave ? facet_moment : node_moment;
    });
    if (!results.contact_force.empty() && now_.size() > 0) {
        for (std::size_t i = 0; i < sum_now_.size(); ++i) {
            results.contact_force[mesh_.nodes[i].node] += sum_now_[i].force;
        }
    }
    results.contacts.push_back(sum);
}

} // namespace plash

#include "contact/surface_contact.h"

#include "contact/closest_point.h"
#include "contact/initial_penetrations.h"
#include "contact/ordered_chunks.h"
#include "core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plash {

namespace {

using Facet = ContactMesh::Facet;

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

bool any_friction(const std::vector<Friction>& frictions)
{
    return std::any_of(frictions.begin(), frictions.end(), [](const Friction& one) { return one.any(); });
}

} // namespace

SurfaceContact::SurfaceContact(const Contact& contact, const Model& model, const std::vector<PartData>& parts)
    : contact_(contact),
      name_(name_of("contact", contact)),
      model_(model),
      mesh_(make_contact_mesh(contact, model, parts)),
      search_(mesh_, model.solids.nodes, &model.thick_shells.nodes, &model),
      lumped_(lumped_masses(model, parts)),
      frictions_(frictions_of(contact, model)),
      table_(any_friction(frictions_)),
      sum_(mesh_.nodes.size())
{
    if (contact.friction_energy && table_.with_friction()) rubbed_off_.resize(mesh_.nodes.size());
    if (!model.stand_ins.empty()) hold_back_waiting();
    if (contact.tie.method != Tie::Method::none) tie(parts);
    if (presses_by_segments(contact)) make_facing();
    rigid_.resize(model.parts.size());
    for (std::size_t part = 0; part < parts.size(); ++part) rigid_[part].rigid = parts[part].rigid;
    for (const auto& node : mesh_.nodes) {
        const bool rigid = node.part != none && rigid_[node.part].rigid;
        kind_.push_back(((node.sides & slave_bit) != 0 ? slave_node : 0) | (rigid ? rigid_node : 0));
    }
}

/// A segment without an element beneath has the mass of its nodes.
void SurfaceContact::make_facing()
{
    FacingSegments::Options options;
    const double slave = contact_.penalty_scale * contact_.slave.stiffness_scale;
    const double master = contact_.penalty_scale * contact_.master.stiffness_scale;
    options.stiffness_scale = {slave, master, 0.5 * (slave + master)};
    options.damping = contact_.damping;
    options.friction_scale = contact_.friction_scale;
    options.two_sided = contact_.kind != Contact::Kind::single_surface;
    options.mixed_friction = contact_.static_friction == -1;
    options.baseline_decay = contact_.baseline_decay;
    options.friction_stiffness_scale = contact_.friction_stiffness_scale;
    options.larger_part_scale = contact_.larger_part_scale;
    for (const auto& [part, own] : model_.part_contacts) {
        if (own.stiffness_scale == 1) continue;
        options.part_scale.resize(model_.parts.size(), 1);
        options.part_scale[part] = own.stiffness_scale;
    }
    std::vector<double> area_mass;
    for (const Segment& segment : mesh_.segments) {
        double mass = segment.area_mass;
        if (mass == 0 && segment.size > 0) {
            for (Index node : segment.nodes) mass += 0.25 * lumped_[node] / (segment.size * segment.size);
        }
        area_mass.push_back(mass);
    }
    facing_.emplace(mesh_, options, frictions_, std::move(area_mass));
}

/// PSTIFF: a segment has the mean mass of its nodes, whatever hangs on these.
void SurfaceContact::weigh_segments()
{
    std::vector<double> area_mass;
    for (const ContactMesh::Facet& facet : mesh_.facets) {
        double mass = 0;
        const int corners = facet.triangle() ? 3 : 4;
        for (int i = 0; i < corners; ++i) mass += mass_[facet.corner[i]] / corners;
        area_mass.push_back(facet.size > 0 ? mass / (facet.size * facet.size) : 0);
    }
    facing_->set_area_mass(std::move(area_mass));
}

/// TIEBREAK: nodes that are held do not touch until they are set free; under OPTION 4 springs only pull, and
/// contact does the rest; under OPTION 1 and 3 nodes are held from their first touch on.
void SurfaceContact::tie(const std::vector<PartData>& parts)
{
    sticks_ = contact_.tie.failure == 1 || contact_.tie.failure == 3;
    if (sticks_) {
        ties_.emplace(contact_, model_, mesh_.segments);
        stuck_.resize(mesh_.nodes.size());
    } else {
        const SurfaceOptions options = surface_options(contact_);
        const Surface slave = make_surface(model_, parts, contact_.slave, options);
        const Surface master = make_surface(model_, parts, contact_.master, options);
        TieSearch search = find_tied_points(slave, master, contact_, model_.nodes.position);
        ties_.emplace(contact_, model_, slave, master, std::move(search.points));
    }
    if (contact_.tie.failure == 4) return;
    number_.resize(model_.nodes.size(), none);
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) number_[mesh_.nodes[i].node] = static_cast<Index>(i);
    acts_on_again_.resize(mesh_.nodes.size());
    for (Index node : ties_->held_nodes()) hold_back(number_[node]);
}

void SurfaceContact::hold_back(Index number)
{
    acts_on_again_[number] = std::exchange(mesh_.nodes[number].acts_on, std::uint8_t{0});
}

/// Holds the nodes of the first surface that touch within a facet of the second; where they touch its rim,
/// they have to come in first. From the next cycle on they do not touch any more, but their springs pull.
void SurfaceContact::stick(const State& state)
{
    touches().for_each([&](const Touch& touch) {
        const auto& node = mesh_.nodes[touch.node];
        const Facet& facet = mesh_.facets[touch.facet];
        if (stuck_[touch.node] || (node.sides & slave_bit) == 0 || (facet.belongs & master_bit) == 0) return;
        TiedPoint point;
        point.node = node.node;
        for (int i = 0; i < 4; ++i) point.corner[i] = mesh_.nodes[facet.corner[i]].node;
        point.segment = touch.facet;
        point.s = touch.s;
        point.t = touch.t;
        point.size = facet.size;
        const TieFrame frame(TieShape(touch.s, touch.t, facet.triangle()), at_corners(state.position, point));
        const Vec3 offset = state.position[point.node] - frame.place;
        point.height = dot(offset, frame.normal);
        if (norm(offset - point.height * frame.normal) > 1e-6 * facet.size) return;
        double area = 0;
        for (const Index own : mesh_.facets_at_node(touch.node)) {
            const Facet& beside = mesh_.facets[own];
            const auto corner = [&](int i) { return motion_.position[beside.corner[i]]; };
            const Vec3 normal = cross(corner(2) - corner(0), corner(3) - corner(1));
            if (std::abs(dot(normal, touch.normal)) < 0.5 * norm(normal)) continue; // the side of a block
            area += beside.size * beside.size / (beside.triangle() ? 3 : 4);
        }
        if (area == 0) area = facet.size * facet.size; // a lone node stands for a segment
        const double side = dot(touch.normal, frame.normal) < 0 ? -1 : 1;
        ties_->hold(point, side, unscaled_stiffness(contact_.penalty_option, node.stiffness, facet.stiffness),
                    area, state);
        stuck_[touch.node] = 1;
        hold_back(touch.node);
        search_.leave_out(touch.node);
    });
}

void SurfaceContact::pull_ties(const Clock& clock, State& state)
{
    ties_->add_forces(clock, state);
    if (ties_->released().empty() || number_.empty()) return;
    for (Index node : ties_->released()) {
        const Index number = number_[node];
        if (mass_[number] > 0) mesh_.nodes[number].acts_on = acts_on_again_[number];
    }
    search_.forget();
}

/// Particles that wait in solids touch nothing.
void SurfaceContact::hold_back_waiting()
{
    std::vector<bool> waits(model_.nodes.size());
    for (Index particle = model_.stand_ins.front().first;
         particle < static_cast<Index>(model_.particles.size()); ++particle)
        waits[model_.particles.node[particle]] = true;
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
        if (!waits[mesh_.nodes[i].node]) continue;
        waiting_.emplace_back(static_cast<Index>(i), std::exchange(mesh_.nodes[i].acts_on, std::uint8_t{0}));
    }
}

/// Those that have got a mass touch like all others; nodes that have given theirs away, and particles that
/// have left the run, touch nothing.
void SurfaceContact::wake_particles(const State& state)
{
    for (const auto& [number, acts_on] : waiting_) {
        mass_[number] = state.mass[mesh_.nodes[number].node];
        if (mass_[number] > 0) mesh_.nodes[number].acts_on = acts_on;
    }
    for (std::size_t i = 0; i < weighty_.size(); ++i) {
        if (weighty_[i] && state.mass[mesh_.nodes[i].node] == 0) mesh_.nodes[i].acts_on = 0;
    }
}

/// Nodes of rigid bodies have no mass in the State: there the mass of their elements serves.
void SurfaceContact::take_masses(const State& state)
{
    mass_.resize(mesh_.nodes.size());
    if (model_.particles.size() > 0) weighty_.resize(mesh_.nodes.size());
    for (std::size_t i = 0; i < mass_.size(); ++i) {
        const Index node = mesh_.nodes[i].node;
        if (!weighty_.empty()) weighty_[i] = state.mass[node] > 0;
        mass_[i] = state.mass[node] > 0 ? state.mass[node] : lumped_[node];
        if (mass_[i] == 0 && std::exchange(mesh_.nodes[i].acts_on, std::uint8_t{0}) != 0) search_.forget();
        const Index part = mesh_.nodes[i].part;
        if (part != none) rigid_[part].mass += mass_[i];
    }
    if (facing_ && contact_.stiffness_of_nodes) weigh_segments();
    lumped_ = {};
}

void SurfaceContact::follow_erosion(const State& state)
{
    const bool known = state.deletions == deletions_seen_;
    if (known && !restarted_) return;
    if (!known) search_.forget();
    if (!known && facing_) facing_->forget();
    restarted_ = false;
    deletions_seen_ = state.deletions;
    if (model_.particles.size() > 0) wake_particles(state);
    mesh_.update_exposed(state);
}

/// Finds and follows touches, and sums up what they do.
void SurfaceContact::find_touches()
{
    constexpr std::size_t owners_at_once = 512; // their touches stay in second-level cache
    PairList& pairs = search_.pairs();
    if (searches_seen_ != search_.searches()) table_.set_owners(pairs.owner);
    searches_seen_ = search_.searches();
    touching_now_ = 0;
    const TouchFinder finder(mesh_, motion_, contact_.square_edges);
    for_chunks_in_order<Room>(
        pairs.owner.size(), owners_at_once,
        [&](Room& room, std::size_t begin, std::size_t end) {
            finder.find(pairs, begin, end, table_, room.finder);
            press(begin, end, finder, room);
        },
        [&](const Room& room) {
            touching_now_ += room.pressed.touches;
            energy_.friction += room.pressed.friction;
            sum_up(room.pressed);
        });
    sum_up_facing();
}

/// SOFT = 0: SLSFAC times the stiffness by PENOPT. SOFT = 1: at least what the smallest mass bears. SOFT = 2:
/// what the masses of node and segment bear together, SLSFAC SFS m1 m2 / (m1 + m2) / (2 dt^2) (keyword
/// manual, *CONTACT, SOFT = 2); without it where SOFT = 2 has no step yet, the penalty serves.
double SurfaceContact::stiffness_of(Index node, Index number) const
{
    const Facet& facet = mesh_.facets[number];
    const double penalty =
        contact_.penalty_scale *
        unscaled_stiffness(contact_.penalty_option, mesh_.nodes[node].stiffness, facet.stiffness);
    if (contact_.soft == 0 || soft_step_ == 0) return penalty;
    const double own = mass_[node], step2 = soft_step_ * soft_step_;
    if (contact_.soft == 2) {
        double segment = 0;
        for (Index corner : facet.corner) segment += 0.25 * mass_[corner];
        const ContactSide& side = (facet.belongs & master_bit) != 0 ? contact_.master : contact_.slave;
        const double scale = 0.5 * contact_.penalty_scale * side.stiffness_scale;
        return segment > 0 ? scale * own * segment / (own + segment) / step2 : scale * own / step2;
    }
    double smallest = own;
    for (Index corner : facet.corner) smallest = std::min(smallest, mass_[corner]);
    return std::max(penalty, 0.5 * contact_.soft_scale * smallest / step2);
}

const Friction& SurfaceContact::friction_of(Index node, Index facet, Friction& mixed) const
{
    if (contact_.static_friction != -1) return frictions_.front(); // that of all
    const auto of_part = [&](Index part) -> const Friction& {
        return part == none ? frictions_.back() : frictions_[part];
    };
    const Friction& own = of_part(mesh_.nodes[node].part);
    const Friction& other = of_part(mesh_.facets[facet].part);
    mixed = {0.5 * (own.at_rest + other.at_rest), 0.5 * (own.moving + other.moving),
             0.5 * (own.decay + other.decay), 0.5 * (own.shear_cap + other.shear_cap)};
    return mixed;
}

/// Nothing touches, and the next touches are looked for anew.
void SurfaceContact::rest()
{
    search_.forget();
    if (facing_) facing_->clear();
    table_.clear();
    touching_now_ = 0;
}

/// Adds the work of forces of both sides over half a step, from their powers by chunk.
void SurfaceContact::take_work(const Clock& clock, std::span<const double> slave,
                               std::span<const double> master)
{
    for (const double power : slave) energy_.slave -= 0.5 * clock.last_step * power;
    for (const double power : master) energy_.master -= 0.5 * clock.last_step * power;
}

/// Loads where the nodes are now and how they came there, and with these velocities takes the second half of
/// the work of the forces at n-1, which are no longer needed then.
void SurfaceContact::move_on(const Clock& clock, const State& state)
{
    const std::size_t count = sum_.size();
    std::vector<double> slave((count + chunk_length - 1) / chunk_length), master(slave.size());
    motion_.load(mesh_, clock, state, [&](std::size_t begin, std::size_t end) {
        if (!summed_) return;
        const Vec3* velocity = motion_.velocity.data();
        double power[2] = {};
        for (std::size_t i = begin; i < end; ++i) {
            power[kind_[i] & slave_node] += dot(sum_[i].force, velocity[i]);
            sum_[i] = NodeSum{};
        }
        slave[begin / chunk_length] = power[1];
        master[begin / chunk_length] = power[0];
    });
    if (summed_) take_work(clock, slave, master);
    summed_ = false;
}

void SurfaceContact::add_forces(const Clock& clock, State& state)
{
    if (mass_.empty()) take_masses(state);
    vote_ = ties_ ? ties_->vote() : StepVote::nothing();
    if (ties_) pull_ties(clock, state);
    if (!active(clock)) {
        if (summed_) move_on(clock, state);
        rest();
        return;
    }
    follow_erosion(state);
    move_on(clock, state);
    const double longest = contact_.soft_step > 0 ? contact_.soft_step : clock.last_step;
    soft_changed_ = contact_.soft != 0 && longest > soft_step_;
    soft_step_ = std::max(soft_step_, longest);
    const std::vector<std::uint8_t>* nodes = nullptr;
    if (facing_) {
        const long searches = facing_->searches();
        energy_.friction += facing_->find(motion_, soft_step_);
        nodes = &facing_->sharp_nodes();
        if (facing_->searches() != searches) search_.narrow(mesh_, *nodes); // other nodes may be sharp
    }
    search_.update(mesh_, motion_, nodes);
    find_touches();
    if (sticks_) stick(state);
    if (contact_.constraint || nothing_touches()) return;
    add_to(clock, state);
}

void SurfaceContact::constrain(const Clock& clock, State& state)
{
    if (!contact_.constraint || !active(clock) || nothing_touches()) return;
    set_constraint_forces(clock, state);
    add_to(clock, state);
}

/// Forces that leave each touching node on its facet at n+1: the penetration that velocities and forces so
/// far lead to, over the step and the inverse masses of node and facet (Taylor and Flanagan 1987, 'PRONTO
/// 2D', contact; Hallquist 2006, 'Kinematic constraint method'). The mass of a corner is shared by the
/// touches on it in proportion to their shares, so that all together do not overdo it. Impacts are plastic,
/// as LS-DYNA's.
void SurfaceContact::set_constraint_forces(const Clock& clock, State& state)
{
    const auto inverse_mass = [&](Index node) {
        const double mass = state.mass[mesh_.nodes[node].node];
        return mass > 0 ? 1 / mass : 0;
    };
    const auto next_velocity = [&](Index node) {
        return motion_.velocity[node] +
               (clock.velocity_step() * inverse_mass(node)) * state.force[mesh_.nodes[node].node];
    };
    std::vector<double> taken(mesh_.nodes.size());
    touches().for_each([&](const Touch& touch) {
        const auto share = shares(touch);
        for (int i = 0; i < 4; ++i) taken[mesh_.facets[touch.facet].corner[i]] += share[i];
    });
    const auto take = [&](std::size_t owner, int layer) {
        const Touch touch = table_.touch(mesh_, motion_, owner, layer);
        const Facet& facet = mesh_.facets[touch.facet];
        const auto share = shares(touch);
        const auto set = [&](TouchTable::Field field, double value) {
            table_.value(field, layer, owner) = value;
        };
        Vec3 velocity = next_velocity(touch.node), friction_now{};
        double inverse = inverse_mass(touch.node), normal_force = 0;
        for (int i = 0; i < 4; ++i) {
            velocity -= share[i] * next_velocity(facet.corner[i]);
            inverse += share[i] * taken[facet.corner[i]] * inverse_mass(facet.corner[i]);
        }
        const double along = dot(velocity, touch.normal);
        const double ahead = touch.active_penetration() - clock.step * along;
        if (ahead > 0 && inverse > 0) {
            normal_force = ahead / (clock.step * clock.velocity_step() * inverse);
            Friction mixed;
            const Friction& friction = friction_of(touch.node, touch.facet, mixed);
            const Vec3 slip = velocity - along * touch.normal;
            const double speed = norm(slip);
            if (friction.any() && speed > 0) {
                const double limit = contact_.friction_scale * friction.coefficient(speed) * normal_force;
                const double stop = speed / (clock.velocity_step() * inverse);
                friction_now = (-std::min(limit, stop) / speed) * slip;
            }
        }
        set(TouchTable::pressing, normal_force);
        if (table_.with_friction()) {
            set(TouchTable::friction_x, friction_now.x);
            set(TouchTable::friction_y, friction_now.y);
            set(TouchTable::friction_z, friction_now.z);
        }
        const Vec3 force = normal_force * touch.normal + friction_now;
        sum_[touch.node].force += force;
        for (int i = 0; i < 4; ++i) sum_[facet.corner[i]].force -= share[i] * force;
    };
    for (std::size_t owner = 0; owner < table_.owners(); ++owner)
        for (int layer = 0; layer < table_.count(owner); ++layer) take(owner, layer);
}

void SurfaceContact::sum_up_facing()
{
    if (!facing_) return;
    for (const FacingTouch& touch : facing_->touches()) {
        const auto put = [&](Index facet, const std::array<Vec3, 4>& force,
                             const std::array<double, 4>& share) {
            for (int i = 0; i < 4; ++i) {
                NodeSum& corner = sum_[mesh_.facets[facet].corner[i]];
                corner.force += force[i];
                corner.stiffness += share[i] * facing_->step_stiffness(touch);
            }
        };
        put(touch.first, touch.on_first, touch.first_share);
        put(touch.second, touch.on_second, touch.second_share);
        for (int i = 0; !rubbed_off_.empty() && i < 4; ++i) {
            const double half = 0.5 * touch.friction_loss;
            rubbed_off_[mesh_.facets[touch.first].corner[i]] += touch.first_share[i] * half;
            rubbed_off_[mesh_.facets[touch.second].corner[i]] += touch.second_share[i] * half;
        }
    }
}

/// Forces to the State; the first half of their work, over the last step (the second: move_on); and the
/// stable step by Gershgorin's bound of the largest frequency of the contact springs on the nodes' masses:
/// omega^2 is at most the largest 2 K_i / m_i, where K_i sums the stiffness with which touches hang on node
/// i.
void SurfaceContact::add_to(const Clock& clock, State& state)
{
    struct Stiffest {
        double stiffness = 0, mass = 1;
        Index at = none;
    };
    const std::size_t count = sum_.size(), chunks = (count + chunk_length - 1) / chunk_length;
    std::vector<Stiffest> stiffest(chunks);
    std::vector<double> slave(chunks), master(chunks);
    for_chunks(count, [&](std::size_t begin, std::size_t end) {
        Stiffest most;
        const Vec3* velocity = motion_.velocity.data();
        double power[2] = {};
        for (std::size_t i = begin; i < end; ++i) {
            const NodeSum& sum = sum_[i];
            if (sum.stiffness == 0 && dot(sum.force, sum.force) == 0) continue;
            power[kind_[i] & slave_node] += dot(sum.force, velocity[i]);
            state.force[mesh_.state_node(i)] += sum.force;
            if (kind_[i] & rigid_node) continue; // votes with its body
            if (sum.stiffness * most.mass > most.stiffness * mass_[i] && mass_[i] > 0)
                most = {sum.stiffness, mass_[i], static_cast<Index>(i)};
        }
        stiffest[begin / chunk_length] = most;
        slave[begin / chunk_length] = power[1];
        master[begin / chunk_length] = power[0];
    });
    take_work(clock, slave, master);
    summed_ = true;
    Stiffest whole;
    for (const Stiffest& one : stiffest)
        if (one.stiffness * whole.mass > whole.stiffness * one.mass) whole = one;
    add_rigid_votes();
    if (whole.at == none) return;
    const double step = 2 / std::sqrt(2 * whole.stiffness / whole.mass);
    if (step > vote_.step) return;
    const ContactMesh::Node& node = mesh_.nodes[whole.at];
    vote_ = {step, "contact at node", model_.nodes.id[node.node], 0};
    if (node.part != none) vote_.part = model_.parts[node.part].id;
}

/// A rigid body swings on all of its touches together; about an axis with at most four times the frequency of
/// its translation, as springs at radius r act against an inertia of at least m r^2 / 4.
void SurfaceContact::add_rigid_votes()
{
    bool any = false;
    for (RigidPart& part : rigid_) {
        part.stiffness = 0;
        any = any || (part.rigid && part.mass > 0);
    }
    if (!any) return;
    for (std::size_t i = 0; i < sum_.size(); ++i)
        if (kind_[i] & rigid_node) rigid_[mesh_.nodes[i].part].stiffness += sum_[i].stiffness;
    for (std::size_t part = 0; part < rigid_.size(); ++part) {
        if (!(rigid_[part].stiffness > 0) || !(rigid_[part].mass > 0)) continue;
        const double step = 2 / std::sqrt(4 * rigid_[part].stiffness / rigid_[part].mass);
        if (step < vote_.step)
            vote_ = {step, "contact of rigid part", model_.parts[part].id, model_.parts[part].id};
    }
}

/// The first cycle goes on with the pairs that are found here; where segments press on segments, with those
/// of the few nodes that are left to look at.
std::vector<std::string> SurfaceContact::notices(const State& state) const
{
    if (contact_.birth > 0) return {};
    return describe(initial_penetrations(contact_, mesh_, search_, state), contact_, mesh_, model_);
}

void SurfaceContact::serialise(Archive& archive)
{
    if (facing_) facing_->serialise(archive);
    archive(mass_, weighty_, motion_.travelled, sum_, summed_, deletions_seen_, soft_step_, energy_, stuck_,
            rubbed_off_, touching_now_);
    search_.serialise(archive);
    if (archive.loading() && ties_ && !number_.empty())
        for (Index node : ties_->held_nodes())
            mesh_.nodes[number_[node]].acts_on = acts_on_again_[number_[node]];
    if (ties_) ties_->serialise(archive);
    if (archive.loading() && ties_ && !number_.empty())
        for (Index node : ties_->held_nodes()) hold_back(number_[node]);
    table_.serialise(archive);
    if (!archive.loading()) return;
    searches_seen_ = search_.searches();
    for (std::size_t i = 0; i < mass_.size(); ++i) {
        if (mass_[i] == 0) mesh_.nodes[i].acts_on = 0;
    }
    if (facing_ && contact_.stiffness_of_nodes && !mass_.empty()) weigh_segments();
    restarted_ = deletions_seen_ > 0;
}

} // namespace plash

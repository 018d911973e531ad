#include "elements/discrete_beams.h"

#include "core/run_error.h"
#include "core/smallest_steps.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr int axial = 0, shear_s = 1, shear_t = 2, torsion = 3, moment_s = 4, moment_t = 5;

bool any_turning(const DiscreteFreedoms& values)
{
    return values[torsion] != 0 || values[moment_s] != 0 || values[moment_t] != 0;
}

} // namespace

DiscreteBeams::DiscreteBeams(const BeamPart& its, State& state) : model_(its.model), part_(its.part)
{
    const Part& part = model_.parts[part_];
    const Record& material = model_.materials[part.material];
    law_ = make_discrete_beam_law(material, model_);
    read_section(model_.sections[part.section]);
    for (Index element : its.elements) {
        Beam beam;
        beam.element = element;
        beam.node1 = model_.beams.nodes[element][0];
        beam.node2 = model_.beams.nodes[element][1];
        const Vec3 side = model_.nodes.position[beam.node2] - model_.nodes.position[beam.node1];
        DiscreteBeamPoint point;
        point.length = point.start_length = norm(side);
        if (law_->along_nodes) {
            if (point.length == 0) {
                throw DeckError(part.where,
                                fmt::format("beam {} of part {} has no length, but *{} acts along it",
                                            model_.beams.id[element], part.id, material.keyword));
            }
            beam.axes[0] = unit(side);
            if (law_->cable && point.length <= law_->length_offset) {
                reject_field(model_.sections[part.section], "OFFSET/DOFN2",
                             fmt::format("{} leaves nothing of the length {} of beam {}", law_->length_offset,
                                         point.length, model_.beams.id[element]));
            }
        } else {
            beam.axes = first_triad(model_, element, rule_);
        }
        beams_.push_back(beam);
        points_.push_back(point);
    }
    change_.resize(beams_.size());
    const bool turns = inertia_ > 0 || rule_.balances() || any_turning(law_->stiffness(points_[0])) ||
                       any_turning(law_->damping(points_[0]));
    if (turns && !law_->along_nodes) state.need_rotation();
    for (std::size_t i = 0; i < beams_.size(); ++i) {
        for (Index node : {beams_[i].node1, beams_[i].node2}) {
            state.mass[node] += 0.5 * mass_of(beams_[i], points_[i]);
            if (inertia_ > 0 && state.rotational()) state.inertia[node] += 0.5 * inertia_;
        }
    }
}

double discrete_beam_volume(const Record& section)
{
    const double volume = section.real("VOL");
    if (volume < 0) reject_field(section, "VOL", "the volume is negative");
    return volume;
}

void DiscreteBeams::read_section(const Record& section)
{
    volume_ = discrete_beam_volume(section);
    inertia_ = section.real("INER");
    if (inertia_ < 0) reject_field(section, "INER", "the inertia is negative");
    law_->area = section.real("CA/DOFN1");
    law_->length_offset = section.real("OFFSET/DOFN2");
    if (law_->cable) {
        positive(section, "CA/DOFN1", "cross-sectional area of the cable");
    } else if (law_->along_nodes) {
        law_->length_offset = 0;
    }
    const double scoor = section.real("SCOOR");
    rule_.scoor = static_cast<int>(std::lround(scoor));
    const int magnitude = rule_.magnitude();
    const bool known = magnitude <= 3 || magnitude == 12 || magnitude == 13;
    if (!known || rule_.scoor != scoor)
        reject_field(section, "SCOOR", fmt::format("{} is none of 0, +-1, +-2, +-3, +-12, +-13", scoor));
    const Id system = section.integer("CID");
    if (system != 0) {
        for (std::size_t i = 0; i < model_.coordinate_systems.size(); ++i) {
            if (model_.coordinate_systems[i].id == system) rule_.system = static_cast<Index>(i);
        }
        if (rule_.system == none)
            reject_field(section, "CID", fmt::format("there is no coordinate system {}", system));
    }
    constexpr const char* held[] = {"RRCON/NULL", "SRCON/NULL", "TRCON/NULL"};
    for (int axis = 0; axis < 3; ++axis) rule_.held[axis] = section.real(held[axis]) == 1;
}

double DiscreteBeams::mass_of(const Beam& beam, const DiscreteBeamPoint& point) const
{
    const double volume = law_->cable && volume_ == 0 ? law_->area * point.start_length : volume_;
    return beam.mass_factor * law_->density * volume;
}

void DiscreteBeams::add_forces(const Clock& clock, State& state)
{
    for (std::size_t i = 0; i < beams_.size(); ++i) {
        if (beams_[i].deleted) continue;
        if (law_->along_nodes)
            follow_line(clock, state, i);
        else
            follow_axes(clock, state, i);
        const DiscreteFreedoms& before = points_[i].force;
        for (int freedom = 0; freedom < 6; ++freedom)
            beams_[i].energy += 0.5 * before[freedom] * change_[i][freedom];
    }
    law_->advance(points_, clock.time, clock.last_step);
    vote_ = StepVote::nothing();
    for (std::size_t i = 0; i < beams_.size(); ++i) {
        Beam& beam = beams_[i];
        if (beam.deleted) continue;
        DiscreteBeamPoint& point = points_[i];
        if (point.failed) point.force = {}; // it does not act on the nodes any more
        for (int freedom = 0; freedom < 6; ++freedom)
            beam.energy += 0.5 * point.force[freedom] * change_[i][freedom];
        if (!std::isfinite(beam.energy)) {
            throw RunError(fmt::format("beam {} of part {} '{}' has an energy that is no finite number",
                                       model_.beams.id[beam.element], model_.parts[part_].id,
                                       model_.parts[part_].title));
        }
        if (point.failed) {
            beam.deleted = true;
            eroded_ += beam.energy;
            state.deleted_beams.resize(model_.beams.size());
            state.deleted_beams[beam.element] = 1;
            ++state.deletions;
            continue;
        }
        push(beam, point, state);
        const double step = stable_step_of(beam, point, state);
        if (step < vote_.step) vote_ = {step, "beam", model_.beams.id[beam.element], model_.parts[part_].id};
    }
}

/// Ways and rates along the line between the nodes.
void DiscreteBeams::follow_line(const Clock& clock, const State& state, std::size_t place)
{
    Beam& beam = beams_[place];
    DiscreteBeamPoint& point = points_[place];
    const Vec3 side = state.position[beam.node2] - state.position[beam.node1];
    const Vec3 velocity = state.velocity[beam.node2] - state.velocity[beam.node1];
    point.length = norm(side);
    if (point.length > 0) beam.axes[0] = (1 / point.length) * side;
    point.rate[axial] = dot(velocity, unit(side - (0.5 * clock.last_step) * velocity));
    const double way = point.length - point.start_length;
    change_[place] = {way - point.way[axial]};
    point.way[axial] = way;
}

/// Ways and rates in the local axes of mid-step.
void DiscreteBeams::follow_axes(const Clock& clock, const State& state, std::size_t place)
{
    Beam& beam = beams_[place];
    DiscreteBeamPoint& point = points_[place];
    const double step = clock.last_step;
    TriadEnds ends;
    ends.side = state.position[beam.node2] - state.position[beam.node1];
    ends.velocity = state.velocity[beam.node2] - state.velocity[beam.node1];
    if (state.rotational()) {
        ends.first_spin = state.angular_velocity[beam.node1];
        ends.second_spin = state.angular_velocity[beam.node2];
    }
    const TriadStep triad = turn_triad(beam.axes, rule_, ends, step, model_, state);
    beam.axes = triad.end;
    point.length = norm(ends.side);
    Vec3 velocity = ends.velocity;
    if (rule_.balances()) {
        const Vec3 middle = ends.side - (0.5 * step) * ends.velocity;
        velocity -= cross(0.5 * (ends.first_spin + ends.second_spin), middle);
    }
    const Vec3 spin = ends.second_spin - ends.first_spin;
    for (int axis = 0; axis < 3; ++axis) {
        point.rate[axis] = dot(velocity, triad.middle[axis]);
        point.rate[3 + axis] = dot(spin, triad.middle[axis]);
    }
    for (int freedom = 0; freedom < 6; ++freedom) {
        change_[place][freedom] = step * point.rate[freedom];
        point.way[freedom] += change_[place][freedom];
    }
}

void DiscreteBeams::push(const Beam& beam, const DiscreteBeamPoint& point, State& state) const
{
    Vec3 pull = point.force[axial] * beam.axes[0];
    if (!law_->along_nodes) pull += point.force[shear_s] * beam.axes[1] + point.force[shear_t] * beam.axes[2];
    state.force[beam.node1] += pull;
    state.force[beam.node2] -= pull;
    if (law_->along_nodes || !state.rotational()) return;
    const Vec3 moment = point.force[torsion] * beam.axes[0] + point.force[moment_s] * beam.axes[1] +
                        point.force[moment_t] * beam.axes[2];
    state.moment[beam.node1] += moment;
    state.moment[beam.node2] -= moment;
    if (!rule_.balances()) return;
    const Vec3 side = state.position[beam.node2] - state.position[beam.node1];
    const Vec3 half = 0.5 * cross(side, pull);
    state.moment[beam.node1] += half;
    state.moment[beam.node2] += half;
}

/// Of the fastest freedom with the beam's own mass, or that of its nodes where it has none: damped central
/// difference is stable up to 2 / omega (sqrt(1 + xi^2) - xi).
double DiscreteBeams::stable_step_of(const Beam& beam, const DiscreteBeamPoint& point,
                                     const State& state) const
{
    const auto softness = [&](const std::vector<double>& masses, double own) {
        if (own > 0) return 4 / own; // two halves
        const auto one = [&](Index node) {
            return masses.empty() || masses[node] == 0 ? 0.0 : 1 / masses[node];
        };
        return one(beam.node1) + one(beam.node2);
    };
    const double along = softness(state.mass, mass_of(beam, point));
    const double about = law_->along_nodes ? 0 : softness(state.inertia, beam.mass_factor * inertia_);
    // Shear forces turn the ends besides: half the length is their lever on both.
    const double across = along + (rule_.balances() ? 0.25 * point.length * point.length * about : 0);
    const DiscreteFreedoms stiffness = law_->stiffness(point), damping = law_->damping(point);
    double smallest = std::numeric_limits<double>::infinity();
    for (int freedom = 0; freedom < 6; ++freedom) {
        const double inverse = freedom == axial ? along : freedom < 3 ? across : about;
        const double square = stiffness[freedom] * inverse, rate = 0.5 * damping[freedom] * inverse;
        // 2 (sqrt(omega^2 + d^2) - d) / omega^2 with d = xi omega, written so that omega may be zero
        const double sum = std::sqrt(square + rate * rate) + rate;
        if (sum > 0) smallest = std::min(smallest, 2 / sum);
    }
    return smallest;
}

double DiscreteBeams::scale_mass(double step, bool only_small, State& state)
{
    double added = 0;
    for (std::size_t i = 0; i < beams_.size(); ++i) {
        Beam& beam = beams_[i];
        const double own = stable_step_of(beam, points_[i], state);
        const double mass = mass_of(beam, points_[i]);
        if (mass == 0 || !std::isfinite(own) || (only_small && own >= step)) continue;
        const double factor = (step / own) * (step / own);
        for (Index node : {beam.node1, beam.node2}) {
            state.mass[node] += 0.5 * (factor - 1) * mass;
            if (inertia_ > 0 && state.rotational())
                state.inertia[node] += 0.5 * (factor - 1) * beam.mass_factor * inertia_;
        }
        added += (factor - 1) * mass;
        beam.mass_factor *= factor;
    }
    return added;
}

void DiscreteBeams::report(EnergyLedger& ledger) const
{
    double internal = 0;
    for (const Beam& beam : beams_) {
        if (!beam.deleted) internal += beam.energy;
    }
    ledger.add_part(part_, internal, 0);
    ledger.eroded_internal += eroded_;
}

void DiscreteBeams::collect(const State& state, ElementResults& results) const
{
    for (std::size_t i = 0; i < beams_.size(); ++i) {
        const Beam& beam = beams_[i];
        const DiscreteBeamPoint& point = points_[i];
        const Index row = results.row_of_beam(beam.element);
        if (row != none && !results.beam_deleted.empty()) results.beam_deleted[row] = beam.deleted;
        if (beam.deleted) continue;
        const DiscreteFreedoms& force = point.force;
        if (row != none && !results.beams.empty()) {
            results.beams[row] = {force[axial],
                                  force[shear_s],
                                  force[shear_t],
                                  force[moment_s],
                                  force[moment_t],
                                  force[torsion],
                                  0,
                                  point.length,
                                  0};
        }
        if (results.springs_wanted)
            results.discrete_beams.push_back({beam.element, point.way, point.force, beam.axes});
        if (results.steps_wanted) {
            add_step(results, {"beam", model_.beams.id[beam.element], model_.parts[part_].id,
                               stable_step_of(beam, point, state)});
        }
        if (results.part_motion.empty()) continue;
        ElementResults::PartMotion& motion = results.part_motion[part_];
        for (Index node : {beam.node1, beam.node2}) {
            const double mass = 0.5 * mass_of(beam, point);
            const Vec3& velocity = state.velocity[node];
            motion.mass += mass;
            motion.kinetic += 0.5 * mass * dot(velocity, velocity);
            motion.momentum[0] += mass * velocity.x;
            motion.momentum[1] += mass * velocity.y;
            motion.momentum[2] += mass * velocity.z;
        }
    }
    if (!results.part_motion.empty()) results.part_motion[part_].eroded_internal += eroded_;
}

} // namespace plash

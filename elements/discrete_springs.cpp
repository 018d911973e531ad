#include "elements/discrete_springs.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

Springs::Springs(const Model& model) : model_(model), part_energy_(model.parts.size())
{
    std::vector<std::vector<Index>> by_part(model.parts.size());
    for (std::size_t i = 0; i < model.discretes.size(); ++i) {
        by_part[model.discretes.part[i]].push_back(static_cast<Index>(i));
    }
    for (std::size_t part = 0; part < by_part.size(); ++part) {
        if (!by_part[part].empty()) add_part(static_cast<Index>(part), by_part[part]);
    }
}

void Springs::add_part(Index part_index, const std::vector<Index>& elements)
{
    const Part& part = model_.parts[part_index];
    if (part.section == none || model_.sections[part.section].keyword != "SECTION_DISCRETE") {
        throw DeckError(part.where,
                        fmt::format("*PART {} has discrete elements but no *SECTION_DISCRETE", part.id));
    }
    if (part.material == none) {
        throw DeckError(part.where, fmt::format("*PART {} has discrete elements but no material", part.id));
    }
    const Record& record = model_.sections[part.section];
    Section section;
    section.torsional = record.integer("DRO") == 1;
    section.magnification = record.real("KD");
    section.reference_rate = record.real("V0");
    section.failure_deflection = record.real("FD");
    section.clearance = record.real("CL");
    if (section.clearance < 0) reject_field(record, "CL", "the clearance is negative");
    if (section.clearance > 0 && section.torsional)
        reject_field(record, "CL", "torsional springs with a clearance are not supported");
    for (const char* field : {"CDL", "TDL"}) {
        if (record.real(field) != 0) reject_field(record, field, "deflection limits are not supported");
    }
    if (section.magnification != 0 && !(section.reference_rate > 0)) {
        reject_field(record, "V0", "the dynamic magnification KD needs a test velocity");
    }
    torsional_ = torsional_ || section.torsional;
    laws_.push_back(DiscreteLaw::from_record(model_.materials[part.material], model_));
    sections_.push_back(section);
    for (Index element : elements) {
        Spring spring;
        spring.element = element;
        spring.node1 = model_.discretes.nodes[element][0];
        spring.node2 = model_.discretes.nodes[element][1];
        if (spring.node1 == none) std::swap(spring.node1, spring.node2);
        spring.law = static_cast<Index>(laws_.size()) - 1;
        spring.section = static_cast<Index>(sections_.size()) - 1;
        spring.scale = model_.discretes.scale[element];
        spring.anchor = model_.nodes.position[spring.node1];
        spring.direction = direction_of(element, section.torsional);
        if (spring.node2 != none) {
            const Vec3 side = model_.nodes.position[spring.node2] - model_.nodes.position[spring.node1];
            const bool along_nodes = norm(spring.direction) == 0;
            spring.length = along_nodes ? norm(side) : dot(side, spring.direction);
        }
        spring.angle = section.torsional ? model_.discretes.initial_offset[element] : 0;
        if (!section.torsional) spring.length -= model_.discretes.initial_offset[element];
        springs_.push_back(spring);
    }
}

Vec3 Springs::direction_of(Index element, bool torsional) const
{
    const Id id = model_.discretes.id[element];
    const Part& part = model_.parts[model_.discretes.part[element]];
    const auto& nodes = model_.discretes.nodes[element];
    const Index orientation = model_.discretes.orientation[element];
    if (orientation == none) {
        const bool two = nodes[0] != none && nodes[1] != none;
        const Vec3 side = two ? model_.nodes.position[nodes[1]] - model_.nodes.position[nodes[0]] : Vec3{};
        if (norm(side) == 0) {
            throw DeckError(part.where,
                            fmt::format("discrete element {} of part {} has no direction: its nodes "
                                        "coincide or one is the ground, and VID names none",
                                        id, part.id));
        }
        return torsional ? unit(side) : Vec3{};
    }
    const Record& record = model_.others[orientation];
    const Id option = record.integer("IOP");
    if (option != 0) {
        reject_field(record, "IOP", fmt::format("option {} is not supported (0: a fixed vector)", option));
    }
    const Vec3 vector = unit({record.real("XT"), record.real("YT"), record.real("ZT")});
    if (norm(vector) == 0) reject_field(record, "XT", "the direction is a zero vector");
    return vector;
}

void Springs::add_forces(const Clock& clock, State& state)
{
    vote_ = StepVote::nothing();
    for (Spring& spring : springs_) {
        if (spring.failed) continue;
        const Section& section = sections_[spring.section];
        const DiscreteLaw& law = laws_[spring.law];
        const bool ground = spring.node2 == none;
        const Vec3 side = ground ? spring.anchor - state.position[spring.node1]
                                 : state.position[spring.node2] - state.position[spring.node1];
        const Vec3 along = norm(spring.direction) > 0 ? spring.direction : unit(side);
        const auto& rates = section.torsional ? state.angular_velocity : state.velocity;
        double rate = dot((ground ? Vec3{} : rates[spring.node2]) - rates[spring.node1], along);
        double deflection = 0;
        if (section.torsional) {
            spring.angle += clock.last_step * rate;
            deflection = spring.angle;
        } else {
            const bool along_nodes = norm(spring.direction) == 0;
            deflection = (along_nodes ? norm(side) : dot(side, along)) - spring.length;
            if (section.clearance > 0) { // carries compression alone, once the gap is closed
                deflection = std::min(deflection + section.clearance, 0.0);
                if (deflection == 0) rate = 0;
            }
        }
        const double change = deflection - spring.state.deflection;
        double force = law.advance(spring.state, deflection, rate, clock.last_step);
        if (section.magnification != 0) {
            force *= 1 + section.magnification * std::abs(rate) / section.reference_rate;
        }
        force *= spring.scale;
        if (clock.cycle > 0 || clock.last_step > 0) {
            const double work = 0.5 * (spring.booked_force + force) * change;
            spring.energy += work;
            part_energy_[model_.discretes.part[spring.element]] += work;
        }
        spring.booked_force = force;
        spring.along = along;
        if (section.failure_deflection != 0 && std::abs(deflection) > std::abs(section.failure_deflection)) {
            spring.failed = true;
            continue;
        }
        auto& forces = section.torsional ? state.moment : state.force;
        forces[spring.node1] += force * along;
        if (!ground) forces[spring.node2] -= force * along;

        const auto& masses = section.torsional ? state.inertia : state.mass;
        const auto softness = [&](Index node) { return masses[node] > 0 ? 1 / masses[node] : 0.0; };
        const double inverse = softness(spring.node1) + (ground ? 0 : softness(spring.node2));
        const double stiffness = spring.scale * law.largest_stiffness;
        if (!(stiffness * inverse > 0)) continue;
        const double step = 2 / std::sqrt(stiffness * inverse);
        if (step < vote_.step) {
            vote_ = {step, "discrete", model_.discretes.id[spring.element],
                     model_.parts[model_.discretes.part[spring.element]].id};
        }
    }
}

void Springs::report(EnergyLedger& ledger) const
{
    for (std::size_t part = 0; part < part_energy_.size(); ++part) {
        if (part_energy_[part] != 0) ledger.add_part(static_cast<int>(part), part_energy_[part], 0);
        ledger.springs += part_energy_[part];
    }
}

void Springs::collect(const State&, ElementResults& results) const
{
    if (!results.springs_wanted) return;
    for (const Spring& spring : springs_) {
        ElementResults::SpringState state{spring.element, sections_[spring.section].torsional, {}, 0, 0};
        if (!spring.failed) {
            state.force = spring.booked_force * spring.along;
            state.magnitude = spring.booked_force;
            state.deflection = spring.state.deflection;
        }
        results.springs.push_back(state);
    }
}

std::unique_ptr<Term> make_springs(const Model& model, State& state)
{
    if (model.discretes.size() == 0) return nullptr;
    auto springs = std::make_unique<Springs>(model);
    if (springs->torsional()) state.need_rotation();
    return springs;
}

} // namespace plash

#include "rigid/part_switches.h"

#include "rigid/deck_nodes.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace plash {

namespace {

constexpr std::string_view switch_keyword = "DEFORMABLE_TO_RIGID_AUTOMATIC";

/// A line of the D2R or R2D cards, or a card of *DEFORMABLE_TO_RIGID.
struct NamedParts {
    std::vector<Index> parts;
    Id lead = 0;
    Location where;
};

std::vector<Index> parts_named(const Model& model, Id id, std::string_view kind, const Location& where)
{
    if (kind == "PSET") {
        for (const PartSet& set : model.part_sets)
            if (set.id == id) return set.parts;
        throw DeckError(where, fmt::format("*{}, field PID: there is no part set {}", switch_keyword, id));
    }
    for (std::size_t part = 0; part < model.parts.size(); ++part)
        if (model.parts[part].id == id) return {static_cast<Index>(part)};
    throw DeckError(where, fmt::format("*{}, field PID: there is no part {}", switch_keyword, id));
}

/// D2R cards have three columns (PID LRB PTYPE), R2D cards two (PID PTYPE).
std::vector<NamedParts> named_parts(const Model& model, const Record& record, std::size_t columns)
{
    std::vector<NamedParts> lines;
    for (const Table& table : record.tables) {
        if (table.columns.size() != columns) continue;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const Location where{record.where.file, table.lines[row]};
            const std::string& kind = table.text[(row + 1) * columns - 1];
            const Id lead = columns == 3 ? static_cast<Id>(table.at(row, 1)) : 0;
            lines.push_back(
                {parts_named(model, static_cast<Id>(table.at(row, 0)), kind, where), lead, where});
        }
    }
    return lines;
}

/// Makes the bodies that switches engage and release.
class BodyMaker {
public:
    BodyMaker(const Model& model, const State& state, std::vector<RigidBody>& bodies)
        : model_(model), state_(state), bodies_(bodies), owner_(state.size(), none), held_(state.size())
    {
        for (std::size_t body = 0; body < bodies.size(); ++body)
            for (Index node : bodies[body].nodes) owner_[node] = static_cast<Index>(body);
        for (const FixedNodes& fixed : model.fixed_nodes)
            for (Index node : fixed.nodes) held_[node] = true;
        for (const PrescribedMotion& motion : model.prescribed_motions)
            for (Index node : motion.nodes) held_[node] = true;
    }

    /// The bodies of some lines: parts with one lead make one with it, others one each.
    std::vector<Index> bodies_of(const std::vector<NamedParts>& lines)
    {
        std::map<Id, std::vector<Index>> led;
        std::map<Id, Location> where;
        for (const NamedParts& line : lines)
            for (Index part : line.parts) {
                const Id lead = line.lead == 0 ? model_.parts[part].id : line.lead;
                led[lead].push_back(part);
                where.try_emplace(lead, line.where);
            }
        std::vector<Index> found;
        for (auto& [lead, parts] : led) {
            const bool there = std::any_of(parts.begin(), parts.end(),
                                           [&](Index part) { return model_.parts[part].id == lead; });
            if (!there) {
                throw DeckError(where[lead],
                                fmt::format("field LRB: part {} does not become rigid by the same "
                                            "cards; parts can only be merged to one that does",
                                            lead));
            }
            std::sort(parts.begin(), parts.end());
            parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
            const auto [known, added] = body_of_.try_emplace(parts, static_cast<Index>(bodies_.size()));
            if (added) add_body(parts, where[lead]);
            found.push_back(known->second);
        }
        return found;
    }

    /// The bodies that parts are of; all parts of a body have to be among them.
    std::vector<Index> bodies_to_release(const std::vector<NamedParts>& lines) const
    {
        std::vector<bool> free(model_.parts.size());
        for (const NamedParts& line : lines)
            for (Index part : line.parts) free[part] = true;
        std::vector<Index> found;
        for (const auto& [parts, body] : body_of_) {
            const auto count =
                std::count_if(parts.begin(), parts.end(), [&](Index part) { return bool(free[part]); });
            if (count == 0) continue;
            if (count < static_cast<std::ptrdiff_t>(parts.size())) {
                throw DeckError(lines.front().where,
                                fmt::format("parts that are merged to part {} are set free one by one; the "
                                            "R2D cards have to name all of a body",
                                            model_.parts[parts.front()].id));
            }
            found.push_back(body);
        }
        return found;
    }

    /// All bodies, and the parts of each.
    const std::map<std::vector<Index>, Index>& all() const { return body_of_; }

private:
    const Model& model_;
    const State& state_;
    std::vector<RigidBody>& bodies_;
    std::vector<Index> owner_; ///< by node: its body
    std::vector<bool> held_;
    std::map<std::vector<Index>, Index> body_of_; ///< by parts

    void add_body(const std::vector<Index>& parts, const Location& where)
    {
        std::vector<bool> wanted(model_.parts.size());
        for (Index part : parts) {
            wanted[part] = true;
            if (model_.is_rigid(part))
                throw DeckError(
                    where, fmt::format("part {} is rigid and cannot be switched", model_.parts[part].id));
        }
        std::vector<Index> nodes;
        for_each_topology(model_, [&](const auto& elements) {
            for (std::size_t i = 0; i < elements.size(); ++i) {
                if (elements.part[i] == none || !wanted[elements.part[i]]) continue;
                for (Index node : elements.nodes[i])
                    if (node != none) nodes.push_back(node);
            }
        });
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        if (nodes.empty())
            throw DeckError(where, fmt::format("part {} has no elements", model_.parts[parts[0]].id));
        std::vector<double> mass, inertia;
        for (Index node : nodes) {
            const auto refuse = [&](std::string_view why) {
                throw DeckError(where, fmt::format("part {} cannot be switched: its node {} {}",
                                                   model_.parts[parts[0]].id, model_.nodes.id[node], why));
            };
            if (owner_[node] != none) refuse("belongs to another rigid body");
            if (held_[node]) refuse("is held or driven");
            if (!(state_.mass[node] > 0)) refuse("has no mass of its own");
            owner_[node] = static_cast<Index>(bodies_.size());
            mass.push_back(state_.mass[node]);
            if (state_.rotational()) inertia.push_back(state_.inertia[node]);
        }
        RigidBody& body = bodies_.emplace_back(rigid_body_of(none, nodes, mass, inertia, state_, {}));
        body.node_mass = std::move(mass);
        body.node_inertia = std::move(inertia);
        body.released = true;
    }
};

PartSwitch read_switch(const Record& record)
{
    PartSwitch one;
    one.id = record.integer("SWSET");
    one.where = record.where;
    const Id code = record.integer("CODE");
    const auto refuse = [&](std::string_view field, const std::string& why) {
        throw DeckError(record.where, fmt::format("*{}, field {}: {}", record.keyword, field, why));
    };
    if (code < 0 || code > 4) refuse("CODE", fmt::format("{} is not supported; 0 to 4 are", code));
    one.code = static_cast<PartSwitch::Code>(code);
    one.from = record.real("TIME1");
    one.to = code == 0 ? forever : value_or(record.real("TIME2"), forever);
    one.delay = record.real("TIME3");
    one.watched = record.integer("ENTNO");
    const Id paired = record.integer("PAIRED");
    if (paired < -1 || paired > 1) refuse("PAIRED", fmt::format("{} is not -1, 0 or 1", paired));
    one.ready = paired != -1;
    for (const char* field : {"NRBF", "NCSF", "RWF"})
        if (record.integer(field) != 0)
            refuse(field, "nodal rigid bodies, constrained sets and walls cannot be switched");
    return one;
}

} // namespace

PartSwitches PartSwitches::read(const Model& model, const State& state, std::vector<RigidBody>& bodies)
{
    PartSwitches result;
    std::vector<const Record*> records;
    for_each_record(model, switch_keyword, [&](const Record& record) { records.push_back(&record); });
    if (records.empty()) return result;
    if (model.controls.relaxation.active() || model.controls.time.selective_mass) {
        throw DeckError(records[0]->where, fmt::format("*{} is not supported beside dynamic relaxation or "
                                                       "selective mass scaling (IMSCL)",
                                                       switch_keyword));
    }
    BodyMaker maker(model, state, bodies);
    std::vector<std::vector<NamedParts>> released;
    std::vector<bool> set_free(model.parts.size());
    for (const Record* record : records) {
        PartSwitch& one = result.switches_.emplace_back(read_switch(*record));
        one.engage = maker.bodies_of(named_parts(model, *record, 3));
        released.push_back(named_parts(model, *record, 2));
        for (const NamedParts& line : released.back())
            for (Index part : line.parts) set_free[part] = true;
    }
    std::vector<NamedParts> at_start;
    for_each_record(model, "DEFORMABLE_TO_RIGID", [&](const Record& record) {
        NamedParts line{parts_named(model, record.integer("PID"), record.text("PTYPE"), record.where),
                        record.integer("LRB"), record.where};
        std::erase_if(line.parts, [&](Index part) { return !set_free[part]; });
        if (!line.parts.empty()) at_start.push_back(std::move(line));
    });
    for (Index body : maker.bodies_of(at_start)) bodies[body].released = false;
    for (std::size_t i = 0; i < records.size(); ++i) {
        PartSwitch& one = result.switches_[i];
        one.release = maker.bodies_to_release(released[i]);
        if (records[i]->integer("PAIRED") == 0) continue;
        const Id wanted = records[i]->integer("RELSW");
        for (std::size_t other = 0; other < result.switches_.size(); ++other)
            if (other != i && result.switches_[other].id == wanted) one.partner = static_cast<Index>(other);
        if (one.partner == none) {
            throw DeckError(one.where,
                            fmt::format("*{}, field RELSW: there is no switch {} to be paired with",
                                        switch_keyword, wanted));
        }
    }
    const bool stressed = std::any_of(model.others.begin(), model.others.end(), [](const Record& record) {
        return record.keyword.starts_with("INITIAL_STRESS");
    });
    result.at_rest_.resize(model.parts.size());
    for (const auto& [parts, body] : maker.all()) {
        result.bodies_.push_back(body);
        result.parts_.push_back(parts);
        for (Index part : parts) result.at_rest_[part] = !bodies[body].released && !stressed;
    }
    return result;
}

std::vector<const PartSwitch*> PartSwitches::act(double time)
{
    std::vector<const PartSwitch*> acting;
    for (PartSwitch& one : switches_) {
        if (!one.ready || time < one.from || time > one.to || time < waits_until_) continue;
        using Code = PartSwitch::Code;
        const bool wants_pressure = one.code == Code::wall_pressed || one.code == Code::contact_pressed;
        if (one.code != Code::time && one.pressed() != wants_pressure) continue;
        one.ready = false;
        if (one.partner != none) switches_[one.partner].ready = true;
        if (one.delay > 0) waits_until_ = time + one.delay;
        acting.push_back(&one);
    }
    return acting;
}

void PartSwitches::wake(Index body)
{
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i] == body)
            for (Index part : parts_[i]) at_rest_[part] = 0;
}

void PartSwitches::serialise(Archive& archive)
{
    for (PartSwitch& one : switches_) archive(one.ready);
    archive(waits_until_, at_rest_);
}

} // namespace plash

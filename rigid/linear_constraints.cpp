#include "rigid/linear_constraints.h"

#include "rigid/deck_nodes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace plash {

namespace {

constexpr double implied_pivot = 1e-9; ///< of a condition that others imply, over its own inverse mass

double& component(std::vector<Vec3>& translation, std::vector<Vec3>& rotation, Index node, int freedom)
{
    return (freedom < 3 ? translation : rotation)[node].*vector_component[freedom % 3];
}

double mass_of(const State& state, Index node, int freedom)
{
    return freedom < 3 ? state.mass[node] : state.inertia[node];
}

} // namespace

LinearConstraints::LinearConstraints(const Model& model, const State& state,
                                     std::vector<const Term*> elements)
    : tied_(model, state, std::move(elements))
{
    read(model);
    read_tied(state);
    mark_driven(model);
    for (const Condition& condition : conditions_) {
        for (const Part& part : condition.parts) {
            if (part.freedom >= 3 && !state.rotational()) {
                throw DeckError(condition.where, fmt::format("node {} has no rotations to constrain",
                                                             model.nodes.id[part.node]));
            }
            if (part.driven || mass_of(state, part.node, part.freedom) > 0) continue;
            throw DeckError(
                condition.where,
                fmt::format("node {} has no mass of its own (nobody or a rigid body moves it): it "
                            "cannot stand in a linear constraint",
                            model.nodes.id[part.node]));
        }
    }
    make_groups();
}

void LinearConstraints::read(const Model& model)
{
    const DeckNodes nodes(model);
    for_each_record(model, "CONSTRAINED_LINEAR_GLOBAL", [&](const Record& record) {
        Condition condition;
        condition.end = forever;
        condition.where = record.where;
        const Table* table = record.table("NID");
        for (std::size_t row = 0; table && row < table->rows(); ++row) {
            const Id freedom = static_cast<Id>(table->at(row, 1));
            if (freedom < 1 || freedom > 6) {
                throw DeckError({record.where.file, table->lines[row]},
                                fmt::format("*{}, field DOF: {} is not one of 1 to 3 translations, 4 to 6 "
                                            "rotations",
                                            record.keyword, freedom));
            }
            const Index node = nodes.find(static_cast<Id>(table->at(row, 0)), record, table->lines[row]);
            if (table->at(row, 2) != 0)
                condition.parts.push_back({node, static_cast<int>(freedom) - 1, table->at(row, 2), false});
        }
        if (condition.parts.empty())
            throw DeckError(record.where, fmt::format("*{} has no terms", record.keyword));
        conditions_.push_back(std::move(condition));
    });
    for_each_record(model, "CONSTRAINED_NODE_SET", [&](const Record& record) {
        constexpr FreedomMask masks[8] = {0, 1, 2, 4, 3, 6, 5, 7};
        const Id code = record.integer("DOF", 1);
        if (code < 1 || code > 7) {
            throw DeckError(record.where,
                            fmt::format("*{}, field DOF: {} is not one of 1 x, 2 y, 3 z, 4 xy, 5 "
                                        "yz, 6 zx, 7 xyz",
                                        record.keyword, code));
        }
        const auto& members = nodes_of_set(model, record, "NSID", record.integer("NSID"));
        const double end = record.real("TF", forever);
        for (int freedom = 0; freedom < 3; ++freedom) {
            if (!(masks[code] >> freedom & 1)) continue;
            for (std::size_t i = 1; i < members.size(); ++i) {
                Condition condition;
                condition.parts = {{members[i - 1], freedom, -1, false}, {members[i], freedom, 1, false}};
                condition.end = end == 0 || end >= 1e20 ? forever : end;
                condition.where = record.where;
                conditions_.push_back(std::move(condition));
            }
        }
    });
}

/// Chains of equal freedoms through the nodes of each group; rotations for those nodes that have them.
void LinearConstraints::read_tied(const State& state)
{
    for (const TiedNodeGroups::Group& group : tied_.groups()) {
        auto& of_group = tied_conditions_.emplace_back();
        for (int freedom = 0; freedom < (state.rotational() ? 6 : 3); ++freedom) {
            Index last = none;
            for (const Index node : group.nodes) {
                if (freedom >= 3 && !(mass_of(state, node, freedom) > 0)) continue;
                if (last != none) {
                    of_group[freedom].push_back(conditions_.size());
                    conditions_.push_back(
                        {{{last, freedom, -1, false}, {node, freedom, 1, false}}, forever, group.where, 0});
                }
                last = node;
            }
        }
    }
}

/// The chains of the groups that lose nodes close over the gaps; conditions that are left over end.
void LinearConstraints::let_go_of_tied_nodes(const State& state)
{
    std::set<std::size_t> touched;
    for (const std::size_t number : tied_.let_go(state)) {
        const std::vector<Index>& left = tied_.groups()[number].nodes;
        for (const auto& chain : tied_conditions_[number]) {
            std::vector<Part> kept;
            const auto keep = [&](const Part& part) {
                if (std::find(left.begin(), left.end(), part.node) != left.end()) kept.push_back(part);
            };
            for (const std::size_t i : chain) {
                if (conditions_[i].end < forever) break; // ended before
                if (i == chain.front()) keep(conditions_[i].parts[0]);
                keep(conditions_[i].parts[1]);
            }
            for (std::size_t link = 0; link < chain.size(); ++link) {
                Condition& condition = conditions_[chain[link]];
                touched.insert(chain[link]);
                if (link + 1 < kept.size()) {
                    condition.parts = {kept[link], kept[link + 1]};
                    condition.parts[0].coefficient = -1;
                } else {
                    condition.end = -1;
                }
            }
        }
    }
    if (touched.empty()) return;
    for (Group& group : groups_) {
        if (std::any_of(group.conditions.begin(), group.conditions.end(),
                        [&](std::size_t i) { return touched.contains(i); }))
            group.end = -1;
    }
}

/// Freedoms along global axes that a motion drives or a support holds.
void LinearConstraints::mark_driven(const Model& model)
{
    std::set<std::pair<Index, int>> driven;
    for (const FixedNodes& fixed : model.fixed_nodes)
        for (Index node : fixed.nodes)
            for (int freedom = 0; freedom < 6; ++freedom)
                if (fixed.freedoms >> freedom & 1) driven.insert({node, freedom});
    for (const PrescribedMotion& motion : model.prescribed_motions)
        for (Index node : motion.nodes)
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(motion.direction.*vector_component[axis]) > 1 - 1e-9)
                    driven.insert({node, axis + (motion.rotation ? 3 : 0)});
    for (Condition& condition : conditions_)
        for (Part& part : condition.parts) part.driven = driven.contains({part.node, part.freedom});
}

void LinearConstraints::make_groups()
{
    std::vector<std::size_t> leader(conditions_.size());
    for (std::size_t i = 0; i < leader.size(); ++i) leader[i] = i;
    const auto find = [&](std::size_t i) {
        while (leader[i] != i) i = leader[i] = leader[leader[i]];
        return i;
    };
    std::map<std::pair<Index, int>, std::size_t> first_use;
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        for (const Part& part : conditions_[i].parts) {
            if (part.driven) continue;
            const auto [use, fresh] = first_use.try_emplace({part.node, part.freedom}, i);
            if (fresh) continue;
            const std::size_t a = find(use->second), b = find(i);
            leader[std::max(a, b)] = std::min(a, b);
        }
    }
    std::map<std::size_t, std::size_t> group_of;
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        const auto [entry, fresh] = group_of.try_emplace(find(i), groups_.size());
        if (fresh) groups_.emplace_back();
        groups_[entry->second].conditions.push_back(i);
    }
    for (Group& group : groups_) find_end(group);
}

void LinearConstraints::find_end(Group& group) const
{
    group.end = forever;
    for (std::size_t i : group.conditions) group.end = std::min(group.end, conditions_[i].end);
}

void LinearConstraints::factor(Group& group, const State& state) const
{
    const std::size_t count = group.conditions.size();
    group.factor.assign(count * (count + 1) / 2, 0);
    group.dropped.assign(count, false);
    std::map<std::pair<Index, int>, std::vector<std::pair<std::size_t, double>>>
        users; // freedom: row, coefficient
    for (std::size_t row = 0; row < count; ++row)
        for (const Part& part : conditions_[group.conditions[row]].parts)
            if (!part.driven) users[{part.node, part.freedom}].push_back({row, part.coefficient});
    const auto at = [&](std::size_t i, std::size_t j) -> double& {
        return group.factor[i * (i + 1) / 2 + j];
    };
    for (const auto& [freedom, rows] : users) {
        const double inverse = 1 / mass_of(state, freedom.first, freedom.second);
        for (const auto& [i, ci] : rows)
            for (const auto& [j, cj] : rows)
                if (j <= i) at(i, j) += ci * cj * inverse;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double own = at(i, i);
        double pivot = own;
        for (std::size_t j = 0; j < i; ++j) {
            double sum = at(i, j);
            for (std::size_t k = 0; k < j; ++k) sum -= at(i, k) * at(j, k);
            at(i, j) = group.dropped[j] ? 0 : sum / at(j, j);
            pivot -= at(i, j) * at(i, j);
        }
        group.dropped[i] = pivot <= implied_pivot * own;
        if (group.dropped[i])
            for (std::size_t j = 0; j < i; ++j) at(i, j) = 0;
        at(i, i) = group.dropped[i] ? 1 : std::sqrt(pivot);
    }
}

void LinearConstraints::solve(const Group& group, std::vector<double>& values) const
{
    const std::size_t count = group.conditions.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double* row = &group.factor[i * (i + 1) / 2];
        double sum = values[i];
        for (std::size_t j = 0; j < i; ++j) sum -= row[j] * values[j];
        values[i] = group.dropped[i] ? 0 : sum / row[i];
    }
    for (std::size_t i = count; i-- > 0;) {
        const double* row = &group.factor[i * (i + 1) / 2];
        values[i] = group.dropped[i] ? 0 : values[i] / row[i];
        for (std::size_t j = 0; j < i; ++j) values[j] -= row[j] * values[i];
    }
}

/// Factors, and takes out of the velocities at t = 0 what the conditions do not allow.
void LinearConstraints::start(State& state)
{
    started_ = true;
    for (Group& group : groups_) {
        factor(group, state);
        std::vector<double> values(group.conditions.size(), 0.0);
        for (std::size_t row = 0; row < values.size(); ++row)
            for (const Part& part : conditions_[group.conditions[row]].parts)
                values[row] += part.coefficient *
                               component(state.velocity, state.angular_velocity, part.node, part.freedom);
        solve(group, values);
        for (std::size_t row = 0; row < values.size(); ++row) {
            for (const Part& part : conditions_[group.conditions[row]].parts) {
                if (part.driven) continue;
                component(state.velocity, state.angular_velocity, part.node, part.freedom) -=
                    values[row] * part.coefficient / mass_of(state, part.node, part.freedom);
            }
        }
    }
}

void LinearConstraints::constrain(const Clock& clock, State& state)
{
    if (!started_) start(state);
    if (!tied_.groups().empty()) let_go_of_tied_nodes(state);
    const double velocity_step = clock.velocity_step();
    double power_before = 0, power_after = 0;
    std::vector<double>& values = values_;
    const auto next_rate = [&](const Part& part) {
        const double mass = mass_of(state, part.node, part.freedom);
        const double rate = component(state.velocity, state.angular_velocity, part.node, part.freedom);
        if (mass == 0) return rate; // held by a body
        return rate + velocity_step / mass * component(state.force, state.moment, part.node, part.freedom);
    };
    for (Group& group : groups_) {
        if (clock.time > group.end) { // the conditions that have ended leave the group
            for (std::size_t i : group.conditions) conditions_[i].multiplier = 0;
            std::erase_if(group.conditions, [&](std::size_t i) { return clock.time > conditions_[i].end; });
            find_end(group);
            factor(group, state);
        }
        values.assign(group.conditions.size(), 0.0);
        for (std::size_t row = 0; row < values.size(); ++row)
            for (const Part& part : conditions_[group.conditions[row]].parts)
                values[row] += part.coefficient * next_rate(part) / velocity_step;
        solve(group, values);
        for (std::size_t row = 0; row < values.size(); ++row) {
            Condition& condition = conditions_[group.conditions[row]];
            condition.multiplier = values[row];
            for (const Part& part : condition.parts) {
                if (part.driven) {
                    const double share = values[row] * part.coefficient;
                    power_before +=
                        share * component(state.velocity, state.angular_velocity, part.node, part.freedom);
                    power_after += share * next_rate(part);
                } else {
                    component(state.force, state.moment, part.node, part.freedom) -=
                        values[row] * part.coefficient;
                }
            }
        }
    }
    work_.add(power_before, clock.last_step, power_after, clock.step);
}

void LinearConstraints::collect(const State&, ElementResults& results) const
{
    if (!results.boundary_forces_wanted) return;
    for (const Condition& condition : conditions_) {
        for (const Part& part : condition.parts) {
            if (!part.driven || condition.multiplier == 0) continue;
            ElementResults::BoundaryForce entry{part.node, none, {}, {}, 0};
            (part.freedom < 3 ? entry.force : entry.moment).*vector_component[part.freedom % 3] =
                condition.multiplier * part.coefficient;
            results.motions.push_back(entry);
        }
    }
}

std::unique_ptr<LinearConstraints> make_linear_constraints(const Model& model, const State& state,
                                                           std::vector<const Term*> elements)
{
    auto constraints = std::make_unique<LinearConstraints>(model, state, std::move(elements));
    return constraints->empty() ? nullptr : std::move(constraints);
}

} // namespace plash

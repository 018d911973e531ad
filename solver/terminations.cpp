#include "solver/terminations.h"

#include "core/prescribed_rate.h"
#include "elements/shell_mass.h"
#include "elements/solid_groups.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

double component(const Vec3& vector, int axis)
{
    return axis == 3 ? norm(vector) : vector.*vector_component[axis];
}

bool outside(double value, const Termination& end)
{
    return value >= end.largest || value <= end.smallest;
}

} // namespace

Terminations::Terminations(const Scene& scene)
    : scene_(scene),
      quiet_since_(scene.model.terminations.size(), -1),
      centers_(scene.model.terminations.size())
{
    const Model& model = scene.model;
    for (std::size_t i = 0; i < centers_.size(); ++i) {
        const Termination& end = model.terminations[i];
        if (end.kind == Termination::Kind::contact) {
            const bool there = std::any_of(model.contacts.begin(), model.contacts.end(),
                                           [&](const Contact& contact) { return contact.id == end.index; });
            if (!there)
                throw DeckError(
                    end.where,
                    fmt::format("*TERMINATION_CONTACT, field CID: there is no contact {}", end.index));
        }
        if (end.kind != Termination::Kind::body) continue;
        std::vector<double> mass(model.nodes.size(), 0.0);
        const SolidMasses solids = solid_masses(model, end.index);
        for (std::size_t k = 0; k < solids.nodes.size(); ++k) mass[solids.nodes[k]] += solids.mass[k];
        for (Index shell = 0; shell < static_cast<Index>(model.shells.size()); ++shell) {
            if (model.shells.part[shell] != end.index) continue;
            const ShellMass share = shell_mass(model, shell);
            const auto corners = shell_corners(model, shell);
            for (int c = 0; c < 4; ++c) mass[corners[c]] += share.corner_mass[c];
        }
        double total = 0;
        for (double m : mass) total += m;
        for (std::size_t node = 0; node < mass.size(); ++node) {
            if (mass[node] == 0) continue;
            centers_[i].nodes.push_back(static_cast<Index>(node));
            centers_[i].weight.push_back(mass[node] / total);
        }
    }
}

bool Terminations::node_ends(const Termination& end) const
{
    if (end.axis < 3) return outside(component(scene_.state.position[end.index], end.axis), end);
    ElementResults results;
    results.contact_force.resize(scene_.state.size());
    for (const auto& term : scene_.terms) term->collect(scene_.state, results);
    return norm(results.contact_force[end.index]) > 0;
}

bool Terminations::body_ends(const Termination& end, const Center& center) const
{
    Vec3 moved{};
    for (std::size_t i = 0; i < center.nodes.size(); ++i) {
        const Index node = center.nodes[i];
        moved += center.weight[i] * (scene_.state.position[node] - scene_.model.nodes.position[node]);
    }
    return outside(component(moved, end.axis), end);
}

bool Terminations::deletion_ends(const Termination& end) const
{
    const bool shells = end.kind == Termination::Kind::deleted_shells;
    const auto& deleted = shells ? scene_.state.deleted_shells : scene_.state.deleted_solids;
    const auto& part = shells ? scene_.model.shells.part : scene_.model.solids.part;
    long count = 0;
    for (std::size_t i = 0; i < std::min(deleted.size(), part.size()); ++i) {
        if (deleted[i] && std::find(end.parts.begin(), end.parts.end(), part[i]) != end.parts.end()) ++count;
    }
    return count >= end.count;
}

bool Terminations::contact_ends(const Termination& end, double& quiet_since, const Clock& clock) const
{
    if (clock.time < end.time) return false;
    ElementResults results;
    for (const auto& term : scene_.terms) term->collect(scene_.state, results);
    double force = 0;
    for (const auto& contact : results.contacts) {
        if (contact.contact == end.index) force = std::abs(component(contact.slave_force, end.axis));
    }
    if (force > end.threshold) {
        quiet_since = -1;
        return false;
    }
    if (quiet_since < 0) quiet_since = clock.time;
    return clock.time - quiet_since >= end.duration;
}

std::string Terminations::describe(const Termination& end) const
{
    const Model& model = scene_.model;
    const std::string place = model.place(end.where);
    switch (end.kind) {
    case Termination::Kind::node:
        return fmt::format("node {} has reached its limit ({})", model.nodes.id[end.index], place);
    case Termination::Kind::body:
        return fmt::format("part {} has reached its limit ({})", model.parts[end.index].id, place);
    case Termination::Kind::deleted_shells:
    case Termination::Kind::deleted_solids:
        return fmt::format("as many elements are deleted as should end the run ({})", place);
    case Termination::Kind::curve:
        return fmt::format("curve {} has come to zero ({})", model.curves[end.index].id, place);
    case Termination::Kind::contact:
        return fmt::format("contact {} has no force any more ({})", end.index, place);
    }
    return {};
}

std::optional<std::string> Terminations::reason(const Clock& clock)
{
    const Model& model = scene_.model;
    const TimeControls& control = model.controls.time;
    if (100 * std::abs(scene_.added_mass_ratio) > control.end_mass_change)
        return fmt::format("mass scaling has added {:.3g} % of the mass (ENDMAS)",
                           100 * scene_.added_mass_ratio);
    const EnergyLedger& ledger = scene_.ledger;
    const double expected = ledger.initial_total + ledger.external_work;
    if (control.end_energy_change > 0 && expected != 0) {
        const double change = 100 * std::abs(ledger.total() / expected - 1);
        if (change > control.end_energy_change)
            return fmt::format("the energy ratio is off by {:.3g} % (ENDENG)", change);
    }
    for (std::size_t i = 0; i < model.terminations.size(); ++i) {
        const Termination& end = model.terminations[i];
        const auto ends = [&] {
            switch (end.kind) {
            case Termination::Kind::node:
                return node_ends(end);
            case Termination::Kind::body:
                return body_ends(end, centers_[i]);
            case Termination::Kind::deleted_shells:
            case Termination::Kind::deleted_solids:
                return deletion_ends(end);
            case Termination::Kind::curve:
                return clock.time >= end.time && curve_value(model, end.index, clock.time) <= 0;
            case Termination::Kind::contact:
                return contact_ends(end, quiet_since_[i], clock);
            }
            return false;
        };
        if (ends()) return describe(end);
    }
    return std::nullopt;
}

} // namespace plash

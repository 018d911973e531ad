#include "sph/particle_coupling.h"

#include "materials/parameters.h"
#include "sph/cells.h"
#include "sph/particle_bodies.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

ParticleCoupling::ParticleCoupling(const Model& model, const Record& record, const State& state)
    : model_(model), record_(record)
{
    for (const char* box : {"IBOXA", "IBOXB"}) {
        if (record.integer(box) != 0) reject_field(record, box, "couplings hold everywhere (0) alone");
    }
    stiffness_ = record.real("PFACT", 1);
    damping_ = record.real("DFACT");
    if (!(stiffness_ > 0)) reject_field(record, "PFACT", fmt::format("{:g} is not positive", stiffness_));
    if (damping_ < 0) reject_field(record, "DFACT", fmt::format("{:g} is negative", damping_));
    if (const Id soft = record.integer("ISOFT"); soft != 0 && soft != 1) {
        reject_field(record, "ISOFT", fmt::format("there is no form {}; there are 0 and 1", soft));
    }
    add_group("SIDA", "SATYP", state);
    first_of_b_ = node_.size();
    add_group("SIDB", "SBTYP", state);
    std::vector<Index> sorted = node_;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
        reject_field(record, "SIDB", "a part of group B is in group A, too");
    }
    force_.resize(node_.size());
    skin_ = node_.empty() ? 0 : 0.4 * *std::max_element(reach_.begin(), reach_.end());
}

/// Adds the particles of a part (type 1) or a part set (0).
void ParticleCoupling::add_group(const char* id, const char* type, const State& state)
{
    const Id wanted = record_.integer(id);
    std::vector<Index> parts;
    if (record_.integer(type) == 1) {
        for (std::size_t i = 0; i < model_.parts.size(); ++i)
            if (model_.parts[i].id == wanted) parts = {static_cast<Index>(i)};
    } else {
        for (const PartSet& set : model_.part_sets)
            if (set.id == wanted) parts = set.parts;
    }
    const double factor = 0.5 * record_.real("SRAD", 1);
    if (!(factor > 0)) reject_field(record_, "SRAD", fmt::format("{:g} is not positive", 2 * factor));
    const std::size_t before = node_.size();
    for (const Index part : parts) {
        std::vector<Vec3> positions;
        for (std::size_t i = 0; i < model_.particles.size(); ++i) {
            if (model_.particles.part[i] != part) continue;
            node_.push_back(model_.particles.node[i]);
            positions.push_back(state.position[node_.back()]);
        }
        if (!positions.empty())
            reach_.resize(node_.size(), factor * initial_smoothing(model_, part, positions));
    }
    if (node_.size() == before) {
        reject_field(record_, id, fmt::format("there are no particles in part or part set {}", wanted));
    }
}

bool ParticleCoupling::pairs_hold(const State& state) const
{
    if (build_position_.empty()) return false;
    const double allowed = 0.25 * skin_ * skin_;
    for (std::size_t i = 0; i < node_.size(); ++i) {
        const Vec3 moved = state.position[node_[i]] - build_position_[i];
        if (!(dot(moved, moved) <= allowed)) return false;
    }
    return true;
}

/// All pairs of A and B closer than their reaches and the skin.
void ParticleCoupling::find_pairs(const State& state)
{
    build_position_.resize(node_.size());
    for (std::size_t i = 0; i < node_.size(); ++i) build_position_[i] = state.position[node_[i]];
    const double largest = *std::max_element(reach_.begin(), reach_.end());
    ParticleCells cells;
    cells.sort(build_position_, 2 * largest + skin_);
    pairs_.clear();
    std::array<Index, 27> around;
    for (Index cell = 0; cell < cells.cell_count(); ++cell) {
        const int count = cells.around(cell, around);
        for (Index place = cells.begin(cell); place < cells.end(cell); ++place) {
            const Index a = cells.order()[place];
            if (a >= static_cast<Index>(first_of_b_)) continue;
            for (int k = 0; k < count; ++k) {
                for (Index other = cells.begin(around[k]); other < cells.end(around[k]); ++other) {
                    const Index b = cells.order()[other];
                    if (b < static_cast<Index>(first_of_b_)) continue;
                    const Vec3 apart = build_position_[a] - build_position_[b];
                    const double limit = reach_[a] + reach_[b] + skin_;
                    if (dot(apart, apart) < limit * limit) pairs_.push_back({a, b});
                }
            }
        }
    }
}

/// Of the forces, at the velocities of n - 1/2.
double ParticleCoupling::power(const State& state) const
{
    double sum = 0;
    for (std::size_t i = 0; i < node_.size(); ++i) sum += dot(force_[i], state.velocity[node_[i]]);
    return sum;
}

void ParticleCoupling::add_forces(const Clock& clock, State& state)
{
    vote_ = {};
    if (clock.last_step == 0) return; // no step yet that the stiffness could go by
    if (first_step_ == 0) first_step_ = clock.last_step;
    taken_ -= 0.5 * clock.last_step * power(state);
    if (!pairs_hold(state)) find_pairs(state);
    std::fill(force_.begin(), force_.end(), Vec3{});
    std::vector<double> stiffness(node_.size());
    constexpr double soft_factor = 0.1;
    for (const auto& [a, b] : pairs_) {
        const Index first = node_[a], second = node_[b];
        const double m1 = state.mass[first], m2 = state.mass[second];
        const Vec3 apart = state.position[first] - state.position[second];
        const double distance = norm(apart), depth = reach_[a] + reach_[b] - distance;
        if (!(depth > 0) || distance == 0 || m1 == 0 || m2 == 0) continue; // no mass: it has left
        const double reduced = m1 * m2 / (m1 + m2);
        const double k = stiffness_ * soft_factor * 2 * reduced / (first_step_ * first_step_);
        const Vec3 normal = (1 / distance) * apart;
        const double opening = dot(state.velocity[first] - state.velocity[second], normal);
        const double drag = opening < 0 ? -2 * damping_ * std::sqrt(k * reduced) * opening : 0;
        const Vec3 push = (k * depth + drag) * normal;
        force_[a] += push;
        force_[b] -= push;
        stiffness[a] += k;
        stiffness[b] += k;
    }
    taken_ -= 0.5 * clock.last_step * power(state);
    for (std::size_t i = 0; i < node_.size(); ++i) {
        if (stiffness[i] == 0) continue;
        state.force[node_[i]] += force_[i];
        // Gershgorin: omega^2 <= 2 k / m. Damping shortens the step by sqrt(1 + d^2) - d.
        const double step = std::sqrt(2 * state.mass[node_[i]] / stiffness[i]) *
                            (std::sqrt(1 + damping_ * damping_) - damping_);
        if (step < vote_.step) vote_ = {step, "coupling at particle", model_.nodes.id[node_[i]], 0};
    }
}

std::vector<std::string> ParticleCoupling::notices(const State&) const
{
    if (!particle_options_of(model_).parts_interact) return {};
    return {"*DEFINE_SPH_TO_SPH_COUPLING: the coupled particles see each other in their kernels as well; "
            "*CONTROL_SPH CONT = 1 parts them"};
}

std::vector<std::unique_ptr<Term>> make_particle_couplings(const Model& model, const State& state)
{
    std::vector<std::unique_ptr<Term>> terms;
    for (const Record& record : model.others) {
        if (record.keyword != "DEFINE_SPH_TO_SPH_COUPLING") continue;
        terms.push_back(std::make_unique<ParticleCoupling>(model, record, state));
    }
    return terms;
}

} // namespace plash

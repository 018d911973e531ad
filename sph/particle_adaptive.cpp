// Particles that wait in solids (*DEFINE_ADAPTIVE_SOLID_TO_SPH): they come out when these are deleted, and
// may be neighbours of others before.

#include "core/parallel.h"
#include "sph/law_lanes.h"
#include "sph/particle_body.h"

#include <algorithm>
#include <cmath>

namespace plash {

/// All that stand in for the solids lost in this cycle come out. Returns their nodes, rising.
std::vector<Index> ParticleBody::take_out_of_solids(State& state)
{
    // Images stand behind the particles; the search that follows makes them anew.
    arrays_.motion.resize(real_count_);
    fill_up();
    std::vector<Index> newcomers;
    for (const auto& [number, lost] : hosts_.take_lost(state)) {
        const SolidHosts::Host& host = hosts_.host(number);
        const bool held = std::any_of(lost.masses.begin(), lost.masses.end(),
                                      [&](const auto& corner) { return state.mass[corner.first] <= 0; });
        if (held) continue; // the mass belongs to a rigid body
        come_out(host, lost, state);
        for (std::size_t i = 0; i < host.weights.size(); ++i)
            newcomers.push_back(hosts_.first_node(host) + static_cast<Index>(i));
    }
    std::erase_if(bonded_places_, [&](Index place) { return arrays_.bonded[place] == 0; });
    std::sort(newcomers.begin(), newcomers.end());
    return newcomers;
}

/// The mass, momentum and internal energy of a solid go to its stand-ins; what its corners moved against each
/// other within a particle is lost.
void ParticleBody::come_out(const SolidHosts::Host& host, const LostSolid& lost, State& state)
{
    const Index first = hosts_.first_node(host);
    const auto count = static_cast<Index>(host.weights.size());
    double mass = 0, kinetic = 0;
    Vec3 momentum{};
    for (const auto& [node, share] : lost.masses) {
        mass += share;
        momentum += share * state.velocity[node];
        kinetic += 0.5 * share * dot(state.velocity[node], state.velocity[node]);
    }
    Vec3 mean{};
    for (Index node = first; node < first + count; ++node) {
        const SolidHosts::Motion motion = hosts_.motion_of(node, state);
        state.position[node] = motion.position;
        state.velocity[node] = motion.velocity;
        mean += (1.0 / count) * motion.velocity;
    }
    for (Index node = first; node < first + count; ++node) {
        state.velocity[node] += (1 / mass) * momentum - mean;
        state.mass[node] = mass / count;
        kinetic -= 0.5 * state.mass[node] * dot(state.velocity[node], state.velocity[node]);
    }
    const Index solid_part = model_.solids.part[host.stand_ins.solid];
    lost_kinetic_[solid_part] += kinetic;
    handed_internal_[solid_part] += lost.internal;
    for (const auto& [node, share] : lost.masses) {
        constexpr double round_off = 1e-9;
        const double left = state.mass[node] - share;
        state.mass[node] = left > round_off * share ? left : 0;
        if (state.mass[node] == 0) state.velocity[node] = {};
    }
    if (host.stand_ins.bond == StandIns::Bond::none) {
        const auto number = std::find_if(parts_.begin(), parts_.end(), [&](const ParticlePart& part) {
            return part.model_part == model_.particles.part[host.stand_ins.first];
        });
        for (Index node = first; node < first + count; ++node) {
            append(static_cast<std::size_t>(number - parts_.begin()), node, state.mass[node], state);
            fill_up();
            take_over(arrays_.real_count() - 1, host, lost, state);
        }
        real_count_ = arrays_.node.size();
        return;
    }
    for (Index place : bonded_places_) {
        if (arrays_.node[place] < first || arrays_.node[place] >= first + count) continue;
        arrays_.bonded[place] = 0;
        if (!arrays_.own_mass.empty()) arrays_.own_mass[place] = mass / count;
        arrays_.motion[place].weight = mass / count;
        const double of_bond = arrays_.energy[place];
        take_over(place, host, lost, state);
        arrays_.energy[place] += of_bond;
    }
}

/// Stress, energy, density and the variables of the law; these begin anew where particles have another
/// material than their solid had.
void ParticleBody::take_over(Index place, const SolidHosts::Host& host, const LostSolid& lost,
                             const State& state)
{
    ParticleArrays& a = arrays_;
    const ParticlePart& part = parts_[a.part[place]];
    const double mass = a.mass(place);
    const double volume = host.volume * hosts_.relative_volume(host, state);
    const auto count = static_cast<double>(host.weights.size());
    a.set_density(place, mass * count / volume);
    a.energy[place] = lost.internal / count * part.constants.density / mass;
    a.rate[place] = 0;
    a.set_pressure(place, -trace(lost.stress) / 3);
    if (options_.volume_weighted) a.motion[place].weight = mass / a.density(place);
    if (!part.law->has_strength()) return;
    a.stress[place] = lost.stress;
    const Index solid_material = model_.parts[model_.solids.part[host.stand_ins.solid]].material;
    const Index material = model_.parts[part.model_part].material;
    const auto size = static_cast<std::size_t>(part.law->history_size());
    const bool same = model_.materials[material].keyword == model_.materials[solid_material].keyword;
    if (!same || lost.history.size() < size) return;
    std::copy_n(lost.history.begin(), size, a.history.begin() + std::size_t(place) * a.history_size);
}

/// Laws in a cycle with newcomers: these have got what their solids had at the end of the step already.
void ParticleBody::apply_laws_beside(const std::vector<Index>& newcomers, double step)
{
    std::vector<PlaceList> old(parts_.size()), fresh(parts_.size());
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        places_[number].for_each([&](Index place) {
            const bool is_new = std::binary_search(newcomers.begin(), newcomers.end(), arrays_.node[place]);
            (is_new ? fresh : old)[number].add(place);
        });
    }
    apply_laws(step, old);
    const ParticleVote vote = vote_;
    apply_laws(0, fresh);
    vote_.take(vote);
}

/// The energy of newcomers counts the work of the step that ends now with the forces of its end, and the
/// motion of all particles as well, whereas these forces act only from its end on: half of their work is
/// counted twice. It is told by the leap that the power of all pair forces makes.
void ParticleBody::book_first_work(const std::vector<Index>& newcomers, double step, const State& state)
{
    const double power = sum_chunks(real_count_, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t p = begin; p < end; ++p)
            sum += dot(state.force[arrays_.node[p]], state.velocity[arrays_.node[p]]);
        return sum;
    });
    for (Index node : newcomers) {
        const Index solid_part = model_.solids.part[hosts_.host_of(node).stand_ins.solid];
        handed_internal_[solid_part] +=
            0.5 * step * (power - pair_power_) / static_cast<double>(newcomers.size());
    }
    pair_power_ = power;
}

/// Puts bonded particles where their solids have them.
void ParticleBody::follow_solids(State& state) const
{
    for_chunks(bonded_places_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Index node = arrays_.node[bonded_places_[i]];
            const SolidHosts::Motion motion = hosts_.motion_of(node, state);
            state.position[node] = motion.position;
            state.velocity[node] = motion.velocity;
        }
    });
}

/// Finds the bonded particles that are neighbours of others.
void ParticleBody::find_pressed()
{
    pressed_.clear();
    std::vector<std::uint8_t> found(real_count_, images_.any() ? 1 : 0); // images are neighbours too
    for (const NeighbourRun& run : runs_) {
        for_listed(run, [&](Index place, Index other, bool) {
            if (other == place || other >= arrays_.real_count()) return;
            found[place] = found[other] = 1;
        });
    }
    for (Index place : bonded_places_)
        if (found[place]) pressed_.push_back(place);
}

/// Mean stresses of the solids that hold pressed particles.
ElementResults ParticleBody::stresses_of_solids(const State& state) const
{
    ElementResults results;
    results.solid_rows.assign(model_.solids.size(), none);
    Index rows = 0;
    for (Index place : pressed_) {
        Index& row = results.solid_rows[hosts_.host_of(arrays_.node[place]).stand_ins.solid];
        if (row == none) row = rows++;
    }
    results.solid_stress.resize(rows);
    for (const Term* solids : solids_) solids->collect(state, results);
    return results;
}

/// Bonded particles have the stress and the density of their solids. What their neighbours strain them is
/// energy of the bond: pair forces do this work on both sides, and the solids know nothing of it.
void ParticleBody::set_bonded(double step, const State& state)
{
    if (pressed_.empty()) return;
    ParticleArrays& a = arrays_;
    const ElementResults results = stresses_of_solids(state);
    for (Index p : pressed_) {
        const ParticlePart& part = parts_[a.part[p]];
        const PartConstants& constants = part.constants;
        const SolidHosts::Host& host = hosts_.host_of(a.node[p]);
        const SymmetricTensor<double>& stress =
            results.solid_stress[results.solid_rows[host.stand_ins.solid]];
        const double pressure = -trace(stress) / 3;
        double power; // by volume
        if (tensor_) {
            power = 0.5 * contract(a.stress[p] + stress, symmetric_part(a.gradient[p]));
            a.stress[p] = stress;
            a.correction[p] = {1, 1, 1, 0, 0, 0}; // its neighbours are those of one side alone
        } else {
            const double closing = constants.volume_weighted ? a.rate[p] : a.rate[p] / a.density(p);
            power = 0.5 * (a.pressure(p) + pressure) * closing;
        }
        a.energy[p] += step * power * constants.density / a.density(p);
        a.rate[p] = 0;
        const double relative_volume = hosts_.relative_volume(host, state);
        const double density =
            a.mass(p) * static_cast<double>(host.weights.size()) / (host.volume * relative_volume);
        const double size = constants.size_of(a.mass(p));
        const double smoothing = constants.smoothing * std::cbrt(relative_volume);
        set_records(constants, p, density,
                    size * std::clamp(smoothing, constants.smallest_smoothing, constants.largest_smoothing),
                    a.push[p].sound, a);
        a.set_pressure(p, pressure);
        set_push(constants, p, stress, a);
    }
}

/// Forces on bonded particles go to their solids.
void ParticleBody::pass_bonded_forces(State& state) const
{
    for (Index place : pressed_) {
        const Index node = arrays_.node[place];
        hosts_.pass_on(state.force[node], node, state);
        state.force[node] = {};
    }
}

} // namespace plash

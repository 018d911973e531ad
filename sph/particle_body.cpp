#include "sph/particle_body.h"

#include "core/parallel.h"
#include "core/release.h"
#include "core/run_error.h"
#include "sph/array_sorter.h"
#include "sph/pair_passes.h"
#include "sph/particle_checks.h"
#include "sph/rings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace plash {

namespace {

double support_of(Kernel kernel)
{
    return with_kernel(kernel, []<class K>(K) { return K::support; });
}

/// Random reads of the State in sorted order: asked for this many particles ahead.
constexpr std::size_t prefetch_distance = 16;

} // namespace

ParticleBody::ParticleBody(std::vector<ParticlePart> parts, ParticleOptions options, const Model& model,
                           State& state)
    : model_(model),
      parts_(std::move(parts)),
      options_(std::move(options)),
      support_(support_of(options_.kernel)),
      images_(options_.mirrors, options_.periods)
{
    tensor_ = options_.renormalised;
    bool viscous = false;
    for (ParticlePart& part : parts_) {
        if (options_.axisymmetric) { // from the mass of the area to that of the ring by radian
            for (std::size_t i = 0; i < part.nodes.size(); ++i) {
                part.mass[i] *= state.position[part.nodes[i]].x;
            }
        }
        part.constants.dimension = options_.dimension;
        part.constants.volume_weighted = options_.volume_weighted;
        part.constants.failed_carry_nothing = options_.failed_carry_nothing;
        part.constants.smoothing_by_cube_root = options_.smoothing_by_cube_root;
        part.constants.laminar_by_velocity = options_.laminar_by_velocity;
        viscous = viscous || part.constants.laminar_viscosity > 0;
        tensor_ = tensor_ || part.law->has_strength();
        arrays_.history_size = std::max(arrays_.history_size, part.law->history_size());
    }
    hosts_ = SolidHosts(model_, state);
    for (const ParticlePart& part : parts_) {
        for (std::size_t i = 0; i < part.nodes.size(); ++i) {
            const bool waits = hosts_.waits(part.nodes[i]);
            if (!waits) state.mass[part.nodes[i]] += part.mass[i];
            if (!waits || hosts_.bond_of(part.nodes[i]) != StandIns::Bond::none) ++real_count_;
        }
    }
    if (hosts_.any()) {
        handed_internal_.resize(model_.parts.size());
        lost_kinetic_.resize(model_.parts.size());
    }
    inflows_ = Inflows(options_.inflows, model_, state);
    create(state);
    if (images_.any_absorbing()) {
        std::vector<double> shear_sounds;
        for (const ParticlePart& part : parts_) shear_sounds.push_back(part.law->shear_sound());
        images_.set_shear_sounds(std::move(shear_sounds));
        arrays_.rest_pressure.resize(real_count_);
        for (const MotionRecord& motion : arrays_.motion) arrays_.rest_velocity.push_back(motion.velocity);
    }
    alive_ = alive(0);
    if (viscous && options_.laminar_by_velocity) arrays_.laminar.resize(real_count_);
    search(state);
    if (tensor_ || options_.axisymmetric) sum_rates({}, 0.5); // for what corrects the first forces
    apply_laws(0, sleepers_);
    apply_laws(0, places_);
    for (std::size_t p = 0; p < arrays_.rest_pressure.size(); ++p) {
        arrays_.rest_pressure[p] = arrays_.pressure(p);
    }
}

/// All particles in the order of parts and their nodes, before the first search sorts them.
void ParticleBody::create(const State& state)
{
    ParticleArrays& a = arrays_;
    a.motion.reserve(real_count_);
    a.node.reserve(real_count_);
    a.part.reserve(real_count_);
    if (options_.volume_weighted) a.own_mass.reserve(real_count_);
    a.push.reserve(real_count_);
    a.energy.reserve(real_count_);
    a.history.reserve(real_count_ * a.history_size);
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const ParticlePart& part = parts_[number];
        for (std::size_t i = 0; i < part.nodes.size(); ++i) {
            const Index node = part.nodes[i];
            const bool waits = hosts_.waits(node), bonded = hosts_.bond_of(node) != StandIns::Bond::none;
            if (!waits || bonded) append(number, node, part.mass[i], state);
        }
    }
    // From here on they stand in the arrays; those that wait take theirs from their solids.
    for (ParticlePart& part : parts_) release(part.mass);
    fill_up();
    const bool bonds = std::any_of(model_.stand_ins.begin(), model_.stand_ins.end(),
                                   [](const StandIns& some) { return some.bond != StandIns::Bond::none; });
    if (!bonds) return;
    arrays_.bonded.resize(real_count_);
    for (std::size_t p = 0; p < real_count_; ++p) {
        arrays_.bonded[p] = hosts_.waits(arrays_.node[p]);
        if (arrays_.bonded[p]) arrays_.energy[p] = 0; // that of its solid counts there
    }
}

/// One more particle behind all others; `fill_up` gives it the rest.
void ParticleBody::append(std::size_t number, Index node, double mass, const State& state)
{
    ParticleArrays& a = arrays_;
    const ParticlePart& part = parts_[number];
    const double density = part.density_at_rest(model_.nodes.position[node]);
    a.motion.push_back({state.position[node], part.constants.smoothing * part.constants.size_of(mass),
                        state.velocity[node], options_.volume_weighted ? mass / density : mass});
    a.node.push_back(node);
    a.part.push_back(static_cast<std::uint8_t>(number));
    if (options_.volume_weighted) a.own_mass.push_back(mass);
    if (options_.axisymmetric) {
        a.motion.back().weight /= ring_radius(a.motion.back());
        a.first_radius.push_back(state.position[node].x);
    }
    a.push.push_back({});
    a.set_density(a.push.size() - 1, density);
    a.energy.push_back(part.law->initial_energy());
    if (a.history_size == 0) return;
    a.history.resize(a.history.size() + a.history_size);
    part.law->start_history(&*a.history.end() - a.history_size);
}

/// Gives the arrays that start at zero as many entries as there are particles.
void ParticleBody::fill_up()
{
    ParticleArrays& a = arrays_;
    const std::size_t count = a.node.size();
    if (tensor_) {
        a.tension.resize(count);
        a.gradient.resize(count);
        a.correction.resize(count, {1, 1, 1, 0, 0, 0});
        a.stress.resize(count);
    }
    if (!a.bonded.empty()) a.bonded.resize(count);
    if (!a.laminar.empty()) a.laminar.resize(count);
    if (!a.wall_gradient.empty()) a.wall_gradient.resize(count);
    if (!a.first_radius.empty()) a.moment.resize(count);
    if (options_.bulk_viscosity) a.bulk.resize(count);
    if (!a.rest_pressure.empty()) {
        a.rest_pressure.resize(count);
        a.rest_velocity.resize(count);
    }
    if (!absorbed_force_.empty()) absorbed_force_.resize(count);
    a.part.resize(count);
    if (!options_.regions.empty() || inflows_.any()) a.asleep.resize(count);
    a.rate.resize(count);
    if (tensor_ || options_.axisymmetric || options_.bulk_viscosity) a.kept_pressure.resize(count);
    a.viscous_force.resize(count);
    a.heat.resize(count);
    a.reach.resize(count);
}

void ParticleBody::add_forces(const Clock& clock, State& state)
{
    const bool acts = clock.time >= options_.birth && clock.time <= options_.death;
    if (!acts && alive_ == 0) {
        if (clock.time > options_.death) vote_ = {}; // until the birth that of the start stands
        return;
    }
    vote_ = {};
    std::vector<Index> newcomers;
    if (acts && hosts_.someone_lost(state)) newcomers = take_out_of_solids(state);
    if (hosts_.any() && !anyone_free()) return;
    follow_solids(state);
    read_motion(clock, state);
    add_absorbed_work(0.5 * clock.last_step);
    if (newcomers.empty()) {
        find_rates(clock, state);
        apply_laws(clock.last_step, places_);
        if (!fallen_asleep_.empty()) apply_last_laws(clock.last_step);
    } else {
        alive_ = alive(clock.time);
        search(state);
        ++cycles_since_search_;
        images_.refresh_motion(arrays_);
        if (clock.last_step > 0) sum_rates(clock, 0.5);
        apply_laws_beside(newcomers, clock.last_step);
    }
    if (!bonded_places_.empty()) set_bonded(clock.last_step, state);
    const int interval = options_.filter_interval;
    if (interval > 0 && clock.cycle > 0 && clock.cycle % interval == 0) filter_densities();
    images_.refresh_all(arrays_);
    add_pair_forces(clock, state);
    if (options_.tensile_repulsion > 0) add_tensile_forces(clock, state);
    if (!arrays_.laminar.empty()) add_laminar_forces(clock, state);
    if (hosts_.any()) {
        book_first_work(newcomers, clock.last_step, state);
        pass_bonded_forces(state);
    }
    find_absorbed_forces();
    add_absorbed_work(0.5 * clock.last_step);
    // Half of the last impulse and half of this one fall into the step that ends now.
    wall_work_ += 0.5 * clock.last_step * wall_power_;
    wall_power_ = power_of_walls();
    wall_work_ += 0.5 * clock.last_step * wall_power_;
    if (options_.velocity_blend > 0 || options_.shifting > 0) find_drifts(state);
}

/// Neighbours of n, and the rates over the step that ends there. Where particles begin or cease to act on
/// each other at n, those of its begin act over its first half and those of its end over the other one: the
/// rates are the mean of both, at the places of either end, as pressure does its work.
void ParticleBody::find_rates(const Clock& clock, State& state)
{
    const bool someone_leaves = anyone_leaves();
    const std::uint64_t now_alive = alive(clock.time);
    const bool holds = lists_hold(state);
    const bool same = now_alive == alive_ && !someone_leaves && (holds || options_.regions.empty());
    const bool mixes = !same && clock.last_step > 0;
    if (mixes) {
        images_.refresh_motion(arrays_);
        sum_rates(clock, 1);
        if (someone_leaves) add_last_work(clock.last_step);
    }
    alive_ = now_alive;
    if (!same || !holds) search(state);
    ++cycles_since_search_;
    images_.refresh_motion(arrays_);
    if (clock.last_step == 0) return;
    if (!mixes) return sum_rates(clock, 0.5);
    const std::vector<double> rate_before = arrays_.rate;
    const std::vector<Tensor3<double>> gradient_before = arrays_.gradient;
    sum_rates(clock, 0);
    for (Index p = 0; p < arrays_.real_count(); ++p) {
        arrays_.rate[p] = 0.5 * (rate_before[p] + arrays_.rate[p]);
        if (tensor_) arrays_.gradient[p] = 0.5 * (gradient_before[p] + arrays_.gradient[p]);
    }
}

/// Density rates, and where stresses need them velocity gradients, over the step that ends at n; of `back`
/// steps before its end.
void ParticleBody::sum_rates(const Clock& clock, double back)
{
    const double step = clock.last_step, time_back = back * step;
    if (!tensor_) {
        const DensityDiffusion diffusion = step > 0 ? density_diffusion(clock) : DensityDiffusion{};
        sum_density_rates(options_.kernel, options_.dimension, time_back, runs_, arrays_, diffusion);
        if (options_.axisymmetric) {
            for (Index p = 0; p < arrays_.real_count(); ++p) {
                double& moment = arrays_.moment[p];
                moment = ring_moment(moment);
                arrays_.rate[p] = arrays_.rate[p] / moment - hoop_rate(arrays_.motion[p], time_back);
            }
        }
        return;
    }
    const auto take = [&](const NeighbourRun& run, const GradientSums* sums) {
        for (Index i = 0; i < run.length(); ++i) take_gradient(run.begin + i, time_back, sums[i]);
    };
    sum_velocity_gradients(options_.kernel, options_.dimension, time_back, runs_, arrays_, take);
}

/// The correction is that of the middle of the step; what the forces of its end use has turned on by half.
void ParticleBody::take_gradient(Index place, double time_back, const GradientSums& sums)
{
    ParticleArrays& a = arrays_;
    double scale = options_.volume_weighted ? 1 : 1 / a.density(place);
    Tensor3<double> gradient = sums.gradient();
    if (options_.axisymmetric) {
        const double weight = 1 / ring_radius(a.motion[place]);
        gradient.yx *= weight;
        gradient.yy *= weight;
    }
    if (options_.axisymmetric) {
        a.moment[place] = options_.renormalised ? 1 : ring_moment(0.5 * (sums.moment[0] + sums.moment[1]));
        scale /= a.moment[place];
    }
    gradient = scale * gradient;
    if (options_.renormalised) {
        const SymmetricTensor<double> b = gradient_correction(sums, scale, options_.dimension);
        gradient = gradient * full_tensor(b);
        a.correction[place] = turned_half(b, time_back * axial_vector(gradient));
    }
    if (options_.axisymmetric) gradient.zz = hoop_rate(a.motion[place], time_back);
    a.gradient[place] = gradient;
    const double expansion = gradient.xx + gradient.yy + gradient.zz;
    a.rate[place] = options_.volume_weighted ? -expansion : -expansion * a.density(place);
}

/// Takes positions and velocities from the State, and the heat of the second half of the last viscous
/// impulse.
void ParticleBody::read_motion(const Clock& clock, const State& state)
{
    ParticleArrays& a = arrays_;
    const double half_step = 0.5 * clock.last_step;
    for_chunks(real_count_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (p + prefetch_distance < end) {
                __builtin_prefetch(&state.position[a.node[p + prefetch_distance]]);
                __builtin_prefetch(&state.velocity[a.node[p + prefetch_distance]]);
            }
            MotionRecord& motion = a.motion[p];
            const Vec3& velocity = state.velocity[a.node[p]];
            const double heat = a.heat[p] - dot(wide(a.viscous_force[p]), velocity - motion.velocity);
            const PartConstants& part = parts_[a.part[p]].constants;
            a.energy[p] += half_step * heat * part.density / a.mass(p);
            // Volumes at the middle of the step, for the density rates.
            if (part.volume_weighted) motion.weight *= 1 - half_step * a.rate[p];
            const double radius = options_.axisymmetric ? ring_radius(motion) : 1;
            motion.position = state.position[a.node[p]];
            if (options_.axisymmetric) motion.weight *= radius / (0.5 * (radius + ring_radius(motion)));
            motion.velocity = velocity;
        }
    });
}

/// Sorts the particles anew and lists their neighbours.
void ParticleBody::search(State& state)
{
    ParticleArrays& a = arrays_;
    std::vector<Index> staying = dismiss_leaving(state);
    release(runs_);                                 // makes room for what sorting needs
    if (a.node.empty()) return put_to_sleep(state); // all still wait in solids
    images_.follow(state, model_.nodes.position);
    followed_.clear();
    for (const PeriodicPair& pair : images_.periods()) {
        followed_.push_back(pair.node == none ? Vec3{} : state.position[pair.node]);
    }
    const double range = set_reaches();
    std::vector<Vec3> position(real_count_);
    for_chunks(real_count_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t p = staying.empty() ? i : staying[i];
            if (images_.wrap(a.motion[p].position)) state.position[a.node[p]] = a.motion[p].position;
            position[i] = a.motion[p].position;
        }
    });
    if (images_.any()) images_.find(range, position);
    ParticleCells cells;
    cells.sort(position, range, real_count_);
    release(position);

    const std::vector<Index>& order = cells.order();
    const std::size_t images = images_.size();
    {
        std::vector<Index> old_place(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(real_count_));
        if (!staying.empty()) {
            for (Index& place : old_place) place = staying[place];
        }
        ArraySorter sort(std::move(old_place));
        sort(a.motion, images);
        sort(a.push, images);
        sort(a.node);
        sort(a.part, images);
        if (!a.bonded.empty()) sort(a.bonded, images);
        if (!a.asleep.empty()) sort(a.asleep);
        if (!a.own_mass.empty()) sort(a.own_mass);
        if (!a.bulk.empty()) sort(a.bulk);
        if (!a.first_radius.empty()) {
            sort(a.first_radius);
            sort(a.moment);
        }
        sort(a.rate);
        if (!a.kept_pressure.empty()) sort(a.kept_pressure);
        sort(a.energy);
        sort(a.viscous_force);
        sort(a.heat);
        sort(a.reach, images);
        if (!a.laminar.empty()) sort(a.laminar, images);
        if (!a.wall_gradient.empty()) sort(a.wall_gradient);
        if (!a.rest_pressure.empty()) {
            sort(a.rest_pressure);
            sort(a.rest_velocity);
        }
        if (tensor_) {
            sort(a.tension, images);
            sort(a.gradient);
            sort(a.correction);
            sort(a.stress);
            sort(a.history, 0, a.history_size);
        }
    }
    put_to_sleep(state);
    images_.settle(order, a);
    cells.release_order();
    images_.refresh_all(a);
    list_neighbours(cells);
    if (hosts_.any()) find_pressed();
}

/// Density, pressure, energy and smoothing length at n, and the shortest stable step.
void ParticleBody::apply_laws(double step, const std::vector<PlaceList>& all_places)
{
    vote_ = {};
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const ParticlePart& part = parts_[number];
        const PlaceList& places = all_places[number];
        std::vector<ParticleVote> votes((places.size() + chunk_length - 1) / chunk_length);
        for_chunks(places.size(), [&](std::size_t begin, std::size_t end) {
            votes[begin / chunk_length] = places.in_chunk(begin, end, [&](std::span<const Index> some) {
                return part.law->advance(part.constants, some, step, arrays_);
            });
        });
        for (const ParticleVote& vote : votes) vote_.take(vote);
    }
}

/// Adds pair forces to the State, and what viscosity does to motion and heat to the particles.
void ParticleBody::take_forces(const NeighbourRun& run, const ForceSums* sums, double half_step, State& state)
{
    ParticleArrays& a = arrays_;
    for (Index i = 0; i < run.length(); ++i) {
        const Index p = run.begin + i;
        if (p + static_cast<Index>(prefetch_distance) < run.end) {
            __builtin_prefetch(&state.force[a.node[p + prefetch_distance]], 1);
        }
        const double heat = sums[i].heat;
        a.viscous_force[p] = narrow(wide(a.viscous_force[p]) + sums[i].viscous_force);
        a.heat[p] += static_cast<float>(heat);
        const double density = parts_[a.part[p]].constants.density;
        a.energy[p] += half_step * heat * density / a.mass(p);
        state.force[a.node[p]] += sums[i].force;
    }
}

void ParticleBody::add_pair_forces(const Clock& clock, State& state)
{
    const double half_step = 0.5 * clock.last_step;
    const auto take = [&](const NeighbourRun& run, const ForceSums* sums) {
        for (Index p = run.begin; p < run.end; ++p) {
            arrays_.viscous_force[p] = {};
            arrays_.heat[p] = 0;
        }
        take_forces(run, sums, half_step, state);
        if (!options_.axisymmetric) return;
        for (Index p = run.begin; p < run.end; ++p) { // hoop stresses, which stand in the zz component
            state.force[arrays_.node[p]].x +=
                arrays_.moment[p] * arrays_.motion[p].weight * arrays_.push[p].push;
        }
    };
    const ArtificialViscosity viscosity =
        options_.bulk_viscosity ? ArtificialViscosity{0, 0} : options_.viscosity;
    sum_pair_forces(options_.kernel, options_.dimension, viscosity, runs_, arrays_, take);
}

void ParticleBody::after_motion(const Clock& clock, State& state)
{
    if (!arrays_.drift.empty()) {
        const bool carries = !arrays_.gradient.empty() && options_.velocity_blend == 0;
        for_chunks(arrays_.drift.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) {
                const Vec3 moved = clock.step * arrays_.drift[p];
                state.position[arrays_.node[p]] += moved;
                if (!carries) continue;
                const Vec3 change = arrays_.gradient[p] * moved;
                state.velocity[arrays_.node[p]] += change;
                arrays_.motion[p].velocity += change; // whose change otherwise is what forces do
            }
        });
    }
    images_.reflect_passed(arrays_, state);
    calm_wake(clock, state);
    for (const auto& [node, part] : leavers_) state.velocity[node] = {};
    leavers_.clear();
}

StepVote ParticleBody::stable_step() const
{
    if (vote_.place == none) return StepVote::nothing();
    const ParticlePart& part = parts_[arrays_.part[vote_.place]];
    return {vote_.step, "particle", model_.nodes.id[arrays_.node[vote_.place]], part.id};
}

/// Pairs that are weighed by masses take the density of a neighbour for their own.
std::vector<std::string> ParticleBody::notices(const State& state) const
{
    std::vector<std::string> lines;
    if (hosts_.any()) {
        lines.push_back(fmt::format("{} particles stand ready in {} solids",
                                    model_.particles.size() - model_.stand_ins.front().first,
                                    model_.stand_ins.size()));
    }
    for (std::string& line : mass_notices(model_, parts_, options_.dimension))
        lines.push_back(std::move(line));
    for (std::string& line : contact_notices(model_, state, parts_)) lines.push_back(std::move(line));
    if (options_.volume_weighted || !options_.parts_interact) return lines;
    const auto density_of = [](const ParticlePart& part) {
        return part.constants.density * part.law->initial_compression();
    };
    const auto [light, heavy] =
        std::minmax_element(parts_.begin(), parts_.end(), [&](const ParticlePart& a, const ParticlePart& b) {
            return density_of(a) < density_of(b);
        });
    constexpr double noticed = 1.2; // their ratio
    if (density_of(*heavy) <= noticed * density_of(*light)) return lines;
    lines.push_back(
        fmt::format("particles of parts {} and {} have the densities {:g} and {:g}: where they meet, FORM 0 "
                    "to 4 and 12 of *CONTROL_SPH are wrong by that ratio; FORM 5 and 6 are not",
                    light->id, heavy->id, density_of(*light), density_of(*heavy)));
    return lines;
}

void ParticleBody::report(EnergyLedger& ledger) const
{
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const double density = parts_[number].constants.density;
        const auto energy_of = [&](const PlaceList& places) {
            return sum_chunks(places.size(), [&](std::size_t begin, std::size_t end) {
                return places.in_chunk(begin, end, [&](std::span<const Index> some) {
                    double sum = 0;
                    for (Index p : some) sum += arrays_.energy[p] * arrays_.mass(p);
                    return sum;
                });
            });
        };
        const double energy = energy_of(places_[number]) + energy_of(sleepers_[number]);
        ledger.add_part(parts_[number].model_part, energy / density, 0);
    }
    for (Index p : bonded_places_) {
        const ParticlePart& part = parts_[arrays_.part[p]];
        ledger.add_part(part.model_part, arrays_.energy[p] * arrays_.mass(p) / part.constants.density, 0);
    }
    for (double energy : handed_internal_) ledger.eroded_internal -= energy;
    for (double energy : lost_kinetic_) ledger.eroded_kinetic += energy;
    ledger.damping += damped_energy_;
    ledger.external_work += wall_work_ + inflows_.work();
    for (const Departed& left : departed_) {
        ledger.eroded_kinetic += left.kinetic;
        ledger.eroded_internal += left.internal;
    }
}

} // namespace plash

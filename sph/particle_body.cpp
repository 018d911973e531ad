#include "sph/particle_body.h"

#include "core/parallel.h"
#include "core/run_error.h"
#include "sph/pair_passes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// values[new place] = values[old place]; images, which have no old place, start from nothing.
template <class Values>
void permute(Values& values, const std::vector<Index>& old_place)
{
    Values moved(old_place.size());
    for_chunks(old_place.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (old_place[p] != none) moved[p] = values[old_place[p]];
        }
    });
    values = std::move(moved);
}

/// The same for rows of `width` values.
void permute_rows(std::vector<double>& values, int width, const std::vector<Index>& old_place)
{
    std::vector<double> moved(old_place.size() * width);
    for_chunks(old_place.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (old_place[p] == none) continue;
            const double* row = values.data() + static_cast<std::size_t>(old_place[p]) * width;
            std::copy(row, row + width, moved.data() + p * width);
        }
    });
    values = std::move(moved);
}

/// Inverse of the moment of a kernel. Particles with too few neighbours to carry a linear field keep the
/// plain gradient.
SymmetricTensor<double> gradient_correction(const SymmetricTensor<double>& m)
{
    constexpr double smallest_determinant = 0.1; // 1 inside, 1/2 at a flat surface, 1/8 at a corner in space
    const double xx = m.yy * m.zz - m.yz * m.yz, xy = m.yz * m.zx - m.xy * m.zz,
                 zx = m.xy * m.yz - m.yy * m.zx;
    const double determinant = m.xx * xx + m.xy * xy + m.zx * zx;
    if (!(determinant > smallest_determinant)) return {1, 1, 1, 0, 0, 0};
    const double per = 1 / determinant;
    return {per * xx, per * (m.xx * m.zz - m.zx * m.zx), per * (m.xx * m.yy - m.xy * m.xy),
            per * xy, per * (m.xy * m.zx - m.xx * m.yz), per * zx};
}

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
    for (ParticlePart& part : parts_) {
        part.constants.dimension = options_.dimension;
        part.constants.volume_weighted = options_.volume_weighted;
        tensor_ = tensor_ || part.law->has_strength();
        arrays_.history_size = std::max(arrays_.history_size, part.law->history_size());
        for (std::size_t i = 0; i < part.nodes.size(); ++i) state.mass[part.nodes[i]] += part.mass[i];
        real_count_ += part.nodes.size();
    }
    create(state);
    search(state);
    if (tensor_) sum_rates(0); // for the correction of the first forces
    apply_laws(0);
}

/// All particles in the order of parts and their nodes, before the first search sorts them.
void ParticleBody::create(const State& state)
{
    ParticleArrays& a = arrays_;
    a.motion.reserve(real_count_);
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const ParticlePart& part = parts_[number];
        for (std::size_t i = 0; i < part.nodes.size(); ++i) {
            const Index node = part.nodes[i];
            a.particle.push_back(static_cast<Index>(a.motion.size()));
            a.motion.push_back(
                {state.position[node], part.constants.smoothing, state.velocity[node], part.mass[i]});
            a.node.push_back(node);
            a.part.push_back(static_cast<std::uint8_t>(number));
            a.mass.push_back(part.mass[i]);
            a.density.push_back(part.constants.density * part.law->initial_compression());
            a.energy.push_back(part.law->initial_energy());
            if (a.history_size == 0) continue;
            a.history.resize(a.history.size() + a.history_size);
            part.law->start_history(&*a.history.end() - a.history_size);
        }
    }
    if (tensor_) {
        a.tension.resize(real_count_);
        a.gradient.resize(real_count_);
        a.correction.assign(real_count_, {1, 1, 1, 0, 0, 0});
        a.stress.resize(real_count_);
    }
    a.image.resize(real_count_);
    a.push.resize(real_count_);
    a.rate.resize(real_count_);
    a.pressure.resize(real_count_);
    a.viscous_force.resize(real_count_);
    a.heat.resize(real_count_);
}

double ParticleBody::mean_neighbours() const
{
    std::size_t close = 0;
    const auto& motion = arrays_.motion;
    const auto touches = [&](Index a, Index b) {
        const Vec3 apart = motion[a].position - motion[b].position;
        const double reach = 0.5 * support_ * (motion[a].smoothing + motion[b].smoothing);
        return a != b && dot(apart, apart) < reach * reach;
    };
    for (const NeighbourRun& run : runs_) {
        const std::uint16_t* inside = run.inside.data();
        const Index* outside = run.outside.data();
        for (Index i = 0; i < run.length(); ++i) {
            const Index p = run.begin + i;
            for (int k = 0; k < run.batches[i].inside * lane_count; ++k)
                close += 2 * touches(p, run.begin + *inside++);
            for (int k = 0; k < run.batches[i].outside * lane_count; ++k) close += touches(p, *outside++);
        }
    }
    return real_count_ > 0 ? static_cast<double>(close) / static_cast<double>(real_count_) : 0;
}

void ParticleBody::add_forces(const Clock& clock, State& state)
{
    vote_ = {};
    if (clock.time < options_.birth || clock.time > options_.death) return;
    read_motion(clock, state);
    if (!lists_hold()) search(state);
    images_.refresh_motion(arrays_);
    if (clock.last_step > 0) sum_rates(clock.last_step);
    apply_laws(clock.last_step);
    images_.refresh_all(arrays_);
    add_pair_forces(clock, state);
}

/// Density rates, and where stresses need them velocity gradients, over the step that ends at n.
void ParticleBody::sum_rates(double step)
{
    if (!tensor_) {
        sum_density_rates(options_.kernel, options_.dimension, 0.5 * step, runs_, arrays_);
        return;
    }
    const auto take = [&](const NeighbourRun& run, const GradientSums* sums) {
        for (Index i = 0; i < run.length(); ++i) {
            if (!arrays_.image[run.begin + i]) take_gradient(run.begin + i, sums[i]);
        }
    };
    sum_velocity_gradients(options_.kernel, options_.dimension, 0.5 * step, runs_, arrays_, take);
}

void ParticleBody::take_gradient(Index place, const GradientSums& sums)
{
    ParticleArrays& a = arrays_;
    const double scale = options_.volume_weighted ? 1 : 1 / a.density[place];
    const double* v = sums.velocity;
    Tensor3<double> gradient{v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]};
    gradient = scale * gradient;
    if (options_.renormalised) {
        const double* m = sums.moment;
        const SymmetricTensor<double> b =
            gradient_correction({scale * m[0], scale * m[1], options_.dimension == 2 ? 1 : scale * m[2],
                                 scale * m[3], scale * m[4], scale * m[5]});
        const Tensor3<double> full{b.xx, b.xy, b.zx, b.xy, b.yy, b.yz, b.zx, b.yz, b.zz};
        gradient = gradient * full;
        a.correction[place] = b;
    }
    a.gradient[place] = gradient;
    const double expansion = gradient.xx + gradient.yy + gradient.zz;
    a.rate[place] = options_.volume_weighted ? -expansion : -expansion * a.density[place];
}

/// Takes positions and velocities from the State, and the heat of the second half of the last viscous
/// impulse.
void ParticleBody::read_motion(const Clock& clock, const State& state)
{
    ParticleArrays& a = arrays_;
    const double half_step = 0.5 * clock.last_step;
    for_chunks(a.motion.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (p + prefetch_distance < end && !a.image[p + prefetch_distance]) {
                __builtin_prefetch(&state.position[a.node[p + prefetch_distance]]);
                __builtin_prefetch(&state.velocity[a.node[p + prefetch_distance]]);
            }
            if (a.image[p]) continue;
            MotionRecord& motion = a.motion[p];
            const Vec3& velocity = state.velocity[a.node[p]];
            const double heat = a.heat[p] - dot(a.viscous_force[p], velocity - motion.velocity);
            const PartConstants& part = parts_[a.part[p]].constants;
            a.energy[p] += half_step * heat * part.density / a.mass[p];
            // Volumes at the middle of the step, for the density rates.
            if (part.volume_weighted) motion.weight *= 1 - half_step * a.rate[p];
            motion.position = state.position[a.node[p]];
            motion.velocity = velocity;
        }
    });
}

/// Whether no pair can have come into reach that is not on the lists.
bool ParticleBody::lists_hold() const
{
    // The largest relative displacement is at most twice the largest one, and at most the diagonal of the box
    // of all displacements: the second is what counts for a body that flies.
    struct Moved {
        Vec3 lower{}, upper{};
        double square = 0, growth = 0;
    };
    const ParticleArrays& a = arrays_;
    std::vector<Moved> partial((a.motion.size() + chunk_length - 1) / chunk_length);
    for_chunks(a.motion.size(), [&](std::size_t begin, std::size_t end) {
        Moved moved;
        bool first = true;
        for (std::size_t p = begin; p < end; ++p) {
            if (a.image[p]) continue;
            const Vec3 d = a.motion[p].position - a.build_position[p];
            if (first) moved.lower = moved.upper = d;
            first = false;
            moved.lower = {std::min(moved.lower.x, d.x), std::min(moved.lower.y, d.y),
                           std::min(moved.lower.z, d.z)};
            moved.upper = {std::max(moved.upper.x, d.x), std::max(moved.upper.y, d.y),
                           std::max(moved.upper.z, d.z)};
            moved.square = std::max(moved.square, dot(d, d));
            moved.growth = std::max(moved.growth, a.motion[p].smoothing - a.build_smoothing[p]);
        }
        partial[begin / chunk_length] = moved;
    });
    Moved all = partial.empty() ? Moved{} : partial.front();
    for (const Moved& moved : partial) {
        all.lower = {std::min(all.lower.x, moved.lower.x), std::min(all.lower.y, moved.lower.y),
                     std::min(all.lower.z, moved.lower.z)};
        all.upper = {std::max(all.upper.x, moved.upper.x), std::max(all.upper.y, moved.upper.y),
                     std::max(all.upper.z, moved.upper.z)};
        all.square = std::max(all.square, moved.square);
        all.growth = std::max(all.growth, moved.growth);
    }
    const double relative = images_.any() ? 2 * std::sqrt(all.square)
                                          : std::min(2 * std::sqrt(all.square), norm(all.upper - all.lower));
    return relative + support_ * all.growth <= skin_;
}

/// Sorts the particles anew and lists their neighbours.
void ParticleBody::search(State& state)
{
    ParticleArrays& a = arrays_;
    double largest = 0;
    for (std::size_t p = 0; p < a.motion.size(); ++p) largest = std::max(largest, a.motion[p].smoothing);
    skin_ = options_.skin * support_ * largest;
    const double range = support_ * largest + skin_;

    std::vector<Index> place_of(real_count_);
    std::vector<Vec3> position(real_count_);
    for_chunks(a.motion.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (a.image[p]) continue;
            if (images_.wrap(a.motion[p].position)) state.position[a.node[p]] = a.motion[p].position;
            place_of[a.particle[p]] = static_cast<Index>(p);
            position[a.particle[p]] = a.motion[p].position;
        }
    });
    if (images_.any()) images_.find(range, position);
    ParticleCells cells;
    cells.sort(position, range);

    const std::vector<Index>& order = cells.order();
    std::vector<Index> old_place(order.size());
    for (std::size_t p = 0; p < order.size(); ++p) {
        old_place[p] = order[p] < static_cast<Index>(real_count_) ? place_of[order[p]] : none;
    }
    permute(a.motion, old_place);
    permute(a.push, old_place);
    permute(a.node, old_place);
    permute(a.part, old_place);
    permute(a.mass, old_place);
    permute(a.density, old_place);
    permute(a.rate, old_place);
    permute(a.pressure, old_place);
    permute(a.energy, old_place);
    permute(a.viscous_force, old_place);
    permute(a.heat, old_place);
    if (tensor_) {
        permute(a.tension, old_place);
        permute(a.gradient, old_place);
        permute(a.correction, old_place);
        permute(a.stress, old_place);
        permute_rows(a.history, a.history_size, old_place);
    }
    a.particle = order;
    a.image.resize(order.size());
    places_.assign(parts_.size(), {});
    for (std::size_t p = 0; p < order.size(); ++p) {
        a.image[p] = old_place[p] == none;
        if (!a.image[p]) places_[a.part[p]].push_back(static_cast<Index>(p));
    }
    images_.settle(a);
    images_.refresh_all(a);
    list_neighbours(cells);
}

void ParticleBody::list_neighbours(const ParticleCells& cells)
{
    ParticleArrays& a = arrays_;
    a.build_position.resize(a.motion.size());
    a.build_smoothing.resize(a.motion.size());
    std::vector<double> reach(a.motion.size());
    for (std::size_t p = 0; p < a.motion.size(); ++p) {
        a.build_position[p] = a.motion[p].position;
        a.build_smoothing[p] = a.motion[p].smoothing;
        reach[p] = 0.5 * (support_ * a.motion[p].smoothing + skin_);
    }
    std::vector<std::uint64_t> sees;
    if (!options_.parts_interact) {
        for (std::size_t part = 0; part < parts_.size(); ++part) sees.push_back(1ULL << part);
    }
    build_neighbours(cells, {a.build_position, reach, a.image, a.part, sees}, runs_);
    ++searches_;
}

/// Density, pressure, energy and smoothing length at n, and the shortest stable step.
void ParticleBody::apply_laws(double step)
{
    vote_ = {};
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const ParticlePart& part = parts_[number];
        const std::span<const Index> places = places_[number];
        std::vector<ParticleVote> votes((places.size() + chunk_length - 1) / chunk_length);
        for_chunks(places.size(), [&](std::size_t begin, std::size_t end) {
            votes[begin / chunk_length] =
                part.law->advance(part.constants, places.subspan(begin, end - begin), step, arrays_);
        });
        for (const ParticleVote& vote : votes) vote_.take(vote);
    }
}

void ParticleBody::add_pair_forces(const Clock& clock, State& state)
{
    ParticleArrays& a = arrays_;
    const double half_step = 0.5 * clock.last_step;
    const auto take = [&](const NeighbourRun& run, const ForceSums* sums) {
        for (Index i = 0; i < run.length(); ++i) {
            const Index p = run.begin + i;
            if (a.image[p]) continue;
            const double weight = a.motion[p].weight;
            a.viscous_force[p] = weight * sums[i].viscous_force;
            a.heat[p] = weight * sums[i].heat;
            const double density = parts_[a.part[p]].constants.density;
            a.energy[p] += half_step * a.heat[p] * density / a.mass[p];
            state.force[a.node[p]] += weight * sums[i].force;
        }
    };
    sum_pair_forces(options_.kernel, options_.dimension, options_.viscosity, runs_, arrays_, take);
}

void ParticleBody::after_motion(const Clock&, State& state)
{
    images_.reflect_passed(arrays_, state);
}

StepVote ParticleBody::stable_step() const
{
    if (vote_.place == none) return StepVote::nothing();
    const ParticlePart& part = parts_[arrays_.part[vote_.place]];
    return {vote_.step, "particle", model_.nodes.id[arrays_.node[vote_.place]], part.id};
}

void ParticleBody::report(EnergyLedger& ledger) const
{
    for (std::size_t number = 0; number < parts_.size(); ++number) {
        const std::span<const Index> places = places_[number];
        const double density = parts_[number].constants.density;
        const double energy = sum_chunks(places.size(), [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (Index p : places.subspan(begin, end - begin)) sum += arrays_.energy[p] * arrays_.mass[p];
            return sum;
        });
        ledger.add_part(parts_[number].model_part, energy / density, 0);
    }
}

} // namespace plash

// What a body of particles does beyond the plain scheme, when the deck asks for it (*PLASH_SPH_FORMULATION).

#include "core/parallel.h"
#include "core/prescribed_rate.h"
#include "sph/absorbed_power.h"
#include "sph/moving_domain.h"
#include "sph/pair_passes.h"
#include "sph/particle_body.h"

#include <algorithm>
#include <cmath>

namespace plash {

/// Acceleration by the body loads that act on all particles: on everything, or on every part of this body.
Vec3 ParticleBody::gravity(double time) const
{
    const auto acts_here = [&](const BodyLoad& load) {
        if (load.kind != BodyLoad::Kind::translation) return false;
        if (load.parts.empty()) return load.nodes.empty();
        return std::all_of(parts_.begin(), parts_.end(), [&](const ParticlePart& part) {
            return std::find(load.parts.begin(), load.parts.end(), part.model_part) != load.parts.end();
        });
    };
    Vec3 sum{};
    for (const BodyLoad& load : model_.body_loads) {
        if (!acts_here(load)) continue;
        sum -= (load.scale * curve_value(model_, load.curve, time)) * load.direction;
    }
    return sum;
}

DensityDiffusion ParticleBody::density_diffusion(const Clock& clock)
{
    if (!(options_.density_diffusion > 0)) return {};
    arrays_.diffusion.resize(real_count_);
    return {options_.density_diffusion, gravity(clock.time),  arrays_.push.data(),     arrays_.part.data(),
            arrays_.image.data(),       arrays_.real_count(), options_.volume_weighted};
}

/// Re-initialised densities; pressures follow with the next step.
void ParticleBody::filter_densities()
{
    ParticleArrays& a = arrays_;
    images_.refresh_all(a);
    const std::vector<double> density =
        filtered_densities(options_.kernel, options_.dimension, options_.volume_weighted, runs_, a);
    for_chunks(density.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (!parts_[a.part[p]].law->has_strength()) a.change_density(p, density[p]);
        }
    });
}

void ParticleBody::add_tensile_forces(const Clock& clock, State& state)
{
    const auto take = [&](const NeighbourRun& run, const ForceSums* sums) {
        take_forces(run, sums, 0.5 * clock.last_step, state);
    };
    sum_tensile_forces(options_.kernel, options_.dimension, options_.volume_weighted,
                       options_.tensile_repulsion, runs_, arrays_, take);
}

/// Images behind walls without slip follow from the gradients of the last step, and gradients from how the
/// images move: so they agree with each other. The first step has mirror images.
void ParticleBody::add_laminar_forces(const Clock& clock, State& state)
{
    const bool sticking = images_.any_sticking();
    if (sticking && !arrays_.wall_gradient.empty()) images_.bend_at_walls(arrays_);
    const auto take = [&](const NeighbourRun& run, const ForceSums* sums) {
        take_forces(run, sums, 0.5 * clock.last_step, state);
    };
    sum_laminar_forces(options_.kernel, options_.dimension, runs_, arrays_, take);
    if (sticking) find_wall_gradients();
}

void ParticleBody::find_wall_gradients()
{
    ParticleArrays& a = arrays_;
    a.wall_gradient.resize(real_count_);
    const auto take = [&](const NeighbourRun& run, const GradientSums* sums) {
        for (Index i = 0; i < run.length(); ++i) {
            const Index p = run.begin + i;
            const double scale = options_.volume_weighted ? 1 : 1 / a.density(p);
            a.wall_gradient[p] = (scale * sums[i].gradient()) *
                                 full_tensor(gradient_correction(sums[i], scale, options_.dimension));
        }
    };
    sum_velocity_gradients(options_.kernel, options_.dimension, 0, runs_, a, take);
}

/// What sliding walls do: viscous forces between particles take from the motion what they heat, so what
/// motion and heat gain together comes from the images behind such walls. Likewise what particles asleep
/// would be heated by.
double ParticleBody::power_of_walls() const
{
    const bool sliding =
        std::any_of(options_.mirrors.begin(), options_.mirrors.end(),
                    [](const MirrorPlane& wall) { return wall.no_slip && norm(wall.velocity) > 0; });
    if (!sliding && !anyone_asleep()) return 0;
    return sum_chunks(real_count_, [&](std::size_t begin, std::size_t end) {
        double power = 0;
        for (std::size_t p = begin; p < end; ++p) {
            power += dot(wide(arrays_.viscous_force[p]), arrays_.motion[p].velocity) + arrays_.heat[p];
        }
        return power;
    });
}

/// Work of absorbing planes with the forces of n, over half of the step that ends there.
void ParticleBody::add_absorbed_work(double half_step)
{
    if (absorbed_force_.empty()) return;
    double power = absorbed_power_;
    for (Index p = 0; p < arrays_.real_count(); ++p) {
        power += dot(absorbed_force_[p], arrays_.motion[p].velocity);
    }
    wall_work_ += half_step * power;
}

void ParticleBody::find_absorbed_forces()
{
    absorbed_force_.clear();
    absorbed_power_ = 0;
    if (!images_.any_absorbing() && !anyone_asleep()) return;
    absorbed_force_.assign(real_count_, {});
    with_kernel(options_.kernel, [&]<class K>(K) {
        for (const NeighbourRun& run : runs_) {
            AbsorbedPower<K> pass(arrays_, images_, run.begin, options_.dimension, absorbed_force_);
            walk_pairs<double>(run, pass);
            absorbed_power_ += pass.power;
        }
    });
}

/// XSPH moves a particle with a velocity nearer to that of its neighbours. Shifting moves it away from where
/// particles crowd, with 2 h U times the crowding, U being the largest speed against the mean; not near a
/// free surface, where the kernel is not full and crowding says nothing.
void ParticleBody::find_drifts(const State& state)
{
    ParticleArrays& a = arrays_;
    a.drift.assign(real_count_, {});
    Vec3 momentum{};
    double mass = 0, fastest = 0;
    for (const ParticlePart& part : parts_)
        for (std::size_t i = 0; i < part.nodes.size(); ++i) {
            momentum += state.mass[part.nodes[i]] * state.velocity[part.nodes[i]];
            mass += state.mass[part.nodes[i]]; // none once the particle has left
        }
    const Vec3 mean = (1 / mass) * momentum;
    for (const ParticlePart& part : parts_)
        for (Index node : part.nodes) fastest = std::max(fastest, norm(state.velocity[node] - mean));

    const double inside = 0.85 * options_.dimension;
    const auto take = [&](const NeighbourRun& run, const DriftSums* sums) {
        for (Index i = 0; i < run.length(); ++i) {
            const Index p = run.begin + i;
            Vec3 drift = options_.velocity_blend * sums[i].smoothed;
            if (options_.shifting > 0 && sums[i].spread > inside) {
                Vec3 shift = (-2 * options_.shifting * a.motion[p].smoothing * fastest) * sums[i].crowding;
                const double speed = norm(shift);
                if (speed > 0.5 * fastest) shift = (0.5 * fastest / speed) * shift;
                drift += shift;
            }
            a.drift[p] = drift;
        }
    };
    sum_drifts(options_.kernel, options_.dimension, options_.volume_weighted, runs_, a, take);
}

/// Calms what the lower planes of moving periodic pairs are about to reach; the energy taken is damping.
void ParticleBody::calm_wake(const Clock& clock, State& state)
{
    const auto periods = images_.periods();
    for (std::size_t index = 0; index < periods.size(); ++index) {
        const PeriodicPair& pair = periods[index];
        if (pair.node == none || !(pair.calm > 0)) continue;
        PeriodicPair now = pair; // the planes themselves move with the next search
        const Vec3 along = unit(pair.period);
        const double moved = clock.step * dot(state.velocity[pair.node], along);
        const double since_search = dot(state.position[pair.node] - followed_[index], along);
        now.lower += since_search * along;
        const CalmZone zone(now, moved);
        damped_energy_ += sum_chunks(real_count_, [&](std::size_t begin, std::size_t end) {
            double taken = 0;
            for (std::size_t p = begin; p < end; ++p) {
                taken += calm_particle(zone, static_cast<Index>(p), clock.step, state);
            }
            return taken;
        });
    }
}

/// The energy that a particle loses in the zone. The loop has let the force of n act with the whole velocity
/// over the first half of the step, while all terms take their work over the whole step with the velocity
/// that they find, the calmed one: the difference goes with what is taken.
double ParticleBody::calm_particle(const CalmZone& zone, Index place, double step, State& state)
{
    ParticleArrays& a = arrays_;
    const Index node = a.node[place];
    Vec3& position = state.position[node];
    const double kept = zone.kept(position);
    if (kept == 1) return 0;
    Vec3& velocity = state.velocity[node];
    const double mass = a.mass(place);
    const double kinetic =
        0.5 * (1 - kept) *
        ((1 + kept) * mass * dot(velocity, velocity) - step * dot(state.force[node], velocity));
    velocity = kept * velocity;
    const Vec3 home = zone.home(model_.nodes.position[node], position);
    position = home + kept * (position - home);
    const ParticlePart& part = parts_[a.part[place]];
    const double at_rest = part.density_at_rest(model_.nodes.position[node]);
    a.change_density(place, at_rest + kept * (a.density(place) - at_rest));
    const double energy = part.law->initial_energy();
    const double heat = (1 - kept) * (a.energy[place] - energy) * mass / part.constants.density;
    a.energy[place] = energy + kept * (a.energy[place] - energy);
    return kinetic + heat;
}

} // namespace plash

// Particles outside of the active regions.

#include "sph/particle_body.h"

#include <algorithm>

namespace plash {

bool ParticleBody::is_awake(Index place) const
{
    const Index part = parts_[arrays_.part[place]].model_part;
    bool concerned = false;
    for (std::size_t i = 0; i < options_.regions.size(); ++i) {
        const ActiveRegion& region = options_.regions[i];
        if (std::find(region.parts.begin(), region.parts.end(), part) == region.parts.end()) continue;
        if (region.holds(arrays_.motion[place].position, regions_at_[i])) return true;
        concerned = true;
    }
    return !concerned;
}

/// Finds who is awake, and stops who is not; the energy of their motion counts as damped.
void ParticleBody::put_to_sleep(State& state)
{
    ParticleArrays& a = arrays_;
    places_.assign(parts_.size(), {});
    sleepers_.assign(parts_.size(), {});
    if (options_.regions.empty()) {
        for (std::size_t i = 0; i < parts_.size(); ++i) places_[i].reserve(parts_[i].nodes.size());
    }
    regions_at_.clear();
    for (const ActiveRegion& region : options_.regions) {
        regions_at_.push_back(region.travelled(state, model_.nodes.position));
    }
    for (Index p = 0; p < a.real_count(); ++p) {
        a.asleep[p] = !options_.regions.empty() && !is_awake(p);
        (a.asleep[p] ? sleepers_ : places_)[a.part[p]].push_back(p);
        if (!a.asleep[p]) continue;
        Vec3& velocity = state.velocity[a.node[p]];
        damped_energy_ += 0.5 * a.mass(p) * dot(velocity, velocity);
        velocity = a.motion[p].velocity = {};
        a.rate[p] = 0;
    }
}

void ParticleBody::constrain(const Clock&, State& state)
{
    for (const std::vector<Index>& sleepers : sleepers_) {
        for (Index p : sleepers) {
            state.force[arrays_.node[p]] = {};
            state.velocity[arrays_.node[p]] = {};
        }
    }
}

} // namespace plash

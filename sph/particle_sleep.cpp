// Particles outside of the active regions, and those that have not flowed in yet.

#include "sph/particle_body.h"

#include <algorithm>

namespace plash {

bool ParticleBody::is_awake(Index place) const
{
    const MotionRecord& motion = arrays_.motion[place];
    if (inflows_.waits(arrays_.node[place])) {
        // Within reach of who is in, until the next one comes in and all are looked at again.
        return inflows_.distance(arrays_.node[place], motion.position) < 2.5 * support_ * motion.smoothing;
    }
    const Index part = parts_[arrays_.part[place]].model_part;
    bool concerned = false;
    for (std::size_t i = 0; i < options_.regions.size(); ++i) {
        const ActiveRegion& region = options_.regions[i];
        if (std::find(region.parts.begin(), region.parts.end(), part) == region.parts.end()) continue;
        if (region.holds(motion.position, regions_at_[i])) return true;
        concerned = true;
    }
    return !concerned;
}

/// Whether particles stand still whose neighbours move.
bool ParticleBody::anyone_asleep() const
{
    return std::any_of(sleepers_.begin(), sleepers_.end(),
                       [](const PlaceList& places) { return places.size() > 0; });
}

/// Finds who is awake. Others see those that fall asleep stand still from now on; their nodes are stopped
/// when all forces are known.
void ParticleBody::put_to_sleep(State& state)
{
    ParticleArrays& a = arrays_;
    places_.assign(parts_.size(), {});
    sleepers_.assign(parts_.size(), {});
    fallen_asleep_.clear();
    const bool nobody = options_.regions.empty() && !inflows_.any();
    inflows_.look(state);
    regions_at_.clear();
    for (const ActiveRegion& region : options_.regions) {
        regions_at_.push_back(region.travelled(state, model_.nodes.position));
    }
    bonded_places_.clear();
    if (nobody && a.bonded.empty() && parts_.size() == 1) { // all are awake, from the first one on
        places_[0].take_all(a.real_count());
        return;
    }
    for (Index p = 0; p < a.real_count(); ++p) {
        if (!a.bonded.empty() && a.bonded[p]) {
            if (!nobody) a.asleep[p] = 0;
            bonded_places_.push_back(p);
            continue;
        }
        const bool asleep = !nobody && !is_awake(p);
        const bool was_awake = nobody || a.asleep[p] == 0;
        if (!nobody) a.asleep[p] = asleep;
        // Those that wait to flow in are pressed by those in front of them.
        const bool at_rest = asleep && !inflows_.waits(a.node[p]);
        (at_rest ? sleepers_ : places_)[a.part[p]].add(p);
        if (!at_rest) continue;
        a.motion[p].velocity = {};
        if (!was_awake) continue;
        fallen_asleep_.resize(parts_.size());
        fallen_asleep_[a.part[p]].add(p);
    }
}

/// Laws of those that have fallen asleep, a last time: what pressed on them did so for half of the step.
void ParticleBody::apply_last_laws(double step)
{
    const ParticleVote vote = vote_;
    apply_laws(step, fallen_asleep_);
    vote_ = vote;
}

void ParticleBody::constrain(const Clock& clock, State& state)
{
    inflows_.constrain(clock, state);
    // All terms have counted the work of the forces of n over the step that ends there.
    for (const PlaceList& fallen : fallen_asleep_) {
        fallen.for_each([&](Index p) {
            const Index node = arrays_.node[p];
            const Vec3& velocity = state.velocity[node];
            damped_energy_ += 0.5 * (arrays_.mass(p) * dot(velocity, velocity) +
                                     clock.last_step * dot(state.force[node], velocity));
        });
    }
    fallen_asleep_.clear();
    for (const auto& [node, part] : leavers_) {
        departed_[part].kinetic += 0.5 * clock.last_step * dot(state.force[node], state.velocity[node]);
    }
    for (const PlaceList& sleepers : sleepers_) {
        sleepers.for_each([&](Index p) {
            state.force[arrays_.node[p]] = {};
            state.velocity[arrays_.node[p]] = {};
        });
    }
}

} // namespace plash

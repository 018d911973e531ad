// Particles that leave the run: out of the box of *CONTROL_SPH, faster than its MAXV, or through a plane that
// reflects nothing.

#include "core/parallel.h"
#include "sph/particle_body.h"

namespace plash {

bool ParticleBody::leaves(Index place) const
{
    if (!arrays_.bonded.empty() && arrays_.bonded[place]) return false;
    const MotionRecord& motion = arrays_.motion[place];
    if (options_.box && !options_.box->holds(motion.position)) return true;
    for (const MirrorPlane& plane : options_.mirrors) {
        if (plane.absorbing && dot(motion.position - plane.point, plane.normal) < 0) return true;
    }
    return dot(motion.velocity, motion.velocity) > options_.largest_speed * options_.largest_speed;
}

bool ParticleBody::anyone_leaves() const
{
    if (!options_.box && options_.largest_speed == forever && !images_.any_absorbing()) return false;
    return sum_chunks(arrays_.real_count(), [&](std::size_t begin, std::size_t end) {
               double count = 0;
               for (std::size_t p = begin; p < end; ++p) {
                   count += leaves(static_cast<Index>(p));
               }
               return count;
           }) > 0;
}

/// Forces of others have acted on leaving particles for the first half of the step that ends now: their
/// energies take its work, with the rates that `find_rates` has found before it lets them go.
void ParticleBody::add_last_work(double step)
{
    ParticleArrays& a = arrays_;
    for (Index p = 0; p < a.real_count(); ++p) {
        if (!leaves(p)) continue;
        const PartConstants& part = parts_[a.part[p]].constants;
        double power; // by volume
        if (parts_[a.part[p]].law->has_strength()) {
            power = contract(a.stress[p], symmetric_part(a.gradient[p]));
            if (!a.bulk.empty()) power -= a.bulk[p] * trace(symmetric_part(a.gradient[p]));
        } else {
            const double closing = part.volume_weighted ? a.rate[p] : a.rate[p] / a.density(p);
            power = (a.pressure(p) + (a.bulk.empty() ? 0 : a.bulk[p])) * closing;
        }
        a.energy[p] += 0.5 * step * power * part.density / a.density(p);
    }
}

/// Takes leaving particles out of the motion: their nodes stand still without mass from the end of the cycle
/// on, as other terms still count the work of their last forces, and their energies go to the eroded ones.
/// Returns the places of those that stay; empty: all do.
std::vector<Index> ParticleBody::dismiss_leaving(State& state)
{
    ParticleArrays& a = arrays_;
    std::vector<Index> staying;
    departed_.resize(parts_.size());
    if (!anyone_leaves()) return staying;
    for (Index p = 0; p < a.real_count(); ++p) {
        if (!leaves(p)) {
            staying.push_back(p);
            continue;
        }
        Departed& left = departed_[a.part[p]];
        ++left.count;
        left.mass += a.mass(p);
        left.kinetic += 0.5 * a.mass(p) * dot(a.motion[p].velocity, a.motion[p].velocity);
        left.internal += a.energy[p] * a.mass(p) / parts_[a.part[p]].constants.density;
        state.mass[a.node[p]] = 0;
        leavers_.emplace_back(a.node[p], a.part[p]);
    }
    real_count_ = staying.size();
    ++state.deletions; // contacts look again at what they hold
    return staying;
}

} // namespace plash

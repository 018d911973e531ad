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

/// Takes leaving particles out of the motion: their nodes stand still without mass, their energies go to the
/// eroded ones. Returns the places of those that stay; empty: all do.
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
        state.velocity[a.node[p]] = {};
    }
    real_count_ = staying.size();
    return staying;
}

} // namespace plash

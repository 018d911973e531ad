// What a body of particles hands to recorders.

#include "sph/particle_body.h"

#include <cmath>
#include <numeric>

namespace plash {

namespace {

/// Stress of a particle: that of its law, or the pressure of a fluid [stress].
SymmetricTensor<double> stress_of(const ParticlePart& part, const ParticleArrays& arrays, Index place)
{
    if (part.law->has_strength()) return arrays.stress[place];
    const double pressure = arrays.pressure(place);
    return {-pressure, -pressure, -pressure, 0, 0, 0};
}

double strain_of(const ParticlePart& part, const ParticleArrays& arrays, Index place)
{
    if (!part.law->has_strength()) return std::log(arrays.density(place) / part.constants.density);
    return part.law->plastic_strain(arrays.history.data() + std::size_t(place) * arrays.history_size);
}

} // namespace

std::vector<int> ParticleBody::count_neighbours() const
{
    const auto& motion = arrays_.motion;
    std::vector<int> count(arrays_.real_count());
    const auto touches = [&](Index a, Index b) {
        const Vec3 apart = motion[a].position - motion[b].position;
        const double reach = 0.5 * support_ * (motion[a].smoothing + motion[b].smoothing);
        return a != b && dot(apart, apart) < reach * reach;
    };
    for (const NeighbourRun& run : runs_) {
        for_listed(run, [&](Index p, Index other, bool inside) {
            if (!touches(p, other)) return;
            ++count[p];
            if (inside) ++count[other];
        });
    }
    return count;
}

double ParticleBody::mean_neighbours() const
{
    const std::vector<int> count = count_neighbours();
    const double all = std::accumulate(count.begin(), count.end(), 0.0);
    return real_count_ > 0 ? all / static_cast<double>(real_count_) : 0;
}

void ParticleBody::collect(const State& state, ElementResults& results) const
{
    if (!results.part_motion.empty()) {
        for (std::size_t number = 0; number < parts_.size(); ++number) {
            const ParticlePart& part = parts_[number];
            ElementResults::PartMotion& motion = results.part_motion[part.model_part];
            motion.eroded_kinetic += departed_[number].kinetic;
            motion.eroded_internal += departed_[number].internal;
            for (Index node : part.nodes) {
                const Vec3& velocity = state.velocity[node];
                const double mass = state.mass[node]; // none once the particle has left
                motion.mass += mass;
                motion.kinetic += 0.5 * mass * dot(velocity, velocity);
                motion.momentum[0] += mass * velocity.x;
                motion.momentum[1] += mass * velocity.y;
                motion.momentum[2] += mass * velocity.z;
            }
        }
    }
    if (!results.part_motion.empty()) {
        for (std::size_t part = 0; part < handed_internal_.size(); ++part) {
            results.part_motion[part].eroded_internal -= handed_internal_[part];
            results.part_motion[part].eroded_kinetic += lost_kinetic_[part];
        }
    }
    if (results.particles.empty()) return;
    const ParticleArrays& a = arrays_;
    const std::vector<int> neighbours = count_neighbours();
    std::vector<Index> element_of(state.size(), none);
    for (const ParticlePart& part : parts_) {
        for (std::size_t i = 0; i < part.elements.size(); ++i) element_of[part.nodes[i]] = part.elements[i];
    }
    for (Index p = 0; p < a.real_count(); ++p) {
        if (element_of[a.node[p]] == none || hosts_.waits(a.node[p])) continue;
        const ParticlePart& part = parts_[a.part[p]];
        ElementResults::Particle& particle = results.particles[element_of[a.node[p]]];
        particle.smoothing = a.motion[p].smoothing;
        particle.pressure = a.pressure(p);
        particle.density = a.density(p);
        particle.mass = a.mass(p);
        particle.internal_energy = a.energy[p] * a.mass(p) / part.constants.density;
        particle.plastic_strain = strain_of(part, a, p);
        particle.stress = stress_of(part, a, p);
        particle.neighbours = neighbours[p];
        particle.active = true;
    }
}

} // namespace plash

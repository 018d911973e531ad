#pragma once

#include "sph/images.h"
#include "sph/particle_arrays.h"

#include <cmath>

namespace plash {

/// The zone in front of the lower plane of moving periodic planes (Siemann & Groenenboom 2014): while the
/// plane comes nearer, a particle's velocity and its displacement from the place where it started fall
/// linearly to zero, so that what comes in again through the upper plane is still water. Nothing ahead of a
/// ditching body then remembers its wake, and the number of particles does not depend on the length of the
/// run.
class CalmZone {
public:
    /// pair   where its planes stand now
    /// moved  how far they have moved in this step [length]
    CalmZone(const PeriodicPair& pair, double moved)
        : lower_(pair.lower), period_(pair.period), calm_(pair.calm), moved_(moved)
    {}

    /// The share of its deviation that a particle at a place keeps in this step: 1 outside of the zone.
    double kept(const Vec3& position) const
    {
        const double ahead = dot(position - lower_, unit(period_)); // of the plane where it stands now
        if (ahead >= calm_ || moved_ <= 0) return 1;
        return ahead <= 0 ? 0 : ahead / (ahead + moved_);
    }

    /// The place of the lattice of periods around `start` that is nearest to a position.
    Vec3 home(const Vec3& start, const Vec3& position) const
    {
        const double periods = std::round(dot(position - start, period_) / dot(period_, period_));
        return start + periods * period_;
    }

private:
    Vec3 lower_, period_;
    double calm_, moved_;
};

} // namespace plash

#pragma once

#include "output/result_file.h"
#include "output/schedule.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// What sphout says of one particle.
struct ParticleRow {
    Id id = 0;
    Id part = 0;
    ElementResults::Particle state;
};

/// The table of one state; `cycle` counts from 1. Two lines a particle: the six stresses, von Mises stress
/// and plastic strain (of fluids the logarithm of density over its reference); then pressure, density,
/// smoothing length, internal energy of the particle, neighbours and whether it is active.
std::string format_sphout(long cycle, double time, std::span<const ParticleRow>);

/// *DATABASE_SPHOUT: the particles of *DATABASE_HISTORY_SPH. The columns are Plash's own: no file of LS-DYNA
/// was there to compare with.
class SphoutRecorder final : public ScheduledRecorder {
public:
    SphoutRecorder(const Model&, Schedule, const ResultPath& path);

private:
    std::vector<Index> particles_; ///< by the Model's order
    ResultFile file_;

    void write_state(const Snapshot&) override;
    void serialise_files(Archive& archive) override { archive(file_); }
};

} // namespace plash

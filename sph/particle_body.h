#pragma once

#include "core/term.h"
#include "model/model.h"
#include "sph/images.h"
#include "sph/neighbours.h"
#include "sph/particle_arrays.h"
#include "sph/particle_law.h"
#include "sph/velocity_gradient.h"

#include <memory>
#include <vector>

namespace plash {

/// Particles of one part as they start.
struct ParticlePart {
    Index model_part = 0; ///< index in the Model
    Id id = 0;            ///< of the part
    std::vector<Index> nodes;
    std::vector<double> mass; ///< by node [mass]
    std::shared_ptr<const ParticleLaw> law;
    PartConstants constants;
};

/// How the particles of a scene act on each other.
struct ParticleOptions {
    Kernel kernel = Kernel::cubic_spline;
    int dimension = 3;
    bool volume_weighted = false;  ///< the fluid forms: pairs weighed by volumes instead of masses
    bool renormalised = false;     ///< kernel gradients corrected to be exact for linear fields
    bool parts_interact = true;    ///< false: particles see only their own part (CONT = 1)
    ArtificialViscosity viscosity; ///< of pairs
    double birth = 0;              ///< particles act on each other from here ... [time]
    double death = forever;        ///< ... to here [time]
    double skin = 0.1;             ///< of the neighbour lists, as a share of the largest kernel radius
    std::vector<MirrorPlane> mirrors;
    std::vector<PeriodicPair> periods;
};

/// All particles of a scene that see each other (smoothed particle hydrodynamics). Each particle is a node of
/// the State; density, energy and pressure live here.
///
/// A step, in the loop's staggering: density advances with the velocities at n - 1/2, centred between the
/// positions at n - 1 and n; the law gives the pressure at n; pair forces at n go to the State. Pressure work
/// is the mean pressure times the change of volume. Viscous forces at n act from n - 1/2 to n + 1/2: their
/// heat is taken with the velocities of both ends, so that what the motion loses the particles gain exactly.
class ParticleBody : public Term {
public:
    /// Adds the masses of the particles to the State.
    ParticleBody(std::vector<ParticlePart> parts, ParticleOptions options, const Model& model, State& state);

    std::string_view name() const override { return "particles"; }
    std::size_t items() const override { return real_count_; }
    void add_forces(const Clock& clock, State& state) override;
    void after_motion(const Clock& clock, State& state) override;
    StepVote stable_step() const override;
    void report(EnergyLedger& ledger) const override;
    void serialise(Archive& archive) override { archive(arrays_, images_, runs_, places_, skin_, searches_); }

    const ParticleArrays& arrays() const { return arrays_; }
    const std::vector<NeighbourRun>& runs() const { return runs_; }
    long searches() const { return searches_; } ///< neighbour searches so far
    /// Mean number of real neighbours closer than the kernel radius.
    double mean_neighbours() const;

private:
    const Model& model_;
    std::vector<ParticlePart> parts_;
    ParticleOptions options_;
    double support_; ///< kernel radius over smoothing length
    ParticleArrays arrays_;
    Images images_;
    std::vector<NeighbourRun> runs_;
    std::vector<std::vector<Index>> places_; ///< by part: sorted places of its particles
    std::size_t real_count_ = 0;
    bool tensor_ = false; ///< push is a tensor
    double skin_ = 0;     ///< [length]
    long searches_ = 0;
    ParticleVote vote_;

    void create(const State& state);
    void read_motion(const Clock& clock, const State& state);
    bool lists_hold() const;
    void sum_rates(double step);
    void take_gradient(Index place, const GradientSums& sums);
    void search(State& state);
    void list_neighbours(const ParticleCells& cells);
    void apply_laws(double step);
    void add_pair_forces(const Clock& clock, State& state);
};

} // namespace plash

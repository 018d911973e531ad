#pragma once

#include "core/term.h"
#include "materials/depth_stress.h"
#include "model/model.h"
#include "sph/active_region.h"
#include "sph/density_rate.h"
#include "sph/images.h"
#include "sph/inflow.h"
#include "sph/neighbours.h"
#include "sph/particle_arrays.h"
#include "sph/particle_law.h"
#include "sph/place_list.h"
#include "sph/solid_hosts.h"
#include "sph/velocity_gradient.h"

#include <memory>
#include <optional>
#include <vector>

namespace plash {

/// Particles of one part as they start.
struct ParticlePart {
    Index model_part = 0; ///< index in the Model
    Id id = 0;            ///< of the part
    std::vector<Index> nodes;
    std::vector<double> mass;    ///< by node; of rings of the area in the plane [mass]
    std::vector<Index> elements; ///< by node: place in Model::particles, for results; may be empty
    std::shared_ptr<const ParticleLaw> law;
    PartConstants constants;
    double birth = 0;                  ///< its particles are particles from here ... [time]
    double death = forever;            ///< ... to here, and nodes that fly freely otherwise [time]
    std::optional<DepthStress> weight; ///< of what lies above, at the start

    /// Density at rest of a particle that started at a place [mass/volume].
    double density_at_rest(const Vec3& start) const
    {
        return constants.density *
               (weight ? law->compression_at(-weight->vertical(start.z)) : law->initial_compression());
    }
};

/// How the particles of a scene act on each other.
struct ParticleOptions {
    Kernel kernel = Kernel::cubic_spline;
    bool own_kernel = false; ///< `kernel` holds, whatever the sections say
    int dimension = 3;
    bool axisymmetric = false; ///< particles are rings around the y axis (sph/rings.h); with volume weights
    bool volume_weighted = false;        ///< the fluid forms: pairs weighed by volumes instead of masses
    bool renormalised = false;           ///< kernel gradients corrected to be exact for linear fields
    bool failed_carry_nothing = false;   ///< failed solids lose their stress (IEROD = 1)
    bool smoothing_by_cube_root = false; ///< smoothing lengths by the root of div(v) (DERIV = 1)
    bool parts_interact = true;          ///< false: particles see only their own part (CONT = 1)
    ArtificialViscosity viscosity;       ///< of pairs, or
    bool bulk_viscosity = false;         ///< of particles, as solid elements have it (IAVIS = 1)
    double density_diffusion = 0;        ///< delta of Molteni & Colagrossi, 0.1 as a rule; fluids only [-]
    double velocity_blend = 0;           ///< epsilon of XSPH, 0.5 as a rule [-]
    double shifting = 0;                 ///< strength of particle shifting, 1 as a rule [-]
    double tensile_repulsion = 0;        ///< epsilon of Monaghan's artificial pressure, 0.2 as a rule [-]
    bool graded = false;                 ///< smoothing lengths by the masses of particles
    bool laminar_by_velocity = false;    ///< laminar viscosity of Morris et al., not of Monaghan & Cleary
    int filter_interval = 0;             ///< cycles between two density re-initialisations; 0: none
    std::vector<ActiveRegion> regions;   ///< where particles are awake; none: everywhere
    std::optional<Box> box;              ///< particles that leave it leave the run (BOXID)
    double largest_speed = forever;      ///< faster particles leave the run (MAXV) [velocity]
    double birth = 0;                    ///< particles act on each other from here ... [time]
    double death = forever;              ///< ... to here [time]
    double skin = 0; ///< of the neighbour lists, as a share of the largest kernel radius; 0: what costs least
    std::vector<MirrorPlane> mirrors;
    std::vector<PeriodicPair> periods;
    std::vector<Inflow> inflows;
};

class CalmZone;

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
    std::size_t items() const override { return real_count_; } ///< asleep ones included
    void add_forces(const Clock& clock, State& state) override;
    void constrain(const Clock& clock, State& state) override;
    void after_motion(const Clock& clock, State& state) override;
    StepVote stable_step() const override;
    std::vector<std::string> notices(const State& state) const override;
    void report(EnergyLedger& ledger) const override;
    void serialise(Archive& archive) override
    {
        archive(wall_work_, wall_power_, absorbed_force_, absorbed_power_, inflows_, real_count_, hosts_,
                handed_internal_, lost_kinetic_, bonded_places_, pressed_, pair_power_);
        archive(arrays_, images_, runs_, places_, sleepers_, searches_, departed_, followed_, damped_energy_,
                regions_at_, skin_, least_skin_, mean_share_, cycles_since_search_, alive_);
    }
    void collect(const State& state, ElementResults& results) const override;

    const ParticleArrays& arrays() const { return arrays_; }
    const std::vector<NeighbourRun>& runs() const { return runs_; }
    /// What particles have taken with them that left the box or were too fast.
    struct Departed {
        long count = 0;
        double mass = 0, kinetic = 0, internal = 0;
    };
    const std::vector<Departed>& departed() const { return departed_; } ///< by part of the body
    long searches() const { return searches_; }                         ///< neighbour searches so far
    /// Who knows the stresses of the solids in which particles wait.
    void watch_solids(std::vector<const Term*> solids) { solids_ = std::move(solids); }
    /// Mean number of real neighbours closer than the kernel radius.
    double mean_neighbours() const;
    /// The same of each particle, by sorted place.
    std::vector<int> count_neighbours() const;

private:
    const Model& model_;
    std::vector<ParticlePart> parts_;
    ParticleOptions options_;
    double support_; ///< kernel radius over smoothing length
    ParticleArrays arrays_;
    Images images_;
    Inflows inflows_;
    SolidHosts hosts_;
    std::vector<const Term*> solids_;
    std::vector<NeighbourRun> runs_;
    std::vector<PlaceList> places_;    ///< by part: its particles that are awake
    std::vector<PlaceList> sleepers_;  ///< and those that are not
    std::vector<Index> bonded_places_; ///< of particles that wait in solids as neighbours of others
    std::vector<Index> pressed_;       ///< those of them that have such a neighbour
    std::vector<double>
        handed_internal_; ///< by part of the Model: energy of solids that particles have [energy]
    std::vector<double> lost_kinetic_; ///< likewise: of motion, when they took its place [energy]
    double pair_power_ = 0; ///< of all pair forces in the last cycle, where particles wait [energy/time]
    std::size_t real_count_ = 0;
    bool tensor_ = false;   ///< push is a tensor
    double least_skin_ = 0; ///< of any particle [length]
    double skin_ = 0;       ///< as a share of the largest kernel radius
    double mean_share_ = 1; ///< of the skins of all particles, over skin_
    long cycles_since_search_ = 0;
    long searches_ = 0;
    std::vector<Departed> departed_;
    /// Nodes and parts of the body of those that have left in this cycle.
    std::vector<std::pair<Index, Index>> leavers_;
    std::vector<PlaceList> fallen_asleep_; ///< by part: in this cycle; empty: nobody has
    std::vector<Vec3> followed_; ///< by periodic pair: where its node was at the last search [length]
    double wall_work_ = 0;  ///< of walls that slide on the viscous fluid, absorbing planes, sleepers [energy]
    double wall_power_ = 0; ///< [energy/time]
    std::vector<Vec3>
        absorbed_force_;        ///< by sorted place, of absorbing planes and sleepers; empty without [force]
    double absorbed_power_ = 0; ///< what goes with it [energy/time]
    double damped_energy_ = 0;  ///< taken from the wake of moving domains and from sleepers [energy]
    std::vector<Vec3> regions_at_; ///< by region: how far it had travelled at the last search [length]
    std::uint64_t alive_ = ~0ULL;  ///< by part, a bit each: acted at the last search
    ParticleVote vote_;

    void create(const State& state);
    void append(std::size_t number, Index node, double mass, const State& state);
    void fill_up();
    bool anyone_free() const { return real_count_ > bonded_places_.size(); }
    std::vector<Index> take_out_of_solids(State& state);
    void come_out(const SolidHosts::Host& host, const LostSolid& lost, State& state);
    void take_over(Index place, const SolidHosts::Host& host, const LostSolid& lost, const State& state);
    void apply_laws_beside(const std::vector<Index>& newcomers, double step);
    void book_first_work(const std::vector<Index>& newcomers, double step, const State& state);
    void follow_solids(State& state) const;
    void tell_bonded_apart(std::vector<std::uint8_t>& group, std::vector<std::uint64_t>& sees) const;
    void find_pressed();
    ElementResults stresses_of_solids(const State& state) const;
    void set_bonded(double step, const State& state);
    void pass_bonded_forces(State& state) const;
    void read_motion(const Clock& clock, const State& state);
    std::uint64_t alive(double time) const;
    bool lists_hold(const State& state) const;
    bool leaves(Index place) const;
    bool anyone_leaves() const;
    bool is_awake(Index place) const;
    bool anyone_asleep() const;
    void put_to_sleep(State& state);
    void find_rates(const Clock& clock, State& state);
    void sum_rates(const Clock& clock, double back);
    void take_gradient(Index place, double time_back, const GradientSums& sums);
    void search(State& state);
    std::vector<Index> dismiss_leaving(State& state);
    void add_last_work(double step);
    void apply_last_laws(double step);
    void choose_skin();
    double set_reaches();
    void list_neighbours(const ParticleCells& cells);
    void apply_laws(double step, const std::vector<PlaceList>& all_places);
    void add_pair_forces(const Clock& clock, State& state);
    Vec3 gravity(double time) const;
    DensityDiffusion density_diffusion(const Clock& clock);
    void filter_densities();
    void add_tensile_forces(const Clock& clock, State& state);
    void add_laminar_forces(const Clock& clock, State& state);
    void find_drifts(const State& state);
    void find_wall_gradients();
    double power_of_walls() const;
    void add_absorbed_work(double half_step);
    void find_absorbed_forces();
    void calm_wake(const Clock& clock, State& state);
    double calm_particle(const CalmZone& zone, Index place, double step, State& state);
    void take_forces(const NeighbourRun& run, const ForceSums* sums, double half_step, State& state);
};

} // namespace plash

#pragma once

#include "core/term.h"
#include "elements/element_loss.h"
#include "elements/erosion.h"
#include "elements/initial_stress.h"
#include "elements/patches.h"
#include "elements/section_watch.h"
#include "elements/solid_eight_step.h"
#include "elements/solid_step.h"
#include "elements/ten_node_tetrahedron.h"
#include "model/model.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plash {

/// What a group of one-point solids is made from.
struct SolidSetup {
    const Model& model;
    Index part = none;
    std::vector<Index> elements;       ///< of the Model
    std::vector<Index> connectivity{}; ///< eight State indices an element; degenerate shapes repeat nodes
    SolidGradientRule rule = SolidGradientRule::centre;
    SolidParameters parameters{};
    double initial_relative_volume = 1;     ///< volume at the start over reference volume
    bool nodal_volume = false;              ///< volumes averaged over nodes (elements/solid_nodal_volume.h)
    bool eight_points = false;              ///< fully integrated (elements/solid_eight_point.h)
    SolidShear shear = SolidShear::full;    ///< of fully integrated elements
    const TenNodeRule* ten_nodes = nullptr; ///< ten-node tetrahedra: ten State indices an element
    std::string notice{};                   ///< what the user should know of the formulation; empty: nothing
    double shear_modulus = 0;               ///< elastic, for the bound of the step; 0: a fluid [stress]
    double shortest_step = 0;               ///< TDEL: elements below it are deleted [time]
    bool erode_inverted = false;            ///< delete elements without volume instead of stopping the run
    const InitialStresses* initial_stresses = nullptr; ///< looked at while the group is made
    const InitialStresses* initial_strains = nullptr;  ///< likewise; of what result files show
    bool thick_shells = false;                         ///< the elements are those of *ELEMENT_TSHELL

    int corner_count() const { return ten_nodes ? 10 : 8; }
    const Elements<8>& bricks() const
    {
        return thick_shells ? static_cast<const Elements<8>&>(model.thick_shells) : model.solids;
    }
    std::string_view kind() const { return thick_shells ? "thick shell" : "solid"; }
};

/// Whether the stress of a material point may be given at the start: not where it follows from something
/// else.
template <class Point>
inline constexpr bool stress_is_free = [] {
    if constexpr (requires { Point::stress_is_free; }) return bool{Point::stress_is_free};
    return false;
}();

/// Everything of a group of one-point solids that does not depend on the material: elements, history,
/// energies, votes, loss of elements. SolidOnePoint adds the step itself.
class SolidGroup : public Term {
public:
    std::string_view name() const override { return name_; }
    std::size_t items() const override { return static_cast<std::size_t>(patches_.element_count); }
    StepVote stable_step() const override { return vote_; }
    double scale_mass(double step, bool only_small, State&) override;
    bool scale_selectively(double step, bool only_small, const State&, SelectiveMasses&) override;
    Index scaled_part() const override { return setup_.part; }
    std::vector<std::string> notices(const State&) const override;
    void report(EnergyLedger&) const override;
    void serialise(Archive&) override;
    void collect(const State&, ElementResults&) const override;

    Index part() const { return setup_.part; }
    /// Mass of all elements, without mass scaling [mass].
    double mass() const;

protected:
    double constant_of(std::size_t place, SolidConstant constant) const
    {
        return constants_[place / lane_count * constant_count_ + constant][place % lane_count];
    }

    /// What a patch sums up in one cycle.
    struct PatchSum {
        Lanes internal{}, hourglass{}, viscous{};              ///< [energy]; viscous: of this step alone
        double step = std::numeric_limits<double>::infinity(); ///< smallest stable step [time]
        std::size_t place = 0;                                 ///< of the element that wants it
        std::vector<std::size_t> inverted;                     ///< places that have no volume
        std::vector<ElementLoss> lost;                         ///< that have failed
    };

    SolidGroup(SolidSetup setup, const State& state, int history_size, int constant_count,
               int plastic_strain_place);

    Lanes* history_of(Index batch) { return &history_[static_cast<std::size_t>(batch) * history_size_]; }
    Lanes* constants_of(Index batch)
    {
        return &constants_[static_cast<std::size_t>(batch) * constant_count_];
    }

    /// Positions of a batch as modes.
    SolidModes<Lanes> start_position(const Patches::Patch&, Index batch, const State&) const;
    /// Nodal vectors of a batch at the start.
    template <int Count>
    void start_corners(const Patches::Patch&, Index batch, const State&, Vector3<Lanes> (&)[Count]) const;
    /// Means of the corners of a batch.
    Vector3<Lanes> start_centre(const Patches::Patch&, Index batch, const State&) const;
    /// Sets volume and mass of a batch at the start; DeckError when a volume is not positive.
    void start_batch(Index batch, const Lanes& volume, const SolidModes<Lanes>& position, const State& state);
    /// Adds the elements' masses to their corners and keeps their first stable steps, batch x lane.
    void finish_start(std::vector<double> first_step, State& state);

    /// Where the stresses of a formulation's points stand in the history of a batch.
    struct StressPlaces {
        bool free = false;                  ///< the law takes a stress as it is
        int points = 1;                     ///< 1: the mean stress is that of the point
        int first = 0, size = 0;            ///< of several points
        int plastic_strain = -1;            ///< variable of a point's law, or -1
        std::vector<ShownVariable> shown{}; ///< history variables of a point in result files
    };
    /// Takes the stresses and plastic strains that the deck gives for the start; DeckError for laws whose
    /// stress follows from something else.
    void take_initial_stresses(const StressPlaces&);

    /// Adds what only the formulation knows of an element to the results.
    virtual void collect_points(const Patches::Patch&, std::size_t /*place*/, const State&,
                                ElementResults&) const
    {}

    /// One step: work(patch, batch, copies of the nodes, sum) for all batches, patch by patch.
    template <class Work>
    void each_batch(const Clock& clock, State& state, Work&& work)
    {
        start_cycle(clock);
        patches_.for_each(state, false,
                          [&](std::ptrdiff_t number, const Patches::Patch& patch, NodeCopies& nodes) {
                              PatchSum sum;
                              const Index end = patch.first_batch + patch.batch_count;
                              for (Index batch = patch.first_batch; batch < end; ++batch)
                                  work(patch, batch, nodes, sum);
                              if (!strain_.empty()) add_strains(patch, nodes, clock.last_step);
                              sums_[number] = std::move(sum);
                          });
        close_cycle(state);
    }
    /// Calls begin(patch, batch) for all batches; returns what it gives, the first stable steps, batch x
    /// lane.
    template <class Begin>
    std::vector<double> first_steps(Begin&& begin)
    {
        std::vector<double> steps(patches_.elements.size());
        for (const Patches::Patch& patch : patches_.patches) {
            for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch)
                store(&steps[static_cast<std::size_t>(batch) * lane_count], Lanes{begin(patch, batch)});
        }
        return steps;
    }
    /// Modes of a nodal vector of a batch, from the copies of a patch.
    SolidModes<Lanes> modes_at(Index batch, const AlignedDoubles& values) const
    {
        const auto corner = [&](int i) {
            return load_corner<Lanes>(values.data(), patches_.corner_offsets(batch, i));
        };
        return modes_of<Lanes>(
            {corner(0), corner(1), corner(2), corner(3), corner(4), corner(5), corner(6), corner(7)});
    }
    void add_modes(Index batch, const SolidModes<Lanes>& force, NodeCopies& nodes) const
    {
        const int active = patches_.active_lanes(batch);
        for_corners(force, [&](int corner, const Vector3<Lanes>& of_corner) {
            add_corner(nodes.force.data(), patches_.corner_offsets(batch, corner), of_corner, active);
        });
    }

    /// To be called before the patches of a cycle. Elements are deleted whose step falls below TDEL of their
    /// material, or with *CONTROL_TIMESTEP ERODE below DTMIN times the first step of the run, which is known
    /// in cycle 1.
    void start_cycle(const Clock&);
    /// Takes what a batch has to say into the patch's sum; zeroes the forces of elements that are deleted or
    /// lost in this cycle.
    void take(Index batch, const SolidModes<Lanes>& position, const NodeCopies& nodes,
              SolidResult<Lanes>& result, PatchSum& sum);
    /// The same for formulations whose forces are not SolidModes; returns the elements whose forces have to
    /// vanish.
    LaneMask take_vote(Index batch, const SolidModes<Lanes>& position, SolidVote<Lanes>& vote, PatchSum& sum);
    /// For those that a batch has just lost; power  of its forces at the end of the step [energy/time]
    void book_missing_work(Index batch, const Lanes& power, PatchSum& sum) const;
    /// Takes the patch sums into the group; deletes elements, or throws RunError.
    void close_cycle(State&);

    SolidSetup setup_;
    Patches patches_;
    SectionWatch section_watch_;
    std::vector<PatchSum> sums_; ///< by patch

    Index corner(const Patches::Patch&, std::size_t place, int corner) const;
    std::size_t element_of(std::size_t place) const { return patches_.elements[place]; }
    const Lanes* history_of(Index batch) const
    {
        return &history_[static_cast<std::size_t>(batch) * history_size_];
    }
    bool is_alive(std::size_t place) const
    {
        return alive_.empty() || alive_[place / lane_count][place % lane_count] != 0;
    }
    template <class Work>
    void for_each_element(Work&& work) const
    {
        for (const Patches::Patch& patch : patches_.patches) {
            for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
                for (int lane = 0; lane < patches_.active_lanes(batch); ++lane) {
                    work(patch, static_cast<std::size_t>(batch) * lane_count + lane);
                }
            }
        }
    }

private:
    using LaneArray = std::vector<Lanes, CacheAligned<Lanes>>;
    double smallest_step_ = 0; ///< elements below it are deleted [time]
    std::string name_;
    int history_size_, constant_count_;
    int plastic_strain_;                  ///< which history variable, or -1
    std::optional<SolidErosion> erosion_; ///< *MAT_ADD_EROSION
    StressPlaces stress_places_;
    double time_ = 0, last_step_ = 0; ///< of the cycle [time]
    LaneArray history_;               ///< batch x variable
    LaneArray constants_;             ///< batch x constant
    std::vector<double> first_step_;  ///< batch x lane, at the start
    LaneArray step_factor_; ///< by batch: what loose elements lose and mass scaling gains; empty without
    LaneArray step_limit_;  ///< by batch: longest step of loose elements [time]; empty without
    LaneArray alive_;       ///< by batch: 1, or 0 when deleted; empty while none is
    LaneArray strain_;      ///< batch x 6: strains for result files; empty unless they are wanted (STRFLG)
    StepVote vote_;
    double internal_ = 0, hourglass_ = 0, viscous_ = 0;
    double eroded_internal_ = 0, eroded_hourglass_ = 0;

    /// The nodes of an element without repetition, with their shares in its mass.
    struct Corners {
        std::array<Index, 10> node;
        std::array<double, 10> share;
        int count;
    };
    Corners distinct_corners(const Patches::Patch&, std::size_t place) const;
    /// Brings the steps of elements to `step`; take(element, corners, extra mass) gets what that costs.
    template <class Take>
    void scale_steps(double step, bool only_small, Take&& take);
    /// Its place in State::deleted_solids.
    Index brick_number(std::size_t place) const;
    const Patches::Patch& patch_of(std::size_t place) const;
    void put_initial_stress(std::size_t place, const InitialStress&, const StressPlaces&);
    void take_initial_strains();
    void add_strains(const Patches::Patch&, const NodeCopies&, double time_step);
    void add_strain_of(Index batch, const NodeCopies&, double time_step);
    double shown_value(std::size_t place, int number) const;
    void collect_point_results(std::size_t place, Index row, ElementResults&) const;
    void hold_back_loose_elements(const State&);
    void limit_step(std::size_t place, double limit);
    void silence(Index batch, const LaneMask& dead, const LaneMask& silent, SolidVote<Lanes>&);
    void erase(const ElementLoss&, State&);
    LostSolid lost_solid(std::size_t place) const;
    std::string describe(std::size_t place, const std::vector<Vec3>& position) const;
};

} // namespace plash

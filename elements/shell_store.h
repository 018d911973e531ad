#pragma once

#include "core/energy_ledger.h"
#include "core/results.h"
#include "core/term.h"
#include "elements/element_loss.h"
#include "elements/initial_stress.h"
#include "elements/patches.h"
#include "elements/section_watch.h"
#include "elements/shell_kernel.h"
#include "elements/shell_mass.h"
#include "model/model.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// Area of a shell in the plane of its frame, at the positions of the state [length^2].
double shell_area(const Model& model, const State& state, Index element);

/// Square of the length that a shell's step is made of, at the positions of the state [length^2].
double squared_length_of(const Model& model, const State& state, Index element, int length_rule);

/// The shells of a part that make one group.
struct ShellPart {
    const Model& model;
    Index part = none;
    std::vector<Index> elements;                       ///< of the Model
    const InitialStresses* initial_stresses = nullptr; ///< looked at while the group is made
    const InitialStresses* initial_strains = nullptr;  ///< likewise; of what result files show
    double offset_share =
        0;              ///< OFFSET of all elements over half of their thickness; laminates read their own
    bool alone = false; ///< its elements share their nodes with no other shell
    double stiffness_share = 1; ///< TSLIMT of *CONTROL_TIMESTEP: of Young's modulus
};

/// Where the state of a shell group is kept between steps, and what does not depend on the law: energies, the
/// step vote, erosion, results.
class ShellStore {
public:
    /// Energies of a patch since the start [energy] and its shortest element.
    struct PatchSums {
        double internal = 0, hourglass = 0, viscous = 0;
        double squared_length = 0; ///< smallest of the patch [length^2]
        Index place = 0;           ///< of that element: batch x lane_count + lane
        std::vector<ElementLoss> lost;

        void serialise(Archive& archive) { archive(internal, hourglass, viscous); }
    };

    /// plane_points     columns of points that an element has
    /// initial_history  of the law, at the start
    /// plastic_strain   which history variable is the plastic strain; none: there is none
    ShellStore(const ShellPart& part, const State& state, ShellSettings settings, int plane_points,
               std::span<const double> initial_history, Index plastic_strain);

    const Model& model;
    Index part;
    std::string name; ///< as lists of terms show it
    /// Part of the plate wave's step that elements on their own bear: they swell and shrink as a whole, with
    /// omega^2 = 4 c^2 (1 + nu) / l^2 when square. 1 where TSSFAC leaves room for that.
    double step_share = 1;
    ShellSettings settings;
    ShellPlate plate;
    Patches patches;
    SectionWatch section_watch;
    std::vector<PatchSums> sums; ///< by patch

    Lanes* record(Index batch) { return records_.data() + static_cast<std::size_t>(batch) * record_size_; }
    const Lanes* record(Index batch) const
    {
        return records_.data() + static_cast<std::size_t>(batch) * record_size_;
    }
    std::size_t record_bytes() const { return record_size_ * sizeof(Lanes); } ///< of one batch

    /// To be called before every cycle's patches: with ERODE of *CONTROL_TIMESTEP, elements go whose step
    /// falls below DTMIN times the first step of the run, which is known in cycle 1.
    void start_cycle(const Clock& clock);

    /// To be called after every cycle's patches: takes out the elements that are lost (they give no more
    /// forces, and their energies stay as eroded) and throws RunError when an energy is no finite number.
    void close_cycle(State& state);

    /// Takes the stresses and plastic strains that the deck gives for the start; DeckError for plies.
    void take_initial_stresses(const ShellPart& part, const State& state);
    /// Adds the masses and rotary inertias of the elements at the start.
    void add_masses(State& state) const;
    /// As Term::scale_mass: changes the mass of elements so that their step becomes `step`.
    double scale_mass(double step, bool only_small, State& state);
    /// As Term::scale_selectively.
    void scale_selectively(double step, bool only_small, const State& state, SelectiveMasses& masses);

    StepVote vote() const;
    void report(EnergyLedger& ledger) const;
    void serialise(Archive& archive)
    {
        archive(records_, sums, eroded_internal_, eroded_hourglass_, settings.shortest_squared_length);
    }
    void collect(const State& state, ElementResults& results) const;

    int plane_points() const { return plane_points_; }
    /// Place and weight of a point through the thickness: of the rule, or of the plies in the record.
    std::pair<double, double> place_of(Index batch, int lane, int point) const;
    /// Which variables of a point hold place and weight of its ply; none: there are no plies.
    Index ply_place = none, ply_weight = none;
    /// History variables in result files: one list for all points, or one for each ply.
    std::vector<std::vector<ShownVariable>> shown;

private:
    double eroded_internal_ = 0, eroded_hourglass_ = 0; ///< [energy]
    std::size_t record_size_;
    int plane_points_;
    int point_size_;
    Index plastic_strain_;
    std::vector<Lanes, CacheAligned<Lanes>> records_;

    void erode(const ElementLoss& loss, PatchSums& patch_sums, State& state);
    void check_finite() const;
    /// An element's masses and rotary inertias times `factor`.
    std::array<SelectiveMasses::Corner, 4> masses_of(Index element, double factor, const State& state) const;
    /// Adds them; returns the mass.
    double add_mass(Index element, double factor, State& state) const;
    /// Brings the steps of elements to `step`; take(element, growth of mass) gets what that costs.
    template <class Take>
    void scale_steps(double step, bool only_small, const State& state, Take&& take);
    void take_initial_strains(const ShellPart& part, const State& state);
    void collect_history(Index batch, int lane, Index row, ElementResults& results) const;
    void collect_strains(const State& state, Index batch, int lane, Index row, ElementResults& results) const;
    void collect_steps(const State& state, ElementResults& results) const;
    void collect_element(const State& state, Index batch, int lane, ElementResults& results) const;
    void collect_motion(const State&, Index batch, int lane, ElementResults::PartMotion&) const;
};

} // namespace plash

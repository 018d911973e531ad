#pragma once

#include "core/energy_ledger.h"
#include "core/results.h"
#include "core/term.h"
#include "elements/beam_kernel.h"
#include "elements/element_loss.h"
#include "elements/patches.h"
#include "model/model.h"

#include <span>
#include <string>
#include <vector>

namespace plash {

/// The beams of a part that make one group.
struct BeamPart {
    const Model& model;
    Index part = none;
    std::vector<Index> elements; ///< of the Model
};

/// Where the state of a beam group is kept between steps, and what does not depend on formulation and law:
/// preloads, energies, the step vote, loss of elements, results.
class BeamStore {
public:
    /// Energies of a patch since the start [energy], its largest demand on the step, lost elements.
    struct PatchSums {
        double internal = 0, preload = 0;
        double step = 0; ///< smallest stable step [time]
        Index place = 0; ///< of that element: batch x lane_count + lane
        std::vector<ElementLoss> lost;

        void serialise(Archive& archive) { archive(internal, preload); }
    };

    /// Where the points of the law stand in a record; `size` 0: the formulation has no points.
    struct PointLayout {
        int first = 0, size = 0, count = 0;
        Index plastic_strain = none; ///< which history variable
    };

    BeamStore(const BeamPart&, const State&, BeamSettings, int record_size, PointLayout,
              std::span<const double> initial_history);

    const Model& model;
    Index part;
    std::string name; ///< as lists of terms show it
    BeamSettings settings;
    Patches patches;
    std::vector<PatchSums> sums; ///< by patch
    double shortest_step = 0;    ///< ERODE of *CONTROL_TIMESTEP: beams below it go [time]

    Lanes* record(Index batch) { return records_.data() + static_cast<std::size_t>(batch) * record_size_; }
    const Lanes* record(Index batch) const
    {
        return records_.data() + static_cast<std::size_t>(batch) * record_size_;
    }

    /// To be called before the patches of a cycle: axial stresses that preloads ask for now; in cycle 1, the
    /// step below which beams go, DTMIN times the first one.
    void start_cycle(const Clock&);
    BeamPrescription<Lanes> prescription(Index batch) const;
    /// Preloads begin anew with the curves of a phase.
    void begin_phase();

    /// Stable step of a batch [time].
    Lanes stable_step(Index batch, const Lanes& length) const;

    /// To be called after every cycle's patches: takes out the elements that are lost; RunError when an
    /// energy is no finite number.
    void close_cycle(State&);

    void add_masses(State&) const;
    /// As Term::scale_mass.
    double scale_mass(double step, bool only_small, State&);

    /// What goes on from cycle to cycle.
    void serialise(Archive& archive) { archive(records_, sums, preloads_, eroded_internal_, shortest_step); }

    StepVote vote() const;
    void report(EnergyLedger&) const;
    void collect(const State&, ElementResults&) const;

private:
    /// A preload with its elements in this group and its force now.
    struct Preload {
        const BeamPreload* given;
        std::vector<LaneMask> mask; ///< by batch
        double stress = 0;          ///< now [stress]
        bool active = true, has_acted = false;
        bool acts = false; ///< in this cycle

        void serialise(Archive& archive) { archive(stress, active, has_acted); }
    };

    std::size_t record_size_;
    PointLayout points_;
    std::vector<Lanes, CacheAligned<Lanes>> records_;
    std::vector<Preload> preloads_;
    double eroded_internal_ = 0; ///< [energy]

    void set_axes(const BeamPart&);
    void find_preloads();
    void set_initial_stresses();
    BeamMass mass_of(Index element) const;
    void erode(const ElementLoss&, PatchSums&, State&);
    void check_finite() const;
    void collect_element(const State&, Index batch, int lane, ElementResults&) const;
    void collect_steps(const State&, ElementResults&) const;
    void collect_motion(const State&, Index batch, int lane, ElementResults::PartMotion&) const;
};

} // namespace plash

#pragma once

#include "core/term.h"
#include "elements/beam_store.h"
#include "elements/discrete_triad.h"
#include "materials/discrete_beam_law.h"

#include <memory>
#include <vector>

namespace plash {

/// Discrete beams of one part (*SECTION_BEAM, ELFORM 6): springs and dampers between two nodes in six
/// freedoms, along local axes that turn with the nodes or (cables and the like) along the line of the nodes.
///
/// With |SCOOR| up to 1 the nodes are taken to lie together: forces act against one another whatever the
/// distance. With 2, 3, 12 and 13 the beam has a length: its relative motion is that beyond rotation with
/// the mean spin of the nodes, and each node gets half of the moment that balances the shear forces. Both
/// are work-conjugate, so that the energy book closes. Sources: LS-DYNA keyword manual, *SECTION_BEAM; LSTC
/// knowledge base, 'Discrete beam'.
class DiscreteBeams : public Term {
public:
    /// Adds the masses and inertias of the elements to the state. DeckError for what is not supported.
    DiscreteBeams(const BeamPart& part, State& state);

    std::string_view name() const override { return "discrete beams"; }
    std::size_t items() const override { return beams_.size(); }
    void add_forces(const Clock&, State&) override;
    StepVote stable_step() const override { return vote_; }
    double scale_mass(double step, bool only_small, State&) override;
    void report(EnergyLedger&) const override;
    void collect(const State&, ElementResults&) const override;
    std::vector<std::string> notices(const State&) const override
    {
        if (law_->notice.empty()) return {};
        return {law_->notice};
    }
    void serialise(Archive& archive) override { archive(beams_, points_, eroded_); }

private:
    struct Beam {
        Index element = none; ///< of the Model
        Index node1 = none, node2 = none;
        Triad axes{};           ///< at n; of laws along the nodes the first alone
        double mass_factor = 1; ///< by which mass scaling has raised the mass
        double energy = 0;
        bool deleted = false;
    };
    const Model& model_;
    Index part_;
    std::unique_ptr<DiscreteBeamLaw> law_;
    TriadRule rule_;
    double volume_ = 0, inertia_ = 0; ///< VOL, INER
    std::vector<Beam> beams_;
    std::vector<DiscreteBeamPoint> points_; ///< of beams_
    std::vector<DiscreteFreedoms> change_;  ///< of the ways in this step; room for each cycle
    double eroded_ = 0;
    StepVote vote_;

    void read_section(const Record& section);
    double mass_of(const Beam&, const DiscreteBeamPoint&) const;
    void follow_line(const Clock&, const State&, std::size_t place);
    void follow_axes(const Clock&, const State&, std::size_t place);
    void push(const Beam&, const DiscreteBeamPoint&, State&) const;
    double stable_step_of(const Beam&, const DiscreteBeamPoint&, const State&) const;
};

/// VOL of *SECTION_BEAM, which with the density is the mass of a discrete beam [volume]. DeckError below
/// zero.
double discrete_beam_volume(const Record& section);

} // namespace plash

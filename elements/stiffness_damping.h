#pragma once

#include "core/term.h"
#include "elements/patches.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// Damping in proportion to stiffness of the solids or shells of one part (*DAMPING_PART_STIFFNESS): stresses
/// beta C : D beside those of the material, with its elastic moduli C and the strain rate D at n - 1/2, which
/// act on the mean gradient of solids and on membrane and bending of shells at their centre. Rigid motion of
/// any size is not damped, since D is zero then; hourglass modes and transverse shear are left alone.
///
/// COEF < 0: beta = -COEF, so that a vibration omega has the damping ratio beta omega / 2 (Rayleigh).
/// COEF > 0: beta = COEF times the step, so that COEF is the ratio of the fastest vibration that the step
/// resolves (omega = 2 / step) and slower ones have less in proportion: this is how LS-DYNA describes it.
/// Source: LS-DYNA keyword manual, *DAMPING_PART_STIFFNESS; Hallquist (2006), 'Rayleigh damping'.
class StiffnessDampingGroup : public Term {
public:
    enum class Shape { solid, shell };

    /// DeckError where the material has no elastic moduli E and PR (or G and BULK).
    StiffnessDampingGroup(const Model&, const StiffnessDamping&, Shape, std::vector<Index> elements, State&);

    std::string_view name() const override { return "stiffness damping"; }
    std::size_t items() const override { return patches_.element_count; }
    void add_forces(const Clock&, State&) override;
    StepVote stable_step() const override;
    void report(EnergyLedger& ledger) const override;
    void serialise(Archive& archive) override { archive(records_, taken_); }

private:
    /// Six stresses or resultants of the last step; of shells thickness and the volume at the start.
    static constexpr int record_size = 8;
    struct Lengths {
        Lanes crossing{}; ///< of the step [length]
        Lanes bound{};    ///< the same for the mass that the element has [length]
    };
    struct PatchVote {
        double step = 0;
        Index place = 0;
    };
    const Model& model_;
    StiffnessDamping given_;
    Shape shape_;
    Patches patches_;
    double lame_ = 0, shear_ = 0;    ///< [stress]
    double plane_ = 0, poisson_ = 0; ///< E / (1 - nu^2) [stress]
    double wave_speed_ = 0;          ///< [velocity]
    std::vector<Lanes, CacheAligned<Lanes>> records_;
    std::vector<double> taken_;    ///< by patch: out of the motion so far [energy]
    std::vector<PatchVote> votes_; ///< by patch

    bool gone(Index element, const State&) const;
    /// Work that the stresses of the batch have taken in the last step, by lane.
    Lanes damp_solids(Index batch, double beta, double step, NodeCopies&, Lengths&, const Lanes& alive);
    Lanes damp_shells(Index batch, double beta, double step, NodeCopies&, Lengths&, const Lanes& alive);
};

/// The groups of a Model's *DAMPING_PART_STIFFNESS, and of DAMP of *MAT_FABRIC (a share of critical damping,
/// as COEF above 0) where a part has none of its own.
std::vector<std::unique_ptr<Term>> make_stiffness_damping(const Model&, State&);

} // namespace plash

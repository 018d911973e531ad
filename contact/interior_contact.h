#pragma once

#include "contact/part_data.h"
#include "core/term.h"
#include "model/model.h"

namespace plash {

/// *CONTACT_INTERIOR: keeps the solids of a part set (soft foams) from being turned inside out. Where the
/// middles of two opposite faces come closer than DA2 (0.1) of their distance at the start, a spring between
/// them resists, whose stiffness is DA1 (1) SLSFAC E A / h with E the bulk modulus or DA3. Forces act along
/// the line of the middles, so that they neither push nor turn the body.
class InteriorContact : public Term {
public:
    InteriorContact(const Model& model, const std::vector<PartData>& parts, const PartSet& set,
                    double penalty_scale);

    void serialise(Archive& archive) override { archive(springs_, energy_); }
    std::string_view name() const override { return "interior contact"; }
    std::size_t items() const override { return springs_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    StepVote stable_step() const override { return vote_; }
    void report(EnergyLedger& ledger) const override { ledger.sliding += energy_; }
    double energy() const { return energy_; }

private:
    /// Between the middles of two opposite faces of a hexahedron.
    struct Spring {
        Index solid = none;
        int direction = 0;    ///< of the three pairs of faces
        double limit = 0;     ///< distance below which it acts [length]
        double stiffness = 0; ///< [force/length]
        Vec3 force{};         ///< on the far face at n [force]

        void serialise(Archive& archive) { archive(force); }
    };
    const Model& model_;
    std::vector<Spring> springs_;
    double energy_ = 0;
    StepVote vote_;
};

} // namespace plash

#pragma once

#include "core/term.h"
#include "model/model.h"

#include <memory>
#include <vector>

namespace plash {

/// *DEFINE_SPH_TO_SPH_COUPLING: a penalty contact between the particles of two groups of parts, which must
/// not see each other in their kernels (*CONTROL_SPH CONT = 1). Two particles touch when they are closer than
/// SRAD times their mean smoothing length at the start (keyword manual, *DEFINE_SPH_TO_SPH_COUPLING); the
/// force acts along their line and is k times the depth.
///
/// The manual does not say k. Here it is that of the soft constraint (*CONTACT, SOFT = 1) with its factor of
/// 0.1: k = PFACT 0.1 m / dt^2 with m = 2 m1 m2 / (m1 + m2) and dt the first step of the run, for ISOFT 0 and
/// 1 alike. DFACT is a share of the critical damping of each pair, while it closes.
class ParticleCoupling : public Term {
public:
    ParticleCoupling(const Model& model, const Record& record, const State& state);

    std::string_view name() const override { return "particle coupling"; }
    std::size_t items() const override { return node_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    StepVote stable_step() const override { return vote_; }
    std::vector<std::string> notices(const State& state) const override;
    void report(EnergyLedger& ledger) const override { ledger.sliding += taken_; }
    void serialise(Archive& archive) override
    {
        archive(force_, pairs_, build_position_, first_step_, taken_);
    }

private:
    struct Pair {
        Index a, b; ///< places in node_
    };
    const Model& model_;
    const Record& record_;
    double stiffness_ = 1, damping_ = 0; ///< PFACT, DFACT
    std::vector<Index> node_;            ///< of group A, then of group B
    std::size_t first_of_b_ = 0;
    std::vector<double> reach_;        ///< half of the distance below which equal particles touch [length]
    std::vector<Vec3> force_;          ///< by node_, at the last n [force]
    std::vector<Pair> pairs_;          ///< that may touch, in a fixed order
    std::vector<Vec3> build_position_; ///< when they were found [length]
    double skin_ = 0;                  ///< [length]
    double first_step_ = 0;            ///< [time]; 0: not known yet
    double taken_ = 0;                 ///< out of the motion [energy]
    StepVote vote_;

    void add_group(const char* id, const char* type, const State& state);
    bool pairs_hold(const State& state) const;
    void find_pairs(const State& state);
    double power(const State& state) const;
};

/// One term for each such keyword of the deck.
std::vector<std::unique_ptr<Term>> make_particle_couplings(const Model& model, const State& state);

} // namespace plash

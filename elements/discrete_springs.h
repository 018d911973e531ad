#pragma once

#include "core/term.h"
#include "elements/discrete_law.h"

#include <memory>
#include <vector>

namespace plash {

/// Springs and dampers between two nodes, or a node and the ground (*ELEMENT_DISCRETE with
/// *SECTION_DISCRETE). They act along the line of the nodes or a direction of *DEFINE_SD_ORIENTATION;
/// torsional ones (DRO = 1) about it. What dampers take out counts as internal energy, as in LS-DYNA's
/// 'spring and damper energy'.
class Springs : public Term {
public:
    /// DeckError for what is not supported.
    explicit Springs(const Model& model);

    bool torsional() const { return torsional_; }
    bool empty() const { return springs_.empty(); }

    void serialise(Archive& archive) override { archive(springs_, part_energy_); }
    std::string_view name() const override { return "springs"; }
    std::size_t items() const override { return springs_.size(); }
    void add_forces(const Clock&, State&) override;
    StepVote stable_step() const override { return vote_; }
    void report(EnergyLedger&) const override;
    void collect(const State&, ElementResults&) const override;

private:
    /// *SECTION_DISCRETE.
    struct Section {
        bool torsional = false;
        double magnification = 0, reference_rate = 1; ///< KD, V0: force times 1 + KD |rate| / V0
        double failure_deflection = 0;                ///< FD; 0: never
        double clearance = 0; ///< CL: way of compression before the spring carries anything [length]
    };
    struct Spring {
        Index element = none;             ///< of the Model
        Index node1 = none, node2 = none; ///< second none: the ground
        Index law = none, section = none;
        double scale = 1;
        double length = 0; ///< at the start, less the initial offset [length]
        Vec3 anchor{};     ///< where the ground is
        Vec3 direction{};  ///< of _SD_ORIENTATION; zero: along the nodes
        double angle = 0;  ///< of torsional springs so far
        DiscreteLaw::State state;
        double booked_force = 0; ///< at n - 1
        Vec3 along{};            ///< in which it acted at n
        double energy = 0;
        bool failed = false;

        void serialise(Archive& archive) { archive(angle, state, booked_force, along, energy, failed); }
    };

    const Model& model_;
    std::vector<DiscreteLaw> laws_;
    std::vector<Section> sections_;
    std::vector<Spring> springs_;
    std::vector<double> part_energy_;
    bool torsional_ = false;
    StepVote vote_;

    void add_part(Index part, const std::vector<Index>& elements);
    Vec3 direction_of(Index element, bool torsional) const;
};

/// The Model's springs, or nothing; asks for rotations where some are torsional.
std::unique_ptr<Term> make_springs(const Model&, State&);

} // namespace plash

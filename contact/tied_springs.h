#pragma once

#include "contact/tied_points.h"
#include "core/clock.h"
#include "core/results.h"
#include "core/term.h"
#include "model/model.h"

namespace plash {

/// Nodes that springs hold over segments: tied contact with OFFSET and TIEBREAK.
///
/// Each spring has the energy k |gap|^2 / 2, where the gap is measured from the point that goes along with
/// the segment (tied_points.h); its forces on the corners are the derivatives of this energy, so that
/// momentum, angular momentum and energy are kept also with an offset. (LS-DYNA's _OFFSET leaves the moment
/// of the offset unbalanced; its _BEAM_OFFSET transmits it.) With tied rotations a rotational spring acts
/// between the node and the segment.
///
/// Failure of TIEBREAK: (tension / NFLS)^NEN + (shear / SFLS)^MES >= 1 with stress = force / area of the node
/// (or forces for node ties). OPTION 2 and 4 then release the node; 6 and 8 let the stress fall in proportion
/// to the opening until it reaches PARAM. OPTION 4 holds in tension only and slides freely in the plane.
/// OPTION 1 and 3 hold nodes from where they come into contact (hold), 1 for good, 3 until they fail.
class TiedSprings {
public:
    TiedSprings(const Contact& contact, const Model& model, const Surface& slave, const Surface& master,
                std::vector<TiedPoint> points);

    /// Without points, for nodes that come to be held later.
    /// segments  that they may be held on
    TiedSprings(const Contact& contact, const Model& model, std::vector<Segment> segments);

    /// Holds one more node, without force where it is now.
    /// side       +1 or -1: the node opens along the segment's normal or against it
    /// stiffness  unscaled [force/length]
    /// area       of the node [length^2]
    void hold(const TiedPoint& point, double side, double stiffness, double area, const State& state);

    /// Adds forces at n and the work of the last step.
    void add_forces(const Clock& clock, State& state);
    StepVote vote() const { return vote_; }
    std::size_t size() const { return springs_.size(); }
    std::size_t broken() const { return broken_; }
    /// Nodes set free in the last cycle (State indices).
    const std::vector<Index>& released() const { return released_; }
    /// State indices of the nodes that are held now and must not touch the master surface.
    std::vector<Index> held_nodes() const;
    double energy() const { return slave_energy_ + master_energy_; }
    void collect(const State& state, ElementResults::ContactForce& sum) const;
    void collect_nodes(std::vector<Vec3>& contact_force) const;
    void serialise(Archive& archive);

private:
    struct Spring {
        TiedPoint point;
        TieShape shape;
        double side = 1;           ///< +1: the node opens along the normal, -1: against it
        double stiffness = 0;      ///< [force/length]
        double turn_stiffness = 0; ///< [moment]
        double unscaled = 0;       ///< stiffness by the materials, with SLSFAC [force/length]
        double area = 1;           ///< of the node [length^2]; 1 for failure by forces
        double onset = 0;          ///< opening at which the stress began to fall; 0: it has not [length]
        double damage = 0;
        bool broken = false;
        Vec3 force{};  ///< on the node [force]
        Vec3 moment{}; ///< on the node [moment]
        std::array<Vec3, 4> corner_force{};
    };
    const Contact& contact_;
    const Model& model_;
    std::vector<Segment> segments_; ///< of the master surface, to see them erode
    std::vector<Spring> springs_;
    std::vector<Index> released_;
    std::size_t broken_ = 0;
    bool rotations_ = false;
    double slave_energy_ = 0, master_energy_ = 0;
    long deletions_seen_ = 0;
    double first_step_ = 0;
    StepVote vote_;

    void set_stiffness(Spring& spring, const State& state) const;
    void set_vote(const State& state);
    void follow_erosion(const State& state);
    void load(const Clock& clock, const State& state, Spring& spring) const;
    bool fails(const Spring& spring, double tension, double shear) const;
};

/// Areas of the nodes of a surface, a quarter (third) of each of its segments [length^2].
std::vector<double> node_areas(const Surface& surface, const std::vector<Vec3>& position);

/// *CONTACT_TIED_..._OFFSET: ties and nothing else.
class TiedContact : public Term {
public:
    TiedContact(const Contact& contact, TiedSprings springs, std::vector<std::string> notices)
        : contact_(contact),
          name_(name_of("tied contact", contact)),
          springs_(std::move(springs)),
          notices_(std::move(notices))
    {}

    void serialise(Archive& archive) override { springs_.serialise(archive); }
    std::string_view name() const override { return name_; }
    std::size_t items() const override { return springs_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    StepVote stable_step() const override { return springs_.vote(); }
    std::vector<std::string> notices(const State&) const override { return notices_; }
    void report(EnergyLedger& ledger) const override { ledger.sliding += springs_.energy(); }
    void collect(const State& state, ElementResults& results) const override;
    const TiedSprings& springs() const { return springs_; }

private:
    const Contact& contact_;
    std::string name_;
    TiedSprings springs_;
    std::vector<std::string> notices_;
};

} // namespace plash

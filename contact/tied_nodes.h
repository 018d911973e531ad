#pragma once

#include "contact/tied_points.h"
#include "core/term.h"
#include "model/model.h"

#include <memory>

namespace plash {

/// Nodes that segments carry without any spring: *CONTACT_TIED_... without OFFSET and with
/// CONSTRAINED_OFFSET.
///
/// The mass of a tied node goes to the corners of its segment by their shape functions (so the loop does not
/// move it), its forces and moments do in every cycle, and its velocity follows from the corners' (Hallquist
/// 2006, 'Tied interface', row-summed mass). Heights above the segment turn with it; a gap that the deck
/// leaves stays, where LS-DYNA without _OFFSET moves the node onto the segment. A corner may itself be tied
/// or belong to a rigid body.
class TiedNodes {
public:
    /// Finds the ties of all contacts that are made by constraints and moves their masses. The State has all
    /// masses; rigid bodies are made afterwards.
    TiedNodes(const Model& model, State& state);

    bool empty() const { return ties_.empty() && notices_.empty(); }
    std::size_t size() const { return ties_.size(); }
    const std::vector<std::string>& notices() const { return notices_; }

    /// Forces of tied nodes to the corners; before anything acts on the summed forces.
    void hand_over_forces(State& state);
    /// Velocities of tied nodes for the next step; after everything that acts on the corners.
    void follow(const Clock& clock, State& state);
    void collect(const State& state, ElementResults& results) const;
    /// The masses are moved when the ties are made; what they were then is kept for the results.
    void serialise(Archive& archive)
    {
        for (Tie& tie : ties_) archive(tie);
    }

private:
    struct Tie {
        TiedPoint point;
        TieShape shape;
        bool rotations = false;       ///< angular velocity and moments are tied as well
        bool corners_turn = false;    ///< and go to angular freedoms of the corners
        std::size_t contact = 0;      ///< into Model::contacts
        double mass = 0;              ///< [mass]
        Vec3 force{}, acceleration{}; ///< of the node at n
        Vec3 spin_rate{};

        void serialise(Archive& archive) { archive(mass, force, acceleration, spin_rate); }
    };
    const Model& model_;
    std::vector<Tie> ties_; ///< a node comes before the corners of its segment that are tied too
    std::vector<std::string> notices_;

    void find(std::size_t contact, const std::vector<struct PartData>& parts, const State& state,
              std::vector<Index>& tie_of_node);
    void sort(const std::vector<Index>& tie_of_node);
    void move_masses(State& state);
};

/// Whether a tied contact is made by constraints.
bool ties_by_constraint(const Contact& contact);

/// The two terms of the scene that tied nodes need.
class TiedForces : public Term {
public:
    explicit TiedForces(std::shared_ptr<TiedNodes> nodes) : nodes_(std::move(nodes)) {}
    void serialise(Archive& archive) override { nodes_->serialise(archive); }
    std::string_view name() const override { return "tied nodes"; }
    std::size_t items() const override { return nodes_->size(); }
    void constrain(const Clock&, State& state) override { nodes_->hand_over_forces(state); }
    std::vector<std::string> notices(const State&) const override { return nodes_->notices(); }
    void collect(const State& state, ElementResults& results) const override
    {
        nodes_->collect(state, results);
    }

private:
    std::shared_ptr<TiedNodes> nodes_;
};

class TiedMotion : public Term {
public:
    explicit TiedMotion(std::shared_ptr<TiedNodes> nodes) : nodes_(std::move(nodes)) {}
    std::string_view name() const override { return "motion of tied nodes"; }
    void constrain(const Clock& clock, State& state) override { nodes_->follow(clock, state); }

private:
    std::shared_ptr<TiedNodes> nodes_;
};

} // namespace plash

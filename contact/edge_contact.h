#pragma once

#include "contact/contact_mesh.h"
#include "contact/penalty_law.h"
#include "core/term.h"
#include "model/model.h"

#include <map>

namespace plash {

/// A straight edge with a round rim: a beam, or the side of a shell.
struct ContactEdge {
    std::array<Index, 2> node{};            ///< State indices, rising
    std::array<Index, 2> shell{none, none}; ///< shells beside it; none for beams
    Index beam = none;
    Index part = none;
    std::uint8_t sides = 0; ///< slave_bit, master_bit: which sides of the contact the edge is of
    double radius = 0;      ///< half the contact thickness [length]
    double stiffness = 0;   ///< unscaled [force/length]
    bool inner = false;     ///< acts also between two living shells (_INTERIOR)

    /// Whether the edge acts now: a beam; a side of a shell without a neighbour, or any with _INTERIOR.
    bool there(const State& state) const;
};

/// Edges of a contact: sides of shells, and in general contact beams, spot-weld beams (ELFORM 9) only where
/// CPARM8 = 2 asks for them, as in LS-DYNA. Shells without thickness of their own and solids have none.
std::vector<ContactEdge> contact_edges(const Model& model, const std::vector<PartData>& parts,
                                       const Contact& contact);

/// Closest points of two segments p0 p1 and q0 q1: p0 + s (p1 - p0), q0 + t (q1 - q0), 0 <= s, t <= 1
/// (Ericson 2005, 'Real-Time Collision Detection', 5.1.9).
struct EdgePoints {
    double s = 0, t = 0;
};
EdgePoints closest_points(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1);

/// Two edges that touch, with what they remember.
struct EdgeTouch {
    Index first = none, second = none; ///< edges, first < second
    double s = 0, t = 0;               ///< on the first and on the second
    Vec3 normal{};                     ///< unit, from the second to the first
    double penetration = 0;            ///< sum of radii less the distance [length]
    double baseline = 0, rounding = 0; ///< as in Touch [length]
    double stiffness = 0;              ///< [force/length]
    Vec3 friction{}, force{};          ///< on the first [force]
};

/// Penalty contact of edges on edges: beams against beams, against the free sides of shells, and these
/// against one another. Beside the contact of nodes with segments it makes *CONTACT_AUTOMATIC_GENERAL, and
/// what SOFT = 2 sees at edges (DEPTH 3, 5); of two surfaces, edges of one touch those of the other.
/// Stiffness, friction, damping and the bookkeeping of energy are those of SurfaceContact.
class EdgeContact : public Term {
public:
    EdgeContact(const Contact& contact, const Model& model, const std::vector<PartData>& parts);

    void serialise(Archive& archive) override;
    std::string_view name() const override { return name_; }
    std::size_t items() const override { return edges_.size(); }
    void add_forces(const Clock& clock, State& state) override;
    StepVote stable_step() const override { return vote_; }
    void report(EnergyLedger& ledger) const override { ledger.sliding += energy_; }
    void collect(const State& state, ElementResults& results) const override;

    const std::vector<ContactEdge>& edges() const { return edges_; }
    const std::vector<EdgeTouch>& touches() const { return now_; }
    double sliding_energy() const { return energy_; }

private:
    struct Pair {
        Index first, second;
    };
    const Contact& contact_;
    std::string name_;
    const Model& model_;
    std::vector<ContactEdge> edges_;
    std::vector<std::vector<Index>> at_node_; ///< edges by place in `nodes_`
    std::vector<Index> nodes_;                ///< State indices of the edges' nodes, rising
    std::vector<std::array<Index, 2>> ends_;  ///< of each edge, into `nodes_`
    std::vector<double> mass_;                ///< by place in `nodes_`
    std::vector<bool> rigid_;                 ///< likewise
    std::vector<double> lumped_;
    std::vector<Pair> pairs_;       ///< rising
    std::vector<Index> acting_;     ///< places in `nodes_` of the edges that were there at the search
    std::vector<Vec3> searched_at_; ///< of these
    double margin_ = 0;
    std::vector<double> length_;                 ///< of the edges at the start
    std::vector<EdgeTouch> now_, before_;        ///< in the order of `pairs_`
    std::vector<Vec3> force_now_, force_before_; ///< by place in `nodes_`
    double energy_ = 0, friction_energy_ = 0;
    double soft_step_ = 0;
    long deletions_seen_ = 0;
    StepVote vote_;

    void take_masses(const State& state);
    bool pairs_hold(const Clock& clock, const State& state) const;
    void search(const State& state);
    bool may_meet(const ContactEdge& a, const ContactEdge& b) const;
    /// visit(edge) for an edge and those that share a node with it.
    template <class Visit>
    void for_neighbours(Index edge, Visit&& visit) const
    {
        visit(edge);
        for (Index end : ends_[edge]) {
            for (Index other : at_node_[end])
                if (other != edge) visit(other);
        }
    }
    bool beside(const Pair& pair, const Vec3& normal, EdgeTouch& found) const;
    bool touch_of(const Clock& clock, const State& state, const Pair& pair, const EdgeTouch* before,
                  EdgeTouch& touch) const;
    void drop_repeated(const State& state);
    bool owns_end(const State& state, Index edge, double along, const Vec3& offset) const;
    double stiffness_of(const EdgeTouch& touch) const;
    Friction friction_of(Index first, Index second) const;
    double apply_law(const Clock& clock, const State& state, EdgeTouch& touch) const;
    void sum_up(const Clock& clock, State& state);
};

} // namespace plash

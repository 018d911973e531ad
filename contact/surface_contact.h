#pragma once

#include "contact/facing_segments.h"
#include "contact/lane_points.h"
#include "contact/tied_springs.h"
#include "contact/touch.h"
#include "core/term.h"

#include <optional>

namespace plash {

/// Penalty contact of nodes on segments: single surface, two-way or one-way, automatic or oriented.
///
/// Stiffness of a touch: SOFT = 0: SLSFAC times the smaller (or as PENOPT says) of node and segment
/// stiffness. SOFT = 1: at least SOFSCL m* / (2 dt^2) with the smallest mass of node and segment nodes and
/// the longest step of the run so far, so that soft and stiff bodies meet as the step allows (Hallquist 2006,
/// 'Soft constraint'). SOFT = 2: from the masses of node and segment alone; between surfaces segments press
/// on segments (FacingSegments), and nodes act where rims and sharp corners meet a face.
///
/// TIEBREAK contacts own the springs that hold their nodes until they fail.
///
/// Energy: work of the contact forces by the trapezoidal rule over each step. Sliding energy is what they
/// have taken out of the motion: elastic energy that comes back, friction and damping that do not.
class SurfaceContact : public Term {
public:
    SurfaceContact(const Contact& contact, const Model& model, const std::vector<PartData>& parts);

    std::string_view name() const override { return name_; }
    std::size_t items() const override { return mesh_.nodes.size(); }
    void add_forces(const Clock& clock, State& state) override;
    void constrain(const Clock& clock, State& state) override;
    StepVote stable_step() const override { return vote_; }
    /// Initial penetrations: how many, how deep, where.
    std::vector<std::string> notices(const State& state) const override;
    void report(EnergyLedger& ledger) const override { ledger.sliding += sliding_energy(); }
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override;

    const Contact& contact() const { return contact_; }
    const ContactMesh& mesh() const { return mesh_; }
    /// All touches as they stand after add_forces.
    TouchList touches() const { return table_.list(mesh_, motion_); }
    /// Segments that press on segments, or nullptr.
    const FacingSegments* facing() const { return facing_ ? &*facing_ : nullptr; }
    long searches() const { return search_.searches(); }
    double sliding_energy() const { return energy_.slave + energy_.master + (ties_ ? ties_->energy() : 0); }
    /// Springs of a TIEBREAK contact, or nullptr.
    const TiedSprings* ties() const { return ties_ ? &*ties_ : nullptr; }
    double friction_energy() const { return energy_.friction; }
    /// Whether there is a force at n.
    bool presses() const;

private:
    struct Energy {
        double slave = 0, master = 0, friction = 0; ///< taken out of the motion so far [energy]
    };
    /// What all touches together do to a node.
    struct alignas(32) NodeSum {
        Vec3 force{};
        double stiffness = 0; ///< of the springs that hang on the node [force/length]
    };
    enum NodeKind : std::uint8_t { slave_node = 1, rigid_node = 2 };
    /// A rigid part by its nodes in this contact.
    struct RigidPart {
        bool rigid = false;
        double mass = 0;      ///< [mass]
        double stiffness = 0; ///< of all touches now [force/length]
    };
    /// What a chunk of the touches presses with, in the order of their owners, eight at a time.
    struct Pressed {
        /// Forces on eight nodes or on the points of eight facets, each with its stiffness.
        struct OnNodes {
            Four force[lane_count];
            Index node[lane_count];
            unsigned lanes; ///< those that count, a bit each

            OnNodes() {} // all is set by the one who adds it
        };
        struct OnFacets {
            Four force[lane_count];
            Lanes share[4];
            Index corner[4][lane_count];
            unsigned lanes;

            OnFacets() {}
        };
        /// What friction took of eight nodes in the last step; their facets stand in on_facets.
        struct Rubbed {
            Lanes loss;
            Index node[lane_count];
            std::size_t facets;
        };
        std::vector<OnNodes> on_nodes;
        std::vector<OnFacets> on_facets;
        std::vector<Rubbed> rubbed; ///< only where friction's energy is summed up by face
        std::size_t touches = 0;
        double friction = 0; ///< taken by friction in the last step [energy]

        void clear();
    };
    /// Room of a thread.
    struct Room {
        TouchFinder::Room finder;
        Pressed pressed;
    };
    struct FacetLanes;
    struct FrictionLanes;
    struct NodeBatch;
    struct TouchBatch;

    const Contact& contact_;
    std::string name_;
    const Model& model_;
    ContactMesh mesh_;
    mutable PairSearch search_; ///< follows from where the nodes are: whoever asks first makes it
    ContactMotion motion_;
    std::optional<FacingSegments> facing_;
    std::vector<double> lumped_; ///< masses of the Model's nodes by their elements, until the first cycle
    std::vector<double> mass_;   ///< of the mesh's nodes [mass]
    std::vector<Friction> frictions_; ///< by part, and one more for nodes and facets without a part
    TouchTable table_;
    std::size_t touching_now_ = 0; ///< touches of this cycle
    long searches_seen_ = 0;
    std::vector<NodeSum> sum_;       ///< by mesh node, of this cycle
    bool summed_ = false;            ///< sum_ is not zero everywhere
    std::vector<std::uint8_t> kind_; ///< by mesh node: bits of NodeKind
    long deletions_seen_ = 0;
    bool restarted_ = false; ///< the mesh does not know yet what erosion had taken before the restart
    double soft_step_ = 0;   ///< longest step so far [time]
    bool soft_changed_ = false;
    Energy energy_;
    StepVote vote_;
    std::vector<RigidPart> rigid_; ///< by part of the Model
    std::optional<TiedSprings> ties_;
    std::vector<Index> number_; ///< of the mesh by State index; empty unless ties hold nodes back
    std::vector<std::pair<Index, std::uint8_t>>
        waiting_; ///< mesh nodes of particles that wait in solids, and what they will act on
    std::vector<std::uint8_t> weighty_; ///< by mesh node: had mass in the State; empty where none can lose it
    std::vector<std::uint8_t> acts_on_again_; ///< by mesh node: what a held node will act on
    bool sticks_ = false;                     ///< TIEBREAK OPTION 1, 3: nodes stick where they touch
    std::vector<std::uint8_t> stuck_;         ///< by mesh node: has stuck once; empty unless nodes stick
    /// By mesh node: half of what friction has taken from touches of the node and of its facets [energy];
    /// empty unless asked for (FRCENG).
    std::vector<double> rubbed_off_;

    bool active(const Clock& clock) const
    {
        return clock.time >= contact_.birth && clock.time <= contact_.death;
    }
    bool nothing_touches() const { return touching_now_ == 0 && (!facing_ || facing_->touches().empty()); }
    std::array<double, 4> shares(const Touch& touch) const;
    void make_facing();
    void weigh_segments();
    void rest();
    void tie(const std::vector<PartData>& parts);
    void pull_ties(const Clock& clock, State& state);
    void hold_back(Index number);
    void stick(const State& state);
    void add_rigid_votes();
    void take_masses(const State& state);
    void hold_back_waiting();
    void wake_particles(const State& state);
    void follow_erosion(const State& state);
    void find_touches();
    void press(std::size_t begin, std::size_t end, const TouchFinder& finder, Room& room);
    void press_batch(std::size_t owner, std::size_t lanes, const TouchFinder& finder, Room& room);
    unsigned place_touches(const NodeBatch& nodes, const FacetLanes& facets, TouchBatch& touches);
    void press_touches(const NodeBatch& nodes, const FacetLanes& facets, const TouchBatch& touches,
                       Pressed& pressed);
    Lanes damped(const NodeBatch& nodes, const FacetLanes& facets, const std::array<Lanes, 4>& share,
                 const Lanes& stiffness, const Lanes& closing, const Lanes& force) const;
    Vector3<Lanes> rubbed(const NodeBatch& nodes, const FacetLanes& facets, const TouchBatch& touches,
                          const Vector3<Lanes>& slip, const Lanes& stiffness, const Lanes& force,
                          Lanes& lost);
    void set_stiffness(int layer, std::size_t owner, unsigned active, const Index* facet,
                       const Vector3<Lanes>& normal);
    double stiffness_of(Index node, Index facet) const;
    const Friction& friction_of(Index node, Index facet, Friction& mixed) const;
    FrictionLanes friction_lanes(const Index* node, const Index* facet) const;
    void set_constraint_forces(const Clock& clock, State& state);
    void sum_up(const Pressed& pressed);
    void sum_up_facing();
    void share_out_friction(const Pressed& pressed);
    void add_facing(ElementResults::ContactForce& sum) const;
    /// What acts at the nodes: normal force, friction, area of the exposed facets; by mesh node.
    struct NodeLoads {
        std::vector<double> normal, area;
        std::vector<Vec3> friction;
    };
    NodeLoads node_loads() const;
    void add_pressures(std::vector<double>& pressure) const;
    void add_faces(std::vector<ElementResults::ContactFace>& faces) const;
    void move_on(const Clock& clock, const State& state);
    void take_work(const Clock& clock, std::span<const double> slave, std::span<const double> master);
    void add_to(const Clock& clock, State& state);
};

} // namespace plash

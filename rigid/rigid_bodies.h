#pragma once

#include "core/term.h"
#include "core/work_sum.h"
#include "rigid/body_rows.h"
#include "rigid/joint_springs.h"
#include "rigid/joints.h"
#include "rigid/part_switches.h"
#include "rigid/welds.h"

namespace plash {

/// The rigid bodies of a scene with what binds the deck's names to them.
struct RigidSetup {
    std::vector<RigidBody> bodies;
    std::vector<Index> of_number; ///< by body number: position in `bodies`, `none` where there is no body
    std::vector<Weld> welds;
    std::vector<std::string> notices; ///< for the user
    PartSwitches switches{};
};

/// All rigid bodies of a scene. Their nodes have no mass of their own in the State, so the loop leaves them
/// alone; this term sums their forces, moves the bodies by what acts on them (loads, joints, drives,
/// supports) and gives the nodes the velocities that carry them to their places at n+1.
class RigidBodies : public Term {
public:
    /// Takes the masses of the bodies' nodes out of the state. DeckError for joints, loads and drives that do
    /// not fit the bodies.
    RigidBodies(const Model& model, RigidSetup setup, State& state);

    std::string_view name() const override { return "rigid bodies"; }
    std::size_t items() const override { return bodies_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void after_motion(const Clock& clock, State& state) override;
    StepVote stable_step() const override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;
    std::vector<std::string> notices(const State&) const override { return notices_; }
    void serialise(Archive& archive) override;
    void begin_phase(bool relaxing, State& state) override;

    const std::vector<RigidBody>& bodies() const { return bodies_; }
    const PartSwitches& switches() const { return switches_; }

private:
    /// A row whose target follows a curve: a driven freedom of a body, or a motor.
    struct Drive {
        PrescribedMotion motion;
        std::size_t row;
        Index body;           ///< that is reported
        bool motor = false;   ///< of a joint
        Index joint = none;   ///< position in joints_
        double travelled = 0; ///< VAD = 4: how far the bodies were apart at the birth
        bool born = false;    ///< VAD = 4: that is known
        double rate = 0;      ///< over the last step
        double force = 0;     ///< along or about the direction that drives the body at n [force] or [moment]
        WorkSum work;
    };
    /// A node of a body that the deck holds (*BOUNDARY_SPC).
    struct Support {
        Index node;
        std::size_t row;
        Vec3 direction;
        bool rotation;
        double birth, death;
        double force = 0;
    };
    struct Load {
        const RigidBodyLoad* load;
        Index body;
        double last_magnitude = 0, work = 0;
        Vec3 last_direction{};
    };
    struct Sums { ///< of the forces of the nodes of a body
        Vec3 force{}, moment{};
    };
    struct Motion { ///< of a body over the last step
        Vec3 velocity{}, angular_velocity{}, angular_momentum{};
    };

    const Model& model_;
    std::vector<RigidBody> bodies_;
    BodyRows rows_;
    std::vector<JointRows> joints_;
    std::vector<JointSpring> springs_;
    std::vector<Weld> welds_;
    PartSwitches switches_;
    std::vector<Drive> drives_;
    std::vector<Support> supports_;
    std::vector<Load> loads_;
    std::vector<Motion> before_;
    std::vector<Motion> first_; ///< at the start, while dynamic relaxation runs
    std::vector<Sums> sums_;    ///< by body; room for each cycle
    std::vector<Sums> partial_; ///< by chunk of the largest body
    std::vector<std::string> notices_;
    std::vector<Vec3> joint_force_, joint_moment_;
    double kinetic_ = 0;
    double body_load_work_ = 0;
    std::vector<Index> begun_;   ///< bodies that a switch has made in the last step
    double switched_energy_ = 0; ///< that switches of parts have added to the kinetic energy

    Index body_of(BodyNumber number, const std::vector<Index>& of_number, const Location& where) const;
    void add_drives(const std::vector<Index>& of_number);
    void add_supports(const std::vector<Index>& of_node);
    void add_joints(const std::vector<Index>& of_node, const std::vector<Index>& of_number);
    void add_springs(const std::vector<Index>& of_number);
    void add_loads(const std::vector<Index>& of_number);
    void start();
    void release(Index body, State& state);
    void engage(Index body, State& state);
    void take_last_work(const Clock& clock, const State& state);
    void take_forces(const Clock& clock, const State& state);
    void add_missing_weight(const Clock& clock, RigidBody& body, Sums& sums);
    void set_targets(const Clock& clock, const State& state);
    void set_relative_target(const Clock& clock, const State& state, Drive& drive);
    void book_rows(const Clock& clock);
    void look_for_failed_joints(const Clock& clock, const State& state);
    void move(const Clock& clock, State& state, RigidBody& body, const Motion& before);
};

} // namespace plash

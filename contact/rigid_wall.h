#pragma once

#include "contact/wall_shape.h"
#include "core/term.h"
#include "core/work_sum.h"
#include "model/model.h"

namespace plash {

/// *RIGIDWALL_PLANAR and *RIGIDWALL_GEOMETRIC: nodes may not enter the wall. A node that would be inside
/// after the step lands on the surface instead (perfectly plastic, as LS-DYNA's wall), and is free to leave.
/// Friction acts on the force that stops it: Coulomb, isotropic or orthotropic; FRIC = 1 holds touching
/// nodes; with FRIC = 2 (free to slide) and 3 (not) nodes that come in faster than WVEL are welded to the
/// wall.
///
/// A wall moves as its curve says, or, as a mass (_MOVING), by the momentum that it exchanges with the nodes:
/// its velocity and the impulses on all touching nodes are solved together.
///
/// Nodes of rigid bodies are pushed by a spring of 0.1 m / dt^2 with their lumped mass and the first step, at
/// which every body stays stable however many of its nodes touch.
class RigidWallTerm : public Term {
public:
    /// Before rigid bodies take the masses of their nodes.
    RigidWallTerm(const RigidWall& wall, const Model& model, const State& state);

    std::string_view name() const override { return "rigid wall"; }
    std::size_t items() const override { return nodes_.size(); }
    void constrain(const Clock& clock, State& state) override;
    void report(EnergyLedger& ledger) const override;
    void collect(const State& state, ElementResults& results) const override;
    void serialise(Archive& archive) override;

    const RigidWall& wall() const { return wall_; }
    /// Force of the nodes on the wall at n [force].
    const Vec3& force() const { return force_; }

private:
    /// A node of a rigid body that is pushed out by a spring.
    struct Pushed {
        double baseline = 0; ///< gap below which there is no force: it was there at the start [length]
        Vec3 force{};        ///< at n-1 [force]
    };
    struct Sums {
        Vec3 force{};
        double power_before = 0, power_after = 0; ///< of the wall on deformable nodes
        double pushed_power = 0;                  ///< of the springs over the last step
        double momentum = 0, mass = 0;            ///< of touching nodes along the normal (moving mass)
    };
    const RigidWall& wall_;
    const Model& model_;
    std::vector<Index> nodes_;
    std::vector<double> mass_;   ///< like nodes_, also of nodes of rigid bodies [mass]
    std::vector<Pushed> pushed_; ///< like nodes_; empty where no nodes are or may come to be of rigid bodies
    std::vector<bool> welded_;   ///< like nodes_, only with FRIC = 2 and 3
    bool started_ = false;
    double spring_rate_ = 0; ///< 0.1 / dt^2 of the first step [1/time^2]
    Vec3 moved_{};           ///< of the wall since the start, at n [length]
    Vec3 velocity_{};        ///< of the wall from n to n+1; at n-1/2 between cycles
    Vec3 force_{};           ///< of the nodes on the wall at n [force]
    WorkSum work_;           ///< of the wall on deformable nodes
    double pushed_work_ = 0; ///< of the wall on nodes of rigid bodies [energy]
    WorkSum wall_work_;      ///< of the nodes on the wall [energy]
    double kinetic_ = 0;     ///< of a moving mass [energy]

    void start(const Clock& clock, const State& state);
    Vec3 next_velocity(const Clock& clock, const State& state);
    bool stays_clear(Index node, const Clock& clock, const State& state) const;
    void stop_node(std::size_t i, const Clock& clock, State& state, Sums& sums);
    void push_node(std::size_t i, const Clock& clock, State& state, Sums& sums);
    WallMeeting meeting_of(std::size_t i, const Clock& clock, const State& state,
                           const Vec3& wall_velocity) const;
    Vec3 friction_of(const Vec3& slip_velocity, double normal_force, const Vec3& normal,
                     double stopping) const;
};

} // namespace plash

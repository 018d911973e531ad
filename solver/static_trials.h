#pragma once

#include "core/clock.h"
#include "core/parallel.h"
#include "rigid/rigid_bodies.h"
#include "solver/first_velocities.h"
#include "solver/scene.h"
#include "solver/step_control.h"

#include <string>
#include <vector>

namespace plash {

/// A file for the state of the start of a static phase, gone with this object.
class KeptState {
public:
    explicit KeptState(Scene& scene);
    ~KeptState();
    KeptState(const KeptState&) = delete;
    KeptState& operator=(const KeptState&) = delete;

    void bring_back();

private:
    Scene& scene_;
    std::string path_;

    void pass(Archive::Mode mode);
};

/// A node that may move, with three translations and, with an inertia, three rotations among the unknowns.
struct Freedom {
    Index node;
    double mass;                     ///< of nodes of a rigid body an equal share of the body's [mass]
    double inertia = 0;              ///< [mass length^2]
    double gyration = 0;             ///< radius; rotations count by the length of their way there [length]
    std::size_t first;               ///< of its unknowns
    const RigidBody* body = nullptr; ///< that carries it

    int count() const { return inertia > 0 ? 6 : 3; }
};

/// Accelerations of a scene at places near those of its start.
class StaticTrials {
public:
    StaticTrials(Scene& scene, std::vector<double>& seconds);

    std::size_t unknowns() const { return unknowns_; }
    long count() const { return count_; } ///< sums of forces so far
    const std::vector<Freedom>& freedoms() const { return freedoms_; }
    const Model& model() const { return scene_.model; }
    /// The clock of the phase, with the time at which loads act.
    const Clock& clock() const { return clock_; }

    /// Accelerations [acceleration] at displacements from the places of the start [length].
    void accelerations(const double* displacement, double* result);

    /// Leaves the scene at these places, ready for its first cycle.
    void stay(const double* displacement);

private:
    Scene& scene_;
    std::vector<double>& seconds_;
    FirstVelocities first_;
    KeptState kept_;
    StepControl step_control_;
    Clock clock_;
    double step_ = 0; ///< in which trial places are reached [time]
    std::vector<Freedom> freedoms_;
    std::size_t unknowns_ = 0;
    long count_ = 0;

    void find_freedoms();
    void settle();
    void go_to(const double* displacement);
};

} // namespace plash

#pragma once

#include "core/archive.h"
#include "core/clock.h"
#include "core/state.h"
#include "model/model.h"

#include <cstdint>
#include <vector>

namespace plash {

/// *BOUNDARY_SPH_FLOW: particles that stand ready in front of a plane and move towards it as a curve says.
/// They are pressed by who is in front of them, but no force moves them. Who has passed the plane is a
/// particle like all others.
struct Inflow {
    PrescribedMotion motion; ///< of `nodes`, along its direction; what they have across it stays
    Vec3 point{};            ///< of the plane [length]
    Vec3 normal{};           ///< unit, with the flow
};

/// The inflows of a Model. DeckError where a field makes no sense.
std::vector<Inflow> inflows_of(const Model& model);

/// Drives the particles of all inflows that have not come in yet.
class Inflows {
public:
    Inflows() = default;
    /// Gives those that wait their velocity at t = 0.
    Inflows(std::vector<Inflow> inflows, const Model& model, State& state);

    bool any() const { return !inflows_.empty(); }
    /// Whether the particle of a node has not passed its plane; as `look` has found.
    bool waits(Index node) const { return any() && waits_[node] != 0; }
    /// How far a particle that waits is from its plane [length].
    double distance(Index node, const Vec3& position) const
    {
        const Inflow& inflow = inflows_[waits_[node] - 1];
        return dot(inflow.point - position, inflow.normal);
    }
    /// Whether someone who waits has passed.
    bool someone_passes(const State& state) const;
    /// Finds anew who waits. Who has come in never waits again.
    void look(const State& state);
    /// Makes the forces of those who wait such that they move as the curves say.
    void constrain(const Clock& clock, State& state);
    double work() const { return work_; } ///< done on them so far [energy]
    void serialise(Archive& archive) { archive(waits_, travelled_, force_, work_); }

private:
    const Model* model_ = nullptr;
    std::vector<Inflow> inflows_;
    std::vector<std::uint8_t> waits_; ///< by node: 1 + number of the inflow it waits in
    std::vector<double> travelled_;   ///< by inflow [length]
    std::vector<Vec3> force_;         ///< by node: added in the last cycle [force]
    double work_ = 0;
};

} // namespace plash

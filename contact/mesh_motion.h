#pragma once

#include "contact/contact_mesh.h"
#include "core/clock.h"

namespace plash {

/// Where the nodes of a contact mesh are and how they move, copied into the mesh's order.
struct ContactMotion {
    std::vector<Vec3> position; ///< at n [length]
    std::vector<Vec3> velocity; ///< at n-1/2
    double last_step = 0;       ///< [time]
    double step_range = 0;      ///< bound of the relative motion of any two nodes in the last step [length]
    double travelled = 0;       ///< sum of step_range over all steps: bound of every relative path [length]

    /// Takes positions and velocities from the State.
    void load(const ContactMesh& mesh, const Clock& clock, const State& state);

    Vec3 previous(Index node) const { return position[node] - last_step * velocity[node]; }
};

} // namespace plash

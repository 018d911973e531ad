#pragma once

#include "core/term.h"
#include "math/matrix3.h"
#include "model/model.h"

#include <memory>
#include <utility>

namespace plash {

/// Nodes that follow the mean motion of others (*CONSTRAINED_INTERPOLATION): the rigid motion U + W x r that
/// fits the independent nodes best in the sense of weighted least squares (MacNeal's RBE3 element: NASTRAN
/// theory; with r from the dependent node). What acts on the dependent node goes to the independent ones by
/// the transpose of that fit, so that the pair does no work; its mass is shared out by weight.
class Interpolations {
public:
    /// Takes the mass of the dependent nodes out of the state and gives it to the independent ones. DeckError
    /// for freedoms and weights that are not supported.
    Interpolations(const Model& model, State& state);

    std::size_t size() const { return links_.size(); }
    bool empty() const { return links_.empty(); }
    /// Before the nodes' accelerations are known.
    void hand_forces_on(State& state) const;
    /// Once all other nodes have their forces (or their velocities, in rigid bodies).
    void move_dependents(const Clock& clock, State& state) const;

private:
    struct Link {
        Index dependent;
        bool rotations; ///< DDOF has 456: moments are handed on and the node turns with the mean rotation
        std::vector<Index> nodes;
        std::vector<double> weight; ///< sum 1
    };
    /// The fit at the present places: mean motion of the nodes' centroid and their inertia about it.
    struct Fit {
        Vec3 centroid{};
        Matrix3 inverse_inertia{};
    };
    std::vector<Link> links_;

    static Fit fit_of(const Link& link, const State& state);
};

/// The two moments of a cycle at which interpolations act, each a term of its own.
std::pair<std::unique_ptr<Term>, std::unique_ptr<Term>> make_interpolations(const Model& model, State& state);

} // namespace plash

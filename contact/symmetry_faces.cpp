#include "contact/symmetry_faces.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace plash {

namespace {

/// Directions along which nodes are held, at right angles to one another.
class HeldDirections {
public:
    explicit HeldDirections(const Model& model)
    {
        for (const FixedNodes& fixed : model.fixed_nodes) {
            if (fixed.birth > 0) continue;
            std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
            if (fixed.system != none) axes = model.coordinate_systems[fixed.system].axes;
            if (fixed.local) axes = fixed.axes;
            for (int axis = 0; axis < 3; ++axis) {
                if ((fixed.freedoms >> axis & 1) == 0) continue;
                for (const Index node : fixed.nodes) hold(node, axes[axis]);
            }
        }
    }

    bool hold_along(Index node, const Vec3& normal) const
    {
        const auto found = of_node_.find(node);
        if (found == of_node_.end()) return false;
        double square = 0;
        for (const Vec3& direction : found->second) square += std::pow(dot(direction, normal), 2);
        constexpr double one_degree = 3e-4; // of the square of the cosine
        return square > 1 - one_degree;
    }

private:
    std::unordered_map<Index, std::vector<Vec3>> of_node_;

    void hold(Index node, Vec3 direction)
    {
        std::vector<Vec3>& known = of_node_[node];
        for (const Vec3& other : known) direction -= dot(direction, other) * other;
        if (norm(direction) > 1e-3) known.push_back(unit(direction));
    }
};

} // namespace

void drop_symmetry_faces(const Model& model, std::vector<Segment>& segments)
{
    const HeldDirections held(model);
    const auto& place = model.nodes.position;
    std::erase_if(segments, [&](const Segment& segment) {
        if (segment.solid == none) return false;
        const auto& nodes = segment.nodes;
        const Vec3 normal = unit(cross(place[nodes[2]] - place[nodes[0]],
                                       nodes[3] == nodes[2] ? place[nodes[2]] - place[nodes[1]]
                                                            : place[nodes[3]] - place[nodes[1]]));
        return std::all_of(nodes.begin(), nodes.end(),
                           [&](Index node) { return held.hold_along(node, normal); });
    });
}

} // namespace plash

#pragma once

#include "ale/hex/hex_layout.h"
#include "ale/hex/hex_mesh.h"

namespace plash {

/// Gravity on a mesh whose cells are no parallelepipeds. An eighth of a cell's weight on each of its nodes
/// would not stand against hydrostatic pressure there: what a node carries of the area of a distorted cell's
/// faces is not what it carries of the mass. The weight of a cell acts on its nodes as the pressure does that
/// it adds between the middle of the cell and the node, density times g . (x_node - x_middle), on the
/// derivative of the cell's volume by that node. The sum over the nodes is the cell's weight (the volume is
/// homogeneous of third degree in the nodes), and where pressure in the middles is hydrostatic all cells of a
/// node agree on the pressure there, so that a fluid at rest stays so on any mesh. That is the idea of
/// well-balanced schemes: reconstruct from the hydrostatic solution (Botta, Klein, Langenberg & Lutzenkirchen
/// 2004, J. Comput. Phys. 196, 539-565).
class HexWeight {
public:
    explicit HexWeight(const HexMesh& mesh);

    /// Some cell is no parallelepiped.
    bool needed() const { return !node_force_[0].empty(); }
    /// From the masses of the cells.
    void prepare(const HexMesh& mesh, const double* mass, const std::array<double, 3>& gravity);
    /// Weight on a batch of nodes [force].
    std::array<Lanes, 3> on_nodes(const HexLayout& layout, std::size_t node,
                                  const std::array<double, 3>& gravity) const;
    /// Keeps how the weight of a batch of nodes differs from an eighth of its cells'.
    void keep(std::size_t node, const std::array<Lanes, 3>& difference)
    {
        for (int axis = 0; axis < 3; ++axis) store(&node_force_[axis][node], difference[axis]);
    }
    /// Its work with these mean velocities [energy].
    double work(std::size_t nodes, const std::array<AlignedDoubles, 3>& velocity, double step) const;

private:
    std::array<AlignedDoubles, 3> node_position_, middle_; ///< from the first node of the mesh [length]
    AlignedDoubles density_, weight_;                      ///< of cells [density], density g . x [pressure]
    std::array<AlignedDoubles, 3> node_force_;
};

} // namespace plash

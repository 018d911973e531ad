#pragma once

#include "ale/hex/hex_mesh.h"
#include "ale/node_smoothing.h"

#include <cstdint>

namespace plash {

/// Smooths a mesh that has gone with its material. All ways start from the same places (Jacobi), so that the
/// order of nodes does not count. With x the node, sums over the cells around it:
///
/// - simple average: to the mean of the other nodes of these cells, each counted in every cell that has it;
/// - volume weighted (Kikuchi, Chung, Torigaki & Taylor 1986, CMAME 57, 67-89): to sum V x_m / sum V, x_m the
///   middles of the cells and V their volumes before the step; half of the way, as the whole one leaves a
///   checkerboard as it is;
/// - isoparametric (Herrmann 1976, J. Eng. Mech. Div. 102, 749-756, w = 1; here in space): to
///   sum (a1 + a2 + a3 - b12 - b23 - b31 + c) / cells, a the cell's nodes next to x, b those across its
///   faces, c the one across the cell; a mesh at rest is the transfinite interpolation of its boundary. An
///   eighth of the way: its whole way amplifies a checkerboard by seven, this takes it out at once;
/// - equipotential (Winslow 1963, UCRL-7312; J. Comput. Phys. 1, 149, 1966): sum g^ab d_ab x = 0 for
/// Laplace's
///   equation of the logical coordinates, by central differences over the eight cells of a regular node.
///   Half of the way, for the same reason. At irregular nodes the simple average.
/// Instead of these, `back` takes every node to its place of the start.
///
/// At plane sides and straight edges nodes slide along them, as if the mesh were mirrored there; where sides
/// are bent or three of them meet, nodes go with the material. In a step no node goes further than a quarter
/// of its shortest edge: two faces of a cell that come together leave half of it to the remap.
class HexSmoothing {
public:
    /// kept  nodes that are not smoothed
    HexSmoothing(const HexMesh& mesh, const std::vector<Index>& kept);

    /// nodes  where the material has taken them; where they go is put there [length]
    void operator()(const HexMesh& mesh, const NodeSmoothing& by, std::vector<Vec3>& nodes) const;

private:
    /// Which logical axis of the node an axis of a cell at it is, and whether it leads up or down along it.
    struct Frame {
        std::array<std::int8_t, 3> axis{}, sign{};
    };
    struct Walls;

    std::vector<Vec3> start_; ///< places at the start [length]
    std::vector<bool> kept_;
    std::vector<Frame> frames_;         ///< as HexMesh::node_corner
    std::vector<std::int8_t> mirrored_; ///< by node: axes that end there, bits 1, 2, 4; -1: irregular
    std::vector<Index> outer_faces_;    ///< of the mesh
    std::vector<Index> outer_number_;   ///< of nodes among the outer ones; none: inside
    std::size_t outer_nodes_ = 0;

    void find_frame(const HexMesh& mesh, std::size_t node);
    std::vector<Walls> walls_at(const HexMesh& mesh, const std::vector<Vec3>& nodes) const;
    Vec3 equipotential_way(const HexMesh& mesh, std::size_t node, const Walls& walls,
                           const std::vector<Vec3>& nodes) const;
    Vec3 way_of(const HexMesh& mesh, const NodeSmoothing& by, std::size_t node, const Walls& walls,
                const std::vector<Vec3>& nodes) const;
};

} // namespace plash

#pragma once

#include "ale/box_fields.h"
#include "ale/hex/hex_lanes.h"
#include "ale/hex/hex_sweep.h"

/// What stands where on a mesh of hexahedra, by batches of lane_count cells, so that void is skipped and
/// cells that are full of one group are spared the work that interfaces need.
namespace plash {

class HexActivity {
public:
    using Mask = BoxContents::Mask;

    /// mixed  a cell may be partly empty or hold several groups; else it is one group, full cells, for ever
    HexActivity(const HexMesh& mesh, const std::vector<HexSweep>& sweeps, bool mixed);

    /// Looks at the fractions of all batches, or of those that fluid may have reached.
    void look(const FluidFields& fields, bool at_all);
    /// From what the cells hold now: what stands around them, and where fluid may get within a step.
    void spread();

    Mask of_cells(std::size_t cell) const { return own_[cell / lane_count]; }
    /// Of the batch and all cells that share a node with it, when spread() was called.
    Mask around_cells(std::size_t cell) const { return around_[cell / lane_count]; }
    bool reaches_cells(std::size_t cell) const { return reached_[cell / lane_count] != 0; }

    /// Of the cells that meet in a batch of nodes; and whether fluid may get to these nodes within a step.
    Mask of_nodes(std::size_t node) const { return of(nodes_, node, own_); }
    bool reaches_nodes(std::size_t node) const { return reached_nodes_[node / lane_count] != 0; }
    /// Of the cells beside a batch of faces of the mesh.
    Mask of_faces(std::size_t face) const { return of(faces_, face, own_); }
    bool reaches_faces(std::size_t face) const { return of(faces_, face, reached_) != 0; }
    /// By direction: of the four cells in line of a batch of faces, of the cells around the four nodes in
    /// line of a batch of edges; whether fluid may get to a batch of members or nodes of a sweep.
    Mask of_lines(int direction, std::size_t entry) const
    {
        return of(sweeps_[direction].lines, entry, own_);
    }
    Mask of_edges(int direction, std::size_t edge) const { return of(sweeps_[direction].edges, edge, own_); }
    bool reaches_members(int direction, std::size_t member) const
    {
        return of(sweeps_[direction].members, member, reached_) != 0;
    }
    bool reaches_swept_nodes(int direction, std::size_t entry) const
    {
        return of(sweeps_[direction].nodes, entry, reached_nodes_) != 0;
    }

    void serialise(Archive& archive);

private:
    using Lists = Grouped<Index>; ///< batches of cells (or of nodes) that batches of something touch
    struct SweepLists {
        Lists lines, edges, members, nodes;
    };

    bool mixed_;
    int reach_;         ///< rings of cells that fluid may cross within a step
    std::size_t cells_; ///< of the mesh
    Lists ring_, nodes_, faces_;
    std::vector<SweepLists> sweeps_;
    std::vector<Mask> own_, around_, reached_, reached_nodes_;

    static Mask of(const Lists& lists, std::size_t entry, const std::vector<Mask>& masks)
    {
        Mask mask = 0;
        const std::size_t batch = entry / lane_count;
        for (const Index* near = lists.begin(batch); near != lists.end(batch); ++near) mask |= masks[*near];
        return mask;
    }
};

} // namespace plash

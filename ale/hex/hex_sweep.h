#pragma once

#include "ale/hex/hex_lanes.h"
#include "ale/hex/hex_mesh.h"

namespace plash {

/// A list of entries for each of several owners.
template <class T>
struct Grouped {
    std::vector<std::size_t> first; ///< of each owner; one more entry for the end
    std::vector<T> entries;

    const T* begin(std::size_t owner) const { return entries.data() + first[owner]; }
    const T* end(std::size_t owner) const { return entries.data() + first[owner + 1]; }
};

/// What a sweep along all chords of one direction needs.
struct HexSweep {
    /// A cell that the sweep passes, and along which of its axes.
    struct Member {
        Index cell;
        int axis;
    };
    std::vector<Member> members;
    std::size_t first_face = 0; ///< of the mesh; `lines` has an entry for each of the direction
    /// Cells across each face; at the end of a chord the last one stands for what lies beyond.
    HexLines lines;
    AlignedDoubles ends_below, ends_above; ///< 1 where the chord ends at the face, by entry of `lines`

    /// Edges along the chords, from node `below` to node `above`, and the members around each: the mass that
    /// goes along an edge is an eighth of the sum of what passes the lower and the upper faces of these.
    HexLines edges; ///< with the nodes before and after
    struct Part {
        std::vector<Index> member; ///< by edge; beyond the last one of an edge any, with sign 0
        AlignedDoubles sign;       ///< -1 where the chord runs against the edge
    };
    std::vector<Part> around_edge;

    /// Nodes that the sweep touches, and what flows in and out there.
    std::vector<Index> nodes;
    struct Flow {
        Index edge;  ///< or the face of the mesh, at an end of the chord
        double sign; ///< +1 in, -1 out
        bool end;    ///< of the chord: a quarter of what passes the face, with the node's own velocity
    };
    Grouped<Flow> at_node; ///< by position in `nodes`
};

/// One for each direction.
std::vector<HexSweep> make_hex_sweeps(const HexMesh& mesh);

} // namespace plash

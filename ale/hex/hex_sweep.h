#pragma once

#include "ale/hex/hex_lanes.h"
#include "ale/hex/hex_mesh.h"

namespace plash {

/// What a sweep along all chords of one direction needs.
struct HexSweep {
    /// A cell that the sweep passes, and along which of its axes.
    struct Member {
        Index cell;
        int axis;
    };
    std::vector<Member> members;
    PlaceList member_cell, low_face, high_face; ///< of the members
    std::size_t first_face = 0; ///< of the mesh; `lines` has an entry for each of the direction
    /// Cells across each face; at the end of a chord the last one stands for what lies beyond.
    HexLines lines;
    AlignedDoubles ends_below, ends_above; ///< 1 where the chord ends at the face, by entry of `lines`

    /// Edges along the chords, from node `below` to node `above`, and the members around each: the mass that
    /// goes along an edge is an eighth of the sum of what passes the lower and the upper faces of these.
    HexLines edges; ///< with the nodes before and after
    struct Part {
        PlaceList member;    ///< by edge; beyond the last one of an edge any, with sign 0
        AlignedDoubles sign; ///< -1 where the chord runs against the edge
    };
    std::vector<Part> around_edge;

    /// Nodes that the sweep touches, and edges by which it comes in (sign +1) and leaves (-1).
    PlaceList nodes;
    struct Flow {
        PlaceList edge; ///< by position in `nodes`; any, with sign 0, where there is none
        AlignedDoubles sign;
    };
    std::vector<Flow> at_node;
    /// Ends of chords: a quarter of what passes the face of the mesh, with the node's own velocity.
    struct End {
        Index position; ///< in `nodes`
        Index face;
        double sign;
    };
    std::vector<End> ends;
};

/// One for each direction.
std::vector<HexSweep> make_hex_sweeps(const HexMesh& mesh);

} // namespace plash

#pragma once

#include "ale/hex/hex_mesh.h"
#include "math/aligned.h"

#include <span>

namespace plash {

/// Moves the nodes of a mesh, step by step and each on its own.
///
/// What a face sweeps while its nodes go straight from x to x + d is the integral over the way of the areas
/// N_i n dA times d_i. Areas are of second degree in the way, so that two points of Gauss are exact, and the
/// volumes swept by the faces of a cell add up to the change of its volume to round-off: the geometric
/// conservation law (Thomas & Lombard 1979, AIAA J. 17, 1030-1037), without which uniform flow would not stay
/// uniform on a mesh that turns or is stretched.
class HexMotion {
public:
    void prepare(const HexMesh& mesh, std::vector<Vec3> next);
    /// The same where it is known what the faces will sweep.
    void prepare(std::vector<Vec3> next, const AlignedDoubles& swept);
    bool prepared() const { return !next_.empty(); }
    const AlignedDoubles& swept() const { return swept_; }
    /// Puts the nodes there and measures the mesh anew. HexDefect where a cell has lost its volume.
    void move(HexMesh& mesh);

private:
    std::vector<Vec3> next_;
    AlignedDoubles swept_;
};

/// Volumes that the faces sweep, from below to above, until the nodes are at `next` [length^3]; with a batch
/// of entries beyond the last face.
void find_swept(const HexMesh& mesh, const std::vector<Vec3>& next, AlignedDoubles& swept);

/// Areas of the faces with the nodes at `position`; nothing else is measured.
void measure_faces(HexMesh& mesh, const std::vector<Vec3>& position);

/// Measures faces and cells of a mesh whose nodes have moved.
void remeasure(HexMesh& mesh);

} // namespace plash

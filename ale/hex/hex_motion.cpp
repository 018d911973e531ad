#include "ale/hex/hex_motion.h"

#include "ale/hex/hex_lanes.h"
#include "conditions/segment_forces.h"
#include "core/parallel.h"

#include <cmath>

namespace plash {

namespace {

Vec3 sum_of_areas(const std::array<Vec3, 4>& areas)
{
    return (areas[0] + areas[1]) + (areas[2] + areas[3]);
}

/// Areas of a face with its nodes at `position`, seen from the side from which the face sees its own.
std::array<Vec3, 4> areas_at(const HexFace& face, std::span<const Vec3> position)
{
    std::array<Vec3, 4> areas = unit_pressure_forces(face.nodes, position);
    if (dot(sum_of_areas(areas), sum_of_areas(face.area)) < 0)
        for (Vec3& area : areas) area = -1.0 * area;
    return areas;
}

} // namespace

void find_swept(const HexMesh& mesh, const std::vector<Vec3>& next, AlignedDoubles& swept)
{
    swept.assign(padded(mesh.faces.size()) + lane_count, 0.0);
    std::vector<Vec3> between(mesh.nodes());
    for (const double way : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
        for (std::size_t node = 0; node < mesh.nodes(); ++node)
            between[node] = mesh.position[node] + way * (next[node] - mesh.position[node]);
        for_chunks(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t number = begin; number < end; ++number) {
                const HexFace& face = mesh.faces[number];
                const std::array<Vec3, 4> areas = areas_at(face, between);
                for (int n = 0; n < 4; ++n)
                    swept[number] += 0.5 * dot(areas[n], next[face.nodes[n]] - mesh.position[face.nodes[n]]);
            }
        });
    }
}

void HexMotion::prepare(const HexMesh& mesh, std::vector<Vec3> next)
{
    next_ = std::move(next);
    find_swept(mesh, next_, swept_);
}

void HexMotion::prepare(std::vector<Vec3> next, const AlignedDoubles& swept)
{
    next_ = std::move(next);
    swept_ = swept;
}

void HexMotion::move(HexMesh& mesh)
{
    mesh.position = std::move(next_);
    next_.clear();
    remeasure(mesh);
}

void measure_faces(HexMesh& mesh, const std::vector<Vec3>& position)
{
    for_chunks(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t number = begin; number < end; ++number)
            mesh.faces[number].area = areas_at(mesh.faces[number], position);
    });
}

void remeasure(HexMesh& mesh)
{
    measure_faces(mesh, mesh.position);
    const std::size_t places = mesh.volume.size(); // more than cells: places beyond the mesh keep a volume
    measure(mesh);
    mesh.volume.resize(places, 1.0);
}

} // namespace plash

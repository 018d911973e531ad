#include "ale/hex/hex_weight.h"

#include "core/parallel.h"

namespace plash {

namespace {

bool is_parallelepiped(const HexMesh& mesh, std::size_t cell)
{
    const HexCorners& corners = mesh.corners[cell];
    const Vec3& first = mesh.position[corners[0]];
    std::array<Vec3, 3> edges;
    for (int axis = 0; axis < 3; ++axis) edges[axis] = mesh.position[corners[1 << axis]] - first;
    const double round_off = 1e-9 * (norm(edges[0]) + norm(edges[1]) + norm(edges[2]));
    for (int corner = 3; corner < 8; ++corner) {
        Vec3 expected = first;
        for (int axis = 0; axis < 3; ++axis)
            if (corner >> axis & 1) expected += edges[axis];
        if (norm(mesh.position[corners[corner]] - expected) > round_off) return false;
    }
    return true;
}

void set(std::array<AlignedDoubles, 3>& at, std::size_t place, const Vec3& value)
{
    at[0][place] = value.x;
    at[1][place] = value.y;
    at[2][place] = value.z;
}

} // namespace

HexWeight::HexWeight(const HexMesh& mesh)
{
    bool distorted = false;
    for (std::size_t cell = 0; cell < mesh.cells() && !distorted; ++cell)
        distorted = !is_parallelepiped(mesh, cell);
    if (!distorted) return;
    const std::size_t nodes = padded(mesh.nodes() + 1), cells = padded(mesh.cells() + 1);
    for (int axis = 0; axis < 3; ++axis) {
        node_position_[axis].resize(nodes, 0.0);
        node_force_[axis].resize(nodes, 0.0);
        middle_[axis].resize(cells, 0.0);
    }
    density_.resize(cells, 0.0);
    weight_.resize(cells, 0.0);
    const Vec3 origin = mesh.position.front();
    for (std::size_t node = 0; node < mesh.nodes(); ++node)
        set(node_position_, node, mesh.position[node] - origin);
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
        Vec3 sum{};
        for (const Index node : mesh.corners[cell]) sum += mesh.position[node] - origin;
        set(middle_, cell, 0.125 * sum);
    }
}

void HexWeight::prepare(const HexMesh& mesh, const double* mass, const std::array<double, 3>& gravity)
{
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; cell += lane_count) {
            const Lanes density = load<Lanes>(mass + cell) / load<Lanes>(&mesh.volume[cell]);
            Lanes along{};
            for (int axis = 0; axis < 3; ++axis) along += gravity[axis] * load<Lanes>(&middle_[axis][cell]);
            store(&density_[cell], density);
            store(&weight_[cell], density * along);
        }
    });
}

std::array<Lanes, 3> HexWeight::on_nodes(const HexLayout& layout, std::size_t node,
                                         const std::array<double, 3>& gravity) const
{
    std::array<Lanes, 3> force{};
    Lanes along{};
    for (int axis = 0; axis < 3; ++axis) along += gravity[axis] * load<Lanes>(&node_position_[axis][node]);
    for (const HexLayout::Corner& corner : layout.corners) {
        const Places cell = corner.cell.at(node);
        const Lanes pressure = gather(density_.data(), cell) * along - gather(weight_.data(), cell);
        for (int axis = 0; axis < 3; ++axis) force[axis] += pressure * load<Lanes>(&corner.area[axis][node]);
    }
    return force;
}

double HexWeight::work(std::size_t nodes, const std::array<AlignedDoubles, 3>& velocity, double step) const
{
    return step * sum_chunks(nodes, [&](std::size_t begin, std::size_t end) {
               Lanes sum{};
               for (std::size_t node = begin; node < end; node += lane_count)
                   for (int axis = 0; axis < 3; ++axis)
                       sum += load<Lanes>(&node_force_[axis][node]) * load<Lanes>(&velocity[axis][node]);
               return sum_of(sum);
           });
}

} // namespace plash

#include "ale/hex/hex_fluid.h"

#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace plash {

HexFluid::HexFluid(HexMesh all_cells, std::vector<FluidGroup> all_groups, LagrangeSettings settings)
    : Fluid(all_groups, settings,
            FluidFields(padded(all_cells.cells()), all_cells.nodes(), static_cast<int>(all_groups.size()),
                        settings.void_allowed || all_groups.size() > 1, settings.viscous)),
      mesh(std::move(all_cells)),
      mixed_(settings.void_allowed || groups.size() > 1),
      sweeps_(make_hex_sweeps(mesh)),
      locator_(mesh),
      corner_area_(mesh.node_corner.size()),
      outer_area_(mesh.nodes()),
      contents_(mesh.cells(), mixed_ ? 0 : 1),
      face_rate_(padded(mesh.faces.size()) + lane_count),
      face_seen_(face_rate_.size()),
      volume_flux_(face_rate_.size()),
      mass_flux_(face_rate_.size()),
      scratch_(groups.size())
{
    std::size_t members = 0, lines = 0, edges = 0;
    for (const HexSweep& sweep : sweeps_) {
        members = std::max(members, sweep.members.size());
        lines = std::max(lines, padded(sweep.lines.size));
        edges = std::max(edges, padded(sweep.edges.size));
    }
    for (GroupScratch& group : scratch_) {
        group.density.resize(mesh.cells());
        group.energy.resize(mesh.cells());
        for (AlignedDoubles* flux : {&group.volume_flux, &group.mass_flux, &group.energy_flux})
            flux->resize(lines);
    }
    member_flux_.resize(members);
    edge_flux_.resize(edges);
    for (AlignedDoubles& component : edge_velocity_) component.resize(edges);
    lay_out_lanes();

    for (std::size_t entry = 0; entry < corner_area_.size(); ++entry) {
        const Index cell = mesh.node_corner[entry] / 8, corner = mesh.node_corner[entry] % 8;
        const Index node = mesh.corners[cell][corner];
        for (int axis = 0; axis < 3; ++axis) {
            const int side = corner >> axis & 1;
            const HexFace& face = mesh.faces[mesh.cell_faces[cell][2 * axis + side]];
            const auto own = std::find(face.nodes.begin(), face.nodes.end(), node) - face.nodes.begin();
            corner_area_[entry] += (side == 1 ? 1.0 : -1.0) * face.area[own];
        }
    }
    for (const HexFace& face : mesh.faces) {
        if (face.below != none && face.above != none) continue;
        for (int n = 0; n < 4; ++n)
            outer_area_[face.nodes[n]] += (face.above == none ? 1.0 : -1.0) * face.area[n];
    }
    std::vector<double> sizes;
    for (const auto& width : mesh.width) sizes.push_back(std::min({width[0], width[1], width[2]}));
    std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
    common_size_ = sizes[sizes.size() / 2];
}

void HexFluid::lay_out_lanes()
{
    const std::size_t faces = padded(mesh.faces.size()), cells = padded(mesh.cells());
    for (int n = 0; n < 4; ++n) {
        face_nodes_[n].resize(faces, 0);
        for (AlignedDoubles& component : face_area_[n]) component.resize(faces, 0.0);
    }
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        for (int n = 0; n < 4; ++n) {
            const Vec3& area = mesh.faces[i].area[n];
            face_nodes_[n][i] = mesh.faces[i].nodes[n];
            face_area_[n][0][i] = area.x;
            face_area_[n][1][i] = area.y;
            face_area_[n][2][i] = area.z;
        }
    }
    for (auto& of_side : cell_faces_) of_side.resize(cells, 0);
    for (AlignedDoubles& width : width_) width.resize(cells, 1.0);
    for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
        for (int side = 0; side < 6; ++side) cell_faces_[side][cell] = mesh.cell_faces[cell][side];
        for (int axis = 0; axis < 3; ++axis) width_[axis][cell] = mesh.width[cell][axis];
    }
    mesh.volume.resize(cells, 1.0);
}

double HexFluid::total_mass(int group) const
{
    double sum = 0;
    for (double mass : fields.groups[group].mass) sum += mass;
    return sum;
}

std::array<double, 3> HexFluid::momentum() const
{
    std::array<double, 3> sum{};
    for (std::size_t node = 0; node < mesh.nodes(); ++node)
        for (int axis = 0; axis < 3; ++axis)
            sum[axis] += fields.node_mass[node] * fields.velocity[axis][node];
    return sum;
}

FluidCell HexFluid::cell(std::size_t number) const
{
    FluidCell cell;
    cell.place = number;
    cell.volume = mesh.volume[number];
    for (int corner = 0; corner < 8; ++corner) {
        cell.corners[corner] = mesh.corners[number][corner];
        cell.points[corner] = mesh.position[mesh.corners[number][corner]] + offset_;
    }
    return cell;
}

std::vector<OuterNode> HexFluid::outer_nodes() const
{
    std::vector<OuterNode> nodes;
    for (const HexFace& face : mesh.faces) {
        if (face.below != none && face.above != none) continue;
        const Vec3 area = (face.area[0] + face.area[1]) + (face.area[2] + face.area[3]);
        const double parts[3] = {area.x, area.y, area.z};
        int along = -1;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(parts[axis]) > (1 - 1e-9) * norm(area)) along = axis;
        for (const Index node : face.nodes) nodes.push_back({static_cast<std::size_t>(node), along});
    }
    return nodes;
}

void HexFluid::shift(const std::array<double, 3>& distance)
{
    offset_ += Vec3{distance[0], distance[1], distance[2]};
}

void HexFluid::update_contents()
{
    if (!mixed_) return;
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell) {
            Mask mask = 0;
            double fullest = 0;
            for (std::size_t group = 0; group < groups.size(); ++group) {
                const double fraction = fields.groups[group].fraction[cell];
                if (fraction > 0) mask |= Mask(1u << group);
                fullest = std::max(fullest, fraction);
            }
            if (fullest < 1) mask |= BoxContents::empty_space;
            contents_[cell] = mask;
        }
    });
}

double HexFluid::kinetic_energy() const
{
    return sum_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t node = begin; node < end; ++node) {
            const double x = fields.velocity[0][node], y = fields.velocity[1][node],
                         z = fields.velocity[2][node];
            sum += fields.node_mass[node] * (x * x + y * y + z * z);
        }
        return 0.5 * sum;
    });
}

double HexFluid::internal_energy(int group) const
{
    const double* energy = fields.groups[group].energy.data();
    return sum_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t cell = begin; cell < end; ++cell) sum += energy[cell];
        return sum;
    });
}

void HexFluid::find_node_masses()
{
    const AlignedDoubles& mass = fields.total_mass();
    for_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t node = begin; node < end; ++node) {
            double sum = 0;
            for (std::size_t i = mesh.first_corner[node]; i < mesh.first_corner[node + 1]; ++i)
                sum += mass[mesh.node_corner[i] / 8];
            fields.node_mass[node] = 0.125 * sum;
        }
    });
}

MeshPoint HexFluid::locate(const Vec3& point, const std::array<int, 3>& guess) const
{
    const HexLocator::Found found = locator_(mesh, point - offset_, guess[0]);
    if (found.cell == none) return {guess, {}, false};
    return {{found.cell, 0, 0}, found.part, true};
}

std::ptrdiff_t HexFluid::cell_beyond(const MeshPoint& point, int axis, int side) const
{
    const HexFace& face = mesh.faces[mesh.cell_faces[point.cell[0]][2 * axis + side]];
    const Index next = side == 0 ? face.below : face.above;
    return next == none ? -1 : next;
}

PlaceWeights HexFluid::node_weights(const MeshPoint& point) const
{
    PlaceWeights result;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis)
            weight *= corner >> axis & 1 ? point.part[axis] : 1 - point.part[axis];
        result.place[corner] = mesh.corners[point.cell[0]][corner];
        result.weight[corner] = weight;
    }
    return result;
}

PlaceWeights HexFluid::cell_weights(const MeshPoint& point) const
{
    const Index own = point.cell[0];
    /// The neighbour of a cell along a direction of the point's own cell; itself where there is none.
    const auto step = [&](Index cell, int axis) {
        const auto& direction = mesh.direction[cell];
        const auto same = std::find(direction.begin(), direction.end(), mesh.direction[own][axis]);
        if (same == direction.end()) return cell;
        const int side = point.part[axis] < 0.5 ? 0 : 1;
        const HexFace& face = mesh.faces[mesh.cell_faces[cell][2 * (same - direction.begin()) + side]];
        const Index next = side == 0 ? face.below : face.above;
        return next == none ? cell : next;
    };
    double reach[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Index next = step(own, axis);
        const double width = norm(mesh.edge[own][axis]);
        const auto& direction = mesh.direction[next];
        const auto same = std::find(direction.begin(), direction.end(), mesh.direction[own][axis]);
        const double beyond =
            same == direction.end() ? width : norm(mesh.edge[next][same - direction.begin()]);
        reach[axis] = std::abs(point.part[axis] - 0.5) * width / (0.5 * (width + beyond));
    }
    PlaceWeights result;
    for (int corner = 0; corner < 8; ++corner) {
        Index cell = own;
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const bool beyond = corner >> axis & 1;
            if (beyond) cell = step(cell, axis);
            weight *= beyond ? reach[axis] : 1 - reach[axis];
        }
        result.place[corner] = cell;
        result.weight[corner] = weight;
    }
    return result;
}

double HexFluid::point_spacing(const Vec3& a, const Vec3& b) const
{
    const HexLocator::Found found = locator_(mesh, 0.5 * (a + b) - offset_, none);
    const double length = norm(b - a);
    if (found.cell == none || !(length > 0)) return 0.5 * common_size_;
    // How far one can go along the segment within a cell.
    double crossings = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3& edge = mesh.edge[found.cell][axis];
        crossings = std::max(crossings, std::abs(dot(b - a, edge)) / (length * dot(edge, edge)));
    }
    return 0.5 / crossings;
}

void HexFluid::serialise(Archive& archive)
{
    Fluid::serialise(archive);
    archive(contents_, offset_);
}

} // namespace plash

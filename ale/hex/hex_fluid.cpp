#include "ale/hex/hex_fluid.h"

#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace plash {

HexFluid::HexFluid(HexMesh all_cells, std::vector<FluidGroup> all_groups, LagrangeSettings settings)
    : Fluid(all_groups, settings,
            FluidFields(padded(all_cells.cells() + 1), padded(all_cells.nodes() + 1),
                        static_cast<int>(all_groups.size()), settings.void_allowed || all_groups.size() > 1,
                        settings.viscous)),
      mesh(std::move(all_cells)),
      mixed_(settings.void_allowed || groups.size() > 1),
      sweeps_(make_hex_sweeps(mesh)),
      layout_(mesh),
      activity_(mesh, sweeps_, mixed_),
      locator_(mesh),
      weight_(mesh),
      mid_pressure_(fields.pressure.size()),
      face_rate_(padded(mesh.faces.size()) + lane_count),
      volume_flux_(face_rate_.size()),
      mass_flux_(face_rate_.size()),
      scratch_(groups.size()),
      of_sweep_(sweeps_.size()),
      still_nodes_(fields.node_mass.size() / lane_count),
      still_cells_(fields.pressure.size() / lane_count)
{
    std::size_t members = 0, edges = 0, nodes = 0;
    for (std::size_t direction = 0; direction < sweeps_.size(); ++direction) {
        const HexSweep& sweep = sweeps_[direction];
        members = std::max(members, padded(sweep.members.size()));
        edges = std::max(edges, padded(sweep.edges.size));
        nodes = std::max(nodes, sweep.nodes.place.size());
        of_sweep_[direction].edge_flux.resize(padded(sweep.edges.size));
        of_sweep_[direction].still_edges.resize(padded(sweep.edges.size) / lane_count);
        of_sweep_[direction].still_faces.resize(padded(sweep.lines.size) / lane_count);
    }
    for (GroupScratch& group : scratch_) {
        group.density.resize(fields.volume.size());
        group.energy.resize(fields.volume.size());
        for (AlignedDoubles* flux : {&group.volume_flux, &group.mass_flux, &group.energy_flux})
            flux->resize(face_rate_.size());
        if (mixed_) group.node_fraction.resize(fields.node_mass.size());
    }
    member_flux_.resize(members);
    for (AlignedDoubles& component : edge_velocity_) component.resize(edges);
    end_change_.resize(nodes);
    end_inflow_.resize(nodes);
    mesh.volume.resize(fields.volume.size(), 1.0);

    std::vector<double> sizes;
    for (const auto& width : mesh.width) sizes.push_back(std::min({width[0], width[1], width[2]}));
    std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
    common_size_ = sizes[sizes.size() / 2];
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
        const double outward = face.above == none ? 1 : -1;
        const double parts[3] = {area.x, area.y, area.z};
        int along = -1;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(parts[axis]) > (1 - 1e-9) * norm(area)) along = axis;
        for (int n = 0; n < 4; ++n)
            nodes.push_back({static_cast<std::size_t>(face.nodes[n]), along, outward * face.area[n]});
    }
    return nodes;
}

/// The velocity of a node on a curved wall is tangential to the wall there, not to each of its faces: what
/// passed one of them outward would come back through the next. Without their areas neither passes, and
/// pressure does the same work on the motion as on the cells. Viscous stress still sees the whole cell.
void HexFluid::close_curved_walls()
{
    std::vector<const SlipNode*> slip_of(mesh.nodes());
    for (const SlipNode& node : slipping) slip_of[node.place] = &node;
    for (std::size_t number = 0; number < mesh.faces.size(); ++number) {
        const HexFace& face = mesh.faces[number];
        if (face.below != none && face.above != none) continue;
        bool wall = true, curved = false;
        for (int n = 0; n < 4; ++n) {
            const SlipNode* node = slip_of[face.nodes[n]];
            wall = wall && node;
            if (!node) break;
            Vec3 along = face.area[n];
            for (int i = 0; i < node->count; ++i)
                along -= dot(along, node->directions[i]) * node->directions[i];
            curved = curved || norm(along) > 1e-9 * norm(face.area[n]);
        }
        if (wall && curved) layout_.close(mesh, number);
    }
}

void HexFluid::shift(const std::array<double, 3>& distance)
{
    offset_ += Vec3{distance[0], distance[1], distance[2]};
}

void HexFluid::move_nodes(std::vector<Vec3> next, double step)
{
    motion_.prepare(mesh, std::move(next));
    take_wind(step);
}

void HexFluid::take_wind(double step)
{
    wind_.resize(motion_.swept().size());
    for (std::size_t face = 0; face < wind_.size(); ++face) wind_[face] = motion_.swept()[face] / step;
}

void HexFluid::follow_material(const NodeSmoothing& smoothing)
{
    follows_ = smoothing;
}

/// Forces and their work are to see the mesh of mid-step, as far as velocities tell at t_n: with the areas of
/// t_n a body that turns would change its volume by the square of the angle of a step.
void HexFluid::stand_midway(double step)
{
    std::vector<Vec3> middle = mesh.position;
    for (std::size_t node = 0; node < mesh.nodes(); ++node)
        for (int axis = 0; axis < 3; ++axis)
            middle[node].*vector_component[axis] += 0.5 * step * fields.velocity[axis][node];
    measure_faces(mesh, middle);
    layout_.measure(mesh);
}

/// Once mean velocities are known.
void HexFluid::go_with_material(double step)
{
    std::vector<Vec3> next = mesh.position;
    for (std::size_t node = 0; node < mesh.nodes(); ++node)
        for (int axis = 0; axis < 3; ++axis)
            next[node].*vector_component[axis] += step * fields.mean_velocity[axis][node];
    find_swept(mesh, next, material_swept_);
    if (follows_->sum() > 0) {
        (*smoothing_)(mesh, *follows_, next);
        move_nodes(std::move(next), step);
        return;
    }
    motion_.prepare(std::move(next), material_swept_);
    take_wind(step);
}

/// After the nodes have moved. Weights of slopes stay those of the start: they are ratios of lengths along
/// chords.
void HexFluid::take_new_measures()
{
    layout_.measure(mesh);
    locator_ = HexLocator(mesh);
    if (weight_.needed()) weight_ = HexWeight(mesh);
}

void HexFluid::update_contents()
{
    activity_.look(fields, true);
}

double HexFluid::kinetic_energy() const
{
    return sum_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        Lanes sum{};
        for (std::size_t node = begin; node < end; node += lane_count) {
            if (!activity_.reaches_nodes(node)) continue;
            const Lanes x = load<Lanes>(&fields.velocity[0][node]),
                        y = load<Lanes>(&fields.velocity[1][node]),
                        z = load<Lanes>(&fields.velocity[2][node]);
            sum += load<Lanes>(&fields.node_mass[node]) * (x * x + y * y + z * z);
        }
        return 0.5 * sum_of(sum);
    });
}

double HexFluid::internal_energy(int group) const
{
    const double* energy = fields.groups[group].energy.data();
    return sum_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        Lanes sum{};
        for (std::size_t cell = begin; cell < end; cell += lane_count)
            if (!BoxContents::nothing(activity_.of_cells(cell))) sum += load<Lanes>(energy + cell);
        return sum_of(sum);
    });
}

void HexFluid::find_node_masses()
{
    const double* mass = fields.total_mass().data();
    for_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t node = begin; node < end; node += lane_count) {
            Lanes sum{};
            if (!BoxContents::nothing(activity_.of_nodes(node)))
                for (const HexLayout::Corner& corner : layout_.corners)
                    sum += gather(mass, corner.cell.at(node));
            store(&fields.node_mass[node], 0.125 * sum);
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
    archive(activity_, offset_, wind_);
    if (wind_.empty()) return;
    archive(mesh.position);
    if (!archive.loading()) return;
    remeasure(mesh);
    take_new_measures();
}

} // namespace plash

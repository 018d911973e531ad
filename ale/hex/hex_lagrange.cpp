#include "ale/hex/hex_fluid.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace plash {

double HexFluid::accelerate(double step)
{
    const AlignedDoubles& mass = fields.total_mass();
    const bool viscous = !fields.viscous[0].empty();
    return sum_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        double work = 0;
        for (std::size_t node = begin; node < end; ++node) {
            double own_mass = 0;
            Vec3 force = -outside_pressure * outer_area_[node];
            for (std::size_t i = mesh.first_corner[node]; i < mesh.first_corner[node + 1]; ++i) {
                const Index cell = mesh.node_corner[i] / 8;
                const Vec3& area = corner_area_[i];
                own_mass += mass[cell];
                force += (fields.pressure[cell] + 0.5 * step * fields.pressure_rate[cell]) * area;
                if (!viscous) continue;
                const double xx = fields.viscous[0][cell], yy = fields.viscous[1][cell],
                             zz = fields.viscous[2][cell], xy = fields.viscous[3][cell],
                             yz = fields.viscous[4][cell], zx = fields.viscous[5][cell];
                force.x -= xx * area.x + xy * area.y + zx * area.z;
                force.y -= xy * area.x + yy * area.y + yz * area.z;
                force.z -= zx * area.x + yz * area.y + zz * area.z;
            }
            own_mass *= 0.125;
            fields.node_mass[node] = own_mass;
            const double forces[3] = {force.x, force.y, force.z};
            for (int axis = 0; axis < 3; ++axis) {
                double &velocity = fields.velocity[axis][node], &mean = fields.mean_velocity[axis][node];
                if (!(own_mass > 0)) {
                    velocity = mean = 0;
                    continue;
                }
                const double fall = step * gravity[axis];
                const double gain = step / own_mass * forces[axis] + fall;
                mean = velocity + 0.5 * gain;
                velocity += gain;
                work += own_mass * fall * mean;
            }
        }
        return work;
    });
}

/// Entry a holds the gradient of component a [1/time].
std::array<Vec3, 3> HexFluid::velocity_gradient(std::size_t cell,
                                                const std::array<AlignedDoubles, 3>& of) const
{
    std::array<Vec3, 3> sum{};
    for (int side = 0; side < 6; ++side) {
        const HexFace& face = mesh.faces[mesh.cell_faces[cell][side]];
        const double per_volume = (side % 2 == 1 ? 1 : -1) / mesh.volume[cell];
        for (int n = 0; n < 4; ++n) {
            const Vec3 area = per_volume * face.area[n];
            for (int axis = 0; axis < 3; ++axis) sum[axis] += of[axis][face.nodes[n]] * area;
        }
    }
    return sum;
}

void HexFluid::deform(double step)
{
    const auto& u = fields.mean_velocity;
    find_face_rates(u);
    for_chunks(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) volume_flux_[i] = step * face_seen_[i];
    });
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell) {
            const auto& faces = mesh.cell_faces[cell];
            const double growth = step * ((face_rate_[faces[1]] - face_rate_[faces[0]]) +
                                          (face_rate_[faces[3]] - face_rate_[faces[2]]) +
                                          (face_rate_[faces[5]] - face_rate_[faces[4]]));
            fields.volume[cell] = mesh.volume[cell] + growth;
            const Mask mask = contents_[cell];
            if (BoxContents::nothing(mask)) continue;
            double work = (fields.pressure[cell] + 0.5 * step * fields.pressure_rate[cell]) * growth;
            if (!fields.viscous[0].empty()) {
                const std::array<Vec3, 3> slope = velocity_gradient(cell, u);
                const auto stress = [&](int component) { return fields.viscous[component][cell]; };
                const double power = stress(0) * slope[0].x + stress(1) * slope[1].y +
                                     stress(2) * slope[2].z + stress(3) * (slope[0].y + slope[1].x) +
                                     stress(4) * (slope[1].z + slope[2].y) +
                                     stress(5) * (slope[2].x + slope[0].z);
                work -= power * mesh.volume[cell] * step;
            }
            const int only = BoxContents::pure(mask) ? BoxContents::only_group(mask) : -1;
            deform_cells<double>(fields, cell, only, mesh.volume[cell], growth, work);
        }
    });
}

double HexFluid::work_on_sides() const
{
    double inward = 0;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const HexFace& face = mesh.faces[i];
        if (face.below == none)
            inward += volume_flux_[i];
        else if (face.above == none)
            inward -= volume_flux_[i];
    }
    return outside_pressure * inward;
}

/// Growth of cells comes from face_rate_; what passes a face is seen from the moving mesh.
void HexFluid::find_face_rates(const std::array<AlignedDoubles, 3>& velocity)
{
    const auto& mesh_velocity = lagrange.mesh_velocity;
    const bool moves = mesh_velocity[0] != 0 || mesh_velocity[1] != 0 || mesh_velocity[2] != 0;
    for_chunks(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; i += lane_count) {
            Lanes rate{}, wind{};
            for (int n = 0; n < 4; ++n) {
                const LaneMask nodes = places(&face_nodes_[n][i]);
                for (int axis = 0; axis < 3; ++axis) {
                    const Lanes area = load<Lanes>(&face_area_[n][axis][i]);
                    rate += area * gather(velocity[axis].data(), nodes);
                    if (moves) wind += area * mesh_velocity[axis];
                }
            }
            store(&face_rate_[i], rate);
            store(&face_seen_[i], rate - wind);
        }
    });
}

double HexFluid::filled(std::size_t cell) const
{
    double sum = 0;
    for (const GroupFields& group : fields.groups) sum += group.fraction[cell];
    return sum;
}

/// Leaves openness in the place of group 0's share for evaluate_cell, which changes fractions.
void HexFluid::find_openness()
{
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell) {
            const Mask mask = contents_[cell];
            if (BoxContents::nothing(mask)) continue;
            double below[3], above[3];
            for (int axis = 0; axis < 3; ++axis) {
                const HexFace &low = mesh.faces[mesh.cell_faces[cell][2 * axis]],
                              &high = mesh.faces[mesh.cell_faces[cell][2 * axis + 1]];
                below[axis] = filled(low.below == none ? cell : low.below);
                above[axis] = filled(high.above == none ? cell : high.above);
            }
            fields.groups[0].share[cell] = openness(filled(cell), below, above);
        }
    });
}

/// Strain of a batch of cells, or of one, and the rate at which the flow crosses it.
template <class Lane, class FaceValue, class SeenValue>
CellStrain<Lane> strain_of(const FaceValue& rate, const SeenValue& seen, const Lane (&width)[3], Lane volume,
                           Lane& crossing)
{
    CellStrain<Lane> strain;
    strain.divergence = crossing = Lane{};
    for (int axis = 0; axis < 3; ++axis) {
        strain.rate[axis] = (rate(2 * axis + 1) - rate(2 * axis)) / volume;
        strain.width[axis] = width[axis];
        strain.divergence += strain.rate[axis];
        crossing = max(crossing, max(abs(seen(2 * axis)), abs(seen(2 * axis + 1))) / volume);
    }
    return strain;
}

/// Stores the pressure of a batch of cells, or of one; returns the rate at which signals and the flow cross
/// it.
template <class Lane>
Lane HexFluid::respond(std::size_t cell, const CellState<Lane>& state, const CellStrain<Lane>& strain,
                       Lane crossing)
{
    const CellPressure<Lane> pressure = cell_pressure(state, strain, lagrange);
    store(&fields.pressure[cell], pressure.pressure);
    store(&fields.pressure_rate[cell], pressure.rate);
    const Lane shortest = min(min(strain.width[0], strain.width[1]), strain.width[2]);
    return state.density > 0.0 ? pressure.signal / shortest + crossing : Lane{};
}

/// A batch of cells that are full of one group; false when it is none, or when some liquid is torn.
bool HexFluid::evaluate_full(std::size_t cell, CrossingRate& limit)
{
    const Mask mask = contents_[cell];
    if (!BoxContents::pure(mask) || !fields.viscous[0].empty()) return false;
    for (std::size_t other = cell + 1; other < cell + lane_count; ++other)
        if (contents_[other] != mask) return false;
    const Lanes volume = load<Lanes>(&mesh.volume[cell]);
    const auto rate = [&](int side) { return gather(face_rate_.data(), places(&cell_faces_[side][cell])); };
    const auto seen = [&](int side) { return gather(face_seen_.data(), places(&cell_faces_[side][cell])); };
    const Lanes width[3] = {load<Lanes>(&width_[0][cell]), load<Lanes>(&width_[1][cell]),
                            load<Lanes>(&width_[2][cell])};
    Lanes crossing;
    const CellStrain<Lanes> strain = strain_of<Lanes>(rate, seen, width, volume, crossing);
    const int group = BoxContents::only_group(mask);
    const CellState<Lanes> state = pure_state<Lanes>(fields, groups, cell, group, volume);
    if (lagrange.void_allowed && any((state.density > 0.0) & (state.pressure < groups[group].tension_limit)))
        return false;
    const Lanes rates = respond(cell, state, strain, crossing);
    for (int lane = 0; lane < lane_count; ++lane)
        if (rates[lane] > limit.rate) limit = {rates[lane], static_cast<std::ptrdiff_t>(cell + lane)};
    return true;
}

CrossingRate HexFluid::evaluate_cell(std::size_t cell, double last_step, bool& torn)
{
    const Mask mask = contents_[cell];
    const double volume = mesh.volume[cell];
    if (BoxContents::nothing(mask)) {
        fields.pressure[cell] = fields.pressure_rate[cell] = 0;
        if (!fields.viscous[0].empty())
            for (auto& component : fields.viscous) component[cell] = 0;
        return {};
    }
    const auto& faces = mesh.cell_faces[cell];
    const auto of_rate = [&](int side) { return face_rate_[faces[side]]; };
    const auto of_seen = [&](int side) { return face_seen_[faces[side]]; };
    const double width[3] = {width_[0][cell], width_[1][cell], width_[2][cell]};
    double crossing;
    const CellStrain<double> strain = strain_of<double>(of_rate, of_seen, width, volume, crossing);
    const double closing = std::max(-strain.divergence, 0.0) * last_step;
    CellState<double> state;
    if (BoxContents::pure(mask)) {
        const int group = BoxContents::only_group(mask);
        state = pure_state<double>(fields, groups, cell, group, volume);
        if (lagrange.void_allowed && state.density > 0 && state.pressure < groups[group].tension_limit) {
            // Void opens inside the liquid.
            state = mixed_state<double>(fields, groups, true, cell, volume, fields.groups[0].share[cell],
                                        closing);
            torn = true;
        }
    } else {
        state = mixed_state<double>(fields, groups, lagrange.void_allowed, cell, volume,
                                    fields.groups[0].share[cell], closing);
    }
    double rate = respond(cell, state, strain, crossing);
    if (!fields.viscous[0].empty()) {
        double diffusion = 0;
        for (const double across : width) diffusion += 1 / (across * across);
        if (rate > 0) rate += 2 * largest_kinematic_viscosity(groups) * diffusion;
        const std::array<Vec3, 3> slope = velocity_gradient(cell, fields.velocity);
        const double gradient[3][3] = {{slope[0].x, slope[0].y, slope[0].z},
                                       {slope[1].x, slope[1].y, slope[1].z},
                                       {slope[2].x, slope[2].y, slope[2].z}};
        store_viscous_stress<double>(fields, groups, cell, gradient);
    }
    return {rate, static_cast<std::ptrdiff_t>(cell)};
}

CrossingRate HexFluid::evaluate(double last_step)
{
    find_face_rates(fields.velocity);
    if (lagrange.void_allowed) find_openness();
    struct Result {
        CrossingRate limit;
        bool torn = false;
    };
    std::vector<Result> results((mesh.cells() + chunk_length - 1) / chunk_length);
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        Result& result = results[begin / chunk_length];
        for (std::size_t first = begin; first < end; first += lane_count) {
            const std::size_t last = std::min<std::size_t>(first + lane_count, end);
            if (last - first == lane_count && evaluate_full(first, result.limit)) continue;
            for (std::size_t cell = first; cell < last; ++cell) {
                const CrossingRate own = evaluate_cell(cell, last_step, result.torn);
                if (own.rate > result.limit.rate) result.limit = own;
            }
        }
    });
    CrossingRate limit;
    bool torn = false;
    for (const Result& result : results) {
        if (result.limit.rate > limit.rate) limit = result.limit;
        torn = torn || result.torn;
    }
    if (torn) update_contents();
    return limit;
}

} // namespace plash

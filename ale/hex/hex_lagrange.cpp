#include "ale/hex/hex_fluid.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace plash {

double HexFluid::accelerate(double step)
{
    if (follows_) stand_midway(step);
    const double* mass = fields.total_mass().data();
    const bool viscous = !fields.viscous[0].empty();
    const bool weigh = weighs();
    if (weigh) weight_.prepare(mesh, mass, gravity);
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; cell += lane_count)
            store(&mid_pressure_[cell], load<Lanes>(&fields.pressure[cell]) +
                                            0.5 * step * load<Lanes>(&fields.pressure_rate[cell]));
    });
    return sum_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        Lanes work{};
        for (std::size_t node = begin; node < end; node += lane_count) {
            std::uint8_t& still = still_nodes_[node / lane_count];
            if (BoxContents::nothing(activity_.of_nodes(node))) {
                if (still && !activity_.reaches_nodes(node)) continue;
                store(&fields.node_mass[node], Lanes{});
                for (int axis = 0; axis < 3; ++axis) {
                    store(&fields.velocity[axis][node], Lanes{});
                    store(&fields.mean_velocity[axis][node], Lanes{});
                }
                if (weigh) weight_.keep(node, {});
                still = 1;
                continue;
            }
            still = 0;
            Lanes own_mass{}, force[3];
            for (int axis = 0; axis < 3; ++axis)
                force[axis] = -outside_pressure * load<Lanes>(&layout_.outer_area[axis][node]);
            for (const HexLayout::Corner& corner : layout_.corners) {
                const Places cell = corner.cell.at(node);
                const Lanes area[3] = {load<Lanes>(&corner.area[0][node]), load<Lanes>(&corner.area[1][node]),
                                       load<Lanes>(&corner.area[2][node])};
                own_mass += gather(mass, cell);
                const Lanes pressure = gather(mid_pressure_.data(), cell);
                for (int axis = 0; axis < 3; ++axis) force[axis] += pressure * area[axis];
                if (!viscous) continue;
                Lanes stress[6];
                for (int component = 0; component < 6; ++component)
                    stress[component] = gather(fields.viscous[component].data(), cell);
                force[0] -= stress[0] * area[0] + stress[3] * area[1] + stress[5] * area[2];
                force[1] -= stress[3] * area[0] + stress[1] * area[1] + stress[4] * area[2];
                force[2] -= stress[5] * area[0] + stress[4] * area[1] + stress[2] * area[2];
            }
            own_mass *= 0.125;
            if (weigh) {
                std::array<Lanes, 3> difference = weight_.on_nodes(layout_, node, gravity);
                for (int axis = 0; axis < 3; ++axis) {
                    difference[axis] -= own_mass * gravity[axis];
                    force[axis] += difference[axis];
                }
                weight_.keep(node, difference);
            }
            const auto has = own_mass > 0.0;
            const Lanes per_mass = has ? step / own_mass : Lanes{};
            store(&fields.node_mass[node], own_mass);
            for (int axis = 0; axis < 3; ++axis) {
                const double fall = step * gravity[axis];
                const Lanes before = load<Lanes>(&fields.velocity[axis][node]);
                const Lanes gain = per_mass * force[axis] + fall;
                const Lanes mean = before + 0.5 * gain;
                store(&fields.velocity[axis][node], has ? before + gain : Lanes{});
                store(&fields.mean_velocity[axis][node], has ? mean : Lanes{});
                work += has ? own_mass * fall * mean : Lanes{};
            }
        }
        return sum_of(work);
    });
}

bool HexFluid::weighs() const
{
    return weight_.needed() && (gravity[0] != 0 || gravity[1] != 0 || gravity[2] != 0);
}

double HexFluid::further_gravity_work(double step) const
{
    return weighs() ? weight_.work(mesh.nodes(), fields.mean_velocity, step) : 0;
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

/// Work that the viscous stress of a batch of cells takes from the motion, less the sign [energy].
Lanes HexFluid::viscous_work(std::size_t first, double step) const
{
    Lanes work{};
    for (std::size_t cell = first; cell < std::min(first + lane_count, mesh.cells()); ++cell) {
        const std::array<Vec3, 3> slope = velocity_gradient(cell, fields.mean_velocity);
        const auto stress = [&](int component) { return fields.viscous[component][cell]; };
        const double power = stress(0) * slope[0].x + stress(1) * slope[1].y + stress(2) * slope[2].z +
                             stress(3) * (slope[0].y + slope[1].x) + stress(4) * (slope[1].z + slope[2].y) +
                             stress(5) * (slope[2].x + slope[0].z);
        work[cell - first] = power * mesh.volume[cell] * step;
    }
    return work;
}

void HexFluid::deform(double step)
{
    if (follows_) go_with_material(step);
    find_face_rates(fields.mean_velocity, step);
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; cell += lane_count) {
            if (!activity_.reaches_cells(cell)) continue;
            const auto rate = [&](int side) {
                return gather(face_rate_.data(), layout_.cell_faces[side].at(cell));
            };
            const Lanes worked = step * ((rate(1) - rate(0)) + (rate(3) - rate(2)) + (rate(5) - rate(4)));
            Lanes growth = worked;
            if (follows_) {
                growth = Lanes{};
                for (int side = 0; side < 6; ++side) {
                    const Lanes swept = gather(material_swept_.data(), layout_.cell_faces[side].at(cell));
                    growth += side % 2 == 0 ? -swept : swept;
                }
            }
            const Lanes volume = load<Lanes>(&mesh.volume[cell]);
            store(&fields.volume[cell], volume + growth);
            const Mask mask = activity_.of_cells(cell);
            if (BoxContents::nothing(mask)) continue;
            Lanes work = load<Lanes>(&mid_pressure_[cell]) * worked;
            if (!fields.viscous[0].empty()) work -= viscous_work(cell, step);
            const int only = BoxContents::pure(mask) ? BoxContents::only_group(mask) : -1;
            deform_cells<Lanes>(fields, cell, only, volume, growth, work);
        }
    });
}

double HexFluid::work_on_sides(double step) const
{
    double inward = 0;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const HexFace& face = mesh.faces[i];
        if ((face.below != none && face.above != none) || !activity_.reaches_cells(mesh.cell_of_face(i)))
            continue;
        if (face.below == none)
            inward += step * face_rate_[i];
        else
            inward -= step * face_rate_[i];
    }
    return outside_pressure * inward;
}

bool HexFluid::mesh_moves() const
{
    const auto& velocity = lagrange.mesh_velocity;
    return !wind_.empty() || velocity[0] != 0 || velocity[1] != 0 || velocity[2] != 0;
}

/// Growth of cells comes from face_rate_; what passes a face is seen from the moving mesh, whose wind is that
/// of this step, or the last one once it is over.
/// step  over which volumes pass; zero: only the rates are wanted, of faces of cells that hold fluid
void HexFluid::find_face_rates(const std::array<AlignedDoubles, 3>& velocity, double step)
{
    const bool moves = mesh_moves(), deforms = !wind_.empty();
    if (moves) face_seen_.resize(face_rate_.size());
    for_chunks(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; i += lane_count) {
            if (step > 0 ? !activity_.reaches_faces(i) : BoxContents::nothing(activity_.of_faces(i)))
                continue;
            Lanes rate{}, wind{};
            for (int n = 0; n < 4; ++n) {
                const Places nodes = layout_.face_nodes[n].at(i);
                for (int axis = 0; axis < 3; ++axis) {
                    const Lanes area = load<Lanes>(&layout_.face_area[n][axis][i]);
                    rate += area * gather(velocity[axis].data(), nodes);
                    if (moves && !deforms) wind += area * lagrange.mesh_velocity[axis];
                }
            }
            if (deforms) wind = load<Lanes>(&wind_[i]);
            store(&face_rate_[i], rate);
            if (moves) store(&face_seen_[i], rate - wind);
            if (!(step > 0)) continue;
            // The same to the last bit where a face goes with the material.
            store(&volume_flux_[i], follows_
                                        ? load<Lanes>(&material_swept_[i]) - load<Lanes>(&motion_.swept()[i])
                                        : step * (rate - wind));
        }
    });
}

Lanes HexFluid::filled(Places cells) const
{
    Lanes sum{};
    for (const GroupFields& group : fields.groups) sum += gather(group.fraction.data(), cells);
    return sum;
}

/// Leaves openness in the place of group 0's share for evaluate_cells, which changes fractions.
void HexFluid::find_openness()
{
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; cell += lane_count) {
            if (BoxContents::nothing(activity_.of_cells(cell))) continue;
            Lanes open{};
            if (!BoxContents::pure(activity_.around_cells(cell))) {
                Lanes below[3], above[3], own{};
                for (const GroupFields& group : fields.groups) own += load<Lanes>(&group.fraction[cell]);
                for (int axis = 0; axis < 3; ++axis) {
                    below[axis] = filled(layout_.neighbours[2 * axis].at(cell));
                    above[axis] = filled(layout_.neighbours[2 * axis + 1].at(cell));
                }
                open = openness(own, below, above);
            }
            store(&fields.groups[0].share[cell], open);
        }
    });
}

void HexFluid::calm_cells(std::size_t first)
{
    std::uint8_t& still = still_cells_[first / lane_count];
    if (still) return;
    still = 1;
    store(&fields.pressure[first], Lanes{});
    store(&fields.pressure_rate[first], Lanes{});
    if (!fields.viscous[0].empty())
        for (AlignedDoubles& component : fields.viscous) store(&component[first], Lanes{});
}

/// Viscous stress of a batch of cells; returns the rate at which it diffuses through them.
Lanes HexFluid::stress_cells(std::size_t first)
{
    Lanes gradient[3][3] = {}, diffusion{};
    for (std::size_t cell = first; cell < std::min(first + lane_count, mesh.cells()); ++cell) {
        const std::array<Vec3, 3> slope = velocity_gradient(cell, fields.velocity);
        for (int axis = 0; axis < 3; ++axis) {
            gradient[axis][0][cell - first] = slope[axis].x;
            gradient[axis][1][cell - first] = slope[axis].y;
            gradient[axis][2][cell - first] = slope[axis].z;
        }
    }
    store_viscous_stress<Lanes>(fields, groups, first, gradient);
    for (const AlignedDoubles& width : layout_.width) {
        const Lanes across = load<Lanes>(&width[first]);
        diffusion += 1.0 / (across * across);
    }
    return 2 * largest_kinematic_viscosity(groups) * diffusion;
}

/// Pressure of a batch of cells; returns the rate at which signals and the flow cross them.
Lanes HexFluid::evaluate_cells(std::size_t first, double last_step, bool& torn)
{
    const Mask mask = activity_.of_cells(first);
    if (BoxContents::nothing(mask)) {
        calm_cells(first);
        return Lanes{};
    }
    still_cells_[first / lane_count] = 0;
    const Lanes volume = load<Lanes>(&mesh.volume[first]), per_volume = 1.0 / volume;
    const AlignedDoubles& passing = seen();
    CellStrain<Lanes> strain;
    Lanes crossing{};
    strain.divergence = Lanes{};
    for (int axis = 0; axis < 3; ++axis) {
        const Places low = layout_.cell_faces[2 * axis].at(first),
                     high = layout_.cell_faces[2 * axis + 1].at(first);
        strain.rate[axis] = (gather(face_rate_.data(), high) - gather(face_rate_.data(), low)) * per_volume;
        strain.width[axis] = load<Lanes>(&layout_.width[axis][first]);
        strain.divergence += strain.rate[axis];
        crossing = max(crossing, max(abs(gather(passing.data(), low)), abs(gather(passing.data(), high))));
    }
    const Lanes closing = max(-strain.divergence, Lanes{}) * last_step;
    const auto mixed = [&] {
        const Lanes open = lagrange.void_allowed ? load<Lanes>(&fields.groups[0].share[first]) : Lanes{};
        return mixed_state<Lanes>(fields, groups, lagrange.void_allowed, first, volume, open, closing);
    };
    CellState<Lanes> state;
    if (BoxContents::pure(mask)) {
        const int group = BoxContents::only_group(mask);
        state = pure_state<Lanes>(fields, groups, first, group, volume);
        if (lagrange.void_allowed &&
            any((state.density > 0.0) & (state.pressure < groups[group].tension_limit))) {
            state = mixed(); // void opens inside the liquid
            torn = true;
        }
    } else {
        state = mixed();
    }
    const CellPressure<Lanes> pressure = cell_pressure(state, strain, lagrange);
    store(&fields.pressure[first], pressure.pressure);
    store(&fields.pressure_rate[first], pressure.rate);
    const Lanes shortest = min(min(strain.width[0], strain.width[1]), strain.width[2]);
    Lanes rate = pressure.signal / shortest + crossing * per_volume;
    if (!fields.viscous[0].empty()) rate += stress_cells(first);
    return state.density > 0.0 ? rate : Lanes{};
}

CrossingRate HexFluid::evaluate(double last_step)
{
    activity_.spread();
    find_face_rates(fields.velocity, 0);
    if (lagrange.void_allowed) find_openness();
    struct Result {
        CrossingRate limit;
        bool torn = false;
    };
    std::vector<Result> results((mesh.cells() + chunk_length - 1) / chunk_length);
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        Result& result = results[begin / chunk_length];
        for (std::size_t first = begin; first < end; first += lane_count) {
            const Lanes rates = evaluate_cells(first, last_step, result.torn);
            if (!any(rates > result.limit.rate)) continue;
            for (int lane = 0; lane < lane_count; ++lane)
                if (rates[lane] > result.limit.rate)
                    result.limit = {rates[lane], static_cast<std::ptrdiff_t>(first + lane)};
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

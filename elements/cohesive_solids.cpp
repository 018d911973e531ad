#include "elements/cohesive_solids.h"

#include "math/symmetric_tensor.h"
#include "math/tensor3.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr int cohesive_patch_length = 256;

/// Shape functions of the surface's corners at a point: at the corner itself, or at the Gauss point next to
/// it.
double shape(int corner, int point, bool at_corners)
{
    if (at_corners) return corner == point ? 1 : 0;
    constexpr int a[] = {-1, 1, 1, -1}, b[] = {-1, -1, 1, 1};
    const double place = 1 / std::sqrt(3.0);
    return 0.25 * (1 + place * a[corner] * a[point]) * (1 + place * b[corner] * b[point]);
}

/// Rows: x along side 1-2, y, and n normal to the diagonals of the middle surface.
template <class Lane>
Tensor3<Lane> surface_axes(const Vector3<Lane> (&x)[8])
{
    const auto middle = [&](int i) { return x[i] + x[i + 4]; };
    const Vector3<Lane> n = cross(middle(2) - middle(0), middle(3) - middle(1));
    const Vector3<Lane> normal = (1.0 / sqrt(Lane{dot(n, n)})) * n;
    const Vector3<Lane> side = middle(1) - middle(0) + middle(2) - middle(3);
    const Vector3<Lane> flat = side - dot(side, normal) * normal;
    const Vector3<Lane> along = (1.0 / sqrt(Lane{dot(flat, flat)})) * flat, across = cross(normal, along);
    return {along.x, along.y, along.z, across.x, across.y, across.z, normal.x, normal.y, normal.z};
}

template <class Lane>
Vector3<Lane> gap_at(const Vector3<Lane> (&x)[8], int point, bool at_corners)
{
    Vector3<Lane> gap{};
    for (int i = 0; i < 4; ++i) {
        const double n = shape(i, point, at_corners);
        if (n != 0) gap += broadcast<Lane>(n) * (x[i + 4] - x[i]);
    }
    return gap;
}

/// Area of the middle surface that belongs to a point: the Jacobian there (times the weight 1 of either
/// rule).
double area_at(const Vec3 (&x)[8], int point, bool at_corners)
{
    constexpr int a[] = {-1, 1, 1, -1}, b[] = {-1, -1, 1, 1};
    const double place = at_corners ? 1 : 1 / std::sqrt(3.0);
    Vec3 by_a{}, by_b{};
    for (int i = 0; i < 4; ++i) {
        const Vec3 middle = 0.5 * (x[i] + x[i + 4]);
        by_a += 0.25 * a[i] * (1 + place * b[i] * b[point]) * middle;
        by_b += 0.25 * b[i] * (1 + place * a[i] * a[point]) * middle;
    }
    return norm(cross(by_a, by_b));
}

std::vector<Index> nodes_of(const Model& model, const std::vector<Index>& elements)
{
    std::vector<Index> nodes;
    for (Index element : elements)
        nodes.insert(nodes.end(), model.solids.nodes[element].begin(), model.solids.nodes[element].end());
    return nodes;
}

} // namespace

bool is_cohesive(const Model& model, Index part)
{
    const Index section = model.parts[part].section;
    if (section == none || model.sections[section].keyword != "SECTION_SOLID") return false;
    const Record::Field* formulation = model.sections[section].peek("ELFORM");
    return formulation && (formulation->value == 19 || formulation->value == 20);
}

CohesiveSolids::CohesiveSolids(const Model& model, Index part, std::vector<Index> elements, State& state)
    : model_(model),
      part_(part),
      law_(CohesiveMixedMode::from_record(model.materials[model.parts[part].material])),
      name_(fmt::format("cohesive elements of part {}", model.parts[part].id)),
      patches_(8, elements, nodes_of(model, elements), state.position, cohesive_patch_length),
      history_(static_cast<std::size_t>(patches_.batch_count()) * history_size),
      constants_(static_cast<std::size_t>(patches_.batch_count()) * points * constant_size),
      lost_(patches_.patches.size())
{
    with_arms_ = model.sections[model.parts[part].section].integer("ELFORM") == 20;
    if (with_arms_) start_arms(state);
    start(state);
}

/// The layer stands at COHOFF between the nodes 1-4 (-1) and 5-8 (1).
void CohesiveSolids::start_arms(State& state)
{
    const Record& section = model_.sections[model_.parts[part_].section];
    const double place = section.real("COHOFF");
    if (!(place >= -1 && place <= 1)) {
        throw DeckError(
            section.where,
            fmt::format("*SECTION_SOLID {}, field COHOFF: {} is not between -1 and 1", section.id, place));
    }
    state.need_rotation();
    arms_.resize(static_cast<std::size_t>(patches_.batch_count()) * 8);
    for (const Patches::Patch& patch : patches_.patches) {
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            for (int lane = 0; lane < lane_count; ++lane) {
                const std::size_t element = static_cast<std::size_t>(batch) * lane_count + lane;
                for (int i = 0; i < 4; ++i) {
                    const Vec3 across = state.position[corner(patch, element, i + 4)] -
                                        state.position[corner(patch, element, i)];
                    for (int side : {0, 1}) {
                        const Vec3 arm = (0.5 * (1 + place) - side) * across;
                        Vector3<Lanes>& kept = arms_[static_cast<std::size_t>(batch) * 8 + i + 4 * side];
                        kept.x[lane] = arm.x;
                        kept.y[lane] = arm.y;
                        kept.z[lane] = arm.z;
                    }
                }
            }
        }
    }
}

Vec3 CohesiveSolids::arm(std::size_t place, int corner) const
{
    if (!with_arms_) return {};
    const Vector3<Lanes>& kept = arms_[place / lane_count * 8 + corner];
    const auto lane = static_cast<int>(place % lane_count);
    return {kept.x[lane], kept.y[lane], kept.z[lane]};
}

Index CohesiveSolids::corner(const Patches::Patch& patch, std::size_t place, int corner) const
{
    const std::uint16_t* offset = patches_.corner_offsets(static_cast<Index>(place / lane_count), corner);
    return patches_.nodes[patch.first_node + offset[place % lane_count] / 4];
}

void CohesiveSolids::start(State& state)
{
    for (const Patches::Patch& patch : patches_.patches) {
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            Lanes* history = history_of(batch);
            history[alive] = broadcast<Lanes>(1);
            for (int lane = 0; lane < lane_count; ++lane) {
                const std::size_t place = static_cast<std::size_t>(batch) * lane_count + lane;
                Vec3 x[8];
                for (int i = 0; i < 8; ++i) x[i] = state.position[corner(patch, place, i)];
                const Vec3 across = x[4] + x[5] + x[6] + x[7] - (x[0] + x[1] + x[2] + x[3]);
                for (int i = 0; i < 8; ++i) x[i] += arm(place, i);
                const Tensor3<double> axes = surface_axes(x);
                double whole = 0, thickness = 0;
                for (int point = 0; point < points; ++point) {
                    Lanes* c =
                        &constants_[(static_cast<std::size_t>(batch) * points + point) * constant_size];
                    const Vec3 gap = axes * gap_at(x, point, law_.at_corners);
                    c[area][lane] = area_at(x, point, law_.at_corners);
                    c[gap_x][lane] = gap.x;
                    c[gap_y][lane] = gap.y;
                    c[gap_z][lane] = gap.z;
                    whole += c[area][lane];
                    thickness += c[area][lane] * (with_arms_ ? 0.25 * (axes * across).z : gap.z);
                }
                if (!(whole > 0)) {
                    throw DeckError(model_.parts[part_].where,
                                    fmt::format("cohesive solid {} of part {} has no area between its nodes "
                                                "1-4 and 5-8",
                                                model_.solids.id[patches_.elements[place]],
                                                model_.parts[part_].id));
                }
                if (lane >= patches_.active_lanes(batch)) continue;
                // The mean gap times the area is the volume.
                const double mass = law_.density * (law_.by_area ? whole : std::max(thickness, 0.0));
                for (int i = 0; i < 8; ++i) state.mass[corner(patch, place, i)] += mass / 8;
            }
        }
    }
}

/// Two nodes of mass m on a spring k = E A / 4 vibrate with w = sqrt(k (1/m + 1/m)). With the masses of
/// everything that hangs on the nodes; half of 2 / w leaves room for the stiffness of their neighbours, whose
/// own votes do not know of this spring.
void CohesiveSolids::vote(const State& state)
{
    vote_known_ = true;
    double largest = 0;
    for (const Patches::Patch& patch : patches_.patches) {
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            for (int lane = 0; lane < patches_.active_lanes(batch); ++lane) {
                const std::size_t place = static_cast<std::size_t>(batch) * lane_count + lane;
                for (int i = 0; i < 4; ++i) {
                    double softness = 0;
                    for (int end : {i, i + 4}) {
                        const Index node = corner(patch, place, end);
                        const Vec3 lever = arm(place, end);
                        const double mass = state.mass[node], inertia = with_arms_ ? state.inertia[node] : 0;
                        if (mass > 0) softness += 1 / mass;
                        if (inertia > 0) softness += dot(lever, lever) / inertia;
                    }
                    const Lanes* c =
                        &constants_[(static_cast<std::size_t>(batch) * points + i) * constant_size];
                    const double square =
                        std::max(law_.normal_stiffness, law_.shear_stiffness) * c[area][lane] * softness;
                    if (square <= largest) continue;
                    largest = square;
                    vote_ = {1 / std::sqrt(square), "solid", model_.solids.id[patches_.elements[place]],
                             model_.parts[part_].id};
                }
            }
        }
    }
}

void CohesiveSolids::add_forces(const Clock& clock, State& state)
{
    if (!vote_known_ || vote_.element == 0) vote(state);
    patches_.for_each(state, with_arms_,
                      [&](std::ptrdiff_t number, const Patches::Patch& patch, NodeCopies& nodes) {
                          lost_[number].clear();
                          const Index end = patch.first_batch + patch.batch_count;
                          for (Index batch = patch.first_batch; batch < end; ++batch)
                              add_batch_forces(batch, clock.last_step, nodes, lost_[number]);
                      });
    for (const auto& places : lost_) {
        for (std::size_t place : places) {
            Lanes* history = history_of(static_cast<Index>(place / lane_count));
            const int lane = static_cast<int>(place % lane_count);
            eroded_ += history[energy][lane];
            for (int i = 0; i < history_size; ++i) history[i][lane] = 0;
            state.deleted_solids.resize(model_.solids.size());
            state.deleted_solids[patches_.elements[place]] = 1;
            ++state.deletions;
        }
    }
}

void CohesiveSolids::add_batch_forces(Index batch, double time_step, NodeCopies& nodes,
                                      std::vector<std::size_t>& lost)
{
    Vector3<Lanes> position[8], velocity[8], force[8] = {};
    for (int i = 0; i < 8; ++i) {
        position[i] = load_corner<Lanes>(nodes.position.data(), patches_.corner_offsets(batch, i));
        velocity[i] = load_corner<Lanes>(nodes.velocity.data(), patches_.corner_offsets(batch, i));
    }
    Vector3<Lanes>* const arms = with_arms_ ? &arms_[static_cast<std::size_t>(batch) * 8] : nullptr;
    if (arms && time_step > 0) {
        // The layer's sides go with the arms; velocities become those of the sides over the step.
        for (int i = 0; i < 8; ++i) {
            const auto spin =
                load_corner<Lanes>(nodes.angular_velocity.data(), patches_.corner_offsets(batch, i));
            const Vector3<Lanes> before = arms[i];
            arms[i] = incremental_rotation(broadcast<Lanes>(0.5 * time_step) * spin) * before;
            velocity[i] += broadcast<Lanes>(1 / time_step) * (arms[i] - before);
        }
    }
    if (arms)
        for (int i = 0; i < 8; ++i) position[i] += arms[i];
    Lanes* history = history_of(batch);
    const Lanes here = history[alive];
    const Tensor3<Lanes> axes = surface_axes(position);
    Lanes power{}, failed{};
    for (int point = 0; point < points; ++point) {
        const Lanes* c = &constants_[(static_cast<std::size_t>(batch) * points + point) * constant_size];
        Lanes* h = history + point * point_size;
        const Vector3<Lanes> start{c[gap_x], c[gap_y], c[gap_z]};
        const Vector3<Lanes> separation = axes * gap_at(position, point, law_.at_corners) - start;
        const Vector3<Lanes> local = law_.traction(separation, h[damage]);
        const Vector3<Lanes> traction = (here * c[area]) * transposed_times(axes, local); // [force]
        const Vector3<Lanes> before{h[traction_x], h[traction_y], h[traction_z]};
        power += 0.5 * dot(before + traction, gap_at(velocity, point, law_.at_corners));
        h[traction_x] = traction.x;
        h[traction_y] = traction.y;
        h[traction_z] = traction.z;
        failed += h[damage] >= 1.0 ? broadcast<Lanes>(1) : Lanes{};
        for (int i = 0; i < 4; ++i) {
            const double n = shape(i, point, law_.at_corners);
            if (n == 0) continue;
            force[i] += broadcast<Lanes>(n) * traction;
            force[i + 4] -= broadcast<Lanes>(n) * traction;
        }
    }
    history[energy] += time_step * power;
    const int active = patches_.active_lanes(batch);
    if (law_.points_to_fail > 0) {
        for (int lane = 0; lane < active; ++lane) {
            if (here[lane] != 0 && failed[lane] >= law_.points_to_fail)
                lost.push_back(static_cast<std::size_t>(batch) * lane_count + lane);
        }
    }
    for (int i = 0; i < 8; ++i)
        add_corner(nodes.force.data(), patches_.corner_offsets(batch, i), force[i], active);
    if (!arms) return;
    for (int i = 0; i < 8; ++i)
        add_corner(nodes.moment.data(), patches_.corner_offsets(batch, i), cross(arms[i], force[i]), active);
}

void CohesiveSolids::report(EnergyLedger& ledger) const
{
    double sum = 0;
    for (Index batch = 0; batch < patches_.batch_count(); ++batch)
        for (int lane = 0; lane < patches_.active_lanes(batch); ++lane)
            sum += history_[static_cast<std::size_t>(batch) * history_size + energy][lane];
    ledger.add_part(part_, sum, 0);
    ledger.eroded_internal += eroded_;
}

/// Stress with the traction on the surface and nothing along it, and the mean damage in the place of plastic
/// strain.
void CohesiveSolids::collect(const State& state, ElementResults& results) const
{
    if (!results.part_motion.empty()) results.part_motion[part_].eroded_internal += eroded_;
    for (const Patches::Patch& patch : patches_.patches) {
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            const Lanes* history = &history_[static_cast<std::size_t>(batch) * history_size];
            for (int lane = 0; lane < patches_.active_lanes(batch); ++lane) {
                const std::size_t place = static_cast<std::size_t>(batch) * lane_count + lane;
                const Index row = results.row_of_solid(patches_.elements[place]);
                if (row == none) continue;
                const bool gone = history[alive][lane] == 0;
                if (!results.solid_deleted.empty()) results.solid_deleted[row] = gone;
                Vec3 x[8];
                for (int i = 0; i < 8; ++i) x[i] = state.position[corner(patch, place, i)] + arm(place, i);
                const Tensor3<double> axes = surface_axes(x);
                Vec3 t{};
                double whole = 0, mean_damage = 0;
                for (int point = 0; point < points; ++point) {
                    const Lanes* h = history + point * point_size;
                    const Lanes* c =
                        &constants_[(static_cast<std::size_t>(batch) * points + point) * constant_size];
                    t += Vec3{h[traction_x][lane], h[traction_y][lane], h[traction_z][lane]};
                    whole += c[area][lane];
                    mean_damage += h[damage][lane] / points;
                }
                t *= 1 / whole;
                const Vec3 n{axes.zx, axes.zy, axes.zz};
                const double normal = dot(t, n);
                const auto stress = [&](double Vec3::*i, double Vec3::*j) {
                    return t.*i * n.*j + n.*i * t.*j - normal * (n.*i * n.*j);
                };
                if (!results.solid_stress.empty()) {
                    results.solid_stress[row] = {stress(&Vec3::x, &Vec3::x), stress(&Vec3::y, &Vec3::y),
                                                 stress(&Vec3::z, &Vec3::z), stress(&Vec3::x, &Vec3::y),
                                                 stress(&Vec3::y, &Vec3::z), stress(&Vec3::z, &Vec3::x)};
                }
                if (!results.solid_plastic_strain.empty()) results.solid_plastic_strain[row] = mean_damage;
            }
        }
    }
}

std::vector<std::unique_ptr<Term>> make_cohesive_solids(const Model& model, State& state)
{
    std::vector<std::vector<Index>> elements(model.parts.size());
    for (std::size_t element = 0; element < model.solids.size(); ++element) {
        const Index part = model.solids.part[element];
        if (is_cohesive(model, part)) elements[part].push_back(static_cast<Index>(element));
    }
    std::vector<std::unique_ptr<Term>> terms;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (elements[i].empty()) continue;
        const Part& part = model.parts[i];
        if (part.material == none || model.materials[part.material].keyword != "MAT_COHESIVE_MIXED_MODE") {
            throw DeckError(
                part.where,
                fmt::format("*PART {}: cohesive elements (ELFORM 19, 20) have *MAT_COHESIVE_MIXED_MODE",
                            part.id));
        }
        terms.push_back(
            std::make_unique<CohesiveSolids>(model, static_cast<Index>(i), std::move(elements[i]), state));
    }
    return terms;
}

} // namespace plash

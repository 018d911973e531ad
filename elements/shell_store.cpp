#include "elements/shell_store.h"

#include "core/run_error.h"
#include "core/smallest_steps.h"
#include "elements/collect_patches.h"
#include "elements/result_layers.h"
#include "elements/shell_mass.h"
#include "math/tensor3.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr int patch_length = 256; // elements; its node copies and records stay in second-level cache

Patches cut_shells(const ShellPart& part, const State& state)
{
    std::vector<Index> connectivity;
    connectivity.reserve(4 * part.elements.size());
    for (Index element : part.elements) {
        for (Index node : shell_corners(part.model, element)) connectivity.push_back(node);
    }
    return Patches(4, part.elements, connectivity, state.position, patch_length);
}

/// Frame of an element at the positions of the state.
ShellFrame<double> frame_of(const Model& model, const State& state, Index element)
{
    const std::array<Index, 4> nodes = shell_corners(model, element);
    Vec3 corner[4];
    for (int i = 0; i < 4; ++i) corner[i] = state.position[nodes[i]];
    return shell_frame(pattern_of(corner[0], corner[1], corner[2], corner[3]));
}

/// Least rotary inertia over mass with which shear waves stay stable at the step of the plate wave, also
/// where nodes carry half their plate mass (a strip one element wide): its highest frequency obeys omega^2 <=
/// kappa G / rho (4 / l^2 + 1 / r^2), from the one-point shear energy of Belytschko, Lin & Tsay.
double least_squared_gyration(const ShellSettings& settings, double step_scale, double length_squared)
{
    const ShellStiffness& stiffness = settings.stiffness;
    const double shear = stiffness.shear_factor * stiffness.shear_modulus;
    const double plate = stiffness.wave_impedance * settings.wave_speed;
    const double margin = plate / (step_scale * step_scale * shear) - 1;
    // Without margin the step would have to shrink whatever the inertia; no law has such moduli.
    return margin > 0 ? 0.25 * length_squared / margin : 0;
}

/// Least rotary inertia over mass with which stretching and bending, coupled by nodes that lie beside the
/// middle of the thickness, stay stable at the step of the plate wave. Alternating motions u, r theta of the
/// nodes meet the stiffness [1, e / r; e / r, (e^2 + t^2 / 12) / r^2] times that of stretching alone, whose
/// larger root is below its trace.
double offset_squared_gyration(const ShellMass& share, double step_scale)
{
    if (share.offset == 0) return 0;
    // Alone, sheets of two elements and more reach up to 1.12 times the frequency squared of the plate wave.
    constexpr double free_corners = 1.12, least_margin = 0.05;
    const double margin = std::max(1 / (step_scale * step_scale * free_corners) - 1, least_margin);
    return (share.offset * share.offset + share.thickness * share.thickness / 12) / margin;
}

/// Components in global axes of a tensor given in a frame.
SymmetricTensor<double> to_global(const ShellFrame<double>& frame, const SymmetricTensor<double>& local)
{
    const Vec3 row1 = local.xx * frame.e1 + local.xy * frame.e2 + local.zx * frame.e3;
    const Vec3 row2 = local.xy * frame.e1 + local.yy * frame.e2 + local.yz * frame.e3;
    const Vec3 row3 = local.zx * frame.e1 + local.yz * frame.e2 + local.zz * frame.e3;
    const auto component = [&](double Vec3::*a, double Vec3::*b) {
        return frame.e1.*a * row1.*b + frame.e2.*a * row2.*b + frame.e3.*a * row3.*b;
    };
    return {component(&Vec3::x, &Vec3::x), component(&Vec3::y, &Vec3::y), component(&Vec3::z, &Vec3::z),
            component(&Vec3::x, &Vec3::y), component(&Vec3::y, &Vec3::z), component(&Vec3::z, &Vec3::x)};
}

/// Components in a frame of a tensor given in global axes.
SymmetricTensor<double> to_local(const ShellFrame<double>& frame, const SymmetricTensor<double>& global)
{
    const Tensor3<double> rows{frame.e1.x, frame.e1.y, frame.e1.z, frame.e2.x, frame.e2.y,
                               frame.e2.z, frame.e3.x, frame.e3.y, frame.e3.z};
    return rotated(global, rows);
}

CornerPattern<double> pattern_at(const Model& model, const State& state, Index element)
{
    const std::array<Index, 4> nodes = shell_corners(model, element);
    Vec3 corner[4];
    for (int i = 0; i < 4; ++i) corner[i] = state.position[nodes[i]];
    return pattern_of(corner[0], corner[1], corner[2], corner[3]);
}

} // namespace

double shell_area(const Model& model, const State& state, Index element)
{
    return shell_frame(pattern_at(model, state, element)).area;
}

double squared_length_of(const Model& model, const State& state, Index element, int length_rule)
{
    const CornerPattern<double> position = pattern_at(model, state, element);
    return squared_length(position, shell_frame(position).area, length_rule);
}

ShellStore::ShellStore(const ShellPart& its, const State& state, ShellSettings its_settings, int plane_points,
                       std::span<const double> initial_history, Index plastic_strain)
    : model(its.model),
      part(its.part),
      name(fmt::format("shells of part {}", model.parts[its.part].id)),
      settings(std::move(its_settings)),
      plate(shell_plate(model, model.parts[its.part])),
      patches(cut_shells(its, state)),
      section_watch(model, &CrossSection::shells, model.shells.size(), patches),
      sums(patches.patches.size()),
      plane_points_(plane_points),
      point_size_(shell_record::history + static_cast<int>(initial_history.size())),
      plastic_strain_(plastic_strain)
{
    using namespace shell_record;
    const int point_count = plane_points_ * settings.rule.size();
    record_size_ = points + static_cast<std::size_t>(point_count) * point_size_;
    settings.column_share = 1.0 / plane_points_;
    constexpr double margin = 0.98;
    const double alone = its.alone ? std::sqrt(1 + settings.poisson_ratio) : 1,
                 scale = model.controls.time.step_scale;
    if (its.alone) step_share = std::min(1.0, margin / (scale * alone));
    const double spare = margin / (scale * step_share * alone);
    settings.spare_density = std::max(spare * spare, 1.0);
    if (model.controls.output.strains()) {
        settings.strain_place = static_cast<int>(record_size_);
        record_size_ += 12;
    }
    records_.resize(patches.batch_count() * record_size_);
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        Lanes* values = record(batch);
        values[mass_factor] = broadcast<Lanes>(1.0);
        for (int lane = 0; lane < lane_count; ++lane) {
            const Index element = patches.elements[batch * lane_count + lane];
            values[thickness][lane] = shell_mass(model, element, plate).thickness;
            values[reference_volume][lane] = values[thickness][lane] * shell_area(model, state, element);
        }
        for (int point = 0; point < point_count; ++point) {
            Lanes* variables = values + points + point * point_size_ + history;
            for (double start : initial_history) *variables++ = broadcast<Lanes>(start);
        }
    }
    take_initial_strains(its, state);
}

/// *INITIAL_STRAIN_SHELL: nothing but what result files show begins with it.
void ShellStore::take_initial_strains(const ShellPart& its, const State& state)
{
    if (settings.strain_place == 0 || !its.initial_strains) return;
    for (std::size_t place = 0; place < patches.elements.size(); ++place) {
        const Index element = patches.elements[place];
        const auto found = its.initial_strains->find(element);
        if (found == its.initial_strains->end()) continue;
        const ShellFrame<double> frame = frame_of(model, state, element);
        for (const int side : {0, 1}) {
            const double thickness_place = settings.rule.size() == 0 ? 0
                                           : side == 0               ? settings.rule.place.front()
                                                                     : settings.rule.place.back();
            const SymmetricTensor<double> local =
                to_local(frame, through_thickness(found->second, thickness_place, 0).stress);
            put_stress(local,
                       record(static_cast<Index>(place / lane_count)) + settings.strain_place + 6 * side,
                       static_cast<int>(place % lane_count));
        }
    }
}

void ShellStore::take_initial_stresses(const ShellPart& its, const State& state)
{
    using namespace shell_record;
    if (!its.initial_stresses || its.initial_stresses->empty()) return;
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        for (int lane = 0; lane < lane_count; ++lane) {
            const Index element = patches.elements[batch * lane_count + lane];
            const auto found = its.initial_stresses->find(element);
            if (found == its.initial_stresses->end()) continue;
            if (ply_place != none) {
                throw DeckError(found->second.where,
                                fmt::format("*INITIAL_STRESS_SHELL: shell {} has plies, whose "
                                            "stresses cannot be given",
                                            model.shells.id[element]));
            }
            const ShellFrame<double> frame = frame_of(model, state, element);
            for (int i = 0; i < plane_points_ * settings.rule.size(); ++i) {
                const auto [column, layer] = std::div(i, settings.rule.size());
                const InitialStressPoint start =
                    through_thickness(found->second, settings.rule.place[layer], column);
                const SymmetricTensor<double> local = to_local(frame, start.stress);
                Lanes* values = record(batch) + points + i * point_size_;
                values[stress_xx][lane] = local.xx;
                values[stress_yy][lane] = local.yy;
                values[stress_xy][lane] = local.xy;
                values[stress_yz][lane] = settings.membrane ? 0 : local.yz;
                values[stress_zx][lane] = settings.membrane ? 0 : local.zx;
                if (plastic_strain_ != none) values[history + plastic_strain_][lane] = start.plastic_strain;
            }
        }
    }
}

void ShellStore::erode(const ElementLoss& loss, PatchSums& patch_sums, State& state)
{
    using namespace shell_record;
    const std::size_t place = loss.place;
    Lanes* values = record(static_cast<Index>(place / lane_count));
    const auto lane = static_cast<int>(place % lane_count);
    patch_sums.internal -= values[internal_energy][lane];
    patch_sums.hourglass -= values[hourglass_energy][lane];
    eroded_internal_ += values[internal_energy][lane] + loss.missing_work;
    eroded_hourglass_ += values[hourglass_energy][lane];
    values[mass_factor][lane] = 0;
    state.deleted_shells.resize(model.shells.size());
    state.deleted_shells[patches.elements[place]] = 1;
    ++state.deletions;
}

void ShellStore::start_cycle(const Clock& clock)
{
    const TimeControls& control = model.controls.time;
    if (clock.cycle != 1 || !control.erode_small_shells) return;
    const double length =
        control.smallest_step_factor * clock.last_step / control.step_scale * settings.wave_speed;
    settings.shortest_squared_length = std::max(settings.shortest_squared_length, length * length);
}

void ShellStore::close_cycle(State& state)
{
    check_finite();
    for (PatchSums& patch : sums) {
        for (const ElementLoss& loss : patch.lost) erode(loss, patch, state);
        patch.lost.clear();
    }
}

std::array<SelectiveMasses::Corner, 4> ShellStore::masses_of(Index element, double factor,
                                                             const State& state) const
{
    const ShellMass share = shell_mass(model, element, plate);
    const double length = squared_length_of(model, state, element, settings.length_rule);
    const double step_scale = model.controls.time.step_scale;
    const double gyration =
        std::max({share.squared_gyration, least_squared_gyration(settings, step_scale, length),
                  offset_squared_gyration(share, step_scale)});
    const std::array<Index, 4> nodes = shell_corners(model, element);
    std::array<SelectiveMasses::Corner, 4> corners;
    for (int corner = 0; corner < 4; ++corner) {
        const double mass = factor * share.corner_mass[corner];
        corners[corner] = {nodes[corner], mass, gyration * mass};
    }
    return corners;
}

double ShellStore::add_mass(Index element, double factor, State& state) const
{
    double added = 0;
    for (const SelectiveMasses::Corner& corner : masses_of(element, factor, state)) {
        state.mass[corner.node] += corner.mass;
        state.inertia[corner.node] += corner.inertia;
        added += corner.mass;
    }
    return added;
}

void ShellStore::add_masses(State& state) const
{
    for (Index i = 0; i < patches.element_count; ++i) add_mass(patches.elements[i], 1, state);
}

template <class Take>
void ShellStore::scale_steps(double step, bool only_small, const State& state, Take&& take)
{
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        Lanes& factors = record(batch)[shell_record::mass_factor];
        for (int lane = 0; lane < lane_count; ++lane) {
            const Index element = patches.elements[batch * lane_count + lane];
            const double length = std::sqrt(squared_length_of(model, state, element, settings.length_rule));
            const double ratio = step * settings.wave_speed / (step_share * length);
            if (only_small && ratio <= 1) continue;
            factors[lane] = ratio * ratio;
            if (lane < patches.active_lanes(batch)) take(element, factors[lane] - 1);
        }
    }
}

double ShellStore::scale_mass(double step, bool only_small, State& state)
{
    double added = 0;
    scale_steps(step, only_small, state,
                [&](Index element, double growth) { added += add_mass(element, growth, state); });
    return added;
}

void ShellStore::scale_selectively(double step, bool only_small, const State& state, SelectiveMasses& masses)
{
    scale_steps(step, only_small, state, [&](Index element, double growth) {
        masses.begin(SelectiveMasses::Kind::shell, element);
        for (const SelectiveMasses::Corner& corner : masses_of(element, growth, state)) {
            if (corner.mass != 0) masses.corners.push_back(corner);
        }
    });
}

StepVote ShellStore::vote() const
{
    const PatchSums* shortest = nullptr;
    for (const PatchSums& patch : sums) {
        if (!shortest || patch.squared_length < shortest->squared_length) shortest = &patch;
    }
    if (!shortest || shortest->squared_length >= eroded_length) return StepVote::nothing();
    return {step_share * std::sqrt(shortest->squared_length) / settings.wave_speed, "shell",
            model.shells.id[patches.elements[shortest->place]], model.parts[part].id};
}

void ShellStore::report(EnergyLedger& ledger) const
{
    PatchSums total;
    for (const PatchSums& patch : sums) {
        total.internal += patch.internal;
        total.hourglass += patch.hourglass;
        total.viscous += patch.viscous;
    }
    ledger.add_part(part, total.internal, total.hourglass);
    ledger.bulk_viscosity += total.viscous;
    ledger.eroded_internal += eroded_internal_;
    ledger.eroded_hourglass += eroded_hourglass_;
}

void ShellStore::check_finite() const
{
    bool finite = true;
    for (const PatchSums& patch : sums) finite = finite && std::isfinite(patch.internal + patch.hourglass);
    if (finite) return;
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        const Lanes energy =
            record(batch)[shell_record::internal_energy] + record(batch)[shell_record::hourglass_energy];
        for (int lane = 0; lane < patches.active_lanes(batch); ++lane) {
            if (std::isfinite(energy[lane])) continue;
            const Index element = patches.elements[batch * lane_count + lane];
            const Vec3& place = model.nodes.position[model.shells.nodes[element][0]];
            throw RunError(fmt::format("shell {} of part {} '{}' has energies that are no finite numbers (it "
                                       "started near ({:.6g}, {:.6g}, {:.6g}))",
                                       model.shells.id[element], model.parts[part].id,
                                       model.parts[part].title, place.x, place.y, place.z));
        }
    }
}

void ShellStore::collect(const State& state, ElementResults& results) const
{
    if (results.steps_wanted) collect_steps(state, results);
    section_watch.collect(patches, state, results);
    collect_patches(patches, part, results,
                    [&](const Patches::Patch&, Index batch, int lane, ElementResults::PartMotion& sum) {
                        collect_element(state, batch, lane, results);
                        if (!results.part_motion.empty()) collect_motion(state, batch, lane, sum);
                    });
    if (!results.part_motion.empty()) results.part_motion[part].eroded_internal += eroded_internal_;
}

std::pair<double, double> ShellStore::place_of(Index batch, int lane, int point) const
{
    if (ply_place == none) {
        return {settings.rule.place[point] - settings.reference_offset, settings.rule.weight[point]};
    }
    const Lanes* values = record(batch) + shell_record::points + point * point_size_ + shell_record::history;
    return {values[ply_place][lane], values[ply_weight][lane]};
}

void ShellStore::collect_steps(const State& state, ElementResults& results) const
{
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        for (int lane = 0; lane < patches.active_lanes(batch); ++lane) {
            const Index element = patches.elements[batch * lane_count + lane];
            const double factor = record(batch)[shell_record::mass_factor][lane];
            const Lanes* values = record(batch);
            const double volume = values[shell_record::thickness][lane] * shell_area(model, state, element);
            const double length =
                stretched_share(settings, double{values[shell_record::reference_volume][lane]}, volume) *
                squared_length_of(model, state, element, settings.length_rule);
            add_step(results, {"shell", model.shells.id[element], model.parts[part].id,
                               step_share * std::sqrt(factor * length) / settings.wave_speed});
        }
    }
}

void ShellStore::collect_element(const State& state, Index batch, int lane, ElementResults& results) const
{
    using namespace shell_record;
    const Index element = patches.elements[batch * lane_count + lane];
    const Index row = results.row_of_shell(element);
    if (row == none) return;
    const Lanes* values = record(batch);
    // Mean over the columns of an element.
    const auto point_value = [&](int point, int variable) {
        double sum = 0;
        for (int column = 0; column < plane_points_; ++column) {
            sum += values[points + (column * settings.rule.size() + point) * point_size_ + variable][lane];
        }
        return sum / plane_points_;
    };
    const bool deleted = values[mass_factor][lane] == 0;
    if (!results.shell_deleted.empty()) results.shell_deleted[row] = deleted;
    if (!results.shell_thickness.empty()) results.shell_thickness[row] = values[thickness][lane];
    if (!results.shell_internal_energy.empty()) {
        const ShellMass start = shell_mass(model, element, plate);
        results.shell_internal_energy[row] = values[internal_energy][lane] / (start.area * start.thickness);
    }
    const bool stress_wanted = !results.shell_stress.empty();
    const bool strain_wanted = !results.shell_plastic_strain.empty() && plastic_strain_ != none;
    if (!deleted && (stress_wanted || strain_wanted)) {
        const ShellFrame<double> frame = frame_of(model, state, element);
        for (int layer = 0; layer < results.shell_layers; ++layer) {
            const auto [first, last] = points_of_layer(layer, results.shell_layers, settings.rule.size());
            SymmetricTensor<double> stress;
            double plastic_strain = 0;
            for (int point = first; point <= last; ++point) {
                const double share = 1.0 / (last - first + 1);
                const SymmetricTensor<double> one{point_value(point, stress_xx),
                                                  point_value(point, stress_yy),
                                                  0,
                                                  point_value(point, stress_xy),
                                                  point_value(point, stress_yz),
                                                  point_value(point, stress_zx)};
                stress = stress + share * one;
                if (strain_wanted) plastic_strain += share * point_value(point, history + plastic_strain_);
            }
            const std::size_t place = static_cast<std::size_t>(row) * results.shell_layers + layer;
            if (stress_wanted) results.shell_stress[place] = to_global(frame, stress);
            if (strain_wanted) results.shell_plastic_strain[place] = plastic_strain;
        }
    }
    if (deleted) return;
    if (!results.shell_history.empty()) collect_history(batch, lane, row, results);
    if (!results.shell_strain.empty() && settings.strain_place != 0)
        collect_strains(state, batch, lane, row, results);
    if (results.shell_resultants.empty()) return;
    ShellResultants<double> sum;
    const double thickness_now = values[thickness][lane];
    for (int point = 0; point < settings.rule.size(); ++point) {
        const auto [place, weight] = place_of(batch, lane, point);
        const double z = 0.5 * thickness_now * place;
        const double force = weight * thickness_now;
        sum.nxx += force * point_value(point, stress_xx);
        sum.nyy += force * point_value(point, stress_yy);
        sum.nxy += force * point_value(point, stress_xy);
        sum.qx += settings.shear_factor * force * point_value(point, stress_zx);
        sum.qy += settings.shear_factor * force * point_value(point, stress_yz);
        sum.mxx += z * force * point_value(point, stress_xx);
        sum.myy += z * force * point_value(point, stress_yy);
        sum.mxy += z * force * point_value(point, stress_xy);
    }
    results.shell_resultants[row] = {sum.mxx, sum.myy, sum.mxy, sum.qx, sum.qy, sum.nxx, sum.nyy, sum.nxy};
}

void ShellStore::collect_history(Index batch, int lane, Index row, ElementResults& results) const
{
    using namespace shell_record;
    const int layers = settings.rule.size(), wanted = results.shell_history_size;
    for (int layer = 0; layer < results.shell_layers; ++layer) {
        const auto [first, last] = points_of_layer(layer, results.shell_layers, layers);
        double* values =
            &results.shell_history[(static_cast<std::size_t>(row) * results.shell_layers + layer) * wanted];
        for (int point = first; point <= last; ++point) {
            const auto& list = shown.size() == 1 ? shown[0] : shown[point];
            const double share = 1.0 / (plane_points_ * (last - first + 1));
            for (int i = 0; i < std::min<int>(wanted, static_cast<int>(list.size())); ++i) {
                if (list[i].variable < 0) continue;
                for (int column = 0; column < plane_points_; ++column) {
                    const Lanes* own =
                        record(batch) + points + (column * layers + point) * point_size_ + history;
                    values[i] += share * (own[list[i].variable][lane] - list[i].start);
                }
            }
        }
    }
}

void ShellStore::collect_strains(const State& state, Index batch, int lane, Index row,
                                 ElementResults& results) const
{
    const Lanes* strains = record(batch) + settings.strain_place;
    const ShellFrame<double> frame = frame_of(model, state, patches.elements[batch * lane_count + lane]);
    for (const int side : {0, 1}) {
        const Lanes* s = strains + 6 * side;
        results.shell_strain[row][side] =
            to_global(frame, {s[0][lane], s[1][lane], s[2][lane], s[3][lane], s[4][lane], s[5][lane]});
    }
}

void ShellStore::collect_motion(const State& state, Index batch, int lane,
                                ElementResults::PartMotion& motion) const
{
    const double factor = record(batch)[shell_record::mass_factor][lane];
    if (factor == 0) return;
    const Index element = patches.elements[batch * lane_count + lane];
    const std::array<Index, 4> nodes = shell_corners(model, element);
    const ShellMass share = shell_mass(model, element, plate);
    for (int corner = 0; corner < 4; ++corner)
        add_motion(factor * share.corner_mass[corner], state.velocity[nodes[corner]], motion);
}

} // namespace plash

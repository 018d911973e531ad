#include "elements/beam_store.h"

#include "core/prescribed_rate.h"
#include "core/run_error.h"
#include "core/smallest_steps.h"
#include "elements/collect_patches.h"
#include "elements/initial_beam_stress.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr int beam_patch_length = 256; // elements

Patches cut_beams(const BeamPart& part, const State& state)
{
    std::vector<Index> connectivity;
    connectivity.reserve(2 * part.elements.size());
    for (Index element : part.elements) {
        connectivity.push_back(part.model.beams.nodes[element][0]);
        connectivity.push_back(part.model.beams.nodes[element][1]);
    }
    return Patches(2, part.elements, connectivity, state.position, beam_patch_length);
}

double length_of(const Model& model, Index element)
{
    const auto& nodes = model.beams.nodes[element];
    return norm(model.nodes.position[nodes[1]] - model.nodes.position[nodes[0]]);
}

/// Direction that the deck gives across the axis; zero when it gives none.
Vec3 given_direction(const Model& model, Index element)
{
    const auto& nodes = model.beams.nodes[element];
    if (!model.beams.orientation.empty()) {
        const Vec3& vector = model.beams.orientation[element];
        if (norm(vector) > 0) return vector;
    }
    if (nodes[2] == none) return {};
    return model.nodes.position[nodes[2]] - model.nodes.position[nodes[0]];
}

/// The axis among x, y, z that lies furthest from `along`.
Vec3 any_direction(const Vec3& along)
{
    const Vec3 size{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
    if (size.x <= size.y && size.x <= size.z) return {1, 0, 0};
    return size.y <= size.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
}

} // namespace

BeamStore::BeamStore(const BeamPart& its, const State& state, BeamSettings its_settings, int record_size,
                     PointLayout points, std::span<const double> initial_history)
    : model(its.model),
      part(its.part),
      name(fmt::format("beams of part {}", model.parts[its.part].id)),
      settings(std::move(its_settings)),
      patches(cut_beams(its, state)),
      sums(patches.patches.size()),
      record_size_(record_size),
      points_(points)
{
    records_.resize(patches.batch_count() * record_size_);
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        record(batch)[beam_record::mass_factor] = broadcast<Lanes>(1.0);
        for (int point = 0; point < points_.count; ++point) {
            Lanes* values = record(batch) + points_.first + point * points_.size + 3;
            for (double start : initial_history) *values++ = broadcast<Lanes>(start);
        }
    }
    if (settings.section.formulation == 3) {
        for (Index batch = 0; batch < patches.batch_count(); ++batch) {
            record(batch)[beam_record::own] = broadcast<Lanes>(settings.section.initial_stress);
            record(batch)[beam_record::resultant] =
                broadcast<Lanes>(settings.section.area * settings.section.initial_stress);
        }
    }
    set_axes(its);
    find_preloads();
    set_initial_stresses();
}

/// *INITIAL_STRESS_BEAM on the beams of this group.
void BeamStore::set_initial_stresses()
{
    const auto stresses = initial_beam_stresses(model);
    if (stresses.empty()) return;
    for (Index place = 0; place < patches.batch_count() * lane_count; ++place) {
        const auto found = stresses.find(patches.elements[place]);
        if (found == stresses.end()) continue;
        const InitialBeamStress& given = found->second;
        Lanes* values = record(place / lane_count);
        const int lane = place % lane_count;
        const auto refuse = [&](const std::string& what) {
            throw DeckError(given.where, fmt::format("*INITIAL_STRESS_BEAM: beam {} {}",
                                                     model.beams.id[found->first], what));
        };
        std::vector<InitialBeamStress::Point> points = given.points;
        if (points.empty()) {
            values[beam_record::resultant][lane] = given.axial;
            values[beam_record::resultant + 1][lane] = given.torsion;
            if (given.torsion != 0 && points_.count > 0)
                refuse("has points; give their stresses in place of T11");
            points.resize(points_.count, {given.axial / settings.section.area, 0, 0, 0});
        }
        if (static_cast<int>(points.size()) != points_.count) {
            refuse(fmt::format("has {} points, the card gives {}", points_.count, points.size()));
        }
        for (int point = 0; point < points_.count; ++point) {
            Lanes* stress = values + points_.first + point * points_.size;
            stress[0][lane] = points[point].axial;
            stress[1][lane] = points[point].shear_rs;
            stress[2][lane] = points[point].shear_tr;
            if (points_.plastic_strain != none)
                stress[3 + points_.plastic_strain][lane] = points[point].plastic_strain;
            else if (points[point].plastic_strain != 0)
                refuse("has a material without plastic strain");
        }
    }
}

void BeamStore::set_axes(const BeamPart& its)
{
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        for (int lane = 0; lane < lane_count; ++lane) {
            const Index element = patches.elements[batch * lane_count + lane];
            const auto& nodes = model.beams.nodes[element];
            const Vec3 e1 = unit(model.nodes.position[nodes[1]] - model.nodes.position[nodes[0]]);
            const Part& owner = its.model.parts[part];
            if (norm(e1) == 0) {
                throw DeckError(owner.where, fmt::format("beam {} of part {} has no length",
                                                         model.beams.id[element], owner.id));
            }
            Vec3 across = given_direction(model, element);
            const bool given = norm(across) > 0;
            across -= dot(across, e1) * e1;
            if (norm(across) <= 1e-6 * length_of(model, element)) {
                if (!settings.section.isotropic()) {
                    throw DeckError(
                        owner.where,
                        fmt::format("beam {} of part {} {}", model.beams.id[element], owner.id,
                                    given ? "has its third node (or its orientation) on its own axis"
                                          : "needs a third node: its section bends differently in its two "
                                            "planes"));
                }
                across = any_direction(e1);
                across -= dot(across, e1) * e1;
            }
            const Vec3 e2 = unit(across);
            Lanes* axis = record(batch) + beam_record::second_axis;
            axis[0][lane] = e2.x;
            axis[1][lane] = e2.y;
            axis[2][lane] = e2.z;
        }
    }
}

void BeamStore::find_preloads()
{
    for (const BeamPreload& given : model.beam_preloads) {
        std::vector<bool> member(model.beams.size());
        for (Index beam : given.beams) member[beam] = true;
        Preload preload{&given, std::vector<LaneMask>(patches.batch_count()), 0, true, false, false};
        bool some = false;
        for (Index batch = 0; batch < patches.batch_count(); ++batch) {
            for (int lane = 0; lane < lane_count; ++lane) {
                const bool here = member[patches.elements[batch * lane_count + lane]];
                preload.mask[batch][lane] = here ? -1 : 0;
                some = some || here;
            }
        }
        if (some) preloads_.push_back(std::move(preload));
    }
}

void BeamStore::start_cycle(const Clock& clock)
{
    const TimeControls& control = model.controls.time;
    if (clock.cycle == 1 && control.erode_small_beams)
        shortest_step = control.smallest_step_factor * clock.last_step / control.step_scale;
    for (Preload& preload : preloads_) {
        if (!preload.active || !acts_now(model, preload.given->curve, clock)) {
            preload.acts = false;
            continue;
        }
        preload.acts = true;
        const double force = preload.given->scale * curve_value(model, preload.given->curve, clock.time);
        const bool over = preload.given->curve != none &&
                          clock.time > model.curves[preload.given->curve].curve.abscissa.back();
        // The preload ends with its curve, or when the curve has come back to zero (keyword manual).
        if (over || (force == 0 && preload.has_acted)) preload.active = false;
        if (force != 0) preload.has_acted = true;
        preload.stress = force / settings.section.area;
    }
}

void BeamStore::begin_phase()
{
    for (Preload& preload : preloads_) {
        preload.active = true;
        preload.has_acted = false;
    }
}

BeamPrescription<Lanes> BeamStore::prescription(Index batch) const
{
    BeamPrescription<Lanes> result;
    for (const Preload& preload : preloads_) {
        if (!preload.active || !preload.acts) continue;
        const LaneMask& mask = preload.mask[batch];
        result.active |= mask;
        result.stress = mask ? broadcast<Lanes>(preload.stress) : result.stress;
        result.keeps_bending = preload.given->keeps_bending;
    }
    return result;
}

Lanes BeamStore::stable_step(Index batch, const Lanes& length) const
{
    const Lanes factor = record(batch)[beam_record::mass_factor];
    const BeamSection& section = settings.section;
    Lanes step = (1 / settings.wave_speed) * length;
    if (section.formulation == 2) {
        // Bending: 0.5 L / (c sqrt(3 I (3 / (12 I + A L^2) + 1 / (A L^2)))), the deflection mode with the
        // inertias of beam_mass (Hallquist 2006, 'Time step calculations for beam elements').
        const double inertia = section.larger_inertia();
        const Lanes square = section.area * length * length;
        const Lanes bending = (0.5 / settings.wave_speed) * length /
                              sqrt(3 * inertia * (3.0 / (12 * inertia + square) + 1.0 / square));
        step = min(step, bending);
    }
    return factor > 0.0 ? step * sqrt(factor) : broadcast<Lanes>(std::numeric_limits<double>::infinity());
}

BeamMass BeamStore::mass_of(Index element) const
{
    const double ratio =
        settings.section.formulation == 3 || settings.section.formulation == 2
            ? 0
            : settings.section.shear_factor * settings.shear_modulus / settings.young_modulus;
    return beam_mass(settings.section, settings.density, length_of(model, element), ratio,
                     model.controls.time.step_scale);
}

void BeamStore::add_masses(State& state) const
{
    for (Index i = 0; i < patches.element_count; ++i) {
        const Index element = patches.elements[i];
        const BeamMass share = mass_of(element);
        for (int end = 0; end < 2; ++end) {
            const Index node = model.beams.nodes[element][end];
            state.mass[node] += share.mass;
            if (settings.section.formulation != 3) state.inertia[node] += share.inertia;
        }
    }
}

double BeamStore::scale_mass(double step, bool only_small, State& state)
{
    double added = 0;
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        Lanes length{};
        for (int lane = 0; lane < lane_count; ++lane) {
            length[lane] = length_of(model, patches.elements[batch * lane_count + lane]);
        }
        const Lanes own = stable_step(batch, length);
        Lanes& factors = record(batch)[beam_record::mass_factor];
        for (int lane = 0; lane < patches.active_lanes(batch); ++lane) {
            const double ratio = step / own[lane];
            if (only_small && ratio <= 1) continue;
            const Index element = patches.elements[batch * lane_count + lane];
            const BeamMass share = mass_of(element);
            const double before = factors[lane];
            factors[lane] *= ratio * ratio;
            const double more = factors[lane] - before;
            for (int end = 0; end < 2; ++end) {
                const Index node = model.beams.nodes[element][end];
                state.mass[node] += more * share.mass;
                if (settings.section.formulation != 3) state.inertia[node] += more * share.inertia;
                added += more * share.mass;
            }
        }
    }
    return added;
}

void BeamStore::erode(const ElementLoss& loss, PatchSums& patch_sums, State& state)
{
    const std::size_t place = loss.place;
    Lanes* values = record(static_cast<Index>(place / lane_count));
    const auto lane = static_cast<int>(place % lane_count);
    patch_sums.internal -= values[beam_record::internal_energy][lane];
    eroded_internal_ += values[beam_record::internal_energy][lane] + loss.missing_work;
    values[beam_record::mass_factor][lane] = 0;
    for (int i = 0; i < 6; ++i) values[beam_record::resultant + i][lane] = 0;
    state.deleted_beams.resize(model.beams.size());
    state.deleted_beams[patches.elements[place]] = 1;
    ++state.deletions;
}

void BeamStore::close_cycle(State& state)
{
    check_finite();
    for (PatchSums& patch : sums) {
        for (const ElementLoss& loss : patch.lost) erode(loss, patch, state);
        patch.lost.clear();
    }
}

void BeamStore::check_finite() const
{
    bool finite = true;
    for (const PatchSums& patch : sums) finite = finite && std::isfinite(patch.internal);
    if (finite) return;
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        for (int lane = 0; lane < patches.active_lanes(batch); ++lane) {
            if (std::isfinite(record(batch)[beam_record::internal_energy][lane])) continue;
            const Index element = patches.elements[batch * lane_count + lane];
            const Vec3& place = model.nodes.position[model.beams.nodes[element][0]];
            throw RunError(fmt::format("beam {} of part {} '{}' has an energy that is no finite number (it "
                                       "started near ({:.6g}, {:.6g}, {:.6g}))",
                                       model.beams.id[element], model.parts[part].id, model.parts[part].title,
                                       place.x, place.y, place.z));
        }
    }
}

StepVote BeamStore::vote() const
{
    const PatchSums* shortest = nullptr;
    for (const PatchSums& patch : sums) {
        if (!shortest || patch.step < shortest->step) shortest = &patch;
    }
    if (!shortest || !std::isfinite(shortest->step)) return StepVote::nothing();
    return {shortest->step, "beam", model.beams.id[patches.elements[shortest->place]], model.parts[part].id};
}

void BeamStore::report(EnergyLedger& ledger) const
{
    double internal = 0;
    for (const PatchSums& patch : sums) {
        internal += patch.internal;
        ledger.preload_work += patch.preload;
    }
    ledger.add_part(part, internal, 0);
    ledger.eroded_internal += eroded_internal_;
}

void BeamStore::collect(const State& state, ElementResults& results) const
{
    const bool elements =
        !results.beams.empty() || !results.beam_stress.empty() || !results.beam_deleted.empty();
    const bool motion = !results.part_motion.empty();
    if (elements || motion) {
        collect_patches(patches, part, results,
                        [&](const Patches::Patch&, Index batch, int lane, ElementResults::PartMotion& sum) {
                            if (elements) collect_element(state, batch, lane, results);
                            if (motion) collect_motion(state, batch, lane, sum);
                        });
    }
    if (!results.part_motion.empty()) results.part_motion[part].eroded_internal += eroded_internal_;
    if (results.steps_wanted) collect_steps(state, results);
}

void BeamStore::collect_steps(const State& state, ElementResults& results) const
{
    for (Index batch = 0; batch < patches.batch_count(); ++batch) {
        Lanes length{};
        for (int lane = 0; lane < lane_count; ++lane) {
            const auto& nodes = model.beams.nodes[patches.elements[batch * lane_count + lane]];
            length[lane] = norm(state.position[nodes[1]] - state.position[nodes[0]]);
        }
        const Lanes step = stable_step(batch, length);
        for (int lane = 0; lane < patches.active_lanes(batch); ++lane) {
            const Index element = patches.elements[batch * lane_count + lane];
            add_step(results, {"beam", model.beams.id[element], model.parts[part].id, step[lane]});
        }
    }
}

void BeamStore::collect_element(const State& state, Index batch, int lane, ElementResults& results) const
{
    using namespace beam_record;
    const Index element = patches.elements[batch * lane_count + lane];
    const Index row = results.row_of_beam(element);
    if (row == none) return;
    const Lanes* values = record(batch);
    const bool deleted = values[mass_factor][lane] == 0;
    if (!results.beam_deleted.empty()) results.beam_deleted[row] = deleted;
    const auto point_value = [&](int point, int variable) {
        return values[points_.first + point * points_.size + variable][lane];
    };
    const auto plastic_strain = [&](int point) {
        return points_.plastic_strain == none ? 0 : point_value(point, 3 + points_.plastic_strain);
    };
    if (deleted) return; // its record goes on without meaning
    if (!results.beams.empty()) {
        const auto& nodes = model.beams.nodes[element];
        ElementResults::BeamState& beam = results.beams[row];
        beam.length = norm(state.position[nodes[1]] - state.position[nodes[0]]);
        const BeamMode<double> mode{values[resultant][lane],     values[resultant + 1][lane],
                                    values[resultant + 2][lane], values[resultant + 3][lane],
                                    values[resultant + 4][lane], values[resultant + 5][lane]};
        beam.axial = mode.stretch;
        beam.torsion = mode.twist;
        beam.moment_s = mode.bend_s;
        beam.moment_t = mode.bend_t;
        beam.shear_s = -mode.sway_t / beam.length;
        beam.shear_t = mode.sway_s / beam.length;
        beam.plastic_strain = 0;
        beam.points = points_.count;
        for (int point = 0; point < points_.count; ++point) {
            beam.plastic_strain = std::max(beam.plastic_strain, plastic_strain(point));
        }
    }
    for (int point = 0; point < std::min(results.beam_points, points_.count); ++point) {
        results.beam_stress[static_cast<std::size_t>(row) * results.beam_points + point] = {
            point_value(point, 0), point_value(point, 1), point_value(point, 2), plastic_strain(point)};
    }
}

void BeamStore::collect_motion(const State& state, Index batch, int lane,
                               ElementResults::PartMotion& motion) const
{
    const double factor = record(batch)[beam_record::mass_factor][lane];
    if (factor == 0) return;
    const Index element = patches.elements[batch * lane_count + lane];
    const double mass = factor * mass_of(element).mass;
    for (int end = 0; end < 2; ++end)
        add_motion(mass, state.velocity[model.beams.nodes[element][end]], motion);
}

} // namespace plash

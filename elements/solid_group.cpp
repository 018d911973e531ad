#include "elements/solid_group.h"

#include "core/run_error.h"
#include "core/smallest_steps.h"
#include "elements/collect_patches.h"
#include "elements/solid_strain.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace plash {

namespace {

constexpr double no_step = std::numeric_limits<double>::infinity();

/// Elements a patch. Long ones share fewer nodes, and 1024 elements with their nodes still stay in
/// second-level cache (docs/results/speed.md); small meshes are cut finer, so that every thread gets some.
int patch_length_of(std::size_t elements)
{
    const std::size_t sixteenth = elements / (16 * lane_count) * lane_count;
    return static_cast<int>(std::clamp<std::size_t>(sixteenth, 128, 1024));
}

/// One in the first `active` lanes, zero in the others.
Lanes first_lanes(int active)
{
    Lanes result{};
    for (int lane = 0; lane < active; ++lane) result[lane] = 1;
    return result;
}

} // namespace

SolidGroup::SolidGroup(SolidSetup setup, const State& state, int history_size, int constant_count,
                       int plastic_strain_place)
    : setup_(std::move(setup)),
      patches_(setup_.corner_count(), setup_.elements, setup_.connectivity, state.position,
               patch_length_of(setup_.elements.size())),
      section_watch_(setup_.model, setup_.thick_shells ? &CrossSection::thick_shells : &CrossSection::solids,
                     setup_.bricks().size(), patches_),
      sums_(patches_.patches.size()),
      smallest_step_(setup_.shortest_step),
      name_(fmt::format("{}s of part {}", setup_.kind(), setup_.model.parts[setup_.part].id)),
      history_size_(history_size),
      constant_count_(constant_count),
      plastic_strain_(plastic_strain_place),
      history_(static_cast<std::size_t>(patches_.batch_count()) * history_size),
      constants_(static_cast<std::size_t>(patches_.batch_count()) * constant_count)
{
    setup_.connectivity = {}; // the patches have it now
    setup_.elements = {};
    const Model& model = setup_.model;
    if (model.controls.output.strains() && !setup_.thick_shells) {
        strain_.resize(6 * static_cast<std::size_t>(patches_.batch_count()));
        take_initial_strains();
    }
    const Index material = model.parts[setup_.part].material;
    if (material == none) return;
    if (const auto criteria = erosion_criteria(model, model.materials[material])) {
        erosion_.emplace(*criteria, patches_.batch_count());
    }
}

Index SolidGroup::corner(const Patches::Patch& patch, std::size_t place, int corner) const
{
    const std::uint16_t* offset = patches_.corner_offsets(static_cast<Index>(place / lane_count), corner);
    return patches_.nodes[patch.first_node + offset[place % lane_count] / 4];
}

const Patches::Patch& SolidGroup::patch_of(std::size_t place) const
{
    const auto batch = static_cast<Index>(place / lane_count);
    return *std::prev(
        std::upper_bound(patches_.patches.begin(), patches_.patches.end(), batch,
                         [](Index value, const Patches::Patch& patch) { return value < patch.first_batch; }));
}

std::string SolidGroup::describe(std::size_t place, const std::vector<Vec3>& position) const
{
    const Patches::Patch& patch = patch_of(place);
    Vec3 centre{};
    const int corners = setup_.corner_count();
    for (int i = 0; i < corners; ++i) centre += (1.0 / corners) * position[corner(patch, place, i)];
    const Part& part = setup_.model.parts[setup_.part];
    return fmt::format("{} {} of part {} '{}' near ({:.6g}, {:.6g}, {:.6g})", setup_.kind(),
                       setup_.bricks().id[element_of(place)], part.id, part.title, centre.x, centre.y,
                       centre.z);
}

void SolidGroup::start_batch(Index batch, const Lanes& volume, const SolidModes<Lanes>& position,
                             const State& state)
{
    if (erosion_) erosion_->start(batch, position);
    for (int lane = 0; lane < lane_count; ++lane) {
        if (volume[lane] > 0) continue;
        const std::size_t place = static_cast<std::size_t>(batch) * lane_count + lane;
        throw DeckError(setup_.model.parts[setup_.part].where,
                        fmt::format("{} has the volume {:.6g}: check its node numbering (nodes 1-4 "
                                    "counter-clockwise as seen from nodes 5-8) and its nodes' positions",
                                    describe(place, state.position), volume[lane]));
    }
    const Lanes reference = volume / setup_.initial_relative_volume;
    constants_of(batch)[inverse_volume_constant] = 1.0 / reference;
    constants_of(batch)[mass_constant] = setup_.parameters.density * reference;
}

SolidGroup::Corners SolidGroup::distinct_corners(const Patches::Patch& patch, std::size_t place) const
{
    Corners corners{};
    for (int i = 0; i < setup_.corner_count(); ++i) corners.node[i] = corner(patch, place, i);
    if (const TenNodeRule* rule = setup_.ten_nodes) {
        corners.count = 10;
        corners.share.fill(rule->edge_mass());
        std::fill_n(corners.share.begin(), 4, rule->corner_mass);
        return corners;
    }
    const auto end = corners.node.begin() + 8;
    std::sort(corners.node.begin(), end);
    corners.count = static_cast<int>(std::unique(corners.node.begin(), end) - corners.node.begin());
    corners.share.fill(1.0 / corners.count);
    return corners;
}

SolidModes<Lanes> SolidGroup::start_position(const Patches::Patch& patch, Index batch,
                                             const State& state) const
{
    Vector3<Lanes> corners[8];
    start_corners(patch, batch, state, corners);
    return modes_of(corners);
}

template <int Count>
void SolidGroup::start_corners(const Patches::Patch& patch, Index batch, const State& state,
                               Vector3<Lanes> (&corners)[Count]) const
{
    for (int i = 0; i < Count; ++i) {
        for (int lane = 0; lane < lane_count; ++lane) {
            const Vec3& p =
                state.position[corner(patch, static_cast<std::size_t>(batch) * lane_count + lane, i)];
            corners[i].x[lane] = p.x;
            corners[i].y[lane] = p.y;
            corners[i].z[lane] = p.z;
        }
    }
}

template void SolidGroup::start_corners(const Patches::Patch&, Index, const State&,
                                        Vector3<Lanes> (&)[10]) const;

Vector3<Lanes> SolidGroup::start_centre(const Patches::Patch& patch, Index batch, const State& state) const
{
    Vector3<Lanes> centre{};
    for (int lane = 0; lane < lane_count; ++lane) {
        Vec3 sum{};
        const int corners = setup_.corner_count();
        for (int i = 0; i < corners; ++i)
            sum += state.position[corner(patch, static_cast<std::size_t>(batch) * lane_count + lane, i)];
        centre.x[lane] = sum.x / corners;
        centre.y[lane] = sum.y / corners;
        centre.z[lane] = sum.z / corners;
    }
    return centre;
}

void SolidGroup::finish_start(std::vector<double> first_step, State& state)
{
    first_step_ = std::move(first_step);
    for_each_element([&](const Patches::Patch& patch, std::size_t place) {
        const Corners corners = distinct_corners(patch, place);
        const double mass = constant_of(place, mass_constant);
        for (int i = 0; i < corners.count; ++i) state.mass[corners.node[i]] += corners.share[i] * mass;
    });
    // The step of ten-node tetrahedra is that of an element alone.
    if (!setup_.ten_nodes) hold_back_loose_elements(state);
}

void SolidGroup::take_initial_stresses(const StressPlaces& places)
{
    stress_places_ = places;
    if (!setup_.initial_stresses || setup_.initial_stresses->empty()) return;
    for_each_element([&](const Patches::Patch&, std::size_t place) {
        const auto found = setup_.initial_stresses->find(static_cast<Index>(element_of(place)));
        if (found == setup_.initial_stresses->end()) return;
        if (places.free) return put_initial_stress(place, found->second, places);
        const Part& part = setup_.model.parts[setup_.part];
        throw DeckError(
            found->second.where,
            fmt::format("*INITIAL_STRESS_SOLID: the stress of *{} (part {}) follows from its deformation "
                        "or its equation of state, and cannot be given",
                        setup_.model.materials[part.material].keyword, part.id));
    });
}

void SolidGroup::put_initial_stress(std::size_t place, const InitialStress& initial,
                                    const StressPlaces& places)
{
    Lanes* history = history_of(static_cast<Index>(place / lane_count));
    const int lane = static_cast<int>(place % lane_count);
    const std::size_t given = initial.points.size();
    const InitialStressPoint mean = mean_of(initial);
    put_stress(mean.stress, history, lane);
    if (plastic_strain_ >= 0) history[point_history + plastic_strain_][lane] = mean.plastic_strain;
    if (places.points == 1) return;
    if (given != 1 && given != static_cast<std::size_t>(places.points)) {
        throw DeckError(initial.where,
                        fmt::format("*INITIAL_STRESS_SOLID, field NINT: {} points for an element that "
                                    "has {} (1 or {})",
                                    given, places.points, places.points));
    }
    // The deck lists points in the order of the corners next to them.
    constexpr int corner_of[] = {0, 1, 3, 2, 4, 5, 7, 6}; // of the points of gauss_point()
    for (int i = 0; i < places.points; ++i) {
        Lanes* point = history + places.first + i * places.size;
        const int listed = places.points == ten_points ? i : corner_of[i];
        const InitialStressPoint& one = initial.points[given == 1 ? 0 : listed];
        put_stress(one.stress, point, lane);
        if (places.plastic_strain >= 0) point[6 + places.plastic_strain][lane] = one.plastic_strain;
    }
}

/// *INITIAL_STRAIN_SOLID: nothing but what result files show begins with it.
void SolidGroup::take_initial_strains()
{
    if (!setup_.initial_strains || setup_.initial_strains->empty()) return;
    for_each_element([&](const Patches::Patch&, std::size_t place) {
        const auto found = setup_.initial_strains->find(static_cast<Index>(element_of(place)));
        if (found == setup_.initial_strains->end()) return;
        put_stress(mean_of(found->second).stress, &strain_[6 * (place / lane_count)],
                   static_cast<int>(place % lane_count));
    });
}

void SolidGroup::add_strains(const Patches::Patch& patch, const NodeCopies& nodes, double time_step)
{
    for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch)
        add_strain_of(batch, nodes, time_step);
}

void SolidGroup::add_strain_of(Index batch, const NodeCopies& nodes, double time_step)
{
    Lanes* strain = &strain_[6 * static_cast<std::size_t>(batch)];
    if (setup_.ten_nodes) {
        Vector3<Lanes> x[10], v[10];
        for (int i = 0; i < 10; ++i) {
            v[i] = load_corner<Lanes>(nodes.velocity.data(), patches_.corner_offsets(batch, i));
            x[i] = load_corner<Lanes>(nodes.position.data(), patches_.corner_offsets(batch, i)) -
                   broadcast<Lanes>(0.5 * time_step) * v[i];
        }
        const TenNodeRule& rule = *setup_.ten_nodes;
        add_strain(mean_gradient(ten_node_modes(rule, x), ten_node_modes(rule, v)), time_step, strain);
        return;
    }
    const SolidModes<Lanes> velocity = modes_at(batch, nodes.velocity);
    const SolidModes<Lanes> middle = moved(modes_at(batch, nodes.position), -0.5 * time_step, velocity);
    const bool centre = setup_.rule == SolidGradientRule::centre && !setup_.eight_points;
    add_strain(centre ? mean_gradient<SolidGradientRule::centre>(middle, velocity)
                      : mean_gradient<SolidGradientRule::mean>(middle, velocity),
               time_step, strain);
}

/// History variable `number` (from 0) of an element as result files show it: the mean of its points.
double SolidGroup::shown_value(std::size_t place, int number) const
{
    const StressPlaces& places = stress_places_;
    if (number >= static_cast<int>(places.shown.size())) return 0;
    const ShownVariable& shown = places.shown[number];
    if (shown.variable < 0) return 0;
    const Lanes* history = history_of(static_cast<Index>(place / lane_count));
    const int lane = static_cast<int>(place % lane_count);
    if (places.points == 1) return history[point_history + shown.variable][lane] - shown.start;
    double sum = 0;
    for (int point = 0; point < places.points; ++point)
        sum += history[places.first + point * places.size + 6 + shown.variable][lane];
    return sum / places.points - shown.start;
}

void SolidGroup::collect_point_results(std::size_t place, Index row, ElementResults& results) const
{
    if (!is_alive(place)) return;
    if (!results.solid_history.empty()) {
        for (int i = 0; i < results.solid_history_size; ++i)
            results.solid_history[static_cast<std::size_t>(row) * results.solid_history_size + i] =
                shown_value(place, i);
    }
    if (!results.solid_strain.empty() && !strain_.empty()) {
        const Lanes* s = &strain_[6 * (place / lane_count)];
        const std::size_t lane = place % lane_count;
        results.solid_strain[row] = {s[0][lane], s[1][lane], s[2][lane], s[3][lane], s[4][lane], s[5][lane]};
    }
}

double SolidGroup::mass() const
{
    double sum = 0;
    for_each_element(
        [&](const Patches::Patch&, std::size_t place) { sum += constant_of(place, mass_constant); });
    return sum;
}

template <class Take>
void SolidGroup::scale_steps(double step, bool only_small, Take&& take)
{
    if (step_factor_.empty()) step_factor_.assign(patches_.batch_count(), broadcast<Lanes>(1));
    for_each_element([&](const Patches::Patch& patch, std::size_t place) {
        const double factor = step / first_step_[place];
        if (only_small && factor <= 1) return;
        step_factor_[place / lane_count][place % lane_count] *= factor;
        if (!step_limit_.empty()) step_limit_[place / lane_count][place % lane_count] *= factor;
        first_step_[place] = step;
        take(place, distinct_corners(patch, place),
             (factor * factor - 1) * constant_of(place, mass_constant));
    });
}

double SolidGroup::scale_mass(double step, bool only_small, State& state)
{
    double added = 0;
    scale_steps(step, only_small, [&](std::size_t, const Corners& corners, double extra) {
        added += extra;
        for (int i = 0; i < corners.count; ++i) state.mass[corners.node[i]] += corners.share[i] * extra;
    });
    return added;
}

bool SolidGroup::scale_selectively(double step, bool only_small, const State&, SelectiveMasses& masses)
{
    scale_steps(step, only_small, [&](std::size_t place, const Corners& corners, double extra) {
        masses.begin(SelectiveMasses::Kind::brick, brick_number(place));
        for (int i = 0; i < corners.count; ++i)
            masses.corners.push_back({corners.node[i], corners.share[i] * extra});
    });
    return true;
}

Index SolidGroup::brick_number(std::size_t place) const
{
    const std::size_t before = setup_.thick_shells ? setup_.model.solids.size() : 0;
    return static_cast<Index>(before) + element_of(place);
}

void SolidGroup::start_cycle(const Clock& clock)
{
    time_ = clock.time;
    last_step_ = clock.last_step;
    const TimeControls& control = setup_.model.controls.time;
    if (clock.cycle != 1 || !control.erode_small_step) return;
    smallest_step_ =
        std::max(smallest_step_, control.smallest_step_factor * clock.last_step / control.step_scale);
}

void SolidGroup::take(Index batch, const SolidModes<Lanes>& position, const NodeCopies& nodes,
                      SolidResult<Lanes>& result, PatchSum& sum)
{
    const LaneMask silent = take_vote(batch, position, result.vote, sum);
    if (!any(silent)) return;
    Lanes power{};
    for_corners(result.force, [&](int corner, const Vector3<Lanes>& force) {
        const std::uint16_t* offsets = patches_.corner_offsets(batch, corner);
        power += dot(force, load_corner<Lanes>(nodes.velocity.data(), offsets));
    });
    book_missing_work(batch, power, sum);
    const auto clear = [&](Vector3<Lanes>& force) {
        force = {silent ? Lanes{} : force.x, silent ? Lanes{} : force.y, silent ? Lanes{} : force.z};
    };
    for (auto& force : result.force.linear) clear(force);
    for (auto& force : result.force.hourglass) clear(force);
}

void SolidGroup::book_missing_work(Index batch, const Lanes& power, PatchSum& sum) const
{
    const auto first = static_cast<std::size_t>(batch) * lane_count;
    for (auto loss = sum.lost.rbegin(); loss != sum.lost.rend() && loss->place >= first; ++loss)
        loss->missing_work = 0.5 * last_step_ * power[loss->place - first];
}

LaneMask SolidGroup::take_vote(Index batch, const SolidModes<Lanes>& position, SolidVote<Lanes>& vote,
                               PatchSum& sum)
{
    if (!step_factor_.empty()) vote.stable_step *= step_factor_[batch];
    if (!step_limit_.empty()) vote.stable_step = min(vote.stable_step, step_limit_[batch]);
    const LaneMask dead = alive_.empty() ? LaneMask{} : alive_[batch] == 0.0;
    if (erosion_) vote.failed |= erosion_->lost(batch, position, history_of(batch), time_, last_step_);
    const LaneMask lost = (vote.inverted | vote.failed | (vote.stable_step < smallest_step_)) & ~dead;
    const LaneMask silent = dead | lost;
    if (any(silent)) silence(batch, dead, silent, vote);
    const int active = patches_.active_lanes(batch);
    const auto place_of = [&](int lane) { return static_cast<std::size_t>(batch) * lane_count + lane; };
    if (any(lost)) {
        for (int lane = 0; lane < active; ++lane) {
            if (!lost[lane]) continue;
            if (vote.inverted[lane]) {
                sum.inverted.push_back(place_of(lane));
            } else {
                sum.lost.push_back({place_of(lane), 0});
            }
        }
    }
    const Lanes* history = history_of(batch);
    const Lanes counted = active == lane_count ? broadcast<Lanes>(1) : first_lanes(active);
    sum.internal += counted * history[internal_energy_history];
    sum.hourglass += counted * history[hourglass_energy_history];
    sum.viscous += counted * vote.viscous_work;
    if (any(vote.stable_step < sum.step)) {
        for (int lane = 0; lane < active; ++lane) {
            if (vote.stable_step[lane] >= sum.step) continue;
            sum.step = vote.stable_step[lane];
            sum.place = place_of(lane);
        }
    }
    return silent;
}

void SolidGroup::silence(Index batch, const LaneMask& dead, const LaneMask& silent, SolidVote<Lanes>& vote)
{
    for (int i = 0; i < history_size_; ++i) history_of(batch)[i] = dead ? Lanes{} : history_of(batch)[i];
    vote.viscous_work = silent ? Lanes{} : vote.viscous_work;
    vote.stable_step = silent ? broadcast<Lanes>(no_step) : vote.stable_step;
}

void SolidGroup::erase(const ElementLoss& loss, State& state)
{
    const std::size_t place = loss.place;
    const Model& model = setup_.model;
    state.deleted_solids.resize(brick_count(model));
    state.deleted_solids[brick_number(place)] = 1;
    ++state.deletions;
    if (state.keeps_lost_solids && !setup_.thick_shells) state.lost_solids.push_back(lost_solid(place));
    if (alive_.empty()) alive_.assign(patches_.batch_count(), broadcast<Lanes>(1));
    const auto batch = static_cast<Index>(place / lane_count);
    const int lane = static_cast<int>(place % lane_count);
    Lanes* history = history_of(batch);
    eroded_internal_ += history[internal_energy_history][lane] + loss.missing_work;
    eroded_hourglass_ += history[hourglass_energy_history][lane];
    internal_ -= history[internal_energy_history][lane];
    hourglass_ -= history[hourglass_energy_history][lane];
    alive_[batch][lane] = 0;
    for (int i = 0; i < history_size_; ++i) history[i][lane] = 0;
}

LostSolid SolidGroup::lost_solid(std::size_t place) const
{
    LostSolid lost;
    lost.solid = static_cast<Index>(element_of(place));
    const Corners corners = distinct_corners(patch_of(place), place);
    for (int i = 0; i < corners.count; ++i)
        lost.masses.emplace_back(corners.node[i], corners.share[i] * constant_of(place, mass_constant));
    const Lanes* history = history_of(static_cast<Index>(place / lane_count));
    const int lane = static_cast<int>(place % lane_count);
    lost.stress = {history[0][lane], history[1][lane], history[2][lane],
                   history[3][lane], history[4][lane], history[5][lane]};
    lost.internal = history[internal_energy_history][lane];
    const int points = stress_places_.points;
    const int first = points == 1 ? point_history : stress_places_.first + 6;
    const int size = points == 1 ? history_size_ - point_history : stress_places_.size - 6;
    for (int variable = 0; variable < size; ++variable) {
        double sum = 0;
        for (int point = 0; point < points; ++point)
            sum += history[first + point * stress_places_.size + variable][lane];
        lost.history.push_back(sum / points);
    }
    return lost;
}

void SolidGroup::close_cycle(State& state)
{
    internal_ = hourglass_ = 0;
    PatchSum smallest;
    smallest.step = no_step;
    for (const PatchSum& sum : sums_) {
        for (int lane = 0; lane < lane_count; ++lane) {
            internal_ += sum.internal[lane];
            hourglass_ += sum.hourglass[lane];
            viscous_ += sum.viscous[lane];
        }
        if (sum.step < smallest.step) {
            smallest.step = sum.step;
            smallest.place = sum.place;
        }
    }
    for (const PatchSum& sum : sums_) {
        if (!sum.inverted.empty() && !setup_.erode_inverted) {
            throw RunError(describe(sum.inverted.front(), state.position) +
                           " has no positive volume any more");
        }
        for (std::size_t place : sum.inverted) erase({place, 0}, state);
        for (const ElementLoss& loss : sum.lost) erase(loss, state);
    }
    const Part& part = setup_.model.parts[setup_.part];
    vote_ = smallest.step == no_step ? StepVote::nothing()
                                     : StepVote{smallest.step, setup_.kind(),
                                                setup_.bricks().id[element_of(smallest.place)], part.id};
}

std::vector<std::string> SolidGroup::notices(const State&) const
{
    if (setup_.notice.empty()) return {};
    return {setup_.notice};
}

void SolidGroup::report(EnergyLedger& ledger) const
{
    ledger.add_part(setup_.part, internal_, hourglass_);
    ledger.bulk_viscosity += viscous_;
    ledger.eroded_internal += eroded_internal_;
    ledger.eroded_hourglass += eroded_hourglass_;
}

void SolidGroup::serialise(Archive& archive)
{
    archive(smallest_step_, history_, strain_, alive_, viscous_, eroded_internal_, eroded_hourglass_);
}

void SolidGroup::collect(const State& state, ElementResults& results) const
{
    section_watch_.collect(patches_, state, results);
    if (!results.part_motion.empty()) results.part_motion[setup_.part].eroded_internal += eroded_internal_;
    if (results.steps_wanted) {
        for_each_element([&](const Patches::Patch&, std::size_t place) {
            add_step(results, {setup_.kind(), setup_.bricks().id[element_of(place)],
                               setup_.model.parts[setup_.part].id, first_step_[place]});
        });
    }
    collect_patches(
        patches_, setup_.part, results,
        [&](const Patches::Patch& patch, Index batch, int lane, ElementResults::PartMotion& motion) {
            const std::size_t place = static_cast<std::size_t>(batch) * lane_count + lane;
            const Lanes* history = history_of(batch);
            const Index row =
                setup_.thick_shells ? none : results.row_of_solid(static_cast<Index>(element_of(place)));
            const bool wanted = row != none;
            collect_points(patch, place, state, results);
            if (wanted && !results.solid_stress.empty()) {
                results.solid_stress[row] = {history[0][lane], history[1][lane], history[2][lane],
                                             history[3][lane], history[4][lane], history[5][lane]};
            }
            if (wanted && !results.solid_plastic_strain.empty()) {
                results.solid_plastic_strain[row] =
                    plastic_strain_ < 0 ? 0 : history[point_history + plastic_strain_][lane];
            }
            if (wanted) collect_point_results(place, row, results);
            if (wanted && !results.solid_deleted.empty()) results.solid_deleted[row] = !is_alive(place);
            if (results.part_motion.empty() || !is_alive(place)) return;
            const double mass = constant_of(place, mass_constant);
            const Corners corners = distinct_corners(patch, place);
            for (int i = 0; i < corners.count; ++i)
                add_motion(corners.share[i] * mass, state.velocity[corners.node[i]], motion);
        });
}

} // namespace plash

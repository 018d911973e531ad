#pragma once

#include "elements/beam_store.h"

namespace plash {

/// Beams of one part in one formulation (elements/beam_kernel.h) and one material law.
template <class Formulation, class Law>
class BeamGroup : public Term {
public:
    /// Adds the elements' masses and rotary inertias to the state.
    BeamGroup(const BeamPart& part, State& state, BeamSettings settings, Law law)
        : law_(std::move(law)),
          store_(part, state, settings, Formulation::template record_size<Law>(settings.section),
                 point_layout(settings.section), law_.initial_history())
    {
        store_.add_masses(state);
    }

    void serialise(Archive& archive) override { store_.serialise(archive); }
    void begin_phase(bool, State&) override { store_.begin_phase(); }
    std::string_view name() const override { return store_.name; }
    std::size_t items() const override { return store_.patches.element_count; }
    StepVote stable_step() const override { return store_.vote(); }
    double scale_mass(double step, bool only_small, State& state) override
    {
        return store_.scale_mass(step, only_small, state);
    }
    void report(EnergyLedger& ledger) const override { store_.report(ledger); }
    void collect(const State& state, ElementResults& results) const override
    {
        store_.collect(state, results);
    }

    void add_forces(const Clock& clock, State& state) override
    {
        store_.start_cycle(clock);
        store_.patches.for_each(state, Formulation::rotates,
                                [&](std::ptrdiff_t number, const Patches::Patch& patch, NodeCopies& copies) {
                                    work_on_patch(clock, patch, copies, store_.sums[number]);
                                });
        store_.close_cycle(state);
    }

private:
    Law law_;
    BeamStore store_;

    static BeamStore::PointLayout point_layout(const BeamSection& section)
    {
        const int size = 3 + static_cast<int>(Law::history_size);
        const int records = Formulation::template record_size<Law>(section) - beam_record::own;
        BeamStore::PointLayout layout{beam_record::own, size, records / size, none};
        if constexpr (requires { Law::plastic_strain; }) layout.plastic_strain = Law::plastic_strain;
        return layout;
    }

    void work_on_patch(const Clock& clock, const Patches::Patch& patch, NodeCopies& copies,
                       BeamStore::PatchSums& sums)
    {
        sums.step = std::numeric_limits<double>::infinity();
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            const std::uint16_t* first = store_.patches.corner_offsets(batch, 0);
            const std::uint16_t* second = store_.patches.corner_offsets(batch, 1);
            const auto load = [](const NodeCopies::Values& values, const std::uint16_t* offsets) {
                return load_corner<Lanes>(values.data(), offsets);
            };
            BeamEnds<Lanes> ends;
            ends.side = load(copies.position, second) - load(copies.position, first);
            ends.velocity = load(copies.velocity, second) - load(copies.velocity, first);
            if constexpr (Formulation::rotates) {
                const Vector3<Lanes> one = load(copies.angular_velocity, first);
                const Vector3<Lanes> two = load(copies.angular_velocity, second);
                ends.mean_spin = broadcast<Lanes>(0.5) * (one + two);
                ends.spin = two - one;
            }
            Lanes* record = store_.record(batch);
            BeamStep<Lanes> step = beam_step<Formulation>(
                store_.settings, law_, ends, store_.prescription(batch), clock.last_step, record);
            const LaneMask alive = record[beam_record::mass_factor] > 0.0;
            silence_forces(alive, step);
            step.internal_work = alive ? step.internal_work : Lanes{};
            step.preload_work = alive ? step.preload_work : Lanes{};
            record[beam_record::internal_energy] += step.internal_work;

            const int active = store_.patches.active_lanes(batch);
            const LaneMask lost = lost_in(clock, batch, step) & alive;
            if (any(lost)) take_out(batch, active, lost, ends, clock.last_step, step, sums);
            add_corner(copies.force.data(), first, -step.forces.force, active);
            add_corner(copies.force.data(), second, step.forces.force, active);
            if constexpr (Formulation::rotates) {
                add_corner(copies.moment.data(), first, step.forces.moment1, active);
                add_corner(copies.moment.data(), second, step.forces.moment2, active);
            }
            const Lanes stable = store_.stable_step(batch, step.length);
            for (int lane = 0; lane < active; ++lane) {
                sums.internal += step.internal_work[lane];
                sums.preload += step.preload_work[lane];
                if (lost[lane] || stable[lane] >= sums.step) continue;
                sums.step = stable[lane];
                sums.place = batch * lane_count + lane;
            }
        }
    }

    static void silence_forces(const LaneMask& alive, BeamStep<Lanes>& step)
    {
        for (Vector3<Lanes>* vector : {&step.forces.force, &step.forces.moment1, &step.forces.moment2}) {
            *vector = {alive ? vector->x : Lanes{}, alive ? vector->y : Lanes{}, alive ? vector->z : Lanes{}};
        }
    }

    /// Notes elements that go in this cycle. Their forces act no more.
    static void take_out(Index batch, int active, const LaneMask& lost, const BeamEnds<Lanes>& ends,
                         double time_step, BeamStep<Lanes>& step, BeamStore::PatchSums& sums)
    {
        Lanes power = dot(step.forces.force, ends.velocity);
        if constexpr (Formulation::rotates) {
            power += dot(step.forces.moment1 + step.forces.moment2, ends.mean_spin) +
                     0.5 * dot(step.forces.moment2 - step.forces.moment1, ends.spin);
        }
        for (int lane = 0; lane < active; ++lane) {
            const auto place = static_cast<std::size_t>(batch) * lane_count + lane;
            if (lost[lane]) sums.lost.push_back({place, 0.5 * time_step * power[lane]});
        }
        silence_forces(~lost, step);
    }

    /// Elements that break in this cycle: by their resultants, at their failure time, when all points have
    /// failed, or enough of them under *MAT_ADD_EROSION, or when their step falls below what the deck allows.
    LaneMask lost_in(const Clock& clock, Index batch, const BeamStep<Lanes>& step)
    {
        Lanes* record = store_.record(batch);
        LaneMask lost = step.broken;
        if (store_.shortest_step > 0) lost |= store_.stable_step(batch, step.length) < store_.shortest_step;
        if (clock.time >= store_.settings.failure_time) lost = ~LaneMask{};
        if constexpr (requires(HistoryView<Lanes> history) { law_.failed(history); }) {
            if (store_.settings.points_fail) {
                const BeamStore::PointLayout layout = point_layout(store_.settings.section);
                LaneMask failed = ~LaneMask{};
                for (int point = 0; point < layout.count; ++point) {
                    Lanes* history = record + layout.first + point * layout.size + 3;
                    failed &= law_.failed(HistoryView<Lanes>{history});
                }
                if (layout.count > 0) lost |= failed;
            }
        }
        if constexpr (requires(HistoryView<Lanes> history) { law_.eroded(history); }) {
            const BeamStore::PointLayout layout = point_layout(store_.settings.section);
            Lanes count{};
            for (int point = 0; point < layout.count; ++point) {
                Lanes* history = record + layout.first + point * layout.size + 3;
                count += law_.eroded(HistoryView<Lanes>{history}) ? broadcast<Lanes>(1) : Lanes{};
            }
            lost |= count >= static_cast<double>(store_.settings.points_to_erode);
        }
        return lost;
    }
};

} // namespace plash

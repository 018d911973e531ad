#pragma once

#include "elements/shell_store.h"

namespace plash {

/// Shells of one part in one formulation and one material law.
/// Formulation  gives plane_points and step(), see elements/shell_belytschko_tsay.h
template <class Formulation, class Law>
class ShellGroup : public Term {
public:
    /// Adds the elements' masses and rotary inertias to the state.
    ShellGroup(const ShellPart& part, State& state, ShellSettings settings, Law law)
        : law_(std::move(law)),
          store_(part, state, std::move(settings), Formulation::plane_points, law_.initial_history(),
                 plastic_strain_of_law())
    {
        if constexpr (requires { law_.start(store_); }) law_.start(store_);
        if (store_.shown.empty()) store_.shown = {shown_variables(law_, true)};
        store_.take_initial_stresses(part, state);
        store_.add_masses(state);
    }

    std::string_view name() const override { return store_.name; }
    std::size_t items() const override { return store_.patches.element_count; }
    StepVote stable_step() const override { return store_.vote(); }
    double scale_mass(double step, bool only_small, State& state) override
    {
        return store_.scale_mass(step, only_small, state);
    }
    bool scale_selectively(double step, bool only_small, const State& state, SelectiveMasses& masses) override
    {
        store_.scale_selectively(step, only_small, state, masses);
        return true;
    }
    Index scaled_part() const override { return store_.part; }
    void report(EnergyLedger& ledger) const override { store_.report(ledger); }
    void serialise(Archive& archive) override { store_.serialise(archive); }
    void collect(const State& state, ElementResults& results) const override
    {
        store_.collect(state, results);
    }

    std::vector<std::string> notices(const State&) const override
    {
        if (store_.settings.notice.empty()) return {};
        return {store_.settings.notice};
    }

    void add_forces(const Clock& clock, State& state) override
    {
        store_.start_cycle(clock);
        store_.patches.for_each(state, true,
                                [&](std::ptrdiff_t number, const Patches::Patch& patch, NodeCopies& copies) {
                                    work_on_patch(clock, patch, copies, store_.sums[number]);
                                });
        store_.close_cycle(state);
    }

    const ShellStore& store() const { return store_; }

private:
    Law law_;
    ShellStore store_;

    static constexpr Index plastic_strain_of_law()
    {
        if constexpr (requires { Law::plastic_strain; }) {
            return Law::plastic_strain;
        } else {
            return none;
        }
    }

    void work_on_patch(const Clock& clock, const Patches::Patch& patch, NodeCopies& copies,
                       ShellStore::PatchSums& sums)
    {
        const double time_step = clock.last_step;
        Lanes internal{}, hourglass{}, viscous{};
        Lanes shortest = broadcast<Lanes>(eroded_length);
        LaneMask shortest_batch{};
        for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
            prefetch_record(batch + 1);
            const auto load = [&](const NodeCopies::Values& values) {
                const auto corner = [&](int i) {
                    return load_corner<Lanes>(values.data(), store_.patches.corner_offsets(batch, i));
                };
                return pattern_of(corner(0), corner(1), corner(2), corner(3));
            };
            ShellStep<Lanes> step = Formulation::template step<Lanes>(
                store_.settings, law_, load(copies.position), load(copies.velocity),
                load(copies.angular_velocity), time_step, store_.record(batch));

            const int active = store_.patches.active_lanes(batch);
            if (active < lane_count) clear_spare_lanes(active, step);
            const LaneMask lost = lost_in(clock, batch, step.squared_length);
            if (any(lost)) take_out(batch, active, lost, copies, time_step, step, sums);
            const auto add = [&](NodeCopies::Values& values, const CornerPattern<Lanes>& pattern) {
                each_corner(pattern, [&](int corner, const Vector3<Lanes>& force) {
                    add_corner(values.data(), store_.patches.corner_offsets(batch, corner), force, active);
                });
            };
            add(copies.force, step.force);
            add(copies.moment, step.moment);
            internal += step.internal_work;
            hourglass += step.hourglass_work;
            viscous += step.viscous_work;
            const LaneMask shorter = step.squared_length < shortest;
            shortest = shorter ? step.squared_length : shortest;
            shortest_batch = shorter ? LaneMask{} + batch : shortest_batch;
        }
        sums.squared_length = eroded_length;
        for (int lane = 0; lane < lane_count; ++lane) {
            sums.internal += internal[lane];
            sums.hourglass += hourglass[lane];
            sums.viscous += viscous[lane];
            if (shortest[lane] >= sums.squared_length) continue;
            sums.squared_length = shortest[lane];
            sums.place = static_cast<Index>(shortest_batch[lane]) * lane_count + lane;
        }
    }

    /// Notes elements that go in this cycle. Their forces act no more.
    void take_out(Index batch, int active, const LaneMask& lost, const NodeCopies& copies, double time_step,
                  ShellStep<Lanes>& step, ShellStore::PatchSums& sums) const
    {
        Lanes power{};
        const auto add_power = [&](const CornerPattern<Lanes>& forces, const NodeCopies::Values& rates) {
            each_corner(forces, [&](int corner, const Vector3<Lanes>& force) {
                const std::uint16_t* offsets = store_.patches.corner_offsets(batch, corner);
                power += dot(force, load_corner<Lanes>(rates.data(), offsets));
            });
        };
        add_power(step.force, copies.velocity);
        add_power(step.moment, copies.angular_velocity);
        for (int lane = 0; lane < active; ++lane) {
            const auto place = static_cast<std::size_t>(batch) * lane_count + lane;
            if (lost[lane]) sums.lost.push_back({place, 0.5 * time_step * power[lane]});
        }
        silence<Lanes>(~lost, step);
    }

    /// Elements all of whose points have failed, or enough of them under *MAT_ADD_EROSION, or whose time has
    /// come, and those whose step has fallen below what the deck allows.
    LaneMask lost_in(const Clock& clock, Index batch, const Lanes& squared_length)
    {
        const ShellSettings& settings = store_.settings;
        LaneMask lost = squared_length < settings.shortest_squared_length;
        constexpr bool one_law = requires(HistoryView<Lanes> history)
        {
            law_.failed(history);
        };
        constexpr bool plies = requires
        {
            Law::ply_place;
        };
        if constexpr (one_law || plies) {
            if (settings.points_fail) {
                constexpr int point_size = shell_record::history + static_cast<int>(Law::history_size);
                Lanes* history = store_.record(batch) + shell_record::points + shell_record::history;
                LaneMask failed = LaneMask{} - 1;
                const int points = Formulation::plane_points * settings.rule.size();
                for (int point = 0; point < points; ++point, history += point_size) {
                    if constexpr (plies) {
                        failed &= law_.failed(point % settings.rule.size(), HistoryView<Lanes>{history});
                    } else {
                        failed &= law_.failed(HistoryView<Lanes>{history});
                    }
                }
                lost |= failed & (store_.record(batch)[shell_record::mass_factor] > 0.0);
            }
        }
        if constexpr (requires(HistoryView<Lanes> history) { law_.eroded(history); }) {
            constexpr int point_size = shell_record::history + static_cast<int>(Law::history_size);
            Lanes* history = store_.record(batch) + shell_record::points + shell_record::history;
            Lanes count{};
            const int points = Formulation::plane_points * settings.rule.size();
            for (int point = 0; point < points; ++point, history += point_size) {
                count += law_.eroded(HistoryView<Lanes>{history}) ? broadcast<Lanes>(1) : Lanes{};
            }
            LaneMask enough = count >= static_cast<double>(settings.points_to_erode);
            if (clock.time >= settings.failure_time) enough = ~LaneMask{};
            lost |= enough & (store_.record(batch)[shell_record::mass_factor] > 0.0);
        }
        return lost;
    }

    /// Records are walked once a cycle; asking for the next one while this one is worked on hides most of the
    /// way to memory (a third of the time of a mesh that is larger than the cache).
    void prefetch_record(Index batch) const
    {
        constexpr std::size_t cache_line = 64;
        const char* next = reinterpret_cast<const char*>(store_.record(0)) +
                           static_cast<std::size_t>(batch) * store_.record_bytes();
        for (std::size_t line = 0; line < store_.record_bytes(); line += cache_line) {
            __builtin_prefetch(next + line, 1);
        }
    }

    /// The spare lanes of the last batch repeat an element and must not be counted.
    static void clear_spare_lanes(int active, ShellStep<Lanes>& step)
    {
        for (int lane = active; lane < lane_count; ++lane) {
            step.internal_work[lane] = step.hourglass_work[lane] = step.viscous_work[lane] = 0;
            step.squared_length[lane] = eroded_length;
        }
    }
};

} // namespace plash

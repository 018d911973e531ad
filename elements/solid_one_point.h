#pragma once

#include "elements/solid_group.h"

#include <algorithm>
#include <limits>

namespace plash {

/// Group of one-point solids (ELFORM 1) of one part: the material point is known to the compiler.
template <class Point, SolidGradientRule rule>
class SolidOnePoint final : public SolidGroup {
public:
    SolidOnePoint(Point point, SolidSetup setup, State& state)
        : SolidGroup(std::move(setup), state, point_history + Point::history_size,
                     point_constants + Point::constant_size, Point::plastic_strain),
          point_(std::move(point))
    {
        start(state);
    }

    void add_forces(const Clock& clock, State& state) override
    {
        const auto work = [&](std::ptrdiff_t number, const Patches::Patch& patch, NodeCopies& nodes) {
            PatchSum sum;
            const Index end = patch.first_batch + patch.batch_count;
            for (Index batch = patch.first_batch; batch < end; ++batch) {
                add_batch_forces(batch, clock.last_step, nodes, sum);
            }
            sums_[number] = std::move(sum);
        };
        start_cycle(clock);
        patches_.for_each(state, false, work);
        close_cycle(state);
    }

private:
    Point point_;

    /// Forces of one batch. Flattened: the compiler would stop inlining half-way, and pass lanes through
    /// memory.
    [[gnu::flatten]] void add_batch_forces(Index batch, double time_step, NodeCopies& nodes, PatchSum& sum)
    {
        constexpr int history_size = point_history + Point::history_size;
        for (int i = 0; i < history_size; ++i) __builtin_prefetch(history_of(batch) + history_size + i, 1);
        const auto load = [&](const AlignedDoubles& values) {
            const auto corner = [&](int i) {
                return load_corner<Lanes>(values.data(), patches_.corner_offsets(batch, i));
            };
            return modes_of<Lanes>(
                {corner(0), corner(1), corner(2), corner(3), corner(4), corner(5), corner(6), corner(7)});
        };
        const SolidModes<Lanes> position = load(nodes.position), velocity = load(nodes.velocity);
        SolidResult<Lanes> result = solid_step<rule>(point_, setup_.parameters, position, velocity, time_step,
                                                     history_of(batch), constants_of(batch));
        take(batch, position, nodes, result, sum);
        const int active = patches_.active_lanes(batch);
        for_corners(result.force, [&](int corner, const Vector3<Lanes>& force) {
            add_corner(nodes.force.data(), patches_.corner_offsets(batch, corner), force, active);
        });
    }

    /// Volumes, masses, initial history and first stable steps.
    void start(State& state)
    {
        std::vector<double> first_step(patches_.elements.size());
        for (const Patches::Patch& patch : patches_.patches) {
            for (Index batch = patch.first_batch; batch < patch.first_batch + patch.batch_count; ++batch) {
                const SolidModes<Lanes> position = start_position(patch, batch, state);
                start_batch(batch, gradient_of<rule>(position).volume, position, state);
                Lanes* history = history_of(batch);
                point_.start(position, history, constants_of(batch));
                if constexpr (requires { point_.start_at(Vector3<Lanes>{}, history); })
                    point_.start_at(start_centre(patch, batch, state), constants_of(batch));
                std::array<Lanes, point_history + Point::history_size> trial;
                std::copy_n(history, trial.size(), trial.begin());
                const auto result = solid_step<rule>(point_, setup_.parameters, position, SolidModes<Lanes>{},
                                                     0.0, trial.data(), constants_of(batch));
                for (int lane = 0; lane < lane_count; ++lane) {
                    first_step[static_cast<std::size_t>(batch) * lane_count + lane] =
                        result.vote.stable_step[lane];
                }
            }
        }
        take_initial_stresses({stress_is_free<Point>, 1, 0, 0, Point::plastic_strain});
        finish_start(std::move(first_step), state);
    }
};

} // namespace plash

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
        : SolidOnePoint(std::move(point), constant_count(setup), std::move(setup), state)
    {
        start(state);
    }

    void add_forces(const Clock& clock, State& state) override
    {
        each_batch(clock, state, [&](const Patches::Patch&, Index batch, NodeCopies& nodes, PatchSum& sum) {
            add_batch_forces(batch, clock.last_step, nodes, sum);
        });
    }

private:
    Point point_;

    SolidOnePoint(Point point, int constants, SolidSetup&& setup, State& state)
        : SolidGroup(std::move(setup), state, point_history + Point::history_size, constants,
                     Point::plastic_strain),
          point_(std::move(point))
    {}

    static int constant_count(const SolidSetup& setup)
    {
        const bool total = setup.parameters.hourglass.form == SolidHourglass::Form::total_strain;
        return point_constants + Point::constant_size + (total ? total_hourglass_constants : 0);
    }

    /// Forces of one batch. Flattened: the compiler would stop inlining half-way, and pass lanes through
    /// memory.
    [[gnu::flatten]] void add_batch_forces(Index batch, double time_step, NodeCopies& nodes, PatchSum& sum)
    {
        constexpr int history_size = point_history + Point::history_size;
        for (int i = 0; i < history_size; ++i) __builtin_prefetch(history_of(batch) + history_size + i, 1);
        const SolidModes<Lanes> position = modes_at(batch, nodes.position);
        const SolidModes<Lanes> velocity = modes_at(batch, nodes.velocity);
        SolidResult<Lanes> result = solid_step<rule>(point_, setup_.parameters, position, velocity, time_step,
                                                     history_of(batch), constants_of(batch));
        take(batch, position, nodes, result, sum);
        add_modes(batch, result.force, nodes);
    }

    /// Volumes, masses, initial history and first stable steps.
    void start(State& state)
    {
        std::vector<double> first_step = first_steps([&](const Patches::Patch& patch, Index batch) {
            const SolidModes<Lanes> position = start_position(patch, batch, state);
            start_batch(batch, gradient_of<rule>(position).volume, position, state);
            Lanes* history = history_of(batch);
            point_.start(position, history, constants_of(batch));
            if (setup_.parameters.hourglass.form == SolidHourglass::Form::total_strain) {
                start_total_hourglass(position, history + hourglass_history,
                                      constants_of(batch) + point_constants + Point::constant_size);
            }
            if constexpr (requires { point_.start_at(Vector3<Lanes>{}, history); })
                point_.start_at(start_centre(patch, batch, state), constants_of(batch));
            std::array<Lanes, point_history + Point::history_size> trial;
            std::copy_n(history, trial.size(), trial.begin());
            const auto result = solid_step<rule>(point_, setup_.parameters, position, SolidModes<Lanes>{},
                                                 0.0, trial.data(), constants_of(batch));
            return result.vote.stable_step;
        });
        take_initial_stresses(
            {stress_is_free<Point>, 1, 0, 0, Point::plastic_strain, shown_variables(point_, false)});
        finish_start(std::move(first_step), state);
    }
};

} // namespace plash

#pragma once

#include "elements/solid_eight_step.h"
#include "elements/solid_group.h"

#include <algorithm>
#include <array>

namespace plash {

/// Group of fully integrated hexahedra (ELFORM 2, -1, -2) of one part.
template <class Point>
class SolidEightPoint final : public SolidGroup {
public:
    SolidEightPoint(Point point, SolidShear shear, SolidSetup setup, State& state)
        : SolidGroup(std::move(setup), state, history_size, point_constants + Point::constant_size,
                     Point::plastic_strain >= 0 ? 0 : -1),
          point_(std::move(point)),
          shear_(shear)
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
    static constexpr int history_size = first_gauss_point + solid_gauss_points * eight_point_size<Point>;
    Point point_;
    SolidShear shear_;

    void add_batch_forces(Index batch, double time_step, NodeCopies& nodes, PatchSum& sum)
    {
        const SolidModes<Lanes> position = modes_at(batch, nodes.position);
        const SolidModes<Lanes> velocity = modes_at(batch, nodes.velocity);
        SolidResult<Lanes> result = eight_point_step(point_, setup_.parameters, shear_, position, velocity,
                                                     time_step, history_of(batch), constants_of(batch));
        take(batch, position, nodes, result, sum);
        add_modes(batch, result.force, nodes);
    }

    /// Volumes, masses, initial history and first stable steps.
    void start(State& state)
    {
        std::vector<double> first_step = first_steps([&](const Patches::Patch& patch, Index batch) {
            const SolidModes<Lanes> position = start_position(patch, batch, state);
            start_batch(batch, gradient_of<SolidGradientRule::mean>(position).volume, position, state);
            start_history(batch, position);
            if constexpr (requires { point_.start_at(Vector3<Lanes>{}, constants_of(batch)); })
                point_.start_at(start_centre(patch, batch, state), constants_of(batch));
            std::array<Lanes, history_size> trial;
            std::copy_n(history_of(batch), trial.size(), trial.begin());
            const auto result = eight_point_step(point_, setup_.parameters, shear_, position,
                                                 SolidModes<Lanes>{}, 0.0, trial.data(), constants_of(batch));
            return result.vote.stable_step;
        });
        take_initial_stresses({stress_is_free<Point>, solid_gauss_points, first_gauss_point,
                               eight_point_size<Point>, Point::plastic_strain,
                               shown_variables(point_, false)});
        finish_start(std::move(first_step), state);
    }

    /// The material point starts once; all eight points begin as it does.
    void start_history(Index batch, const SolidModes<Lanes>& position)
    {
        std::array<Lanes, point_history + Point::history_size> one{};
        point_.start(position, one.data(), constants_of(batch));
        Lanes* history = history_of(batch);
        std::copy_n(one.begin(), point_history, history);
        for (int i = 0; i < solid_gauss_points; ++i) {
            Lanes* point = history + first_gauss_point + i * eight_point_size<Point>;
            std::copy_n(one.begin() + stress_history, 6, point);
            std::copy_n(one.begin() + point_history, Point::history_size, point + 6);
        }
    }
};

} // namespace plash

#pragma once

#include "elements/solid_group.h"
#include "elements/solid_ten_step.h"

#include <algorithm>

namespace plash {

/// Group of ten-node tetrahedra (ELFORM 16, 17) of one part.
template <class Point>
class SolidTenPoint final : public SolidGroup {
public:
    SolidTenPoint(Point point, SolidSetup setup, State& state)
        : SolidGroup(std::move(setup), state, history_size,
                     ten_point_constants + ten_points * Point::constant_size,
                     Point::plastic_strain >= 0 ? 0 : -1),
          point_(std::move(point))
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
    static constexpr int history_size = first_ten_point + ten_points * ten_point_size<Point>;
    Point point_;

    const TenNodeRule& rule() const { return *setup_.ten_nodes; }

    /// The element between its corners, for what asks about its shape as a whole.
    static SolidModes<Lanes> corner_modes(const Vector3<Lanes> (&x)[10])
    {
        return modes_of<Lanes>({x[0], x[1], x[2], x[2], x[3], x[3], x[3], x[3]});
    }

    void add_batch_forces(Index batch, double time_step, NodeCopies& nodes, PatchSum& sum)
    {
        Vector3<Lanes> x[10], v[10], force[10];
        for (int i = 0; i < 10; ++i) {
            x[i] = load_corner<Lanes>(nodes.position.data(), patches_.corner_offsets(batch, i));
            v[i] = load_corner<Lanes>(nodes.velocity.data(), patches_.corner_offsets(batch, i));
        }
        TenNodeResult<Lanes> result =
            ten_point_step(point_, setup_.parameters, rule(), ten_node_modes(rule(), x),
                           ten_node_modes(rule(), v), time_step, history_of(batch), constants_of(batch));
        const LaneMask silent = take_vote(batch, corner_modes(x), result.vote, sum);
        ten_node_forces(rule(), result.force, force);
        if (any(silent)) {
            Lanes power{};
            for (int i = 0; i < 10; ++i) power += dot(force[i], v[i]);
            book_missing_work(batch, power, sum);
        }
        const int active = patches_.active_lanes(batch);
        for (int i = 0; i < 10; ++i) {
            Vector3<Lanes>& f = force[i];
            if (any(silent)) f = {silent ? Lanes{} : f.x, silent ? Lanes{} : f.y, silent ? Lanes{} : f.z};
            add_corner(nodes.force.data(), patches_.corner_offsets(batch, i), f, active);
        }
    }

    /// Volumes, masses, initial history and first stable steps.
    void start(State& state)
    {
        std::vector<double> first_step = first_steps([&](const Patches::Patch& patch, Index batch) {
            Vector3<Lanes> x[10];
            start_corners(patch, batch, state, x);
            const TenNodeModes<Lanes> position = ten_node_modes(rule(), x);
            start_points(patch, batch, ten_node_points(position), corner_modes(x), state);
            std::array<Lanes, history_size> trial;
            std::copy_n(history_of(batch), trial.size(), trial.begin());
            const auto result = ten_point_step(point_, setup_.parameters, rule(), position,
                                               TenNodeModes<Lanes>{}, 0.0, trial.data(), constants_of(batch));
            return result.vote.stable_step;
        });
        take_initial_stresses({stress_is_free<Point>, ten_points, first_ten_point, ten_point_size<Point>,
                               Point::plastic_strain, shown_variables(point_, false)});
        finish_start(std::move(first_step), state);
    }

    /// Each point starts as the law's point of a tetrahedron with its Jacobian.
    void start_points(const Patches::Patch& patch, Index batch,
                      const std::array<TenNodePoint<Lanes>, ten_points>& x, const SolidModes<Lanes>& corners,
                      const State& state)
    {
        Lanes volume[ten_points], total{}, smallest = broadcast<Lanes>(1);
        for (int q = 0; q < ten_points; ++q) {
            volume[q] = jacobian_of(x[q]).volume;
            total += volume[q];
            smallest = min(smallest, volume[q]);
        }
        start_batch(batch, smallest > 0.0 ? total : smallest, corners, state);
        Lanes* history = history_of(batch);
        Lanes* constants = constants_of(batch);
        for (int q = 0; q < ten_points; ++q) {
            constants[point_constants + q] = volume[q] / setup_.initial_relative_volume;
            std::array<Lanes, point_history + Point::history_size> one{};
            std::array<Lanes, point_constants + Point::constant_size> own{};
            std::copy_n(constants, point_constants, own.begin());
            point_.start(tetrahedron_of(x[q]), one.data(), own.data());
            if constexpr (requires { point_.start_at(Vector3<Lanes>{}, own.data()); })
                point_.start_at(start_centre(patch, batch, state), own.data());
            std::copy_n(own.begin() + point_constants, Point::constant_size,
                        constants + ten_point_constants + q * Point::constant_size);
            if (q == 0) std::copy_n(one.begin(), point_history, history);
            Lanes* point = history + first_ten_point + q * ten_point_size<Point>;
            std::copy_n(one.begin() + stress_history, 6, point);
            std::copy_n(one.begin() + point_history, Point::history_size, point + 6);
        }
    }
};

} // namespace plash

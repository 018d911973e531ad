#pragma once

#include "materials/history.h"
#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace plash::testing {

/// One solid point of a law, driven by strain increments.
template <class Law>
struct DrivenPoint {
    const Law& law;
    SymmetricTensor<double> stress{};
    std::array<double, Law::history_size + 1> history{};

    explicit DrivenPoint(const Law& l) : law(l)
    {
        const auto start = law.initial_history();
        for (std::size_t i = 0; i < start.size(); ++i) history[i] = start[i];
    }

    /// A total strain in equal steps, over `duration`.
    void strain(const SymmetricTensor<double>& total, int steps = 1, double duration = 1)
    {
        for (int i = 0; i < steps; ++i) {
            law.update(stress, (1.0 / steps) * total, HistoryView<double>{history.data()}, duration / steps);
        }
    }
};

/// A batch of points, each walking its own path of strain, stays beside points driven one by one.
/// size       largest strain of a step [-]
/// tolerance  of stresses and history [as they are]
template <class Law>
void expect_lanes_as_points(const Law& law, double size, double tolerance)
{
    SymmetricTensor<Lanes> stress{};
    std::array<Lanes, Law::history_size + 1> history{};
    const auto start = law.initial_history();
    for (std::size_t i = 0; i < start.size(); ++i) history[i] = broadcast<Lanes>(start[i]);
    std::vector<DrivenPoint<Law>> points(lane_count, DrivenPoint(law));
    for (int step = 0; step < 40; ++step) {
        SymmetricTensor<Lanes> increment{};
        for (int lane = 0; lane < lane_count; ++lane) {
            const double a = size * std::sin(0.3 * step + lane);
            const SymmetricTensor<double> one{-a,      0.3 * a,  -2.0 / 3 * size,
                                              0.5 * a, -0.2 * a, 0.1 * lane * a};
            points[lane].strain(one);
            set_lane(increment.xx, lane, one.xx);
            set_lane(increment.yy, lane, one.yy);
            set_lane(increment.zz, lane, one.zz);
            set_lane(increment.xy, lane, one.xy);
            set_lane(increment.yz, lane, one.yz);
            set_lane(increment.zx, lane, one.zx);
        }
        law.update(stress, increment, HistoryView<Lanes>{history.data()}, 1.0);
    }
    for (int lane = 0; lane < lane_count; ++lane) {
        const SymmetricTensor<double>& alone = points[lane].stress;
        EXPECT_NEAR(lane_of(stress.xx, lane), alone.xx, tolerance);
        EXPECT_NEAR(lane_of(stress.yy, lane), alone.yy, tolerance);
        EXPECT_NEAR(lane_of(stress.zz, lane), alone.zz, tolerance);
        EXPECT_NEAR(lane_of(stress.xy, lane), alone.xy, tolerance);
        EXPECT_NEAR(lane_of(stress.yz, lane), alone.yz, tolerance);
        EXPECT_NEAR(lane_of(stress.zx, lane), alone.zx, tolerance);
        for (int i = 0; i < Law::history_size; ++i) {
            EXPECT_NEAR(lane_of(history[i], lane), points[lane].history[i], tolerance);
        }
    }
}

} // namespace plash::testing

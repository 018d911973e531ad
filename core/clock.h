#pragma once

namespace plash {

/// Time as the terms see it while the loop works on step n.
struct Clock {
    double time = 0;      ///< t_n [time]
    double last_step = 0; ///< t_n - t_(n-1), over which the velocities at n - 1/2 acted; 0 in the first cycle
    double step = 0;      ///< t_(n+1) - t_n, known once forces are summed [time]
    long cycle = 0;       ///< n
    bool relaxing = false; ///< in the phase of dynamic relaxation, whose time is its own

    /// Span over which the acceleration at n changes the velocity from n - 1/2 to n + 1/2.
    double velocity_step() const { return 0.5 * (last_step + step); }
    /// (last_step - step) / (4 velocity_step): the share of v(n+1/2)^2 - v(n-1/2)^2 that twice the kinetic
    /// energy at n has beside v(n-1/2) . v(n+1/2), see docs/theory/time_integration.md [-].
    double step_change() const { return 0.5 * (last_step - step) / (last_step + step); }
};

} // namespace plash

#pragma once

namespace plash {

/// Work of forces known only once the new velocity is (constraints, walls), by the trapezoidal rule: the
/// force at n acts over half of the last step with the old velocity and over half of the next with the new
/// one.
struct WorkSum {
    double done = 0;    ///< work up to t_n [energy]
    double pending = 0; ///< share of the force at n that belongs to the step from n to n+1 [energy]

    /// power_before = sum of force . velocity(n-1/2), power_after = sum of force . velocity(n+1/2).
    void add(double power_before, double last_step, double power_after, double step)
    {
        done += pending + 0.5 * power_before * last_step;
        pending = 0.5 * power_after * step;
    }
};

} // namespace plash

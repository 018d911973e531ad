#pragma once

#include "core/archive.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/state.h"

#include <array>
#include <span>
#include <vector>

namespace plash {

/// Four corners of a segment; a triangle repeats the third.
using SegmentNodes = std::array<Index, 4>;

/// Integrals of N_i n dA over a segment as it stands, n to the side from which the corners run
/// counter-clockwise: forces of unit pressure against the back, exact for the bilinear surface. (With
/// position x = m + xi a + eta b' + xi eta c the integrand N_i x_xi cross x_eta is a polynomial, whose
/// integral is written out.)
std::array<Vec3, 4> unit_pressure_forces(const SegmentNodes& segment, std::span<const Vec3> position);

/// Area of a segment and the integrals of N_i dA over it, with the Jacobian taken as constant over a
/// quadrilateral.
double segment_area(const SegmentNodes& segment, std::span<const Vec3> position);

/// Adds the forces of segments' corners to nodes: corners are listed by node once, and summed in that order,
/// so the result does not depend on the number of threads.
class CornerSum {
public:
    CornerSum() = default;
    explicit CornerSum(std::span<const SegmentNodes> segments);

    /// On each corner, segment x 4: forces of unit pressure [area] or of what acts [force].
    std::vector<std::array<Vec3, 4>> force;

    /// Lets the forces of each segment, force_of(segment), act on its nodes. Returns their work over the last
    /// step, by the mean of its ends [energy].
    /// segments  those that the sum was made of
    template <class ForceOf>
    double act(std::span<const SegmentNodes> segments, const Clock& clock, State& state, ForceOf&& force_of)
    {
        const double power = sum_chunks(segments.size(), [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const std::array<Vec3, 4> now = force_of(i);
                for (int c = 0; c < 4; ++c)
                    sum += 0.5 * dot(now[c] + last_[i][c], state.velocity[segments[i][c]]);
                last_[i] = force[i] = now;
            }
            return sum;
        });
        add_to(state.force);
        return clock.last_step * power;
    }
    void serialise(Archive& archive) { archive(last_); }

    /// The sum of (force on a node)^2 / mass over the nodes that have mass.
    double square_over_mass(const std::vector<double>& mass) const;

private:
    std::vector<Index> node_;               ///< nodes that have corners
    std::vector<Index> begin_;              ///< their corners: corner_[begin_[i]] .. corner_[begin_[i + 1]]
    std::vector<Index> corner_;             ///< 4 x segment + corner
    std::vector<std::array<Vec3, 4>> last_; ///< what acted at n-1 [force]

    Vec3 sum_at(std::size_t place) const;
    void add_to(std::vector<Vec3>& nodal_force) const;
};

} // namespace plash

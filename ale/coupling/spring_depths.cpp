// What the springs of a coupling and the volumes of the fluid know of each other.

#include "ale/coupling/fluid_coupling.h"

#include <algorithm>
#include <cmath>

namespace plash {

/// How much further behind the surface fluid stands around a point than its springs know, as the volumes say,
/// where they say anything [length].
std::optional<double> FluidCoupling::unknown_depth(const Touch& touch) const
{
    if (present_.empty()) return {};
    return interface_depth_.unknown(fluid_.fluid(), {touch.place, touch.position, touch.normal},
                                    options_.fluids);
}

/// Tells the volumes how deep the springs are.
void FluidCoupling::sum_depths()
{
    if (present_.empty()) return;
    for (const Index point : active_) {
        const Touch& touch = touches_[point];
        const double at_rest = hydrostatic_ ? rest_unevenness_[point] : 0;
        interface_depth_.count(fluid_.fluid(), {touch.place, touch.position, touch.normal},
                               {touch.area, touch.stiffness, penetration_[point], at_rest});
    }
}

/// How much deeper the spring of a point is than those of its plane in its cell are together, beyond what it
/// was at rest [length].
double FluidCoupling::unevenness(std::size_t point) const
{
    if (present_.empty()) return 0;
    const Touch& touch = touches_[point];
    const std::optional<double> even =
        interface_depth_.even_depth(fluid_.fluid(), {touch.place, touch.position, touch.normal});
    if (!even) return 0;
    return penetration_[point] - (hydrostatic_ ? rest_unevenness_[point] : 0) - *even;
}

void FluidCoupling::remember_rest(std::size_t point)
{
    if (!hydrostatic_) return;
    rest_depth_[point] = -unknown_depth(touches_[point]).value_or(0);
    rest_unevenness_[point] = unevenness(point);
}

/// Share of what springs and volumes differ by that a step makes up for: all of it in the time in which sound
/// crosses so many cells, but not before what moves there, surface or fluid, has crossed a tenth of a cell.
/// What springs do not know has come with the flow through the mesh. A correction at the pace of sound would
/// drive a fluid that hardly moves like a piston, and feed its waves, which springs and volumes see from
/// slightly different places.
double FluidCoupling::share_of_way(const Touch& touch, double cells_of_sound, const Clock& clock) const
{
    constexpr double cells_of_flow = 0.1;
    const Fluid& fluid = fluid_.fluid();
    const std::array<double, 3>& mesh = fluid.lagrange.mesh_velocity;
    const Vec3 of_surface = touch.velocity - Vec3{mesh[0], mesh[1], mesh[2]};
    const Vec3 of_fluid = of_surface - touch.approach;
    const double speed = std::sqrt(std::max(dot(of_surface, of_surface), dot(of_fluid, of_fluid)));
    const double flow_rate = speed / length_along(fluid.edges(touch.place), touch.normal);
    const double rate = std::min(touch.sound_rate / cells_of_sound, flow_rate / cells_of_flow);
    return std::min(rate * clock.last_step, 1.0);
}

/// Penetrations tend to what the volumes of the fluid say: in the time in which sound crosses 50 cells where
/// the fluid stands further behind, and ten times as slowly where it stands less far, so that the pressures
/// of an impact stay; see share_of_way(). A surface neither pulls a fluid that has not come up to it, nor
/// lets one go that it pulls.
///
/// Volumes and nodes of the fluid know the springs of a plane in a cell by little more than what they do
/// together, and single ones would stray as they pass from cell to cell. So they tend to be as deep as the
/// others there, in the time of 50 cells of sound: their force stays, and their energy can only fall.
void FluidCoupling::correct_depth(std::size_t point, const Clock& clock)
{
    const Touch& touch = touches_[point];
    double& depth = penetration_[point];
    const double uneven = unevenness(point);
    // Leak control takes the share of each cycle that the deck asks for, but no more than the flow can bring.
    const double leak_share = std::min(options_.leak_control, share_of_way(touch, 0, clock));
    if (std::optional<double> unknown = unknown_depth(touch)) {
        if (!rest_depth_.empty()) *unknown += rest_depth_[point];
        const double behind = depth + *unknown;
        const double wanted = depth > 0 ? std::max(behind, 0.0) : std::min(behind, 0.0);
        depth += share_of_way(touch, wanted > depth ? 50 : 500, clock) * (wanted - depth);
        // What the springs know is no leak: it holds the pressure.
        depth += leak_share * std::max(*unknown, 0.0);
    } else if (touch.excess > 0) {
        const std::optional<double> known = interface_depth_.mean_depth(fluid_.fluid().place_of(touch.place));
        if (known) depth += leak_share * std::max(touch.excess - *known, 0.0);
    }
    depth -= std::min(touch.sound_rate * clock.last_step / 50, 1.0) * uneven;
}

} // namespace plash

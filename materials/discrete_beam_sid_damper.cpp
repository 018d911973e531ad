#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

/// Share of the whole open area that stays open however far the piston covers the orifices: what leaks past
/// it. The published force grows without bound as the last orifice closes.
constexpr double leakage = 0.01;

/// Integral of sqrt(r^2 - u^2) from 0 to u.
double half_circle_integral(double u, double r)
{
    return 0.5 * (u * std::sqrt(std::max(r * r - u * u, 0.0)) + r * r * std::asin(u / r));
}

/// A curve continued beyond its ends with its first and last slope.
double continued(const Curve& curve, double x)
{
    const auto& at = curve.abscissa;
    const std::size_t last = at.size() - 1;
    if (last == 0 || (x >= at.front() && x <= at.back())) return curve(x);
    const std::size_t left = x < at.front() ? 0 : last - 1;
    const double slope = (curve.ordinate[left + 1] - curve.ordinate[left]) / (at[left + 1] - at[left]);
    return curve.ordinate[left] + slope * (x - at[left]);
}

/// Damper of side impact dummies: a piston (area A) drives fluid through orifices, which it covers one after
/// the other. With V the rate of lengthening and s the shortening, the tensile force is
///     F = SF {K A V [C1 / A0 + C2 |V| RHOF ((A / (C A0))^2 - 1)] - f(s + S0) + V g(s + S0)}
/// (LS-DYNA keyword manual, volume II, *MAT_069). The manual says of A0, the open area, that orifices are
/// circular, that the controller covers part of each and that the piston closes them gradually. Read here as:
/// the piston stands at the length of the beam from the fixed end; of an orifice at d with the radius r that
/// part is open which lies nearer to the fixed end than the piston and outside a segment of the height H,
/// which the controller takes off at the side, across the stroke. At least `leakage` of the whole area stays
/// open. In tension beyond the stroke ST, and in compression from where the last orifice has closed, the
/// damper has bottomed out: a spring STF from there and a dashpot DC stand in for it.
class SidDamper final : public DiscreteBeamLaw {
public:
    SidDamper(const Record& material, const Model& model)
        : stroke_(positive(material, "ST", "stroke of the piston")),
          cover_(material.real("H")),
          constant_(material.real("K")),
          discharge_(positive(material, "C", "discharge coefficient")),
          stop_(positive(material, "STF", "stiffness where the piston bottoms out")),
          fluid_(material.real("RHOF")),
          linear_(material.real("C1")),
          quadratic_(material.real("C2")),
          offset_(material.real("S0"))
    {
        along_nodes = true;
        const double diameter = positive(material, "D", "diameter of the piston");
        piston_ = 0.25 * std::numbers::pi * diameter * diameter;
        if (constant_ < 0) reject_field(material, "K", "a curve (K < 0) is not supported");
        if (cover_ < 0) reject_field(material, "H", "the controller covers less than nothing");
        if (material.real("C3") != 0)
            reject_field(material, "C3", "the term of the fluid's inertia is not published; leave it at 0");
        if (material.integer("LCIDF") != 0) force_ = curve_of(material, "LCIDF", model).curve;
        if (material.integer("LCIDD") != 0) damper_ = curve_of(material, "LCIDD", model).curve;
        read_orifices(material);
        if (quadratic_ != 0 && discharge_ * whole_area_ >= piston_) {
            reject_field(material, "C",
                         fmt::format("C times the area of the orifices, {:.4g}, is not below that of the "
                                     "piston, {:.4g}; fluid that flows so freely would drive the piston",
                                     discharge_ * whole_area_, piston_));
        }
        notice =
            fmt::format("*{} {}: of each orifice the controller leaves all but a segment of height H = "
                        "{:.4g} open, the piston what is nearer to the fixed end; at least {:.3g} stays "
                        "open; it bottoms out at the lengths {:.4g} (last orifice closed) and {:.4g} (ST)",
                        material.keyword, material.id, cover_, leakage * whole_area_, last_closed_, stroke_);
    }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) point.force[0] = force(point);
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const override
    {
        return {std::max(stop_, scale_ * steepest_slope(force_))};
    }
    DiscreteFreedoms damping(const DiscreteBeamPoint& point) const override
    {
        if (past_end(point) != 0) return {dashpot_};
        const double speed = std::abs(point.rate[0]);
        return {scale_ * (viscous(point.length, speed) + speed * viscous_slope(point.length) +
                          std::abs(damper_at(point)))};
    }

private:
    struct Orifice {
        double place; ///< of its centre from the fixed end [length]
        double radius;
    };
    double stroke_, cover_, constant_, discharge_, stop_, fluid_, linear_, quadratic_, offset_;
    double piston_ = 0;      ///< area [length^2]
    double scale_ = 1;       ///< SF
    double dashpot_ = 0;     ///< DC [force/velocity]
    double whole_area_ = 0;  ///< that the controller leaves of all orifices [length^2]
    double last_closed_ = 0; ///< length of the beam at which the piston covers all orifices
    std::vector<Orifice> orifices_;
    Curve force_, damper_; ///< over the shortening

    void read_orifices(const Record& material)
    {
        const Table* table = material.table("ORFLOC");
        const std::size_t count = table == nullptr ? 0 : table->rows();
        if (count == 0) reject_field(material, "ORFLOC", "the damper has no orifice");
        scale_ = value_or(table->at(0, 2), 1);
        dashpot_ = table->at(0, 3);
        if (dashpot_ < 0) reject_field(material, "DC", "the damping is negative");
        const double usual = material.real("R");
        for (std::size_t row = 0; row < count; ++row) {
            const Orifice orifice{table->at(row, 0), value_or(table->at(row, 1), usual)};
            if (!(orifice.radius > 0))
                reject_field(material, "ORFRAD",
                             fmt::format("orifice {} has no radius (R is 0 too)", row + 1));
            if (orifice.place < orifice.radius || orifice.place > stroke_) {
                reject_field(material, "ORFLOC",
                             fmt::format("orifice {} at {} lies beyond the ends of the stroke, {}", row + 1,
                                         orifice.place, stroke_));
            }
            orifices_.push_back(orifice);
            const double end = orifice.place - orifice.radius;
            last_closed_ = row == 0 ? end : std::min(last_closed_, end);
            whole_area_ += open_part(orifice, stroke_ + orifice.radius);
        }
        if (!(whole_area_ > 0)) reject_field(material, "H", "the controller covers all orifices");
    }

    /// Open area of an orifice when the piston stands at `length`: of the circle, what lies nearer to the
    /// fixed end than the piston and beyond the controller, in closed form.
    double open_part(const Orifice& orifice, double length) const
    {
        const double r = orifice.radius, edge = cover_ - r; // of the controller, from the centre
        const double reach = std::clamp(length - orifice.place, -r, r);
        if (edge >= r) return 0;
        const auto both_sides = [&](double from, double to) { // between the two arcs
            return to > from ? 2 * (half_circle_integral(to, r) - half_circle_integral(from, r)) : 0;
        };
        const double chord = std::sqrt(std::max(r * r - edge * edge, 0.0));
        const double to = std::min(reach, chord);
        const double cut =
            to > -chord ? half_circle_integral(to, r) - half_circle_integral(-chord, r) - edge * (to + chord)
                        : 0;
        if (edge >= 0) return cut;
        return both_sides(-r, std::min(reach, -chord)) + cut + both_sides(chord, reach);
    }
    double open_area(double length) const
    {
        double area = 0;
        for (const Orifice& orifice : orifices_) area += open_part(orifice, length);
        return std::max(area, leakage * whole_area_);
    }
    /// How far the piston has gone beyond its ends: above zero in tension.
    double past_end(const DiscreteBeamPoint& point) const
    {
        return std::max(point.length - stroke_, 0.0) + std::min(point.length - last_closed_, 0.0);
    }
    /// Force of the fluid over the speed.
    double viscous(double length, double speed) const
    {
        return constant_ * piston_ * linear_ / open_area(length) + speed * viscous_slope(length);
    }
    double viscous_slope(double length) const
    {
        if (quadratic_ == 0) return 0;
        const double share = piston_ / (discharge_ * open_area(length));
        return constant_ * piston_ * quadratic_ * fluid_ * (share * share - 1);
    }
    double damper_at(const DiscreteBeamPoint& point) const
    {
        return damper_.abscissa.empty() ? 0 : continued(damper_, offset_ - point.way[0]);
    }
    double force(const DiscreteBeamPoint& point) const
    {
        const double rate = point.rate[0], beyond = past_end(point);
        if (beyond != 0) return stop_ * beyond + dashpot_ * rate;
        const double spring = force_.abscissa.empty() ? 0 : continued(force_, offset_ - point.way[0]);
        return scale_ * (viscous(point.length, std::abs(rate)) * rate - spring + rate * damper_at(point));
    }
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_sid_damper(const Record& material, const Model& model)
{
    return std::make_unique<SidDamper>(material, model);
}

} // namespace plash

#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// With S the shortening and V its rate, the compressive force is
///     SCLF { +-KH (V / a(S))^2 + [P0 (C0 / (C0 - S))^N - PA] AP },
/// the first term with the sign of V, and times FR when the damper lengthens. A clearance is taken off S, and
/// with one there is no tension.
class HydraulicGasDamper final : public DiscreteBeamLaw {
public:
    HydraulicGasDamper(const Record& material, const Model& model)
        : chamber_(positive(material, "CO", "length of the gas column")),
          exponent_(material.real("N")),
          pressure_(material.real("P0")),
          ambient_(material.real("PA")),
          piston_(positive(material, "AP", "piston area")),
          hydraulic_(material.real("KH")),
          return_factor_(material.given("FR") ? material.real("FR") : 1),
          scale_(value_or(material.real("SCLF"), 1)),
          clearance_(material.real("CLEAR"))
    {
        along_nodes = true;
        if (hydraulic_ < 0) reject_field(material, "KH", "a curve (KH < 0) is not supported");
        if (clearance_ < 0) reject_field(material, "CLEAR", "the clearance is negative");
        if (hydraulic_ == 0) return;
        orifice_ = curve_of(material, "LCID", model).curve;
        for (double area : orifice_.ordinate) {
            if (!(area > 0))
                reject_field(material, "LCID",
                             fmt::format("the orifice has the area {}; it must stay above zero", area));
        }
    }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) {
            const double shortening = -point.way[0] - clearance_, speed = -point.rate[0];
            if (clearance_ > 0 && shortening <= 0) {
                point.force[0] = 0;
                continue;
            }
            const double gas = (pressure_ * std::pow(ratio(shortening), exponent_) - ambient_) * piston_;
            double push = scale_ * (std::copysign(hydraulic_force(point, speed), speed) + gas);
            if (clearance_ > 0) push = std::max(push, 0.0);
            point.force[0] = -push;
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint& point) const override
    {
        const double shortening = -point.way[0] - clearance_;
        return {scale_ * exponent_ * pressure_ * piston_ / chamber_ *
                std::pow(ratio(shortening), exponent_ + 1)};
    }
    DiscreteFreedoms damping(const DiscreteBeamPoint& point) const override
    {
        const double speed = std::abs(point.rate[0]);
        return {speed > 0 ? 2 * scale_ * hydraulic_force(point, speed) / speed : 0};
    }

private:
    double chamber_, exponent_, pressure_, ambient_, piston_, hydraulic_, return_factor_, scale_, clearance_;
    Curve orifice_; ///< area over the shortening

    /// C0 / (C0 - S); the column cannot shrink to nothing.
    double ratio(double shortening) const
    {
        return chamber_ / std::max(chamber_ - shortening, 1e-3 * chamber_);
    }
    double hydraulic_force(const DiscreteBeamPoint& point, double speed) const
    {
        if (hydraulic_ == 0) return 0;
        const double share = speed / orifice_(-point.way[0]);
        return hydraulic_ * share * share * (speed < 0 ? return_factor_ : 1);
    }
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_hydraulic_gas_damper(const Record& material, const Model& model)
{
    return std::make_unique<HydraulicGasDamper>(material, model);
}

} // namespace plash

#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// F = max(0, F0 + K (L - N)) with the natural length N = start length - OFFSET and K = E A / N, or -E where
/// E is negative, or A stress(strain) of a curve. Until TMAXF0 the force is F0 alone, which grows over TRAMP
/// from TSTART; from then on the cable is elastic about the length that it has reached. FRACL0 brings the
/// natural length to this share of the start length over TRAMP.
///
/// history[0]: what is added to the elastic force once TMAXF0 is over; history[1]: 1 when it is.
class Cable final : public DiscreteBeamLaw {
public:
    Cable(const Record& material, const Model& model)
        : modulus_(material.real("E")),
          preload_(material.real("F0")),
          hold_until_(material.real("TMAXF0")),
          ramp_(material.real("TRAMP"))
    {
        along_nodes = cable = true;
        if (material.integer("LCID") != 0) stress_ = curve_of(material, "LCID", model).curve;
        if (preload_ < 0) reject_field(material, "F0", "a cable carries tension alone");
        if (material.integer("IREAD") > 1) {
            start_ = material.real("TSTART");
            natural_share_ = material.real("FRACL0");
            largest_strain_ = value_or(material.real("MXEPS", 1e20), 1e20);
            largest_force_ = value_or(material.real("MXFRC", 1e20), 1e20);
        }
    }

    void advance(std::span<DiscreteBeamPoint> points, double time, double) const override
    {
        const double ramp = ramp_ > 0 ? std::clamp((time - start_) / ramp_, 0.0, 1.0) : 1.0;
        for (DiscreteBeamPoint& point : points) {
            const double natural =
                natural_length(point) * (natural_share_ > 0 ? 1 + (natural_share_ - 1) * ramp : 1);
            const double strain = (point.length - natural) / natural;
            const double elastic = elastic_force(point, natural, strain);
            double force = ramp * preload_ + elastic;
            if (hold_until_ > 0) {
                double& shift = point.history[0];
                double& over = point.history[1];
                if (over == 0 && time > hold_until_) {
                    over = 1;
                    shift = preload_ - elastic;
                }
                force = over != 0 ? shift + elastic : ramp * preload_;
            }
            point.force[0] = std::max(force, 0.0);
            point.failed = point.failed || strain > largest_strain_ || force > largest_force_;
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint& point) const override
    {
        const double natural = natural_length(point);
        if (!stress_.abscissa.empty()) return {area * steepest_slope(stress_) / natural};
        return {modulus_ < 0 ? -modulus_ : modulus_ * area / natural};
    }

private:
    double modulus_, preload_, hold_until_, ramp_;
    double start_ = 0, natural_share_ = 0, largest_strain_ = 1e20, largest_force_ = 1e20;
    Curve stress_; ///< over engineering strain

    double natural_length(const DiscreteBeamPoint& point) const { return point.start_length - length_offset; }
    double elastic_force(const DiscreteBeamPoint& point, double natural, double strain) const
    {
        if (!stress_.abscissa.empty()) return area * (strain > 0 ? stress_(strain) : 0);
        if (modulus_ < 0) return -modulus_ * (point.length - natural);
        return modulus_ * area * strain;
    }
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_cable(const Record& material, const Model& model)
{
    return std::make_unique<Cable>(material, model);
}

} // namespace plash

#include "materials/discrete_beam_failure.h"
#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Each freedom on its own: an elastic force K (way - plastic way) that does not pass the yield force, a
/// curve of the plastic way so far; damping and preload besides. history[i] is the elastic force,
/// history[6 + i] the plastic way so far, history[12 + i] the way of the last step.
class PlasticDiscreteBeam final : public DiscreteBeamLaw {
public:
    PlasticDiscreteBeam(const Record& material, const Model& model)
        : stiffness_(six_of(material, {"TKR", "TKS", "TKT", "RKR", "RKS", "RKT"})),
          damping_(six_of(material, {"TDR", "TDS", "TDT", "RDR", "RDS", "RDT"})),
          preload_(six_of(material, {"FOR", "FOS", "FOT", "MOR", "MOS", "MOT"})),
          failure_(material)
    {
        constexpr const char* curve[] = {"LCPDR", "LCPDS", "LCPDT", "LCPMR", "LCPMS", "LCPMT"};
        constexpr const char* stiffness[] = {"TKR", "TKS", "TKT", "RKR", "RKS", "RKT"};
        for (int i = 0; i < 6; ++i) {
            if (material.integer(curve[i]) == 0) continue;
            yield_[i] = curve_of(material, curve[i], model).curve;
            if (!(stiffness_[i] > 0)) {
                reject_field(material, stiffness[i],
                             fmt::format("a freedom that yields ({}) needs an elastic stiffness above zero",
                                         curve[i]));
            }
        }
        if (material.integer("RYLD") != 0) {
            reject_field(material, "RYLD",
                         "only 0 is supported, where each freedom yields by itself at its curve");
        }
    }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) {
            for (int i = 0; i < 6; ++i) {
                double& elastic = point.history[i];
                double& plastic = point.history[6 + i];
                double& before = point.history[12 + i];
                elastic += stiffness_[i] * (point.way[i] - before);
                before = point.way[i];
                if (!yield_[i].abscissa.empty()) return_to_yield(i, elastic, plastic);
                point.force[i] = preload_[i] + elastic + damping_[i] * point.rate[i];
            }
            point.failed = point.failed || failure_.met(point);
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const override { return stiffness_; }
    DiscreteFreedoms damping(const DiscreteBeamPoint&) const override { return damping_; }

private:
    DiscreteFreedoms stiffness_, damping_, preload_;
    std::array<Curve, 6> yield_; ///< over the plastic way
    DiscreteBeamFailure failure_;

    /// |elastic| - K flow = yield(plastic + flow), exactly: the curve is followed from point to point.
    void return_to_yield(int i, double& elastic, double& plastic) const
    {
        const Curve& curve = yield_[i];
        double excess = std::abs(elastic) - curve(plastic);
        if (excess <= 0) return;
        double flow = 0;
        const double stiffness = stiffness_[i];
        for (std::size_t knot = 0; knot <= curve.abscissa.size(); ++knot) {
            const double place = plastic + flow;
            const double slope = curve.slope(place);
            // Hardening raises the yield force, softening may let the whole force go.
            const double step =
                stiffness + slope > 0 ? excess / (stiffness + slope) : std::abs(elastic) / stiffness - flow;
            const auto next = std::upper_bound(curve.abscissa.begin(), curve.abscissa.end(), place);
            const double room = next == curve.abscissa.end() ? step : *next - place;
            if (step <= room) {
                flow += step;
                break;
            }
            flow += room;
            excess -= room * (stiffness + slope);
        }
        plastic += flow;
        elastic -= std::copysign(stiffness * flow, elastic);
    }
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_plastic_discrete_beam(const Record& material, const Model& model)
{
    return std::make_unique<PlasticDiscreteBeam>(material, model);
}

} // namespace plash

#include "materials/discrete_beam_failure.h"
#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

class LinearDiscreteBeam final : public DiscreteBeamLaw {
public:
    explicit LinearDiscreteBeam(const Record& material)
        : stiffness_(six_of(material, {"TKR", "TKS", "TKT", "RKR", "RKS", "RKT"})),
          damping_(six_of(material, {"TDR", "TDS", "TDT", "RDR", "RDS", "RDT"})),
          preload_(six_of(material, {"FOR", "FOS", "FOT", "MOR", "MOS", "MOT"}))
    {
        constexpr const char* stiffness[] = {"TKR", "TKS", "TKT", "RKR", "RKS", "RKT"};
        constexpr const char* damping[] = {"TDR", "TDS", "TDT", "RDR", "RDS", "RDT"};
        for (int i = 0; i < 6; ++i) {
            if (stiffness_[i] < 0)
                reject_field(material, stiffness[i],
                             fmt::format("the stiffness {} is negative", stiffness_[i]));
            if (damping_[i] < 0)
                reject_field(material, damping[i], fmt::format("the damping {} is negative", damping_[i]));
        }
    }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) {
            for (int i = 0; i < 6; ++i)
                point.force[i] = preload_[i] + stiffness_[i] * point.way[i] + damping_[i] * point.rate[i];
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const override { return stiffness_; }
    DiscreteFreedoms damping(const DiscreteBeamPoint&) const override { return damping_; }

private:
    DiscreteFreedoms stiffness_, damping_, preload_;
};

class NonlinearDiscreteBeam final : public DiscreteBeamLaw {
public:
    NonlinearDiscreteBeam(const Record& material, const Model& model)
        : preload_(six_of(material, {"FOR", "FOS", "FOT", "MOR", "MOS", "MOT"})), failure_(material)
    {
        constexpr const char* force[] = {"LCIDTR", "LCIDTS", "LCIDTT", "LCIDRR", "LCIDRS", "LCIDRT"};
        constexpr const char* damping[] = {"LCIDTDR", "LCIDTDS", "LCIDTDT", "LCIDRDR", "LCIDRDS", "LCIDRDT"};
        for (int i = 0; i < 6; ++i) {
            force_[i] = odd_curve(material, force[i], model);
            damping_[i] = odd_curve(material, damping[i], model);
            stiffness_[i] = steepest_slope(force_[i]);
            damping_constant_[i] = steepest_slope(damping_[i]);
        }
    }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) {
            for (int i = 0; i < 6; ++i)
                point.force[i] = preload_[i] + force_[i](point.way[i]) + damping_[i](point.rate[i]);
            point.failed = point.failed || failure_.met(point);
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const override { return stiffness_; }
    DiscreteFreedoms damping(const DiscreteBeamPoint&) const override { return damping_constant_; }

private:
    std::array<Curve, 6> force_, damping_;
    DiscreteFreedoms stiffness_{}, damping_constant_{}, preload_;
    DiscreteBeamFailure failure_;
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_linear_discrete_beam(const Record& material, const Model&)
{
    return std::make_unique<LinearDiscreteBeam>(material);
}

std::unique_ptr<DiscreteBeamLaw> make_nonlinear_discrete_beam(const Record& material, const Model& model)
{
    return std::make_unique<NonlinearDiscreteBeam>(material, model);
}

} // namespace plash

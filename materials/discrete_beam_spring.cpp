#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// One spring of *MAT_074 or *MAT_094:
///     F = F0 + f [1 + C1 v + C2 sgn(v) ln max(1, |v| / DLE)] + D v + g(way) h(v),
/// elastic: f = K way, or K times the curve FLCID of the way; inelastic: f follows K and does not pass the
/// yield force, the curve FLCID of the plastic way so far, its negative side for compression. h is the curve
/// HLCID, g the curve GLCID or one. It fails at CDF of shortening and TDF of lengthening.
class BeamSpring {
public:
    BeamSpring(const Record& material, const Model& model)
        : inelastic_(material.keyword == "MAT_INELASTIC_SPRING_DISCRETE_BEAM"),
          stiffness_(material.real("K")),
          preload_(material.real("F0")),
          viscosity_(material.real("D")),
          rate_linear_(material.real("C1")),
          rate_log_(material.real("C2")),
          reference_rate_(value_or(material.real("DLE"), 1)),
          compression_limit_(std::abs(material.real("CDF"))),
          tension_limit_(std::abs(material.real("TDF"))),
          force_(inelastic_ && material.integer("FLCID") != 0 ? curve_of(material, "FLCID", model).curve
                                                              : odd_curve(material, "FLCID", model)),
          rate_force_(odd_curve(material, "HLCID", model))
    {
        if (material.integer("GLCID") != 0) rate_scale_ = curve_of(material, "GLCID", model).curve;
        if (inelastic_) {
            positive(material, "K", "elastic stiffness");
            if (force_.abscissa.empty())
                reject_field(material, "FLCID", "an inelastic spring needs the curve of its yield force");
        } else if (!force_.abscissa.empty() && stiffness_ == 0) {
            stiffness_ = 1;
        }
        if (stiffness_ < 0)
            reject_field(material, "K", fmt::format("the stiffness {} is negative", stiffness_));
        if (!(reference_rate_ > 0))
            reject_field(material, "DLE", fmt::format("{} is no reference rate", reference_rate_));
    }

    double largest_stiffness() const
    {
        return inelastic_ || force_.abscissa.empty() ? stiffness_ : stiffness_ * steepest_slope(force_);
    }
    double largest_damping() const { return viscosity_ + steepest_slope(rate_force_); }

    /// elastic, plastic, before  what an inelastic spring keeps: its force, plastic way and last way
    double force(double way, double rate, double& elastic, double& plastic, double& before) const
    {
        double statics = 0;
        if (inelastic_) {
            elastic += stiffness_ * (way - before);
            before = way;
            const double sense = elastic < 0 ? -1 : 1;
            const double excess = sense * elastic - yield_force(sense, plastic);
            if (excess > 0) { // the yield force of the plastic way so far, as LS-DYNA takes it
                plastic += excess / stiffness_;
                elastic -= sense * excess;
            }
            statics = elastic;
        } else {
            statics = stiffness_ * (force_.abscissa.empty() ? way : force_(way));
        }
        const double log = std::log(std::max(1.0, std::abs(rate) / reference_rate_));
        const double factor = 1 + rate_linear_ * rate + rate_log_ * std::copysign(log, rate);
        const double scale = rate_scale_.abscissa.empty() ? 1 : rate_scale_(way);
        return preload_ + statics * factor + viscosity_ * rate + scale * rate_force_(rate);
    }
    /// A curve that begins at zero holds in both senses; else its negative side is that of compression.
    double yield_force(double sense, double plastic) const
    {
        return force_.abscissa.front() < 0 ? sense * force_(sense * plastic) : force_(plastic);
    }
    bool fails(double way) const
    {
        return (tension_limit_ > 0 && way > tension_limit_) ||
               (compression_limit_ > 0 && -way > compression_limit_);
    }

private:
    bool inelastic_;
    double stiffness_, preload_, viscosity_, rate_linear_, rate_log_, reference_rate_;
    double compression_limit_, tension_limit_;
    Curve force_, rate_force_, rate_scale_;
};

class SpringBeam final : public DiscreteBeamLaw {
public:
    SpringBeam(const Record& material, const Model& model) : spring_(material, model) { along_nodes = true; }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) {
            auto& history = point.history;
            point.force[0] = spring_.force(point.way[0], point.rate[0], history[0], history[1], history[2]);
            point.failed = point.failed || spring_.fails(point.way[0]);
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const override
    {
        return {spring_.largest_stiffness()};
    }
    DiscreteFreedoms damping(const DiscreteBeamPoint&) const override { return {spring_.largest_damping()}; }

private:
    BeamSpring spring_;
};

/// A spring for each freedom, from the materials of the parts that the card names.
class SixSpringBeam final : public DiscreteBeamLaw {
public:
    SixSpringBeam(const Record& material, const Model& model)
    {
        constexpr const char* fields[] = {"TPIDR", "TPIDS", "TPIDT", "RPIDR", "RPIDS", "RPIDT"};
        const std::string_view wanted = material.keyword == "MAT_ELASTIC_6DOF_SPRING_DISCRETE_BEAM"
                                            ? "MAT_ELASTIC_SPRING_DISCRETE_BEAM"
                                            : "MAT_INELASTIC_SPRING_DISCRETE_BEAM";
        for (int i = 0; i < 6; ++i) {
            const Id id = material.integer(fields[i]);
            if (id == 0) continue;
            const auto part = std::find_if(model.parts.begin(), model.parts.end(),
                                           [&](const Part& one) { return one.id == id; });
            if (part == model.parts.end() || part->material == none ||
                model.materials[part->material].keyword != wanted) {
                reject_field(material, fields[i],
                             fmt::format("{} is no part with a material *{}", id, wanted));
            }
            freedoms_.push_back(i);
            springs_.emplace_back(model.materials[part->material], model);
            stiffness_[i] = springs_.back().largest_stiffness();
            damping_[i] = springs_.back().largest_damping();
        }
    }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) {
            for (std::size_t spring = 0; spring < springs_.size(); ++spring) {
                const int i = freedoms_[spring];
                point.force[i] = springs_[spring].force(point.way[i], point.rate[i], point.history[3 * i],
                                                        point.history[3 * i + 1], point.history[3 * i + 2]);
                point.failed = point.failed || springs_[spring].fails(point.way[i]);
            }
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const override { return stiffness_; }
    DiscreteFreedoms damping(const DiscreteBeamPoint&) const override { return damping_; }

private:
    std::vector<int> freedoms_;
    std::vector<BeamSpring> springs_; ///< of `freedoms_`
    DiscreteFreedoms stiffness_{}, damping_{};
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_spring_beam(const Record& material, const Model& model)
{
    return std::make_unique<SpringBeam>(material, model);
}

std::unique_ptr<DiscreteBeamLaw> make_six_spring_beam(const Record& material, const Model& model)
{
    return std::make_unique<SixSpringBeam>(material, model);
}

} // namespace plash

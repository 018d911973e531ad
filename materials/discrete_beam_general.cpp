#include "materials/discrete_beam_laws.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// What one freedom of *MAT_119 or *MAT_121 does.
struct GeneralSpring {
    enum class Unloading { elastic, curves, permanent };
    Unloading unloading = Unloading::elastic;
    Curve loading, returning; ///< force over way; no points of `returning`: zero
    Curve rate_force, rate_scale;
    double stiffness = 0; ///< between the curves [force/length]
    double offset = 0;    ///< permanent way over the largest one [-]
    double tension_limit = 0, compression_limit = 0, start = 0;

    double largest_stiffness() const
    {
        return std::max({steepest_slope(loading), steepest_slope(returning), stiffness});
    }

    /// furthest  largest ways so far to both sides: {tension, compression}, both positive
    /// before    way and static force of the last step
    double force(double way, double rate, double* furthest, double* before) const
    {
        way += start;
        double statics = loading(way);
        if (unloading == Unloading::curves) {
            // Between the curves the force follows the stiffness.
            const double trial = before[1] + stiffness * (way - before[0]);
            const double back = returning(way);
            statics = std::clamp(trial, std::min(statics, back), std::max(statics, back));
        } else if (unloading == Unloading::permanent) {
            double& peak = way < 0 ? furthest[1] : furthest[0];
            const double size = std::abs(way);
            const double kept = offset * peak;
            if (size >= peak) {
                peak = size;
            } else {
                // Quadratic from the force at the peak to zero at the permanent way.
                const double share = size > kept ? (size - kept) / (peak - kept) : 0;
                statics = loading(std::copysign(peak, way)) * share * share;
            }
        }
        before[0] = way;
        before[1] = statics;
        const double scale = rate_scale.abscissa.empty() ? 1 : rate_scale(way);
        return statics + scale * rate_force(rate);
    }
};

class GeneralDiscreteBeam final : public DiscreteBeamLaw {
public:
    GeneralDiscreteBeam(const Record& material, const Model& model)
        : one_(material.keyword == "MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM"),
          one_sum_(material.integer("FCRIT") == 1)
    {
        along_nodes = one_;
        if (material.integer("IFLAG") != 0)
            reject_field(material, "IFLAG", "only 0, the formulation in displacements, is supported");
        const Id option = material.integer("IUNLD");
        if (option != 0 && option != 2 && option != 3) {
            reject_field(material, "IUNLD",
                         fmt::format("{} is not supported (0: along the loading curve, 2: along a curve of "
                                     "its own, 3: quadratic to a permanent offset)",
                                     option));
        }
        const double offset = material.real("OFFSET");
        if (option == 3 && !(offset >= 0 && offset < 1))
            reject_field(material, "OFFSET", fmt::format("{} is not from 0 to below 1", offset));
        constexpr const char* axes[] = {"TR", "TS", "TT", "RR", "RS", "RT"};
        constexpr const char* unloading[] = {"TUR", "TUS", "TUT", "RUR", "RUS", "RUT"};
        constexpr const char* damping[] = {"TDR", "TDS", "TDT", "RDR", "RDS", "RDT"};
        constexpr const char* scale[] = {"TER", "TES", "TET", "RER", "RES", "RET"};
        constexpr const char* limit[] = {"TFAILR", "TFAILS", "TFAILT"};
        constexpr const char* compression[] = {"CFAILR", "CFAILS", "CFAILT"};
        constexpr const char* start[] = {"UR", "US", "UT", "WR", "WS", "WT"};
        for (int i = 0; i < (one_ ? 1 : 6); ++i) {
            const auto name = [&](const char* single, std::string whole) {
                return one_ ? std::string(single) : std::move(whole);
            };
            const auto odd = [&](const std::string& field) {
                return odd_curve(material, field.c_str(), model);
            };
            const char* prefix = i < 3 ? "U" : "W";
            GeneralSpring& spring = springs_[i];
            spring.unloading = option == 0   ? GeneralSpring::Unloading::elastic
                               : option == 2 ? GeneralSpring::Unloading::curves
                                             : GeneralSpring::Unloading::permanent;
            spring.offset = offset;
            spring.loading = odd(name("LCIDT", std::string("LCID") + axes[i]));
            spring.returning = odd(name("LCIDTU", std::string("LCID") + unloading[i]));
            spring.rate_force = odd(name("LCIDTD", std::string("LCID") + damping[i]));
            const std::string scale_field = name("LCIDTE", std::string("LCID") + scale[i]);
            if (material.integer(scale_field) != 0)
                spring.rate_scale = curve_of(material, scale_field, model).curve;
            spring.tension_limit =
                std::abs(material.real(name("UTFAIL", std::string(prefix) + limit[i % 3])));
            spring.compression_limit =
                std::abs(material.real(name("UCFAIL", std::string(prefix) + compression[i % 3])));
            spring.start = material.real(name("IU", std::string("I") + start[i]));
            spring.stiffness = option == 2 ? material.real(one_ ? "K" : i < 3 ? "KT" : "KR") : 0;
            if (spring.stiffness == 0 && option == 2)
                spring.stiffness = std::max(steepest_slope(spring.loading), steepest_slope(spring.returning));
        }
    }

    void advance(std::span<DiscreteBeamPoint> points, double, double) const override
    {
        for (DiscreteBeamPoint& point : points) {
            double tension = 0, compression = 0;
            for (int i = 0; i < (one_ ? 1 : 6); ++i) {
                const GeneralSpring& spring = springs_[i];
                // Only one of the two ways of unloading keeps something.
                double* kept = point.history.data() + 3 * i;
                const bool permanent = spring.unloading == GeneralSpring::Unloading::permanent;
                double unused[2]{};
                point.force[i] = spring.force(point.way[i], point.rate[i], permanent ? kept : unused,
                                              permanent ? unused : kept);
                const double way = point.way[i] + spring.start;
                const double limit = way < 0 ? spring.compression_limit : spring.tension_limit;
                if (limit > 0) (way < 0 ? compression : tension) += (way / limit) * (way / limit);
            }
            const bool failed = one_sum_ ? tension + compression >= 1 : tension >= 1 || compression >= 1;
            point.failed = point.failed || failed;
        }
    }
    DiscreteFreedoms stiffness(const DiscreteBeamPoint&) const override
    {
        DiscreteFreedoms result{};
        for (int i = 0; i < 6; ++i) result[i] = springs_[i].largest_stiffness();
        return result;
    }
    DiscreteFreedoms damping(const DiscreteBeamPoint&) const override
    {
        DiscreteFreedoms result{};
        for (int i = 0; i < 6; ++i) result[i] = steepest_slope(springs_[i].rate_force);
        return result;
    }

private:
    std::array<GeneralSpring, 6> springs_;
    bool one_;     ///< *MAT_121
    bool one_sum_; ///< FCRIT = 1
};

} // namespace

std::unique_ptr<DiscreteBeamLaw> make_general_discrete_beam(const Record& material, const Model& model)
{
    return std::make_unique<GeneralDiscreteBeam>(material, model);
}

} // namespace plash

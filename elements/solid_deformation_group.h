#pragma once

#include "elements/solid_deformation_point.h"
#include "elements/solid_followed_point.h"
#include "elements/solid_rate_group.h"

namespace plash {

/// The group of a law of the deformation gradient: solids with one point, whose gradient is that between
/// start and now at the centre, ten-node tetrahedra likewise, and fully integrated solids, whose points
/// follow theirs. shear_modulus, poisson_ratio  at small strains
template <class Law>
std::unique_ptr<SolidGroup> make_deformation_group(const Record& material, const Record* equation_of_state,
                                                   Law law, double shear_modulus, double poisson_ratio,
                                                   SolidSetup setup, State& state)
{
    refuse_equation_of_state(material, equation_of_state, setup);
    setup.parameters.density = law.density;
    setup.shear_modulus = shear_modulus;
    setup.parameters.hourglass.shear_modulus = shear_modulus;
    setup.parameters.hourglass.poisson_ratio = poisson_ratio;
    if (setup.eight_points) {
        using Point = FollowedPoint<Law>;
        const SolidShear shear = setup.shear;
        return std::make_unique<SolidEightPoint<Point>>(Point{std::move(law)}, shear, std::move(setup),
                                                        state);
    }
    const auto make = [&]<SolidGradientRule rule>() -> std::unique_ptr<SolidGroup> {
        using Point = DeformationPoint<Law, rule>;
        return std::make_unique<SolidOnePoint<Point, rule>>(Point{std::move(law)}, std::move(setup), state);
    };
    if (setup.ten_nodes) {
        using Point = DeformationPoint<Law, SolidGradientRule::mean>;
        return std::make_unique<SolidTenPoint<Point>>(Point{std::move(law)}, std::move(setup), state);
    }
    if (setup.rule == SolidGradientRule::centre) return make.template operator()<SolidGradientRule::centre>();
    return make.template operator()<SolidGradientRule::mean>();
}

} // namespace plash

#pragma once

#include "elements/solid_eight_point.h"
#include "elements/solid_laws.h"
#include "elements/solid_nodal_volume.h"
#include "elements/solid_one_point.h"
#include "elements/solid_points.h"
#include "elements/solid_ten_point.h"

#include <fmt/format.h>

namespace plash {

/// The group of a material point, with the gradient rule that the set-up asks for.
template <class Point>
std::unique_ptr<SolidGroup> make_point_group(Point point, SolidSetup setup, State& state)
{
    if (setup.eight_points) {
        const SolidShear shear = setup.shear;
        return std::make_unique<SolidEightPoint<Point>>(std::move(point), shear, std::move(setup), state);
    }
    if (setup.ten_nodes)
        return std::make_unique<SolidTenPoint<Point>>(std::move(point), std::move(setup), state);
    if (setup.nodal_volume)
        return std::make_unique<SolidNodalVolume<Point>>(std::move(point), std::move(setup), state);
    if (setup.rule == SolidGradientRule::centre) {
        return std::make_unique<SolidOnePoint<Point, SolidGradientRule::centre>>(std::move(point),
                                                                                 std::move(setup), state);
    }
    return std::make_unique<SolidOnePoint<Point, SolidGradientRule::mean>>(std::move(point), std::move(setup),
                                                                           state);
}

/// DeckError when a part names an equation of state for a material that has its own pressure.
inline void refuse_equation_of_state(const Record& material, const Record* equation_of_state,
                                     const SolidSetup& setup)
{
    if (!equation_of_state) return;
    const Part& part = setup.model.parts[setup.part];
    throw DeckError(part.where,
                    fmt::format("*PART {}, field EOSID: *{} takes no equation of state, but {} is "
                                "given; leave the field empty",
                                part.id, material.keyword, equation_of_state->id));
}

/// The group of a law in rate form, which has no use for an equation of state.
template <class Law>
std::unique_ptr<SolidGroup> make_rate_group(const Record& material, const Record* equation_of_state,
                                            SolidSetup setup, State& state)
{
    refuse_equation_of_state(material, equation_of_state, setup);
    RatePoint<Law> point{Law::from_record(material, setup.model)};
    setup.parameters.density = point.law.density;
    setup.shear_modulus = point.law.young_modulus / (2 * (1 + point.law.poisson_ratio));
    setup.parameters.hourglass.shear_modulus = setup.shear_modulus;
    setup.parameters.hourglass.poisson_ratio = point.law.poisson_ratio;
    if constexpr (requires { point.law.shortest_step; }) setup.shortest_step = point.law.shortest_step;
    return make_point_group(std::move(point), std::move(setup), state);
}

} // namespace plash

#pragma once

#include "materials/parameters.h"
#include "math/lanes.h"
#include "math/symmetric_tensor.h"

#include <limits>

namespace plash {

/// What a metal under shock does in tension (SPALL and PC of *MAT_JOHNSON_COOK, *MAT_ELASTIC_PLASTIC_HYDRO).
/// Limit: the pressure stops at PC. Principal: a point spalls when its largest principal stress reaches -PC.
/// Hydrostatic: it spalls when its pressure falls below PC. What has spalled is rubble, without deviator and
/// without tension. Source: Hallquist (2006), LS-DYNA theory manual, material models 10 and 11.
struct Spall {
    enum class Model { limit, principal, hydrostatic };

    Model model = Model::limit;
    double cutoff = -std::numeric_limits<double>::infinity(); ///< PC [stress]

    /// DeckError for a positive PC and for an unknown model.
    static Spall from_record(const Record& record, double fallback_model);

    bool breaks() const { return model != Model::limit && cutoff > -std::numeric_limits<double>::infinity(); }

    /// Lowest pressure that the equation of state may give [stress].
    double lowest_pressure() const
    {
        return model == Model::limit ? cutoff : -std::numeric_limits<double>::infinity();
    }

    /// Whether the points of a batch spall now, and what is left of those that have.
    /// spalled  0 or 1, in and out
    template <class Lane>
    void apply(SymmetricTensor<Lane>& shear, Lane& pressure, Lane& spalled) const
    {
        if (!breaks()) return;
        const Lane one = broadcast<Lane>(1);
        if (model == Model::hydrostatic) {
            spalled = pressure < cutoff ? one : spalled;
        } else if (any(sqrt((2.0 / 3) * contract(shear, shear)) - pressure >= -cutoff)) {
            // No principal deviator is larger than sqrt(2/3) of the deviator's norm.
            for (int lane = 0; lane < lanes_in<Lane>; ++lane) {
                const double largest = largest_principal({lane_of(shear.xx, lane), lane_of(shear.yy, lane),
                                                          lane_of(shear.zz, lane), lane_of(shear.xy, lane),
                                                          lane_of(shear.yz, lane), lane_of(shear.zx, lane)}) -
                                       lane_of(pressure, lane);
                if (largest >= -cutoff) set_lane(spalled, lane, 1);
            }
        }
        const MaskOf<Lane> rubble = spalled > 0.0;
        if (!any(rubble)) return;
        pressure = rubble ? max(pressure, Lane{}) : pressure;
        for (Lane* component : {&shear.xx, &shear.yy, &shear.zz, &shear.xy, &shear.yz, &shear.zx})
            *component = rubble ? Lane{} : *component;
    }

private:
    static double largest_principal(const SymmetricTensor<double>& deviator);
};

} // namespace plash

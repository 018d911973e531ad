#pragma once

#include "materials/history.h"
#include "materials/parameters.h"
#include "materials/von_mises.h"
#include "math/lanes.h"
#include "math/symmetric_tensor.h"

#include <array>

namespace plash {

/// *MAT_ELASTIC (001): isotropic hypoelasticity, Hooke's law for the stress rate.
/// Source: Hallquist (2006), LS-DYNA theory manual, material model 1.
struct Elastic {
    double density;       ///< [mass/volume]
    double young_modulus; ///< [stress]
    double poisson_ratio; ///< [-]

    static constexpr int history_size = 0;
    std::array<double, history_size> initial_history() const { return {}; }

    static Elastic from_record(const Record& record, const Model&)
    {
        if (record.real("E") < 0) {
            reject_field(record, "E", "a curve or function as modulus (E < 0) is not supported");
        }
        return {positive(record, "RO", "mass density"), positive(record, "E", "Young's modulus"),
                poisson_ratio_of(record)};
    }

    double shear_modulus() const { return young_modulus / (2 * (1 + poisson_ratio)); }
    double bulk_modulus() const { return young_modulus / (3 * (1 - 2 * poisson_ratio)); }

    /// One step at a batch of solid points.
    /// stress     Cauchy [stress], in and out
    /// increment  strain increments of the step [-]
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment, HistoryView<Lane>,
                double /*time_step*/) const
    {
        add_elastic_stress(stress, increment, shear_modulus(), bulk_modulus() - 2 * shear_modulus() / 3);
    }

    /// One step at a batch of shell points with stress.zz = 0.
    /// increment  in: all but zz; out: zz, the thickness strain that keeps stress.zz at zero [-]
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane>, double /*time_step*/) const
    {
        add_plane_elastic_stress(stress, increment, young_modulus, poisson_ratio);
        increment.zz = -poisson_ratio / (1 - poisson_ratio) * (increment.xx + increment.yy);
    }

    /// One step at a batch of beam points; see materials/history.h.
    template <class Lane>
    void update_beam(Lane* stress, const Lane& axial, const Lane& rs, const Lane& tr, HistoryView<Lane>,
                     double /*time_step*/) const
    {
        stress[0] += young_modulus * axial;
        stress[1] += shear_modulus() * rs;
        stress[2] += shear_modulus() * tr;
    }
};

} // namespace plash

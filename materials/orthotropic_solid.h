#pragma once

#include "materials/history.h"
#include "materials/parameters.h"
#include "math/symmetric_tensor.h"

#include <algorithm>
#include <array>

namespace plash {

/// *MAT_ORTHOTROPIC_ELASTIC (002) with all six stresses: Hooke's law for the stress rate in the material axes
/// a, b and c. The stiffness is the inverse of the compliances 1 / EA ..., -PRBA / EB ... (Hallquist 2006,
/// material model 2).
struct OrthotropicSolid {
    double density = 0;                                          ///< [mass/volume]
    double stiffness_a = 0, stiffness_b = 0, stiffness_c = 0;    ///< of normal stresses by their own strain
    double stiffness_ab = 0, stiffness_bc = 0, stiffness_ca = 0; ///< and by each other's [stress]
    double shear_ab = 0, shear_bc = 0, shear_ca = 0;             ///< moduli [stress]

    static constexpr int history_size = 0;
    std::array<double, history_size> initial_history() const { return {}; }
    double largest_modulus() const { return std::max({stiffness_a, stiffness_b, stiffness_c}); }

    static OrthotropicSolid from_record(const Record& record, const Model&)
    {
        const double ea = positive(record, "EA", "Young's modulus along a");
        const double eb = positive(record, "EB", "Young's modulus along b");
        const double ec = positive(record, "EC", "Young's modulus along c");
        // Compliances; PRBA is the strain along a per strain along b under stress along b, and so on.
        const double ab = -record.real("PRBA") / eb, ac = -record.real("PRCA") / ec;
        const double bc = -record.real("PRCB") / ec;
        const double a = 1 / ea, b = 1 / eb, c = 1 / ec;
        const double determinant = a * (b * c - bc * bc) - ab * (ab * c - bc * ac) + ac * (ab * bc - b * ac);
        if (!(determinant > 0 && a * b > ab * ab && b * c > bc * bc && a * c > ac * ac)) {
            reject_field(record, "PRBA", "the elastic constants are not positive definite");
        }
        OrthotropicSolid law;
        law.density = positive(record, "RO", "mass density");
        law.stiffness_a = (b * c - bc * bc) / determinant;
        law.stiffness_b = (a * c - ac * ac) / determinant;
        law.stiffness_c = (a * b - ab * ab) / determinant;
        law.stiffness_ab = (ac * bc - ab * c) / determinant;
        law.stiffness_bc = (ab * ac - bc * a) / determinant;
        law.stiffness_ca = (ab * bc - ac * b) / determinant;
        law.shear_ab = positive(record, "GAB", "shear modulus ab");
        law.shear_bc = positive(record, "GBC", "shear modulus bc");
        law.shear_ca = positive(record, "GCA", "shear modulus ca");
        return law;
    }

    /// One step; stress and increment in the material axes (a, b, c = x, y, z).
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const SymmetricTensor<Lane>& increment, HistoryView<Lane>,
                double /*time_step*/) const
    {
        const auto& e = increment;
        stress.xx += stiffness_a * e.xx + stiffness_ab * e.yy + stiffness_ca * e.zz;
        stress.yy += stiffness_ab * e.xx + stiffness_b * e.yy + stiffness_bc * e.zz;
        stress.zz += stiffness_ca * e.xx + stiffness_bc * e.yy + stiffness_c * e.zz;
        stress.xy += 2 * shear_ab * e.xy;
        stress.yz += 2 * shear_bc * e.yz;
        stress.zx += 2 * shear_ca * e.zx;
    }
};

} // namespace plash

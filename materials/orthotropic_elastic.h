#pragma once

#include "materials/left_cauchy_green.h"
#include "materials/orthotropic_axes.h"
#include "materials/orthotropic_solid.h"

namespace plash {

/// *MAT_ORTHOTROPIC_ELASTIC (002) of solids: second Piola-Kirchhoff stress = stiffness : Green's strain, both
/// in the material axes as they stand at the start, so that any rotation is exact and the work of a closed
/// path is none. Source: Hallquist (2006), LS-DYNA theory manual, material model 2.
struct OrthotropicElasticSolid {
    double density = 0; ///< [mass/volume]
    OrthotropicSolid stiffness;
    OrthotropicAxes axes;

    /// The axes at the start.
    static constexpr int history_size = OrthotropicAxes::history_size;

    static OrthotropicElasticSolid from_record(const Record& record, const Model& model)
    {
        const OrthotropicSolid stiffness = OrthotropicSolid::from_record(record, model);
        if (record.real("BETA") != 0) reject_field(record, "BETA", "the angle is not supported for solids");
        return {stiffness.density, stiffness, OrthotropicAxes::from_record(record, model)};
    }

    double mean_shear_modulus() const
    {
        return (stiffness.shear_ab + stiffness.shear_bc + stiffness.shear_ca) / 3;
    }

    /// Cauchy stress at the end of a step: F S F^T / J.
    template <class Lane>
    void update(SymmetricTensor<Lane>& stress, const Tensor3<Lane>& deformation,
                const SymmetricTensor<Lane>& /*increment*/, HistoryView<Lane> history,
                double /*time_step*/) const
    {
        const Tensor3<Lane> local = stored_axes(history.values);
        const SymmetricTensor<Lane> right = left_cauchy_green(transposed(deformation)).left; // F^T F
        const SymmetricTensor<Lane> strain{0.5 * (right.xx - 1.0), 0.5 * (right.yy - 1.0),
                                           0.5 * (right.zz - 1.0), 0.5 * right.xy,
                                           0.5 * right.yz,         0.5 * right.zx};
        SymmetricTensor<Lane> along_axes{};
        stiffness.update(along_axes, rotated(strain, local), history, 0);
        stress =
            (1.0 / determinant(deformation)) * rotated(rotated(along_axes, transposed(local)), deformation);
    }

    /// Density times the square of the speed of the fastest wave along an axis that is stretched to s =
    /// lambda^2 of the largest: C s (3 s - 1) / (2 J), not below that of the start.
    template <class Lane>
    Lane wave_modulus(const Tensor3<Lane>& deformation) const
    {
        const Lane s = max(left_cauchy_green(deformation).largest_square(), broadcast<Lane>(1));
        return (0.5 * stiffness.largest_modulus()) * s * (3.0 * s - 1.0) / determinant(deformation);
    }
};

} // namespace plash

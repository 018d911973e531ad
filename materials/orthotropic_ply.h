#pragma once

#include "materials/history.h"
#include "materials/parameters.h"
#include "math/lanes.h"
#include "math/symmetric_tensor.h"

#include <array>
#include <cmath>

namespace plash {

/// Elastic constants of a ply in its axes a (fibres) and b, with plane stress.
struct OrthotropicPlane {
    double density = 0;                    ///< [mass/volume]
    double ea = 0, eb = 0;                 ///< [stress]
    double nu_ba = 0;                      ///< PRBA: strain along a per strain along b under stress along b
    double gab = 0, gbc = 0, gca = 0;      ///< [stress]
    double thinning_a = 0, thinning_b = 0; ///< PRCA / EC, PRCB / EC: how stresses thin the ply [1/stress]

    static OrthotropicPlane from_record(const Record& record)
    {
        OrthotropicPlane ply;
        ply.density = positive(record, "RO", "mass density");
        ply.ea = positive(record, "EA", "Young's modulus along a");
        ply.eb = positive(record, "EB", "Young's modulus along b");
        ply.nu_ba = record.real("PRBA");
        ply.gab = positive(record, "GAB", "shear modulus ab");
        ply.gbc = positive(record, "GBC", "shear modulus bc");
        ply.gca = positive(record, "GCA", "shear modulus ca");
        if (record.peek("EC") && record.real("EC") > 0) {
            ply.thinning_a = record.real("PRCA") / record.real("EC");
            ply.thinning_b = record.real("PRCB") / record.real("EC");
        }
        if (!(ply.nu_ba * ply.nu_ba * ply.ea / ply.eb < 1)) {
            reject_field(record, "PRBA",
                         "the elastic constants are not positive definite: PRBA^2 EA / EB is "
                         "not below 1");
        }
        return ply;
    }

    /// 1 - nu_ab nu_ba
    double coupling() const { return 1 - nu_ba * nu_ba * ea / eb; }
    double plane_a() const { return ea / coupling(); }
    double plane_b() const { return eb / coupling(); }
    double plane_ab() const { return nu_ba * ea / coupling(); }
    double largest_modulus() const { return std::max(plane_a(), plane_b()); }
};

/// Square of the strain that the limits EFS and ERODS mean, 4/3 (a^2 + a b + b^2 + g^2 / 4), of the normal
/// strains a, b and the engineering shear strain g of a ply.
template <class Lane>
inline Lane effective_ply_strain_square(const Lane& a, const Lane& b, const Lane& engineering_shear)
{
    const Lane half = 0.5 * engineering_shear;
    return (4.0 / 3) * (a * a + a * b + b * b + half * half);
}

/// A ply that is lost (sound = 0) carries nothing any more.
template <class Lane>
inline void clear_lost_ply(SymmetricTensor<Lane>& stress, const Lane& sound)
{
    for (Lane* component : {&stress.xx, &stress.yy, &stress.xy, &stress.yz, &stress.zx})
        *component = sound > 0.0 ? *component : Lane{};
}

/// *MAT_ORTHOTROPIC_ELASTIC (002) in plane stress: Hooke's law for the stress rate in the axes of the ply.
struct OrthotropicElastic {
    OrthotropicPlane plane;

    static constexpr int history_size = 0;
    std::array<double, history_size> initial_history() const { return {}; }
    double density() const { return plane.density; }
    double largest_modulus() const { return plane.largest_modulus(); }

    static OrthotropicElastic from_record(const Record& record, const Model&)
    {
        return {OrthotropicPlane::from_record(record)};
    }

    /// One step; stress and increment in the axes of the ply, zz is left to the caller.
    template <class Lane>
    void update_plane_stress(SymmetricTensor<Lane>& stress, SymmetricTensor<Lane>& increment,
                             HistoryView<Lane>, double) const
    {
        stress.xx += plane.plane_a() * increment.xx + plane.plane_ab() * increment.yy;
        stress.yy += plane.plane_ab() * increment.xx + plane.plane_b() * increment.yy;
        stress.xy += 2 * plane.gab * increment.xy;
        stress.yz += 2 * plane.gbc * increment.yz;
        stress.zx += 2 * plane.gca * increment.zx;
    }
};

} // namespace plash

#include "materials/fabric.h"

#include <fmt/format.h>

namespace plash {

namespace {

/// Plane stress of the liner over that of the fabric at the same strain.
Fabric::Liner liner_on(const OrthotropicPlane& fabric, const Record& record)
{
    Fabric::Liner liner;
    liner.share = record.real("LRATIO");
    if (!(liner.share >= 0 && liner.share <= 1))
        reject_field(
            record, "LRATIO",
            fmt::format("the liner's share of the thickness is {}; it lies between 0 and 1", liner.share));
    const double nu = record.real("PRL");
    if (!(nu > -1 && nu < 1))
        reject_field(record, "PRL", "Poisson's ratio of the liner lies between -1 and 1");
    const double modulus = record.real("EL");
    if (modulus < 0) reject_field(record, "EL", "Young's modulus of the liner is negative");
    liner.plane_modulus = modulus / (1 - nu * nu);
    // Strain of the fabric by its stress: (1, -nu_ab; -nu_ba, 1) with 1 / EA, 1 / EB.
    const double strain_aa = 1 / fabric.ea, strain_bb = 1 / fabric.eb, strain_ab = -fabric.nu_ba / fabric.eb;
    const double along = liner.plane_modulus, across = nu * liner.plane_modulus;
    liner.aa_aa = along * strain_aa + across * strain_ab;
    liner.aa_bb = along * strain_ab + across * strain_bb;
    liner.bb_aa = across * strain_aa + along * strain_ab;
    liner.bb_bb = across * strain_ab + along * strain_bb;
    liner.ab_ab = modulus / (2 * (1 + nu)) / fabric.gab;
    return liner;
}

} // namespace

Fabric Fabric::from_record(const Record& record, const Model&)
{
    Fabric fabric;
    OrthotropicPlane& plane = fabric.plane;
    plane.density = positive(record, "RO", "mass density");
    plane.ea = positive(record, "EA", "Young's modulus along a");
    plane.eb = record.real("EB") > 0 ? record.real("EB") : plane.ea;
    plane.nu_ba = record.real("PRBA");
    plane.gab = record.real("GAB") > 0 ? record.real("GAB") : plane.ea / (2 * (1 + plane.nu_ba));
    plane.gbc = plane.gca = plane.gab;
    if (!(plane.nu_ba * plane.nu_ba * plane.ea / plane.eb < 1)) {
        reject_field(record, "PRBA", "the elastic constants are not positive definite");
    }
    const Id form = record.integer("FORM");
    if (form != 0 && form != 1 && form != 12) {
        reject_field(record, "FORM",
                     fmt::format("form {} is not supported (0, 1 and 12: constant moduli)", form));
    }
    if (record.real("EL") != 0 && record.real("LRATIO") != 0) fabric.liner = liner_on(plane, record);
    fabric.no_compression = record.real("CSE") == 1;
    return fabric;
}

} // namespace plash

#include "materials/fabric.h"

#include <fmt/format.h>

namespace plash {

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
    if (record.real("EL") != 0 && record.real("LRATIO") != 0) {
        reject_field(record, "EL", "an elastic liner is not supported");
    }
    fabric.no_compression = record.real("CSE") == 1;
    return fabric;
}

} // namespace plash

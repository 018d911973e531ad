#include "materials/compression_tension.h"

#include <fmt/format.h>

namespace plash {

namespace {

Hardening flow_curve(const Record& record, const char* field, const Model& model)
{
    const Curve& curve = curve_of(record, field, model).curve;
    for (double stress : curve.ordinate) {
        if (!(stress > 0))
            reject_field(record, field, fmt::format("the curve gives the yield stress {}", stress));
    }
    return Hardening::curve(curve);
}

} // namespace

CompressionTension CompressionTension::from_record(const Record& record, const Model& model)
{
    CompressionTension law;
    law.density = positive(record, "RO", "mass density");
    law.young_modulus = positive(record, "E", "Young's modulus");
    law.poisson_ratio = poisson_ratio_of(record);
    law.pressed = flow_curve(record, "LCIDC", model);
    law.pulled = flow_curve(record, "LCIDT", model);
    law.pressed_from = record.real("PC");
    law.pulled_from = record.real("PT");
    if (law.pressed_from < 0 || law.pulled_from < 0) {
        reject_field(record, law.pressed_from < 0 ? "PC" : "PT", "a negative pressure is not supported");
    }
    for (const char* field : {"LCSRC", "LCSRT", "LCFAIL", "EC", "RPCT", "PCUTF", "K"}) {
        if (record.real(field) != 0)
            reject_field(record, field, "this option is not supported; leave it at 0");
    }
    if (record.real("C") > 0) {
        law.reference_rate = record.real("C");
        law.rate_exponent = 1 / positive(record, "P", "exponent of Cowper and Symonds, needed with C");
        if (record.real("SRFLAG") != 0)
            reject_field(record, "SRFLAG", "only the rate of the total strain (0) is supported");
    }
    const double failure = record.real("FAIL", 1e20);
    if (failure < 0) reject_field(record, "FAIL", "user-defined failure (FAIL < 0) is not supported");
    law.failure_strain = failure < 1e20 ? failure : 0;
    law.shortest_step = record.real("TDEL");
    return law;
}

} // namespace plash

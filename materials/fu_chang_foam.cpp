#include "materials/fu_chang_foam.h"

#include "materials/parameters.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

FuChangFoam FuChangFoam::from_record(const Record& record, const Model& model)
{
    FuChangFoam law;
    LowDensityFoam& foam = law.foam;
    law.density = foam.density = positive(record, "RO", "mass density");
    foam.young_modulus = positive(record, "E", "Young's modulus in tension");
    const Id id = record.integer("TBID");
    if (id == 0) reject_field(record, "TBID", "a foam without curves (D0 to C5) is not supported");
    const auto table = std::find_if(model.tables.begin(), model.tables.end(),
                                    [&](const NamedTable& one) { return one.id == id; });
    if (table == model.tables.end()) {
        const Curve& curve = curve_of(record, "TBID", model).curve;
        foam.set_loading(record, "TBID", Hardening::curve(curve), curve);
    } else {
        std::vector<const Curve*> curves;
        for (Index curve : table->curves) curves.push_back(&model.curves[curve].curve);
        foam.set_loading(record, "TBID",
                         Hardening::table(table->abscissa, curves, table->abscissa.front() < 0),
                         *curves.front());
    }
    const double cutoff = record.real("TC");
    if (cutoff < 0) reject_field(record, "TC", fmt::format("{} is negative (tensile cut-off)", cutoff));
    foam.tensile_cutoff = value_or(cutoff, 1e20);
    foam.tears = record.real("FAIL") == 1;
    const double hysteresis = record.real("HU");
    if (hysteresis < 0 || hysteresis > 1) {
        reject_field(record, "HU", fmt::format("{} is not between 0 and 1 (hysteresis factor)", hysteresis));
    }
    foam.hysteresis = value_or(hysteresis, 1); // 0: back along the curve of the lowest rate
    foam.shape = value_or(record.real("SHAPE"), 1);
    if (value_or(record.real("EXPON", 1), 1) != 1)
        reject_field(record, "EXPON", "only the exponent 1 is supported");
    law.nominal = record.real("SFLAG") == 1;
    const double measure = record.real("RFLAG");
    if (measure != 0 && measure != 1 && measure != 2) reject_field(record, "RFLAG", "there are 0, 1 and 2");
    law.measure = measure == 0 ? Measure::largest : measure == 1 ? Measure::own : Measure::volume;
    if (record.real("TFLAG") != 0)
        reject_field(record, "TFLAG", "curves in tension are not supported; 0 (E) is");
    if (record.integer("PVID") != 0)
        reject_field(record, "PVID", "pressure over volume is not supported; leave it at 0");
    if (record.real("REF") != 0) {
        reject_field(record, "REF", "a reference geometry is not supported; leave the field at 0");
    }
    return law;
}

} // namespace plash

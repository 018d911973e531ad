#include "eos/pore_collapse.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

[[noreturn]] void refuse(const Record& record, const char* field, const std::string& complaint)
{
    throw DeckError(record.where, fmt::format("*{}, field {}: {}", record.keyword, field, complaint));
}

/// A curve of pressure over excess compression that rises everywhere.
const Curve& rising_curve(const Record& record, const char* field, const Model& model)
{
    const Id id = record.integer(field);
    const Index index = model.find_curve(id);
    if (index == none) refuse(record, field, fmt::format("there is no *DEFINE_CURVE {}", id));
    const Curve& curve = model.curves[index].curve;
    if (curve.abscissa.size() < 2) refuse(record, field, "the curve has fewer than two points");
    for (std::size_t i = 1; i < curve.abscissa.size(); ++i) {
        if (curve.ordinate[i] > curve.ordinate[i - 1]) continue;
        refuse(record, field,
               fmt::format("the pressure {} at {} does not rise above {} of the point before",
                           curve.ordinate[i], curve.abscissa[i], curve.ordinate[i - 1]));
    }
    return curve;
}

} // namespace

PoreCollapse PoreCollapse::from_record(const Record& record, const Model& model)
{
    PoreCollapse eos;
    const Curve& virgin = rising_curve(record, "NLD", model);
    const Curve& crushed = rising_curve(record, "NCR", model);
    eos.virgin = {virgin.abscissa, virgin.ordinate};
    eos.crushed = {crushed.abscissa, crushed.ordinate};
    eos.crushed_inverse = {crushed.ordinate, crushed.abscissa};
    eos.collapse_start = record.real("MU1");
    eos.collapse_end = record.real("MU2");
    if (!(eos.collapse_end > eos.collapse_start)) {
        refuse(record, "MU2", fmt::format("{} is not above MU1 = {}", eos.collapse_end, eos.collapse_start));
    }
    const double last_virgin = eos.virgin(eos.collapse_end), last_crushed = eos.crushed(eos.collapse_end);
    if (std::abs(last_virgin - last_crushed) > 0.01 * std::abs(last_crushed)) {
        refuse(
            record, "MU2",
            fmt::format("where all pores are closed the two curves meet, but at {} NLD gives {} and NCR {}",
                        eos.collapse_end, last_virgin, last_crushed));
    }
    eos.energy = record.real("IE0");
    const double excess = record.real("EC0");
    if (!(excess > -1)) refuse(record, "EC0", fmt::format("{} is not above -1", excess));
    eos.relative_volume = 1 / (1 + excess);
    eos.bulk_modulus = eos.evaluate(1 + excess, 1 + excess).cold_slope;
    return eos;
}

} // namespace plash

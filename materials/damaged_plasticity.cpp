#include "materials/damaged_plasticity.h"

#include "materials/parameters.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

std::array<double, DamagedPlasticity::history_size> DamagedPlasticity::initial_history() const
{
    std::array<double, history_size> values{};
    const auto own = law.initial_history();
    std::copy(own.begin(), own.end(), values.begin());
    return values;
}

DamagedPlasticity DamagedPlasticity::from_record(const Record& record, const Model& model)
{
    DamagedPlasticity damaged;
    damaged.law = PiecewiseLinearPlasticity::from_record(record, model);
    damaged.density = damaged.law.density;
    damaged.young_modulus = damaged.law.young_modulus;
    damaged.poisson_ratio = damaged.law.poisson_ratio;
    damaged.shortest_step = damaged.law.shortest_step;
    damaged.onset = record.real("EPPF", 1e12);
    damaged.rupture = value_or(record.real("EPPFR", 1e14), 1e14);
    if (damaged.onset < 0)
        reject_field(record, "EPPF", fmt::format("{} is a negative plastic strain", damaged.onset));
    if (record.integer("LCDM") != 0) {
        damaged.growth = curve_of(record, "LCDM", model).curve;
        for (std::size_t i = 0; i < damaged.growth.ordinate.size(); ++i) {
            const double damage = damaged.growth.ordinate[i], before = i ? damaged.growth.ordinate[i - 1] : 0;
            if (damage >= before && damage <= 1) continue;
            reject_field(record, "LCDM",
                         fmt::format("the damage {} at the strain {} is not between {} and 1 (damage "
                                     "rises from 0 to 1)",
                                     damage, damaged.growth.abscissa[i], before));
        }
    } else if (!(damaged.rupture > damaged.onset)) {
        reject_field(record, "EPPFR",
                     fmt::format("{} is not above EPPF = {}", damaged.rupture, damaged.onset));
    }
    return damaged;
}

} // namespace plash

#include "materials/spall.h"

#include "materials/principal_axes.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

Spall Spall::from_record(const Record& record, double fallback_model)
{
    Spall spall;
    const double cutoff = record.real("PC");
    if (cutoff > 0)
        reject_field(record, "PC", fmt::format("{} is positive (pressure in tension is negative)", cutoff));
    const double model = value_or(record.real("SPALL", fallback_model), fallback_model);
    if (cutoff == 0) return spall;
    spall.cutoff = cutoff;
    if (model != 1 && model != 2 && model != 3) {
        reject_field(record, "SPALL",
                     fmt::format("{} is no spall model (1: pressure limit, 2: largest principal stress, 3: "
                                 "hydrostatic tension)",
                                 model));
    }
    spall.model = model == 1 ? Model::limit : model == 2 ? Model::principal : Model::hydrostatic;
    return spall;
}

double Spall::largest_principal(const SymmetricTensor<double>& deviator)
{
    const auto values = principal_axes(deviator).value;
    return *std::max_element(values.begin(), values.end());
}

} // namespace plash

#include "materials/flow_points.h"

#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

Curve flow_points(const Record& record, int most)
{
    Curve points;
    for (int i = 1; i <= most; ++i) {
        const std::string strain_name = fmt::format("EPS{}", i), stress_name = fmt::format("ES{}", i);
        const double strain = record.real(strain_name), stress = record.real(stress_name);
        if (strain == 0 && stress == 0) {
            if (i == 1 && record.real("ES2") == 0 && record.real("EPS2") == 0) break;
            if (i > 1) break;
        }
        if (i > 1 && strain <= points.abscissa.back()) {
            reject_field(
                record, strain_name,
                fmt::format("{} does not rise above {} of the point before", strain, points.abscissa.back()));
        }
        if (!(stress > 0)) reject_field(record, stress_name, fmt::format("{} is no yield stress", stress));
        points.abscissa.push_back(strain);
        points.ordinate.push_back(stress);
    }
    return points;
}

} // namespace plash

#include "materials/orthotropic_axes.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

OrthotropicAxes axes_of(const Vec3& first, const Vec3& second)
{
    const Vec3 a = unit(first);
    return {OrthotropicAxes::Choice::vectors, a, unit(cross(cross(a, second), a))};
}

OrthotropicAxes OrthotropicAxes::from_record(const Record& record, const Model& model)
{
    const double option = record.real("AOPT");
    if (option == 0) return {};
    if (option < 0) {
        const Id id = static_cast<Id>(-option);
        const auto system = std::find_if(model.coordinate_systems.begin(), model.coordinate_systems.end(),
                                         [&](const CoordinateSystem& one) { return one.id == id; });
        if (system == model.coordinate_systems.end()) {
            reject_field(record, "AOPT", fmt::format("there is no coordinate system {}", id));
        }
        return {Choice::vectors, system->axes[0], system->axes[1]};
    }
    if (option != 2) {
        reject_field(
            record, "AOPT",
            fmt::format("{} is not supported for solids; there are 0 (by nodes), 2 (by vectors a and "
                        "d) and coordinate systems (negative)",
                        option));
    }
    const Vec3 a{record.real("A1"), record.real("A2"), record.real("A3")};
    const Vec3 d{record.real("D1"), record.real("D2"), record.real("D3")};
    if (!(norm(cross(a, d)) > 1e-12 * norm(a) * norm(d))) {
        reject_field(record, "AOPT", "the vectors a (A1 to A3) and d (D1 to D3) span no plane");
    }
    return axes_of(a, d);
}

} // namespace plash

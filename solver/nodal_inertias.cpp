#include "solver/nodal_inertias.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// The moment of inertia about any axis.
double inertia_of(const Record& record)
{
    const double moment = positive(record, "IXX", "moment of inertia");
    const auto reject = [&](const char* field) {
        reject_field(record, field,
                     fmt::format("moments of inertia of nodes have to be equal about all axes (IXX = IYY "
                                 "= IZZ = {}, the others zero)",
                                 moment));
    };
    for (const char* field : {"IYY", "IZZ"})
        if (std::abs(record.real(field) - moment) > 1e-6 * moment) reject(field);
    for (const char* field : {"IXY", "IXZ", "IYZ"})
        if (std::abs(record.real(field)) > 1e-6 * moment) reject(field);
    return moment;
}

} // namespace

void add_nodal_inertias(const Model& model, State& state)
{
    for (const Record& record : model.others) {
        if (record.keyword != "ELEMENT_INERTIA") continue;
        const auto& ids = model.nodes.id;
        const auto found = std::find(ids.begin(), ids.end(), record.integer("NID"));
        if (found == ids.end())
            reject_field(record, "NID", fmt::format("there is no node {}", record.integer("NID")));
        const auto node = static_cast<std::size_t>(found - ids.begin());
        state.need_rotation();
        state.inertia[node] += inertia_of(record);
        state.mass[node] += record.real("MASS");
    }
}

} // namespace plash

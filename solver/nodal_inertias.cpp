#include "solver/nodal_inertias.h"

#include "materials/parameters.h"
#include "rigid/deck_nodes.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>

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
    std::optional<DeckNodes> nodes; // only where a deck has such elements
    for_each_record(model, "ELEMENT_INERTIA", [&](const Record& record) {
        if (!nodes) nodes.emplace(model);
        const Index node = nodes->find(record.integer("NID"), record, record.where.line);
        state.need_rotation();
        state.inertia[node] += inertia_of(record);
        state.mass[node] += record.real("MASS");
    });
}

} // namespace plash

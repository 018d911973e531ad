#pragma once

#include "core/energy_ledger.h"
#include "model/model.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace plash {

/// Parts whose hourglass energy is more than a tenth of their internal energy, a line each, as long as it is
/// more than a thousandth of what the run has turned over: their mesh has moved in modes that one point
/// cannot see. Foams that are crushed against stresses near their modulus go askew in these modes where the
/// control is viscous, since it slows them but does not turn them back.
inline std::vector<std::string> hourglass_warnings(const EnergyLedger& ledger, const Model& model)
{
    std::vector<std::string> lines;
    for (std::size_t part = 0; part < ledger.part_hourglass.size(); ++part) {
        const double hourglass = ledger.part_hourglass[part], internal = ledger.part_internal[part];
        if (!(hourglass > 0.1 * internal && hourglass > 1e-3 * ledger.largest_turnover)) continue;
        lines.push_back(fmt::format(
            "part {} '{}': hourglass energy {:.3g}, internal energy {:.3g}: the mesh has moved in modes that "
            "one point cannot see; a finer mesh, hourglass control with stiffness (IHQ 4, 5, of solids 6) or "
            "a fully integrated ELFORM resists them",
            model.parts[part].id, model.parts[part].title, hourglass, internal));
    }
    return lines;
}

} // namespace plash

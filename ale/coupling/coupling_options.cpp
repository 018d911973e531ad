#include "ale/coupling/coupling_options.h"

#include "materials/parameters.h"
#include "model/eulerian.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace plash {

namespace {

using Direction = CouplingOptions::Direction;

/// LSTRSID by LSTRSTYP: 0 part set, 1 part, 2 segment set.
ContactSide structure_of(const Model& model, const Record& record)
{
    ContactSide side;
    if (record.integer("LSTRSTYP") != 2) {
        side.kind = ContactSide::Kind::parts;
        side.parts = parts_of_fields(model, record, "LSTRSID", "LSTRSTYP");
        return side;
    }
    const Id id = record.integer("LSTRSID");
    for (const SegmentSet& set : model.segment_sets) {
        if (set.id != id) continue;
        side.kind = ContactSide::Kind::segments;
        side.segments = set.segments;
        return side;
    }
    reject_field(record, "LSTRSID", fmt::format("there is no segment set {}", id));
}

unsigned fluids_of(const Model& model, const Record& record, const DeckGroups& groups)
{
    const Id choice = record.integer("MCOUP");
    if (choice < 0) return fluids_of_set(model, record, "MCOUP", -choice, groups);
    if (choice == 0) return ~0u;
    if (choice != 1)
        reject_field(record, "MCOUP",
                     fmt::format("{} is not one of 0 all groups, 1 the densest, negative: a set", choice));
    const DeckGroup* densest = nullptr;
    for (const DeckGroup& group : groups.groups)
        if (group.fluid != none && (!densest || group.density > densest->density)) densest = &group;
    return densest ? 1u << densest->fluid : 0u;
}

void set_common(const Model& model, const Record& record, const DeckGroups& groups, CouplingOptions& options)
{
    options.id = record.id;
    options.where = record.where;
    options.structure = structure_of(model, record);
    options.mesh_parts.resize(model.parts.size());
    for (Index part : parts_of_fields(model, record, "ALESID", "ALESTYP")) options.mesh_parts[part] = true;
    options.fluids = fluids_of(model, record, groups);
    options.start = record.real("START");
    options.end = value_or(record.real("END"), forever);
    options.friction = record.real("FRIC");
    options.penalty = value_or(record.real("PFAC"), 0.1);
    if (options.penalty >= 0) return;
    options.pressure_curve = model.find_curve(std::llround(-options.penalty));
    if (options.pressure_curve == none)
        reject_field(record, "PFAC", fmt::format("there is no curve {:g}", -options.penalty));
    options.penalty = 0.1;
}

CouplingOptions lagrange_in_solid(const Model& model, const Record& record, const DeckGroups& groups)
{
    CouplingOptions options;
    set_common(model, record, groups, options);
    const Id type = record.integer("CTYPE"), direction = record.integer("DIREC");
    if (type != 1 && type != 2 && type != 4 && type != 5)
        reject_field(
            record, "CTYPE",
            fmt::format("coupling type {} is not supported; there are 1 and 2 (constraint) and 4 and "
                        "5 (penalty)",
                        type));
    if (direction < 1 || direction > 3)
        reject_field(record, "DIREC",
                     fmt::format("{} is not one of 1 normal, 2 normal in compression, 3 all", direction));
    constexpr Direction directions[] = {Direction::normal, Direction::compression, Direction::all};
    options.direction = directions[direction - 1];
    options.stiffest = type <= 2;
    if (options.stiffest) options.direction = Direction::all;
    for (const char* porous : {"LCIDPOR", "NVENT"})
        if (record.real(porous) != 0) reject_field(record, porous, "porous coupling is not supported yet");
    options.points_per_edge = static_cast<int>(record.integer("NQUAD"));
    options.least_fraction = value_or(record.real("FRCMIN"), 0.5);
    options.turned = record.integer("NORM") == 1;
    const double thickness = record.real("THKF");
    options.with_thickness = thickness != 0;
    if (thickness < 0) options.structure.thickness = -thickness;
    if (thickness > 0) options.structure.thickness_scale = thickness;
    options.damping = record.real("DAMP");
    options.both_sides = record.integer("BOTHSIDES") == 1;
    options.contact = record.integer("CONTACT");
    // Slow enough not to shake the fluid: PLEAK = 0.1 takes leaked fluid back over some hundred cycles.
    if (record.integer("ILEAK") > 0) options.leak_control = 0.1 * value_or(record.real("PLEAK"), 0.1);
    return options;
}

CouplingOptions structured_fsi(const Model& model, const Record& record, const DeckGroups& groups)
{
    CouplingOptions options;
    set_common(model, record, groups, options);
    options.direction = Direction::compression;
    options.turned = record.integer("FLIP") == 1;
    return options;
}

} // namespace

std::vector<CouplingOptions> coupling_options_of(const Model& model, const DeckGroups& groups)
{
    std::vector<CouplingOptions> couplings;
    bool cut_cells = false;
    for (const Record& record : model.others)
        if (record.keyword == "PLASH_ALE_FORMULATION") cut_cells = record.integer("CUTCELLS") == 1;
    for (const Record& record : model.others) {
        if (record.keyword == "CONSTRAINED_LAGRANGE_IN_SOLID")
            couplings.push_back(lagrange_in_solid(model, record, groups));
        else if (record.keyword == "ALE_STRUCTURED_FSI")
            couplings.push_back(structured_fsi(model, record, groups));
        else
            continue;
        couplings.back().cut_cells = cut_cells;
        if (couplings.back().id == 0) couplings.back().id = static_cast<Id>(couplings.size());
    }
    return couplings;
}

} // namespace plash

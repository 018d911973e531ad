#include "ale/fluid_settings.h"

#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace plash {

namespace {

void set_advection(const Record& record, FluidSettings& settings)
{
    const Id method = record.integer("METH");
    switch (method) {
    case 1:
        settings.order = AdvectionOrder::donor_cell;
        break;
    case 2:
    case -2:
        settings.order = AdvectionOrder::van_leer;
        break;
    case 3:
    case 4:
        settings.order = AdvectionOrder::van_leer;
        settings.conserve_total_energy = true;
        break;
    default:
        reject_field(record, "METH", fmt::format("{} is not supported; there are 1, 2, -2, 3 and 4", method));
    }
}

void set_boundary(const Model& model, const Record& record, FluidSettings& settings)
{
    using Boundary = FluidSettings::Boundary;
    const Id boundary = record.integer("EBC");
    if (boundary < 0 || boundary > 2)
        reject_field(record, "EBC", fmt::format("{} is not one of 0 open, 1 stick, 2 slip", boundary));
    settings.boundary = boundary == 0 ? Boundary::open : boundary == 1 ? Boundary::stick : Boundary::slip;
    settings.outside_pressure = record.real("PREF");
    if (settings.outside_pressure < 0) {
        const Id curve = std::llround(-settings.outside_pressure);
        settings.outside_pressure = 0;
        settings.outside_pressure_curve = model.find_curve(curve);
        if (settings.outside_pressure_curve == none)
            reject_field(record, "PREF", fmt::format("there is no curve {}", curve));
    }
    const Id exempt = record.integer("NSIDEBC");
    if (exempt == 0) return;
    for (const NodeSet& set : model.node_sets) {
        if (set.id != exempt) continue;
        settings.exempt.assign(model.nodes.size(), false);
        for (Index node : set.nodes) settings.exempt[node] = true;
        return;
    }
    reject_field(record, "NSIDEBC", fmt::format("there is no node set {}", exempt));
}

/// Of *CONTROL_ALE or *SECTION_SOLID_ALE.
MeshSmoothing smoothing_of(const Record& record)
{
    MeshSmoothing smoothing;
    smoothing.start = record.real("START");
    smoothing.end = record.real("END");
    if (smoothing.end == 0) smoothing.end = 1e20;    // the section's default
    if (record.real("AFAC") == -1) return smoothing; // the manual's word for no smoothing
    NodeSmoothing& by = smoothing.by;
    const std::pair<const char*, double*> weights[] = {{"AFAC", &by.average},
                                                       {"BFAC", &by.volume},
                                                       {"CFAC", &by.isoparametric},
                                                       {"DFAC", &by.equipotential}};
    for (const auto& [field, weight] : weights) {
        *weight = record.real(field);
        if (!(*weight >= 0))
            reject_field(record, field, fmt::format("{:g} is no weight of smoothing", *weight));
    }
    return smoothing;
}

bool gives_smoothing(const Record& section)
{
    return section.keyword == "SECTION_SOLID_ALE" &&
           (section.real("AFAC") != 0 || section.real("BFAC") != 0 || section.real("CFAC") != 0 ||
            section.real("DFAC") != 0);
}

bool same(const MeshSmoothing& a, const MeshSmoothing& b)
{
    return a.by.average == b.by.average && a.by.volume == b.by.volume &&
           a.by.isoparametric == b.by.isoparametric && a.by.equipotential == b.by.equipotential &&
           a.start == b.start && a.end == b.end;
}

} // namespace

MeshSmoothing mesh_smoothing_of(const Model& model, const MeshBlock& block, const FluidSettings& settings)
{
    std::optional<MeshSmoothing> smoothing;
    Index last = none;
    for (const Index solid : block.solids) {
        const Index part = model.solids.part[solid];
        if (part == last) continue;
        last = part;
        const Record& section = model.sections[model.parts[part].section];
        const MeshSmoothing own = gives_smoothing(section) ? smoothing_of(section) : settings.mesh_smoothing;
        if (smoothing && !same(own, *smoothing))
            reject_field(
                section, "AFAC",
                fmt::format("the mesh of part {} is smoothed in one way only, but its parts have several",
                            model.parts[part].id));
        smoothing = own;
    }
    return smoothing.value_or(settings.mesh_smoothing);
}

FluidSettings fluid_settings_of(const Model& model)
{
    FluidSettings settings;
    for (const Record& record : model.others) {
        if (record.keyword != "CONTROL_ALE") continue;
        settings = {};
        set_advection(record, settings);
        set_boundary(model, record, settings);
        settings.mesh_smoothing = smoothing_of(record);
    }
    for (const Record& record : model.others) {
        if (record.keyword != "PLASH_ALE_FORMULATION") continue;
        settings.smooth = record.real("SMOOTH");
        if (!(settings.smooth >= 0 && settings.smooth <= 1)) {
            reject_field(record, "SMOOTH", fmt::format("{:g} is no share between 0 and 1", settings.smooth));
        }
        const Id cut_cells = record.integer("CUTCELLS");
        if (cut_cells != 0 && cut_cells != 1)
            reject_field(record, "CUTCELLS",
                         fmt::format("{} is not one of 0 springs, 1 cut cells", cut_cells));
    }
    return settings;
}

} // namespace plash

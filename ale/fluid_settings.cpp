#include "ale/fluid_settings.h"

#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>

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

void set_smoothing(const Record& record, FluidSettings& settings)
{
    settings.smoothing_start = record.real("START");
    settings.smoothing_end = record.real("END");
    if (record.real("AFAC") == -1) return; // the manual's word for no smoothing
    NodeSmoothing& mesh = settings.mesh_smoothing;
    const std::pair<const char*, double*> weights[] = {{"AFAC", &mesh.average},
                                                       {"BFAC", &mesh.volume},
                                                       {"CFAC", &mesh.isoparametric},
                                                       {"DFAC", &mesh.equipotential}};
    for (const auto& [field, weight] : weights) {
        *weight = record.real(field);
        if (!(*weight >= 0))
            reject_field(record, field, fmt::format("{:g} is no weight of smoothing", *weight));
    }
}

} // namespace

FluidSettings fluid_settings_of(const Model& model)
{
    FluidSettings settings;
    for (const Record& record : model.others) {
        if (record.keyword != "CONTROL_ALE") continue;
        settings = {};
        set_advection(record, settings);
        set_boundary(model, record, settings);
        set_smoothing(record, settings);
    }
    for (const Record& record : model.others) {
        if (record.keyword != "PLASH_ALE_FORMULATION") continue;
        settings.smooth = record.real("SMOOTH");
        if (!(settings.smooth >= 0 && settings.smooth <= 1)) {
            reject_field(record, "SMOOTH", fmt::format("{:g} is no share between 0 and 1", settings.smooth));
        }
    }
    return settings;
}

} // namespace plash

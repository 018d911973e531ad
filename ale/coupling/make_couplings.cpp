#include "ale/coupling/cut_coupling.h"
#include "ale/coupling/fluid_coupling.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

/// Shells once more, looking the other way.
void add_back_sides(Surface& surface)
{
    const std::size_t count = surface.segments.size();
    for (std::size_t i = 0; i < count; ++i) {
        Segment back = surface.segments[i];
        if (back.shell == none) continue;
        const auto [a, b, c, d] = back.nodes;
        back.nodes = c == d ? std::array<Index, 4>{a, c, b, b} : std::array<Index, 4>{a, d, c, b};
        surface.segments.push_back(back);
    }
}

} // namespace

std::vector<std::unique_ptr<SurfaceCoupling>>
make_fluid_couplings(const Model& model, const std::vector<EulerianFluid*>& fluids, const State& state)
{
    std::vector<std::unique_ptr<SurfaceCoupling>> couplings;
    if (fluids.empty()) return couplings;
    const std::vector<CouplingOptions> all = coupling_options_of(model, fluids.front()->groups());
    if (all.empty()) return couplings;
    const std::vector<PartData> parts = part_data(model);
    SurfaceOptions surface_options;
    surface_options.orient_by_deck = true;
    std::vector<std::vector<CoupledSurface>> cut(fluids.size());
    for (const CouplingOptions& options : all) {
        bool found = false;
        for (std::size_t number = 0; number < fluids.size(); ++number) {
            EulerianFluid* fluid = fluids[number];
            const auto& solids = fluid->block().solids;
            const auto takes_part = [&](Index solid) { return options.mesh_parts[model.solids.part[solid]]; };
            if (!std::any_of(solids.begin(), solids.end(), takes_part)) continue;
            found = true;
            surface_options.thickness_option = options.with_thickness ? 2 : 0;
            Surface surface = make_surface(model, parts, options.structure, surface_options);
            if (surface.segments.empty())
                throw DeckError(options.where, fmt::format("coupling {}: its structure has no shells and no "
                                                           "outer faces of solids",
                                                           options.id));
            if (options.cut_cells) {
                cut[number].push_back({options, std::move(surface)});
                check_cut_coupling(cut[number].back(), *fluid);
                continue;
            }
            if (options.both_sides) add_back_sides(surface);
            couplings.push_back(
                std::make_unique<FluidCoupling>(model, options, std::move(surface), *fluid, state.position));
        }
        if (!found)
            throw DeckError(options.where,
                            fmt::format("coupling {}: no Eulerian mesh belongs to its ALESID", options.id));
    }
    for (std::size_t number = 0; number < fluids.size(); ++number)
        if (!cut[number].empty())
            couplings.push_back(
                std::make_unique<CutCoupling>(std::move(cut[number]), *fluids[number], state.position));
    return couplings;
}

} // namespace plash

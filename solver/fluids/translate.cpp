#include "solver/fluids/translate.h"

#include "solver/fluids/old_water.h"
#include "solver/fluids/rest.h"
#include "solver/fluids/water_contacts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Direction against gravity as mesh_planes() takes it; without gravity the side on which most of the
/// structures' nodes lie.
int upward(const Model& model, const Water& water, const std::vector<Vec3>& structure)
{
    Vec3 up{};
    for (const BodyLoad& load : model.body_loads)
        if (load.kind == BodyLoad::Kind::translation) up += load.scale * load.direction;
    if (norm(up) == 0)
        for (const Vec3& point : structure)
            for (const auto component : vector_component)
                up.*component += std::max(point.*component - water.high.*component, 0.0) -
                                 std::max(water.low.*component - point.*component, 0.0);
    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::abs(up.*vector_component[other]) > std::abs(up.*vector_component[axis])) axis = other;
    const double along = up.*vector_component[axis];
    return along == 0 ? none : 2 * axis + (along > 0 ? 1 : 0);
}

/// Keywords that speak of the Eulerian mesh that was.
void drop_mesh_keywords(Model& model)
{
    static constexpr std::string_view names[] = {"ALE_",
                                                 "CONTROL_ALE",
                                                 "INITIAL_VOID",
                                                 "INITIAL_VOLUME_FRACTION",
                                                 "CONSTRAINED_LAGRANGE_IN_SOLID",
                                                 "DATABASE_FSI",
                                                 "SET_MULTI"};
    std::erase_if(model.others, [](const Record& record) {
        return std::any_of(std::begin(names), std::end(names),
                           [&](std::string_view name) { return record.keyword.starts_with(name); });
    });
}

/// Rigid walls that have become sides of a mesh act on structures alone, or on nothing.
void drop_walls(Model& model, const Water& water, const std::vector<bool>& orphan,
                std::vector<std::string>& lines)
{
    std::erase_if(model.rigid_walls, [&](RigidWall& wall) {
        if (!acts_on_water(wall, water)) return false;
        std::erase_if(wall.nodes, [&](Index node) { return orphan[node]; });
        if (wall.all_nodes || !wall.nodes.empty()) return false;
        lines.push_back(fmt::format("rigid wall {} went, as it acts on nothing else", wall.id));
        return true;
    });
}

std::vector<std::string> to_mesh(Model& model, const FluidChoice& choice, const Water& water)
{
    if (!water.solids && !water.particles) return {};
    if (water.mesh)
        throw DeckError({},
                        "the deck has an Eulerian mesh and other water beside it; --fluid ale makes one mesh "
                        "of water that has none yet");
    const std::vector<WaterWall> walls = walls_of(model, water, RigidWalls::all);
    const std::vector<DepthStress> stresses = depth_stresses(model);
    const WaterContacts contacts(model, water);
    const std::vector<Vec3> structure = contacts.structure_points(model);
    const MeshPlanes planes = mesh_planes(water, walls, choice, structure, upward(model, water, structure));
    std::vector<bool> changed(model.parts.size());
    for (Index part : water.parts) changed[part] = true;
    OldWater old(model, water, changed, FluidForm::ale);
    NewWater made = make_mesh_water(model, water, walls, planes);
    std::vector<std::string> lines = std::move(made.lines);
    drop_walls(model, water, old.orphans(), lines);
    old.hand_over(made, lines);
    contacts.translate(model, FluidForm::ale, water, changed, made, lines);
    rest_in_mesh(model, water, stresses, made, lines);
    if (std::none_of(model.others.begin(), model.others.end(),
                     [](const Record& record) { return record.keyword == "CONTROL_ALE"; }))
        model.others.push_back(made_record("CONTROL_ALE", choice.where, {{"METH", 2}}));
    return lines;
}

std::vector<std::string> to_elements(Model& model, const FluidChoice& choice, const Water& water)
{
    const FluidForm form = *choice.form;
    // Particles feel a mirror better than a plane that stops their centres.
    const std::vector<WaterWall> walls =
        walls_of(model, water, form == FluidForm::sph ? RigidWalls::possible : RigidWalls::none);
    const WaterContacts contacts(model, water);
    // What has the form already stays as it is.
    std::vector<bool> changed(model.parts.size()), present(model.parts.size());
    if (form == FluidForm::sph)
        for (Index part : model.particles.part) present[part] = true;
    else if (!water.mesh)
        for (Index part : model.solids.part) present[part] = true;
    for (std::size_t part = 0; part < changed.size(); ++part)
        changed[part] = water.is_water[part] && !present[part];
    OldWater old(model, water, changed, form);
    if (water.mesh) drop_mesh_keywords(model);
    // Among particles that are there already, others stand as far apart.
    const double spacing = choice.size > 0 ? choice.size : water.particles ? water.smallest_size : 0;
    NewWater made = form == FluidForm::sph ? make_particle_water(model, water, changed, walls, spacing)
                                           : make_solid_water(model, water, changed, walls);
    std::vector<std::string> lines = std::move(made.lines);
    old.hand_over(made, lines);
    contacts.translate(model, form, water, changed, made, lines);
    rest_as_elements(model, lines);
    return lines;
}

} // namespace

std::vector<std::string> translate_fluid(Model& model, const FluidChoice& choice)
{
    if (!choice.form) return {};
    const Water water = find_water(model);
    if (water.pieces.empty())
        throw DeckError(choice.where,
                        "the deck has no water: no solids, particles or Eulerian mesh of *MAT_NULL with "
                        "an equation of state");
    std::vector<std::string> lines;
    if (water.is_already(*choice.form)) {
        lines.push_back(fmt::format("the water is in the form '{}' already: nothing to translate",
                                    to_string(*choice.form)));
        return lines;
    }
    std::string from;
    for (const auto& [there, name] : {std::pair{water.solids, "solids"},
                                      {water.particles, "particles"},
                                      {water.mesh, "an Eulerian mesh"}})
        if (there) from += (from.empty() ? "" : " and ") + std::string(name);
    std::string parts;
    for (Index part : water.parts)
        parts += fmt::format("{}{}", parts.empty() ? "" : ", ", model.parts[part].id);
    lines.push_back(fmt::format("the water of part{} {}, {}, becomes '{}':",
                                water.parts.size() == 1 ? "" : "s", parts, from, to_string(*choice.form)));
    const std::vector<std::string> more =
        *choice.form == FluidForm::ale ? to_mesh(model, choice, water) : to_elements(model, choice, water);
    for (const auto* list : {&water.remarks, &more})
        for (const std::string& line : *list) lines.push_back("  " + line);
    return lines;
}

} // namespace plash

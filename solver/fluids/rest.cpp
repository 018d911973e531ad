#include "solver/fluids/rest.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

void rest_as_elements(Model& model, std::vector<std::string>& lines)
{
    const auto hydrostatic = [](const Record& record) {
        return record.keyword.starts_with("INITIAL_HYDROSTATIC");
    };
    const auto found = std::find_if(model.others.begin(), model.others.end(), hydrostatic);
    if (found == model.others.end()) return;
    RelaxationControls& relaxation = model.controls.relaxation;
    if (relaxation.active()) {
        lines.push_back(fmt::format(
            "*{} went; the run begins with the deck's own *CONTROL_DYNAMIC_RELAXATION", found->keyword));
    } else {
        relaxation.flag = 5;
        relaxation.where = found->where;
        std::vector<BodyLoad> also;
        for (const BodyLoad& load : model.body_loads) {
            if (load.phase != BodyLoad::Phase::of_curve) continue;
            also.push_back(load);
            also.back().phase = BodyLoad::Phase::relaxation;
        }
        model.body_loads.insert(model.body_loads.end(), also.begin(), also.end());
        lines.push_back(fmt::format("*{} became a static start (IDRFLG = 5)", found->keyword));
    }
    std::erase_if(model.others, hydrostatic);
}

void rest_in_mesh(Model& model, const Water& water, const std::vector<DepthStress>& stresses,
                  const NewWater& made, std::vector<std::string>& lines)
{
    std::vector<DepthStress> own, others;
    for (const DepthStress& stress : stresses) (water.is_water[stress.part] ? own : others).push_back(stress);
    if (own.empty()) return;
    const DepthStress& first = own.front();
    const double density = density_of(model, first.part);
    if (own.size() != water.parts.size() ||
        std::any_of(own.begin(), own.end(), [&](const DepthStress& stress) {
            return stress.slope != first.slope || stress.datum != first.datum ||
                   density_of(model, stress.part) != density;
        }))
        throw DeckError(first.where, "*INITIAL_STRESS_DEPTH: as an Eulerian mesh the water rests below one "
                                     "surface; give all its parts the same RO_G, ZDATUM and density");
    std::erase_if(model.others,
                  [](const Record& record) { return record.keyword.starts_with("INITIAL_STRESS_DEPTH"); });
    for (const DepthStress& stress : others)
        model.others.push_back(made_record("INITIAL_STRESS_DEPTH", stress.where,
                                           {{"PID", static_cast<double>(model.parts[stress.part].id)},
                                            {"RO_G", stress.slope},
                                            {"ZDATUM", stress.datum},
                                            {"KFACT", stress.lateral}}));
    if (first.slope == 0) return;
    NamedVector down;
    down.id = free_id(model.vectors);
    down.head.z = first.slope > 0 ? -1 : 1;
    model.vectors.push_back(down);
    const Id surface = free_id(model.nodes.id);
    model.nodes.id.push_back(surface);
    model.nodes.position.push_back({water.low.x, water.low.y, first.datum});
    Record record = made_record("INITIAL_HYDROSTATIC_ALE", first.where,
                                {{"ALESID", static_cast<double>(model.parts[made.mesh_parts.back()].id)},
                                 {"STYPE", 1},
                                 {"VECID", static_cast<double>(down.id)},
                                 {"GRAV", std::abs(first.slope) / density}});
    Table layer;
    layer.columns = {"NID", "MMGBLO"};
    layer.values = {static_cast<double>(surface), 1};
    layer.lines = {first.where.line};
    record.tables.push_back(std::move(layer));
    model.others.push_back(std::move(record));
    lines.push_back("*INITIAL_STRESS_DEPTH of the water became *INITIAL_HYDROSTATIC_ALE");
}

} // namespace plash

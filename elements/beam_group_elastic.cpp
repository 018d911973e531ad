#include "elements/beam_group_of_law.h"
#include "elements/beam_groups.h"
#include "materials/elastic.h"

namespace plash {

std::unique_ptr<Term> make_elastic_beams(const BeamPart& part, BeamSettings settings, State& state)
{
    const Model& model = part.model;
    const Record& material = model.materials[model.parts[part.part].material];
    Elastic law = Elastic::from_record(material, model);
    if (settings.section.formulation != 2 || erosion_criteria(model, material)) {
        return make_beams_of_law(part, std::move(settings), std::move(law), state);
    }
    take_law(law, settings);
    return std::make_unique<BeamGroup<ResultantBeam, Elastic>>(part, state, std::move(settings),
                                                               std::move(law));
}

} // namespace plash

#include "elements/beam_group_of_law.h"
#include "elements/beam_groups.h"
#include "materials/plastic_kinematic.h"

namespace plash {

std::unique_ptr<Term> make_plastic_kinematic_beams(const BeamPart& part, BeamSettings settings, State& state)
{
    const Record& record = part.model.materials[part.model.parts[part.part].material];
    if (PlasticKinematicParameters::from_record(record).has_back_stress()) {
        return make_beams_of_law(part, std::move(settings),
                                 PlasticKinematic<true>::from_record(record, part.model), state);
    }
    return make_beams_of_law(part, std::move(settings),
                             PlasticKinematic<false>::from_record(record, part.model), state);
}

} // namespace plash

#include "elements/beam_group_of_law.h"
#include "elements/beam_groups.h"
#include "materials/piecewise_linear_plasticity.h"
#include "materials/spot_weld.h"

namespace plash {

namespace {

/// The only kinds that the manual lets be spot welds.
const Record& material_of(const BeamPart& part)
{
    return part.model.materials[part.model.parts[part.part].material];
}

double or_infinite(double limit)
{
    return limit > 0 ? limit : std::numeric_limits<double>::infinity();
}

} // namespace

std::unique_ptr<Term> make_piecewise_linear_beams(const BeamPart& part, BeamSettings settings, State& state)
{
    return make_beams_of_law(part, std::move(settings),
                             PiecewiseLinearPlasticity::from_record(material_of(part), part.model), state);
}

std::unique_ptr<Term> make_spot_weld_beams(const BeamPart& part, BeamSettings settings, State& state)
{
    SpotWeld weld = SpotWeld::from_record(material_of(part), part.model);
    if (weld.failure_time > 0) settings.failure_time = weld.failure_time;
    WeldStrength& strength = settings.strength;
    strength.axial = or_infinite(weld.force[0]);
    strength.shear_s = or_infinite(weld.force[1]);
    strength.shear_t = or_infinite(weld.force[2]);
    strength.torsion = or_infinite(weld.moment[0]);
    strength.moment_s = or_infinite(weld.moment[1]);
    strength.moment_t = or_infinite(weld.moment[2]);
    for (int i = 0; i < 3; ++i) {
        strength.limited = strength.limited || weld.force[i] > 0 || weld.moment[i] > 0;
    }
    auto group = make_beams_of_law(part, std::move(settings), std::move(weld.law), state);
    if (weld.wanted_step > 0) group->scale_mass(weld.wanted_step, true, state);
    return group;
}

} // namespace plash

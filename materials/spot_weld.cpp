#include "materials/spot_weld.h"

#include "materials/parameters.h"

#include <fmt/format.h>

namespace plash {

SpotWeld SpotWeld::from_record(const Record& record, const Model& model)
{
    SpotWeld weld;
    PiecewiseLinearPlasticity& law = weld.law;
    law.density = positive(record, "RO", "mass density");
    law.young_modulus = positive(record, "E", "Young's modulus");
    law.poisson_ratio = poisson_ratio_of(record);
    const double yield_stress = record.real("SIGY");
    if (yield_stress < 0) {
        const Index curve = model.find_curve(static_cast<Id>(-yield_stress));
        if (curve == none) {
            reject_field(record, "SIGY", fmt::format("there is no *DEFINE_CURVE {}", -yield_stress));
        }
        law.hardening = Hardening::curve(model.curves[curve].curve);
    } else {
        law.hardening = Hardening::linear(positive(record, "SIGY", "yield stress"), record.real("EH"));
    }
    const double failure = record.real("EFAIL");
    law.failure_strain = failure > 0 && failure < 1e10 ? failure : 0;
    weld.wanted_step = record.real("DT");
    weld.failure_time = record.real("TFAIL");
    constexpr const char* force_names[] = {"NRR", "NRS", "NRT"};
    constexpr const char* moment_names[] = {"MRR", "MSS", "MTT"};
    for (int i = 0; i < 3; ++i) {
        weld.force[i] = record.real(force_names[i]);
        weld.moment[i] = record.real(moment_names[i]);
        if (weld.force[i] < 0) {
            reject_field(record, force_names[i],
                         "failure by a curve over the strain rate (a negative value) is not supported");
        }
        if (weld.moment[i] < 0) {
            reject_field(record, moment_names[i],
                         "failure by a curve over the strain rate (a negative value) is not supported");
        }
    }
    return weld;
}

} // namespace plash

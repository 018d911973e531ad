#include "conditions/pressure_loads.h"

#include "core/parallel.h"
#include "core/prescribed_rate.h"

namespace plash {

PressureLoads::PressureLoads(const Model& model) : model_(model)
{
    for (std::size_t i = 0; i < model.pressure_loads.size(); ++i) {
        const PressureLoad& load = model.pressure_loads[i];
        segments_.insert(segments_.end(), load.segments.begin(), load.segments.end());
        load_.insert(load_.end(), load.segments.size(), static_cast<Index>(i));
    }
    sum_ = CornerSum(segments_);
    elements_ = LoadedElements(model, segments_);
}

double PressureLoads::pressure_of(const PressureLoad& load, const Clock& clock) const
{
    if (clock.time < load.arrival) return 0;
    return load.scale * load_value(model_, load.curve, clock, clock.time - load.arrival);
}

void PressureLoads::add_forces(const Clock& clock, State& state)
{
    std::vector<double> pressure;
    for (const PressureLoad& load : model_.pressure_loads) pressure.push_back(pressure_of(load, clock));
    work_ += sum_.act(segments_, clock, state, [&](std::size_t i) {
        std::array<Vec3, 4> force{};
        const double p = elements_.deleted(i, state) ? 0 : pressure[load_[i]];
        if (p != 0) force = unit_pressure_forces(segments_[i], state.position);
        for (Vec3& corner : force) corner *= -p;
        return force;
    });
}

} // namespace plash

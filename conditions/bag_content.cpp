#include "conditions/bag_content.h"

#include "core/prescribed_rate.h"

#include <algorithm>
#include <cmath>

namespace plash {

namespace {

/// What a step brings: its span and times, the volume at both ends.
struct Span {
    const Model& model;
    const Clock& clock;
    double volume = 0; ///< at n
    double leak_area = 0;

    double step() const { return clock.relaxing ? 0 : clock.last_step; }
    double time() const { return clock.relaxing ? 0 : clock.time; }
    double before() const { return time() - step(); }
    /// A curve by time where there is one.
    double at(Index curve, double otherwise, double when) const
    {
        return curve == none ? otherwise : curve_value(model, curve, when);
    }
    double mass_along(Index curve) const
    {
        return curve == none
                   ? 0
                   : 0.5 * step() * (curve_value(model, curve, before()) + curve_value(model, curve, time()));
    }
};

/// What the surface does to a content without heat.
void add_compression(double pressure, const Span& span, BagState& state)
{
    state.internal_energy -= 0.5 * (state.pressure + pressure) * (span.volume - state.volume);
    state.pressure = pressure;
    state.volume = span.volume;
}

void advance(const PressureOfVolume& law, const Span& span, BagState& state)
{
    const double relative = span.volume / state.first_volume;
    double pressure = 0;
    if (law.curve != none) {
        const Curve& curve = span.model.curves[law.curve].curve;
        pressure = curve(relative);
        state.stiffness = -relative * curve.slope(relative);
    } else {
        const Index by_time = span.clock.relaxing && law.relaxation_curve != none ? law.relaxation_curve
                                                                                  : law.coefficient_curve;
        pressure = law.scale * span.at(by_time, law.coefficient, span.clock.time) / relative;
        state.stiffness = pressure;
    }
    add_compression(pressure, span, state);
}

void advance(const AdiabaticGas& gas, const Span& span, BagState& state)
{
    const double absolute = (gas.pressure + gas.ambient_pressure) *
                            std::pow(state.first_volume / span.volume, gas.ratio_of_specific_heats);
    state.pressure = absolute - gas.ambient_pressure;
    state.stiffness = gas.ratio_of_specific_heats * absolute;
    state.volume = span.volume;
    state.internal_energy = absolute * span.volume / (gas.ratio_of_specific_heats - 1);
}

double gas_constant(const VentedGas& gas)
{
    return gas.heat_at_constant_pressure - gas.heat_at_constant_volume;
}

double area_of(const Orifice& hole, const Span& span, double time, double pressure)
{
    const double coefficient =
        span.at(hole.coefficient_curve, hole.coefficient, hole.coefficient_of_pressure ? pressure : time);
    return coefficient * span.at(hole.area_curve, hole.area, pressure);
}

/// Mass a time that leaves through all holes.
double outflow(const VentedGas& gas, const Span& span, double time, double absolute, const BagState& state)
{
    if (!state.open || state.mass <= 0 || absolute <= gas.ambient_pressure) return 0;
    double area = span.leak_area;
    for (const Orifice& hole : gas.orifices) area += area_of(hole, span, time, absolute);
    double flow = area > 0 ? area * orifice_flow(gas, absolute, state.temperature) : 0;
    if (gas.outflow_curve != none)
        flow += std::max(curve_value(span.model, gas.outflow_curve, absolute - gas.ambient_pressure), 0.0);
    return flow;
}

void set_pressure(const VentedGas& gas, BagState& state)
{
    const double ratio = gas.heat_at_constant_pressure / gas.heat_at_constant_volume;
    const double absolute = (ratio - 1) * state.internal_energy / state.volume;
    state.pressure = absolute - gas.ambient_pressure;
    state.stiffness = ratio * absolute;
    if (state.mass > 0)
        state.temperature = state.internal_energy / (state.mass * gas.heat_at_constant_volume);
    state.open = state.open || state.pressure > gas.opening_pressure;
}

void advance(const VentedGas& gas, const Span& span, BagState& state)
{
    const double step = span.step(), ratio = gas.heat_at_constant_pressure / gas.heat_at_constant_volume;
    const auto entering = [&](double time) {
        return span.clock.relaxing || gas.inflow_curve == none
                   ? 0.0
                   : curve_value(span.model, gas.inflow_curve, time);
    };
    const auto heat_entering = [&](double time) {
        return gas.heat_at_constant_pressure * entering(time) *
               span.at(gas.temperature_curve, gas.inflow_temperature, time);
    };
    const double mass_in = 0.5 * step * (entering(span.before()) + entering(span.time()));
    const double heat_in = 0.5 * step * (heat_entering(span.before()) + heat_entering(span.time()));
    const BagState old = state;
    const double absolute = old.pressure + gas.ambient_pressure;
    const double flow = outflow(gas, span, span.before(), absolute, old);
    // The state at n when `lost` of mass, with the enthalpy `heat`, have left.
    const auto end_with = [&](double lost, double heat) {
        state = old;
        state.volume = span.volume;
        const double change = span.volume - old.volume;
        state.mass = old.mass + mass_in - lost;
        state.internal_energy = (old.internal_energy + heat_in - heat - 0.5 * absolute * change) /
                                (1 + 0.5 * (ratio - 1) * change / span.volume);
        set_pressure(gas, state);
    };
    const double all = old.mass + mass_in;
    const auto part = [&](double lost) { return std::min(lost, all); };
    const double first = part(step * flow);
    end_with(first, gas.heat_at_constant_pressure * old.temperature * first);
    const double later = outflow(gas, span, span.time(), state.pressure + gas.ambient_pressure, state);
    if (flow > 0 || later > 0) {
        const double lost = part(0.5 * step * (flow + later));
        const double temperature = (flow * old.temperature + later * state.temperature) / (flow + later);
        end_with(lost, gas.heat_at_constant_pressure * temperature * lost);
    }
    state.inflow = entering(span.time());
    state.outflow = later;
}

void advance(const LinearFluid& fluid, const Span& span, BagState& state)
{
    state.inflow = span.at(fluid.inflow_curve, 0, span.time());
    state.outflow =
        span.at(fluid.outflow_curve, 0, span.time()) + span.at(fluid.outflow_by_pressure, 0, state.pressure);
    state.mass += span.mass_along(fluid.inflow_curve) - span.mass_along(fluid.outflow_curve);
    if (fluid.outflow_by_pressure != none)
        state.mass -= span.step() * curve_value(span.model, fluid.outflow_by_pressure, state.pressure);
    state.mass = std::max(state.mass, 0.0);
    const double unloaded = state.mass / fluid.density;
    double pressure = 0;
    if (fluid.pressure_by_volume != none) {
        const Curve& curve = span.model.curves[fluid.pressure_by_volume].curve;
        const double relative = span.volume / unloaded;
        pressure = curve(relative);
        state.stiffness = -relative * curve.slope(relative);
    } else {
        const double bulk = span.at(fluid.bulk_curve, fluid.bulk_modulus, span.time());
        pressure = bulk * std::log(unloaded / span.volume);
        state.stiffness = bulk;
    }
    pressure += span.at(fluid.added_pressure, 0, span.time());
    const double largest = span.at(fluid.largest_pressure_curve, fluid.largest_pressure, span.time());
    if (pressure > largest) state.stiffness = 0;
    add_compression(std::min(pressure, largest), span, state);
}

} // namespace

double orifice_flow(const VentedGas& gas, double pressure, double temperature)
{
    const double ratio = gas.heat_at_constant_pressure / gas.heat_at_constant_volume, R = gas_constant(gas);
    const double critical = std::pow(2 / (ratio + 1), ratio / (ratio - 1));
    const double Q = std::max(gas.ambient_pressure / pressure, critical);
    if (Q >= 1) return 0;
    return pressure / (R * std::sqrt(temperature)) * std::pow(Q, 1 / ratio) *
           std::sqrt(2 * gas.conversion * ratio * R / (ratio - 1) * (1 - std::pow(Q, 1 - 1 / ratio)));
}

BagState start_content(const Airbag& bag, const Model& model, double volume)
{
    BagState state;
    state.first_volume = state.volume = volume;
    if (const auto* gas = std::get_if<VentedGas>(&bag.content)) {
        const double ratio = gas->heat_at_constant_pressure / gas->heat_at_constant_volume;
        state.mass = gas->density * volume;
        state.internal_energy = (gas->ambient_pressure + gas->overpressure) * volume / (ratio - 1);
        set_pressure(*gas, state);
    } else if (const auto* fluid = std::get_if<LinearFluid>(&bag.content)) {
        state.mass = fluid->density * volume;
    } else if (const auto* closed = std::get_if<AdiabaticGas>(&bag.content)) {
        state.mass = closed->density * volume;
    }
    advance_content(bag, model, Clock{}, volume, 0, state);
    return state;
}

void advance_content(const Airbag& bag, const Model& model, const Clock& clock, double volume,
                     double leak_area, BagState& state)
{
    const Span span{model, clock, volume, leak_area};
    std::visit([&](const auto& content) { advance(content, span, state); }, bag.content);
}

} // namespace plash

#include "elements/discrete_law.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// The way outward from zero at which a curve first has a force: to the right for positive ones, to the left
/// for negative ones. Beyond its last point the curve is level; then it is that point.
double way_at(const Curve& curve, double force)
{
    const auto& x = curve.abscissa;
    const auto& y = curve.ordinate;
    const double sense = force < 0 ? -1 : 1;
    double last_way = 0, last_force = curve(0);
    const auto passes = [&](double way, double here) {
        return sense * (here - force) >= 0 && sense * (last_force - force) < 0 && way != last_way;
    };
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::size_t point = sense > 0 ? i : x.size() - 1 - i;
        if (sense * x[point] <= 0) continue;
        if (passes(x[point], y[point])) {
            return last_way + (force - last_force) * (x[point] - last_way) / (y[point] - last_force);
        }
        last_way = x[point];
        last_force = y[point];
    }
    return sense * (curve(0) - force) >= 0 ? 0 : last_way;
}

/// Place on a rising curve with a force; beyond its ends the end.
double place_of_force(const Curve& curve, double force)
{
    const auto& x = curve.abscissa;
    const auto& y = curve.ordinate;
    if (force <= y.front()) return x.front();
    for (std::size_t i = 1; i < x.size(); ++i)
        if (force <= y[i]) return x[i - 1] + (force - y[i - 1]) * (x[i] - x[i - 1]) / (y[i] - y[i - 1]);
    return x.back();
}

void check_rising(const Record& material, const char* field, const Curve& curve, bool strictly)
{
    for (std::size_t i = 1; i < curve.ordinate.size(); ++i) {
        const double rise = curve.ordinate[i] - curve.ordinate[i - 1];
        if (rise > 0 || (rise == 0 && !strictly)) continue;
        reject_field(material, field,
                     fmt::format("the curve has to rise{}; it does not from {} to {}",
                                 strictly ? "" : " with BETA other than 0", curve.abscissa[i - 1],
                                 curve.abscissa[i]));
    }
}

} // namespace

DiscreteLaw DiscreteLaw::from_record(const Record& material, const Model& model)
{
    DiscreteLaw law;
    const std::string& name = material.keyword;
    const auto take_curve = [&](const char* field) { return curve_of(material, field, model).curve; };
    if (name == "MAT_SPRING_ELASTIC") {
        law.kind = Kind::elastic;
        law.largest_stiffness = law.stiffness = positive(material, "K", "spring constant");
    } else if (name == "MAT_DAMPER_VISCOUS") {
        law.kind = Kind::viscous;
        law.damping = positive(material, "DC", "damping constant");
    } else if (name == "MAT_SPRING_ELASTOPLASTIC") {
        law.kind = Kind::elastoplastic;
        law.largest_stiffness = law.stiffness = positive(material, "K", "elastic stiffness");
        law.tangent = material.real("KT");
        law.yield_force = positive(material, "FY", "yield force");
        if (!(law.tangent >= 0 && law.tangent < law.stiffness)) {
            reject_field(material, "KT",
                         fmt::format("{} is not between 0 and K = {}", law.tangent, law.stiffness));
        }
    } else if (name == "MAT_SPRING_NONLINEAR_ELASTIC") {
        law.kind = Kind::nonlinear;
        law.force = odd_curve(take_curve("LCD"));
        if (material.integer("LCR") != 0) law.rate_factor = take_curve("LCR");
        law.largest_stiffness = steepest_slope(law.force);
    } else if (name == "MAT_DAMPER_NONLINEAR_VISCOUS") {
        law.kind = Kind::nonlinear_viscous;
        law.force = odd_curve(take_curve("LCDR"));
    } else if (name == "MAT_SPRING_GENERAL_NONLINEAR") {
        law.kind = Kind::general;
        law.force = odd_curve(take_curve("LCDL"));
        law.unloading = odd_curve(take_curve("LCDU"));
        law.tensile_yield = material.real("TYI");
        law.compressive_yield = material.real("CYI");
        if (law.tensile_yield < 0) reject_field(material, "TYI", "the yield force in tension is below zero");
        if (law.compressive_yield > 0)
            reject_field(material, "CYI", "the yield force in compression is above zero");
        const double beta = material.real("BETA");
        law.rule = beta == 0   ? Hardening::independent
                   : beta == 1 ? Hardening::isotropic
                               : Hardening::kinematic;
        if (beta != 0) check_rising(material, "LCDL", law.force, false);
        check_rising(material, "LCDU", law.unloading, true);
        law.largest_stiffness = std::max(steepest_slope(law.force), steepest_slope(law.unloading));
    } else if (name == "MAT_SPRING_MAXWELL") {
        law.kind = Kind::maxwell;
        law.largest_stiffness = law.stiffness = positive(material, "K0", "short-time stiffness");
        law.tangent = material.real("KI");
        law.decay = material.real("BETA");
        if (std::abs(material.real("TC")) > 0 && std::abs(material.real("TC")) < 1e19) {
            reject_field(material, "TC", "a cut-off time is not supported");
        }
    } else if (name == "MAT_SPRING_INELASTIC") {
        law.kind = Kind::inelastic;
        law.force = take_curve("LCFD");
        law.stiffness = std::max(material.real("KU"), steepest_slope(law.force));
        law.largest_stiffness = law.stiffness;
        law.sense = material.real("CTF", 1) < 0 ? -1 : 1;
    } else {
        throw DeckError(material.where,
                        fmt::format("*{} {} is not supported for springs and dampers; there are *MAT_S01 to "
                                    "S08",
                                    name, material.id));
    }
    return law;
}

double DiscreteLaw::advance(State& state, double deflection, double rate, double time_step) const
{
    const double change = deflection - state.deflection;
    state.deflection = deflection;
    switch (kind) {
    case Kind::elastic:
        state.force = stiffness * deflection;
        break;
    case Kind::viscous:
        state.force = damping * rate;
        break;
    case Kind::elastoplastic: {
        const double plastic_modulus = stiffness * tangent / (stiffness - tangent);
        const double trial = state.force + stiffness * change;
        const double excess = std::abs(trial) - (yield_force + plastic_modulus * state.hardening);
        const double flow = excess > 0 ? excess / (stiffness + plastic_modulus) : 0;
        state.hardening += flow;
        state.force = trial - std::copysign(stiffness * flow, trial);
        break;
    }
    case Kind::nonlinear:
        state.force = force(deflection) * (rate_factor.abscissa.empty() ? 1 : rate_factor(rate));
        break;
    case Kind::nonlinear_viscous:
        state.force = force(rate);
        break;
    case Kind::general:
        state.force = general_force(state, deflection, deflection - change);
        break;
    case Kind::maxwell: {
        // The relaxing part under a constant rate, exactly.
        const double span = decay * time_step, kept = std::exp(-span);
        const double share = span > 1e-8 ? (1 - kept) / span : 1 - 0.5 * span;
        state.hardening = kept * state.hardening + (stiffness - tangent) * share * change;
        state.force = tangent * deflection + state.hardening;
        break;
    }
    case Kind::inelastic: {
        // Along the sense that carries: way and force counted positive there.
        const double way = -sense * deflection;
        const double trial = -sense * state.force + stiffness * -sense * change;
        state.force = -sense * std::clamp(trial, 0.0, std::max(0.0, force(way)));
        break;
    }
    }
    return state.force;
}

/// S06. Until the force leaves the range from CYI to TYI the loading curve serves both ways. From then on the
/// spring unloads along the unloading curve, shifted so that it begins where the loading curve was left, and
/// yields again at the end of the range that it has by then: on the same side where it left the loading
/// curve, on the other side along the loading curve shifted to that force.
double DiscreteLaw::general_force(State& state, double deflection, double last) const
{
    if (!state.yielded) {
        const double value = force(deflection);
        if (value <= tensile_yield && value >= compressive_yield) return value;
        state.yielded = true;
        state.side = value > tensile_yield ? 1 : -1;
        state.upper = tensile_yield;
        state.lower = compressive_yield;
        (state.side > 0 ? state.upper : state.lower) = value;
        harden(state);
        return value;
    }
    if (state.side != 0 && state.side * (deflection - last) < 0) { // turns back
        state.left = state.side;
        state.side = 0;
        state.unloading_shift = last - place_of_force(unloading, state.force);
    }
    if (state.side == 0) {
        const double value = unloading(deflection - state.unloading_shift);
        const int reached = value > state.upper ? 1 : value < state.lower ? -1 : 0;
        if (reached == 0) return value;
        const double yield = reached > 0 ? state.upper : state.lower;
        if (reached != state.left) {
            const double way = state.unloading_shift + place_of_force(unloading, yield);
            state.loading_shift = way - way_at(force, yield);
        }
        state.side = reached;
    }
    const double value = force(deflection - state.loading_shift);
    (state.side > 0 ? state.upper : state.lower) = value;
    harden(state);
    return value;
}

/// The yield force of the other side, from the one that the spring stands on.
void DiscreteLaw::harden(State& state) const
{
    if (rule == Hardening::independent) return;
    if (rule == Hardening::kinematic) {
        const double range = tensile_yield - compressive_yield;
        (state.side > 0 ? state.lower : state.upper) =
            state.side > 0 ? state.upper - range : state.lower + range;
        return;
    }
    if (state.side > 0)
        state.lower = compressive_yield - (state.upper - tensile_yield);
    else
        state.upper = tensile_yield + (compressive_yield - state.lower);
}

} // namespace plash

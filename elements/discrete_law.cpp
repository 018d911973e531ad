#include "elements/discrete_law.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

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
                                    "S05, S07 and S08",
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

} // namespace plash

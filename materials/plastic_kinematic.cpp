#include "materials/plastic_kinematic.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

PlasticKinematicParameters PlasticKinematicParameters::from_record(const Record& record)
{
    PlasticKinematicParameters p;
    p.density = positive(record, "RO", "mass density");
    p.young_modulus = positive(record, "E", "Young's modulus");
    p.poisson_ratio = poisson_ratio_of(record);
    p.yield_stress = positive(record, "SIGY", "yield stress");
    const double tangent = record.real("ETAN");
    if (!(tangent >= 0 && tangent < p.young_modulus)) {
        reject_field(
            record, "ETAN",
            fmt::format("{} is not between 0 and E = {} (tangent modulus)", tangent, p.young_modulus));
    }
    p.plastic_modulus = p.young_modulus * tangent / (p.young_modulus - tangent);
    p.beta = record.real("BETA");
    if (!(p.beta >= 0 && p.beta <= 1)) {
        reject_field(record, "BETA",
                     fmt::format("{} is not between 0 (kinematic) and 1 (isotropic hardening)", p.beta));
    }
    p.rate_constant = record.real("SRC");
    p.rate_exponent = record.real("SRP");
    if (p.rate_constant < 0) reject_field(record, "SRC", fmt::format("{} is negative", p.rate_constant));
    if (p.rate_constant > 0 && !(p.rate_exponent > 0)) {
        reject_field(record, "SRP",
                     fmt::format("{} is not positive, but SRC asks for a rate effect", p.rate_exponent));
    }
    p.viscoplastic = record.real("VP") != 0 && p.rate_constant > 0;
    p.failure_strain = record.real("FS");
    return p;
}

double viscoplastic_multiplier(const ReturnPath& path, double yield, double hardening, double rate_constant,
                               double rate_exponent, double time_step)
{
    const double trial = std::sqrt(path.slow_square + path.fast_square);
    if (trial <= yield) return 0;
    const auto excess = [&](double m) {
        const double u = 1 / (1 + path.slow * m), w = 1 / (1 + path.fast * m);
        const double q = std::sqrt(path.slow_square * u * u + path.fast_square * w * w);
        const double strain = 2.0 / 3 * m * q;
        const double factor = 1 + std::pow(strain / (rate_constant * time_step), 1 / rate_exponent);
        return q - factor * (yield + hardening * strain);
    };
    // The excess falls with m. At the upper end even the slower mode alone has come down to the static yield
    // stress. Regula falsi (Illinois) between.
    double low = 0, high = (trial / yield - 1) / std::min(path.slow, path.fast);
    double at_low = trial - yield, at_high = excess(high);
    int side = 0;
    for (int round = 0; round < 100 && high - low > 1e-14 * high; ++round) {
        const double m = (low * at_high - high * at_low) / (at_high - at_low);
        const double at = excess(m);
        if (at > 0) {
            low = m;
            at_low = at;
            if (side == 1) at_high *= 0.5;
            side = 1;
        } else {
            high = m;
            at_high = at;
            if (side == -1) at_low *= 0.5;
            side = -1;
        }
        if (std::abs(at) < 1e-12 * yield) return m;
    }
    return 0.5 * (low + high);
}

} // namespace plash

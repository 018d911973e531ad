#include "materials/flow_laws.h"

#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr double largest_strain = 2; ///< up to which a formula is sampled; beyond, its last slope goes on

template <class Formula>
Hardening sampled(Formula&& stress)
{
    constexpr int points = 200;
    Curve curve;
    for (int i = 0; i <= points; ++i) {
        const double strain = largest_strain * std::pow(static_cast<double>(i) / points, 3);
        curve.abscissa.push_back(strain);
        curve.ordinate.push_back(stress(strain));
    }
    return Hardening::curve(curve);
}

void take_failure(const Record& record, const char* field, PiecewiseLinearPlasticity& law)
{
    const double failure = record.real(field);
    if (failure < 0) reject_field(record, field, "a negative failure strain is not supported");
    law.failure_strain = failure < 1e10 ? failure : 0;
}

void take_isotropic(const Record& record, PiecewiseLinearPlasticity& law)
{
    const double shear = positive(record, "G", "shear modulus");
    const double bulk = positive(record, "BULK", "bulk modulus");
    law.young_modulus = 9 * bulk * shear / (3 * bulk + shear);
    law.poisson_ratio = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
    law.hardening =
        Hardening::linear(positive(record, "SIGY", "yield stress"), std::max(0.0, record.real("ETAN")));
}

void take_power_law(const Record& record, PiecewiseLinearPlasticity& law)
{
    const double k = positive(record, "K", "strength coefficient");
    const double n = record.real("N");
    if (!(n > 0 && n < 1)) reject_field(record, "N", fmt::format("{} is not between 0 and 1 (exponent)", n));
    const double given = record.real("SIGY");
    // Strain at which yielding begins: where both curves meet, at the stress SIGY, or SIGY itself below 0.02.
    const double start = given == 0     ? std::pow(law.young_modulus / k, 1 / (n - 1))
                         : given < 0.02 ? given
                                        : std::pow(given / k, 1 / n);
    law.hardening = sampled([&](double strain) { return k * std::pow(start + strain, n); });
    take_failure(record, "EPSF", law);
    if (!(record.real("SRC") > 0)) return;
    law.rate = record.real("VP") == 1 ? PiecewiseLinearPlasticity::Rate::viscoplastic
                                      : PiecewiseLinearPlasticity::Rate::scaled;
    law.reference_rate = record.real("SRC");
    law.rate_exponent = 1 / positive(record, "SRP", "exponent of Cowper and Symonds, needed with SRC");
}

void take_johnson_cook(const Record& record, PiecewiseLinearPlasticity& law)
{
    const double a = positive(record, "A", "yield stress"), b = record.real("B"), n = record.real("N", 1);
    const double c = record.real("C");
    const double ceiling = record.real("SIGMAX", 1e28), saturation = record.real("SIGSAT", 1e28);
    const auto limit = [](double given) { return given > 0 ? given : 1e28; };
    double highest = limit(ceiling);
    if (limit(saturation) < 1e20) {
        if (c != 0) reject_field(record, "SIGSAT", "a saturation stress with a rate effect is not supported");
        highest = std::min(highest, limit(saturation));
    }
    law.hardening = sampled([&](double strain) { return std::min(a + b * std::pow(strain, n), highest); });
    take_failure(record, "PSFAIL", law);
    if (c == 0) return;
    if (c < 0) reject_field(record, "C", fmt::format("{} is negative", c));
    const double given = record.real("EPSO", 1), reference = given > 0 ? given : 1;
    law.rate = record.real("VP") == 1 ? PiecewiseLinearPlasticity::Rate::viscoplastic
                                      : PiecewiseLinearPlasticity::Rate::scaled;
    law.rate_factor.abscissa = {0};
    law.rate_factor.ordinate = {1};
    for (int tenth = 0; tenth <= 90; ++tenth) { // nine decades
        const double ratio = std::pow(10.0, tenth / 10.0);
        law.rate_factor.abscissa.push_back(reference * ratio);
        law.rate_factor.ordinate.push_back(1 + c * std::log(ratio));
    }
}

} // namespace

bool is_flow_law(std::string_view keyword)
{
    return keyword == "MAT_ISOTROPIC_ELASTIC_PLASTIC" || keyword == "MAT_POWER_LAW_PLASTICITY" ||
           keyword == "MAT_SIMPLIFIED_JOHNSON_COOK";
}

PiecewiseLinearPlasticity read_flow_law(const Record& record, const Model&)
{
    PiecewiseLinearPlasticity law;
    law.density = positive(record, "RO", "mass density");
    if (record.keyword == "MAT_ISOTROPIC_ELASTIC_PLASTIC") {
        take_isotropic(record, law);
        return law;
    }
    law.young_modulus = positive(record, "E", "Young's modulus");
    law.poisson_ratio = poisson_ratio_of(record);
    if (record.keyword == "MAT_POWER_LAW_PLASTICITY") {
        take_power_law(record, law);
    } else {
        take_johnson_cook(record, law);
    }
    return law;
}

} // namespace plash

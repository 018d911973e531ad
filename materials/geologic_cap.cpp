#include "materials/geologic_cap.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Zero of a function that changes its sign between low and high, by bisection with secants (Dowell & Jarratt
/// 1971, BIT 11, 168-174), to round-off.
template <class Function>
double zero_between(double low, double high, double at_low, double at_high, Function&& function)
{
    double last = low;
    for (int i = 0; i < 200; ++i) {
        double middle = high - at_high * (high - low) / (at_high - at_low);
        if (!(middle > std::min(low, high) && middle < std::max(low, high))) middle = 0.5 * (low + high);
        const double value = function(middle);
        if (value == 0 || std::abs(middle - last) <= 1e-15 * std::abs(middle)) return middle;
        if ((value > 0) == (at_high > 0)) {
            at_low *= 0.5; // Illinois: the end that stays counts half
        } else {
            low = high;
            at_low = at_high;
        }
        high = last = middle;
        at_high = value;
    }
    return high;
}

} // namespace

GeologicCap GeologicCap::from_record(const Record& record, const Model&)
{
    GeologicCap law;
    law.density = positive(record, "RO", "mass density");
    const double k = law.bulk_modulus = positive(record, "BULK", "bulk modulus");
    const double g = law.shear_modulus = positive(record, "G", "shear modulus");
    law.young_modulus = 9 * k * g / (3 * k + g);
    law.poisson_ratio = (3 * k - 2 * g) / (2 * (3 * k + g));
    law.alpha = record.real("ALPHA");
    law.theta = record.real("THETA");
    law.gamma = record.real("GAMMA");
    law.beta = record.real("BETA");
    if (law.theta < 0) reject_field(record, "THETA", fmt::format("{} is negative", law.theta));
    if (law.gamma * law.beta < 0) reject_field(record, "BETA", "GAMMA times BETA is negative");
    if (!(law.alpha - law.gamma > 0)) {
        reject_field(record, "ALPHA",
                     fmt::format("the strength without pressure, ALPHA - GAMMA = {}, is not positive",
                                 law.alpha - law.gamma));
    }
    law.ratio = positive(record, "R", "ratio of the cap's axes");
    law.d = positive(record, "D", "exponent of the cap's hardening");
    law.w = positive(record, "W", "largest plastic compaction");
    law.x0 = record.real("X0");
    for (const char* field : {"C", "N"}) {
        if (record.real(field) != 0) {
            reject_field(record, field,
                         "kinematic hardening of the envelope is not supported; leave C and N at 0");
        }
    }
    const double type = value_or(record.real("FTYPE"), 1);
    if (type != 1 && type != 2) reject_field(record, "FTYPE", fmt::format("{} is not 1 or 2", type));
    law.contracts = type == 1;
    law.tension = record.real("TOFF");
    if (law.tension > 0) {
        reject_field(record, "TOFF",
                     fmt::format("{} is positive (compression); tension is negative", law.tension));
    }
    const double plot = value_or(record.real("PLOT"), 1);
    if (plot != std::floor(plot) || plot < 1 || plot > 5) {
        reject_field(record, "PLOT",
                     fmt::format("{} is not supported; there are 1 kappa, 2 end of the cap, 3 plastic "
                                 "compaction, 4 J1, 5 sqrt(J2)",
                                 plot));
    }
    law.shown = static_cast<Shown>(static_cast<int>(plot) - 1);
    // X(kappa) rises with kappa: the slope of Fe is not negative.
    double low = law.x0 - law.ratio * law.envelope(law.x0) - 1, high = law.x0;
    while (law.cap_end(low) > law.x0) low = law.x0 - 2 * (law.x0 - low);
    while (law.cap_end(high) < law.x0) high += 1 + std::abs(high);
    law.first_kappa = zero_between(low, high, law.cap_end(low) - law.x0, law.cap_end(high) - law.x0,
                                   [&](double at) { return law.cap_end(at) - law.x0; });
    return law;
}

double GeologicCap::compaction(double k) const
{
    return w * -std::expm1(-d * (cap_end(k) - x0));
}

GeologicCap::Invariants GeologicCap::returned(Invariants trial) const
{
    const double centre = std::max(trial.kappa, 0.0);
    if (trial.j1 > centre) return to_cap(trial);
    Invariants end = trial;
    if (trial.j1 >= tension && trial.r > envelope(trial.j1)) {
        end = to_envelope(trial);
        if (end.j1 >= tension) return end;
    }
    // Tension, or its corner with the envelope.
    if (end.j1 < tension) {
        end.j1 = tension;
        end.r = std::min(trial.r, std::max(envelope(tension), 0.0));
        end.kappa = contracted(trial.kappa, (tension - trial.j1) / (3 * bulk_modulus), tension);
    }
    return end;
}

/// r = r_trial - G m and J1 = J1_trial + 9 K m Fe'(J1) on r = Fe(J1), with the multiplier m; where this would
/// pass the cap's side it stops at the corner.
GeologicCap::Invariants GeologicCap::to_envelope(const Invariants& trial) const
{
    const double coupling = 9 * bulk_modulus / shear_modulus, centre = std::max(trial.kappa, 0.0);
    const auto miss = [&](double j1) {
        const double slope = theta + gamma * beta * std::exp(-beta * j1);
        return j1 - trial.j1 - coupling * (trial.r - envelope(j1)) * slope;
    };
    Invariants end = trial;
    const double at_trial = miss(trial.j1), at_corner = miss(centre);
    if (at_trial >= 0) {
        end.j1 = trial.j1; // an envelope without slope
    } else if (at_corner <= 0) {
        end.j1 = centre;
    } else {
        end.j1 = zero_between(trial.j1, centre, at_trial, at_corner, miss);
    }
    end.r = envelope(end.j1);
    end.kappa = contracted(trial.kappa, (end.j1 - trial.j1) / (3 * bulk_modulus), end.j1);
    return end;
}

/// For a kappa between the old one and the one whose cap begins at the stress, the plastic compaction gives
/// J1, and the ratio of the flow's parts gives r; the cap must hold both.
GeologicCap::Invariants GeologicCap::to_cap(const Invariants& trial) const
{
    const double before = compaction(trial.kappa);
    Invariants end = trial;
    const auto miss = [&](double k) {
        const double centre = std::max(k, 0.0), change = compaction(k) - before;
        end = {trial.j1 - 3 * bulk_modulus * change, trial.r, k};
        const double past = end.j1 - centre, reach = cap_end(k) - centre;
        if (past <= 0)
            end.r = 0;
        else
            end.r = trial.r / (1 + shear_modulus * ratio * ratio * change / (3 * past));
        return past * std::abs(past) + ratio * ratio * end.r * end.r - reach * reach;
    };
    const double at_old = miss(trial.kappa);
    double high = std::max(trial.kappa, 0.0) + 1e-6 * (1 + std::abs(trial.j1));
    while (miss(high) > 0) high += std::max(high - trial.kappa, 1e-12);
    const double at_high = miss(high);
    miss(zero_between(trial.kappa, high, at_old, at_high, miss));
    end.r = std::min(end.r, std::max(envelope(end.j1), 0.0));
    return end;
}

/// kappa after plastic dilatation; never so far that the cap passes the stress, and not below 0.
double GeologicCap::contracted(double old_kappa, double dilation, double j1) const
{
    const double least = std::max(j1, 0.0);
    if (!contracts || dilation <= 0 || old_kappa <= least) return old_kappa;
    const double wanted = compaction(old_kappa) - dilation;
    if (compaction(least) >= wanted) return least;
    const auto miss = [&](double k) { return compaction(k) - wanted; };
    return zero_between(least, old_kappa, miss(least), miss(old_kappa), miss);
}

} // namespace plash

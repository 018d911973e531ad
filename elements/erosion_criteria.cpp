#include "elements/erosion_criteria.h"

#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

std::array<double, 3> principal_values(const SymmetricTensor<double>& t)
{
    const double mean = trace(t) / 3;
    const SymmetricTensor<double> s = deviator(t);
    const double j2 = 0.5 * contract(s, s);
    if (j2 <= 1e-30 * (mean * mean)) return {mean, mean, mean};
    const double j3 = s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.zx) +
                      s.zx * (s.xy * s.yz - s.yy * s.zx);
    // Lode angle (Malvern 1969).
    const double cosine = std::clamp(1.5 * std::sqrt(3.0) * j3 / std::pow(j2, 1.5), -1.0, 1.0);
    const double angle = std::acos(cosine) / 3, radius = 2 * std::sqrt(j2 / 3);
    const double third = 2 * std::numbers::pi / 3;
    return {mean + radius * std::cos(angle), mean + radius * std::cos(angle - third),
            mean + radius * std::cos(angle + third)};
}

std::optional<ErosionCriteria> erosion_criteria(const Model& model, const Record& material)
{
    for (const Record& record : model.others) {
        if (record.keyword != "MAT_ADD_EROSION" || record.integer("MID") != material.id) continue;
        if (record.integer("IDAM") != 0) {
            reject_field(record, "IDAM", "damage models (DIEM, GISSMO) are not supported; 0 is");
        }
        const double excluded = record.real("EXCL");
        const auto limit = [&](const char* field, bool curve_below_zero = false) -> std::optional<double> {
            const double value = record.real(field);
            if (value == excluded || value == 0) return {};
            if (curve_below_zero && value < 0) {
                reject_field(record, field,
                             "a curve in place of a limit (a negative value) is not supported");
            }
            return value;
        };
        ErosionCriteria criteria;
        criteria.largest_pressure = limit("MXPRES");
        criteria.smallest_pressure = limit("MNPRES");
        criteria.largest_principal_stress = limit("SIGP1", true);
        criteria.largest_equivalent = limit("SIGVM", true);
        criteria.smallest_strain = limit("MNEPS");
        criteria.largest_strain = limit("MXEPS", true);
        criteria.effective_strain = limit("EFFEPS", true);
        criteria.volume_strain = limit("VOLEPS");
        criteria.shear_strain = limit("EPSSH");
        criteria.impulse = limit("IMPULSE");
        criteria.impulse_threshold = record.real("SIGTH");
        criteria.failure_time = limit("FAILTM");
        criteria.thinning = limit("EPSTHIN");
        if (criteria.thinning && *criteria.thinning < 0) {
            reject_field(
                record, "EPSTHIN",
                "the mean thinning of an element (a negative value) is not supported; that of each point "
                "(a positive value) is");
        }
        const double points = record.real("NUMFIP", 1);
        criteria.points = points == excluded || points == 0 ? 1 : points;
        const double needed = record.real("NCS", 1);
        criteria.needed = needed == excluded || needed < 1 ? 1 : static_cast<int>(needed);
        return criteria;
    }
    return {};
}

bool ErosionCriteria::hold(const SymmetricTensor<double>& stress, const std::array<double, 3>& strain,
                           double integral, int met) const
{
    const double pressure = -trace(stress) / 3;
    if (largest_pressure) met += pressure >= *largest_pressure;
    if (smallest_pressure) met += pressure <= *smallest_pressure;
    if (largest_principal_stress) met += principal_values(stress)[0] >= *largest_principal_stress;
    if (largest_equivalent) {
        const SymmetricTensor<double> s = deviator(stress);
        met += std::sqrt(1.5 * contract(s, s)) >= *largest_equivalent;
    }
    if (smallest_strain) met += strain[2] <= *smallest_strain;
    if (largest_strain) met += strain[0] >= *largest_strain;
    const double volume = strain[0] + strain[1] + strain[2];
    if (volume_strain) met += *volume_strain > 0 ? volume >= *volume_strain : volume <= *volume_strain;
    if (effective_strain) {
        double square = 0;
        for (double e : strain) square += (e - volume / 3) * (e - volume / 3);
        met += std::sqrt(2.0 / 3 * square) >= *effective_strain;
    }
    if (shear_strain) met += 0.5 * (strain[0] - strain[2]) >= *shear_strain;
    if (impulse) met += integral >= *impulse;
    return met >= needed;
}

int ErosionCriteria::failed_points(int of_all) const
{
    const double wanted = points > 0 ? points : std::ceil(-points / 100 * of_all - 1e-9);
    return std::clamp(static_cast<int>(wanted), 1, of_all);
}

} // namespace plash

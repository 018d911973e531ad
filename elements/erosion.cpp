#include "elements/erosion.h"

#include "materials/parameters.h"
#include "math/tensor3.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

/// Jacobian of the linear modes of one lane: its columns are the sides.
Tensor3<double> jacobian_of(const SolidModes<Lanes>& position, int lane)
{
    const auto at = [&](int mode) {
        const Vector3<Lanes>& side = position.linear[mode];
        return Vec3{side.x[lane], side.y[lane], side.z[lane]};
    };
    const Vec3 a = at(0), b = at(1), c = at(2);
    return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

Tensor3<double> inverse_of(const Tensor3<double>& m)
{
    const double per = 1 / determinant(m);
    return {per * (m.yy * m.zz - m.yz * m.zy), per * (m.xz * m.zy - m.xy * m.zz),
            per * (m.xy * m.yz - m.xz * m.yy), per * (m.yz * m.zx - m.yx * m.zz),
            per * (m.xx * m.zz - m.xz * m.zx), per * (m.xz * m.yx - m.xx * m.yz),
            per * (m.yx * m.zy - m.yy * m.zx), per * (m.xy * m.zx - m.xx * m.zy),
            per * (m.xx * m.yy - m.xy * m.yx)};
}

/// F^T F.
SymmetricTensor<double> right_cauchy_green(const Tensor3<double>& f)
{
    return {f.xx * f.xx + f.yx * f.yx + f.zx * f.zx, f.xy * f.xy + f.yy * f.yy + f.zy * f.zy,
            f.xz * f.xz + f.yz * f.yz + f.zz * f.zz, f.xx * f.xy + f.yx * f.yy + f.zx * f.zy,
            f.xy * f.xz + f.yy * f.yz + f.zy * f.zz, f.xz * f.xx + f.yz * f.yx + f.zz * f.zx};
}

} // namespace

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
        const double needed = record.real("NCS", 1);
        criteria.needed = needed == excluded || needed < 1 ? 1 : static_cast<int>(needed);
        return criteria;
    }
    return {};
}

SolidErosion::SolidErosion(const ErosionCriteria& criteria, Index batches)
    : criteria_(criteria),
      inverse_(criteria.needs_strain() ? 9 * static_cast<std::size_t>(batches) : 0),
      impulse_(criteria.impulse ? batches : 0)
{}

void SolidErosion::start(Index batch, const SolidModes<Lanes>& position)
{
    if (inverse_.empty()) return;
    Lanes* values = &inverse_[9 * static_cast<std::size_t>(batch)];
    for (int lane = 0; lane < lane_count; ++lane) {
        const Tensor3<double> m = inverse_of(jacobian_of(position, lane));
        const double components[9] = {m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz};
        for (int i = 0; i < 9; ++i) values[i][lane] = components[i];
    }
}

LaneMask SolidErosion::lost(Index batch, const SolidModes<Lanes>& position, const Lanes* stress, double time,
                            double time_step)
{
    LaneMask result{};
    for (int lane = 0; lane < lane_count; ++lane) {
        const SymmetricTensor<double> s{stress[0][lane], stress[1][lane], stress[2][lane],
                                        stress[3][lane], stress[4][lane], stress[5][lane]};
        std::array<double, 3> strain{};
        if (!inverse_.empty()) {
            const Lanes* v = &inverse_[9 * static_cast<std::size_t>(batch)];
            const Tensor3<double> inverse{v[0][lane], v[1][lane], v[2][lane], v[3][lane], v[4][lane],
                                          v[5][lane], v[6][lane], v[7][lane], v[8][lane]};
            const auto squares = principal_values(right_cauchy_green(jacobian_of(position, lane) * inverse));
            for (int i = 0; i < 3; ++i) strain[i] = 0.5 * std::log(std::max(squares[i], 1e-300));
        }
        double impulse = 0;
        if (!impulse_.empty()) {
            const double above = std::max(0.0, principal_values(s)[0] - criteria_.impulse_threshold);
            impulse_[batch][lane] += above * above * time_step;
            impulse = impulse_[batch][lane];
        }
        result[lane] = goes(s, strain, impulse, time) ? -1 : 0;
    }
    return result;
}

bool SolidErosion::goes(const SymmetricTensor<double>& stress, const std::array<double, 3>& strain,
                        double impulse, double time) const
{
    const ErosionCriteria& c = criteria_;
    if (c.failure_time && time >= *c.failure_time) return true;
    int met = 0;
    const double pressure = -trace(stress) / 3;
    if (c.largest_pressure) met += pressure >= *c.largest_pressure;
    if (c.smallest_pressure) met += pressure <= *c.smallest_pressure;
    if (c.largest_principal_stress) met += principal_values(stress)[0] >= *c.largest_principal_stress;
    if (c.largest_equivalent) {
        const SymmetricTensor<double> s = deviator(stress);
        met += std::sqrt(1.5 * contract(s, s)) >= *c.largest_equivalent;
    }
    if (c.smallest_strain) met += strain[2] <= *c.smallest_strain;
    if (c.largest_strain) met += strain[0] >= *c.largest_strain;
    const double volume = strain[0] + strain[1] + strain[2];
    if (c.volume_strain)
        met += *c.volume_strain > 0 ? volume >= *c.volume_strain : volume <= *c.volume_strain;
    if (c.effective_strain) {
        double square = 0;
        for (double e : strain) square += (e - volume / 3) * (e - volume / 3);
        met += std::sqrt(2.0 / 3 * square) >= *c.effective_strain;
    }
    if (c.shear_strain) met += 0.5 * (strain[0] - strain[2]) >= *c.shear_strain;
    if (c.impulse) met += impulse >= *c.impulse;
    return met >= c.needed;
}

} // namespace plash

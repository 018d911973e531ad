#include "elements/erosion.h"

#include "math/tensor3.h"

#include <algorithm>
#include <cmath>

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
    const bool timed_out = criteria_.failure_time && time >= *criteria_.failure_time;
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
        result[lane] = timed_out || criteria_.hold(s, strain, impulse) ? -1 : 0;
    }
    return result;
}

} // namespace plash

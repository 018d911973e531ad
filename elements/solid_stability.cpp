#include "elements/solid_stability.h"

#include "elements/solid_modes.h"
#include "math/tensor3.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace plash {

namespace {

/// Stress of an isotropic elastic body at a strain.
SymmetricTensor<double> hooke(const LinearSolid& solid, const SymmetricTensor<double>& strain)
{
    const double pressure = (solid.bulk - 2.0 / 3 * solid.shear) * trace(strain);
    SymmetricTensor<double> stress = (2 * solid.shear) * strain;
    stress.xx += pressure;
    stress.yy += pressure;
    stress.zz += pressure;
    return stress;
}

/// A vector of three values a node, and its products; the order of sums is fixed.
using NodeField = std::vector<Vec3>;

double inner_product(const NodeField& a, const NodeField& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
    return sum;
}

Vec3 by_component(const Vec3& a, const Vec3& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// M^-1/2 (K + 2 C / step) M^-1/2 x.
void apply_operator(std::span<const LinearSolid> solids, const NodeField& inverse_root, double step,
                    const NodeField& x, NodeField& result)
{
    std::fill(result.begin(), result.end(), Vec3{});
    for (const LinearSolid& solid : solids) {
        Vec3 corner[8];
        Tensor3<double> gradient;
        for (int i = 0; i < 8; ++i) {
            const Index node = solid.node[i];
            corner[i] = by_component(inverse_root[node], x[node]);
            gradient.add_dyad(corner[i], solid.gradient[i]);
        }
        const SymmetricTensor<double> strain = symmetric_part(gradient);
        SymmetricTensor<double> s = hooke(solid, strain);
        const double viscous = 2 * solid.bulk_viscosity / step * trace(strain);
        s.xx += viscous;
        s.yy += viscous;
        s.zz += viscous;
        s = (1 / solid.volume) * s;
        SolidModes<double> modes = modes_of(corner);
        const double resistance = solid.hourglass + 2 * solid.hourglass_damping / step;
        for (Vec3& mode : modes.linear) mode = {};
        for (Vec3& mode : modes.hourglass) mode = resistance * mode;
        for_corners(modes, [&](int i, const Vec3& hourglass) {
            const Vec3& b = solid.gradient[i];
            const Vec3 force{s.xx * b.x + s.xy * b.y + s.zx * b.z, s.xy * b.x + s.yy * b.y + s.yz * b.z,
                             s.zx * b.x + s.yz * b.y + s.zz * b.z};
            result[solid.node[i]] += by_component(inverse_root[solid.node[i]], force + hourglass);
        });
    }
}

/// Largest eigenvalue of a symmetric tridiagonal matrix by bisection on Sturm's sequence.
double largest_of_tridiagonal(const std::vector<double>& diagonal, const std::vector<double>& beside)
{
    double high = 0;
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
        const double before = i > 0 ? std::abs(beside[i - 1]) : 0;
        const double after = i + 1 < diagonal.size() ? std::abs(beside[i]) : 0;
        high = std::max(high, diagonal[i] + before + after);
    }
    const auto above_all = [&](double value) {
        double pivot = 1;
        for (std::size_t i = 0; i < diagonal.size(); ++i) {
            const double square = i > 0 ? beside[i - 1] * beside[i - 1] : 0;
            pivot = diagonal[i] - value - square / pivot;
            if (pivot >= 0) return false;
        }
        return true;
    };
    double low = 0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (above_all(middle) ? high : low) = middle;
    }
    return high;
}

} // namespace

double lone_frequency_squared(const LinearSolid& solid, double mass)
{
    // A stress s accelerates the corners by s B / m and strains the element at the rate of sym(s A), A the
    // sum of the dyads B B^T / (m V): an eigenvalue problem for the strain alone, six values instead of 24.
    Tensor3<double> a;
    for (std::size_t i = 0; i < 8; ++i) {
        Vec3 whole{}; // of a node that several corners share
        for (std::size_t j = 0; j < 8; ++j)
            if (solid.node[j] == solid.node[i]) whole += solid.gradient[j];
        a.add_dyad((1 / (mass * solid.volume)) * whole, solid.gradient[i]);
    }
    SymmetricTensor<double> strain = symmetric_part(a);
    double eigenvalue = 0;
    for (int i = 0; i < 30; ++i) {
        const SymmetricTensor<double> s = hooke(solid, strain);
        const Tensor3<double> stress{s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz};
        const SymmetricTensor<double> next = symmetric_part(stress * a);
        eigenvalue = contract(s, next) / contract(s, strain);
        strain = (1 / eigenvalue) * next;
    }
    return eigenvalue;
}

double largest_eigenvalue(std::span<const LinearSolid> solids, std::span<const Vec3> inverse_mass,
                          double step)
{
    const std::size_t count = inverse_mass.size();
    NodeField inverse_root;
    for (const Vec3& m : inverse_mass)
        inverse_root.push_back({std::sqrt(m.x), std::sqrt(m.y), std::sqrt(m.z)});

    std::mt19937 random(1); // the same start everywhere and always
    const auto number = [&] { return random() / 2147483648.0 - 1; };
    NodeField now(count), before(count), next(count);
    for (Vec3& value : now) {
        value.x = number();
        value.y = number();
        value.z = number();
    }
    const double start = 1 / std::sqrt(inner_product(now, now));
    for (Vec3& value : now) value = start * value;

    constexpr int longest = 60;
    std::vector<double> diagonal, beside;
    double eigenvalue = 0, link = 0;
    for (int i = 0; i < longest; ++i) {
        apply_operator(solids, inverse_root, step, now, next);
        const double along = inner_product(now, next);
        diagonal.push_back(along);
        for (std::size_t node = 0; node < count; ++node)
            next[node] = next[node] - along * now[node] - link * before[node];
        link = std::sqrt(inner_product(next, next));
        const double last = eigenvalue;
        if (i % 5 == 4 || link <= 1e-10 * diagonal.front()) {
            eigenvalue = largest_of_tridiagonal(diagonal, beside);
            if (link <= 1e-10 * diagonal.front() || eigenvalue - last < 1e-4 * eigenvalue) break;
        }
        beside.push_back(link);
        std::swap(before, now);
        std::swap(now, next);
        for (Vec3& value : now) value = (1 / link) * value;
    }
    return eigenvalue;
}

} // namespace plash

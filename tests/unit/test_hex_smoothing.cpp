#include "ale/hex/hex_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace plash {

namespace {

struct Lattice {
    std::array<int, 3> count;
    Index number(int i, int j, int k) const { return i + (count[0] + 1) * (j + (count[1] + 1) * k); }
};

/// Cells of a block whose node (i, j, k) stands at place(i, j, k).
HexMesh block_of(const Lattice& lattice, const std::function<Vec3(int, int, int)>& place)
{
    const auto& n = lattice.count;
    std::vector<Vec3> position;
    for (int k = 0; k <= n[2]; ++k)
        for (int j = 0; j <= n[1]; ++j)
            for (int i = 0; i <= n[0]; ++i) position.push_back(place(i, j, k));
    std::vector<HexCorners> corners;
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                HexCorners cell;
                for (int corner = 0; corner < 8; ++corner)
                    cell[corner] = lattice.number(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
                corners.push_back(cell);
            }
    return make_hex_mesh(std::move(position), std::move(corners));
}

/// As a run does it, but with the material at rest.
void smooth_mesh(HexMesh& mesh, const HexSmoothing& smoothing, const NodeSmoothing& by, int steps)
{
    for (int step = 0; step < steps; ++step) {
        std::vector<Vec3> nodes = mesh.position;
        smoothing(mesh, by, nodes);
        mesh.position = nodes;
        measure(mesh);
    }
}

/// A quarter ring between the radii 1 and e, of an angle of 1, with a different spacing along the radius than
/// the one that the smoothing is to find; nodes in the plane are numbered by i along the radius, j by angle.
HexMesh ring(const Lattice& lattice)
{
    return block_of(lattice, [&](int i, int j, int k) {
        const double part = double(i) / lattice.count[0], angle = double(j) / lattice.count[1];
        const double radius = 1 + (std::exp(1.0) - 1) * part * part; // closer at the inner side
        return Vec3{radius * std::cos(angle), radius * std::sin(angle), 0.1 * k};
    });
}

double ring_error(const Lattice& lattice, const HexMesh& mesh, const std::function<double(int)>& radius)
{
    double worst = 0;
    for (int k = 0; k <= lattice.count[2]; ++k)
        for (int j = 0; j <= lattice.count[1]; ++j)
            for (int i = 0; i <= lattice.count[0]; ++i) {
                const double angle = double(j) / lattice.count[1], r = radius(i);
                const Vec3 wanted{r * std::cos(angle), r * std::sin(angle), 0.1 * k};
                worst = std::max(worst, norm(mesh.position[lattice.number(i, j, k)] - wanted));
            }
    return worst;
}

Vec3 shaken(int i, int j, int k, const Lattice& lattice, double by)
{
    const auto inside = [&](int axis, int index) { return index > 0 && index < lattice.count[axis]; };
    return {i + (inside(0, i) ? by * std::sin(5.0 * i + 3 * j + 7 * k) : 0),
            j + (inside(1, j) ? by * std::sin(2.0 * i + 8 * j + 4 * k) : 0),
            k + (inside(2, k) ? by * std::sin(9.0 * i + 6 * j + 1 * k) : 0)};
}

} // namespace

// In a ring whose curved sides stay and along whose plane ones nodes slide, every node is the mean of those
// around with weights 1 2 1 along each axis. With the angle of a cell d that is
// (R[i-1] + 2 R[i] + R[i+1]) (1 + cos d) / 8 = R[i]: R = a exp(l i) + b exp(-l i), cosh l = 4 / (1 + cos d)
// - 1.
TEST(HexSmoothing, SimpleAverageFindsTheMeanOfTheNodesAround)
{
    const Lattice lattice{{8, 6, 2}};
    HexMesh mesh = ring(lattice);
    const HexSmoothing smoothing(mesh, {});
    smooth_mesh(mesh, smoothing, {1, 0, 0, 0, 0}, 1500);
    const double l = std::acosh(4 / (1 + std::cos(1.0 / 6)) - 1), e = std::exp(1.0);
    const double a = (e - std::exp(-8 * l)) / (std::exp(8 * l) - std::exp(-8 * l)), b = 1 - a;
    EXPECT_LT(ring_error(lattice, mesh, [&](int i) { return a * std::exp(l * i) + b * std::exp(-l * i); }),
              1e-12);
}

// Laplace's equation of the logical coordinates in the ring has the solution ln r and the angle (conformal
// map): radii exp(i / n), which central differences meet to second order. The simple average misses it by
// 0.05.
TEST(HexSmoothing, EquipotentialFindsTheConformalMapOfARing)
{
    double error[2];
    for (int fine = 0; fine < 2; ++fine) {
        const int n = fine ? 12 : 6;
        const Lattice lattice{{n, n, 2}};
        HexMesh mesh = ring(lattice);
        const HexSmoothing smoothing(mesh, {});
        smooth_mesh(mesh, smoothing, {0, 0, 0, 1, 0}, 3000);
        error[fine] = ring_error(lattice, mesh, [&](int i) { return std::exp(double(i) / n); });
    }
    EXPECT_LT(error[0], 3.5e-3);
    EXPECT_NEAR(error[0] / error[1], 4, 0.2);
}

// Between plane sides there is but the even mesh for the simple average and the equipotential, and for
// mixtures. The isoparametric one alone does not see what is linear along an axis, and for the volume
// weighted one there are uneven meshes that rest.
TEST(HexSmoothing, ShakenBlockBecomesEven)
{
    const Lattice lattice{{5, 4, 6}};
    const NodeSmoothing kinds[] = {{1, 0, 0, 0, 0}, {0, 0, 0, 1, 0}, {0.4, 0, 0.2, 0.4, 0}};
    for (const NodeSmoothing& by : kinds) {
        HexMesh mesh = block_of(lattice, [&](int i, int j, int k) { return shaken(i, j, k, lattice, 0.25); });
        const HexSmoothing smoothing(mesh, {});
        smooth_mesh(mesh, smoothing, by, 1000);
        for (int k = 0; k <= 6; ++k)
            for (int j = 0; j <= 4; ++j)
                for (int i = 0; i <= 5; ++i)
                    ASSERT_LT(norm(mesh.position[lattice.number(i, j, k)] - Vec3(i, j, k)), 1e-9)
                        << &by - kinds << ": " << i << " " << j << " " << k;
    }
}

// A block with curved sides whose inner nodes have been shaken: they come to the transfinite interpolation of
// the sides (Gordon & Hall 1973, Int. J. Numer. Meth. Eng. 7, 461-477).
TEST(HexSmoothing, IsoparametricFindsTheTransfiniteInterpolation)
{
    const Lattice lattice{{3, 3, 3}};
    const auto side = [](double x, double y, double z) { // bent both ways on all sides
        return Vec3{x + 0.15 * std::sin(1 + y) * std::cos(z + 0.5),
                    y + 0.15 * std::sin(0.7 + z) * std::cos(x + 0.2),
                    z + 0.15 * std::sin(0.4 + x) * std::cos(y + 0.9)};
    };
    const auto inner = [&](int i, int j, int k) {
        const double p[3] = {i / 3.0, j / 3.0, k / 3.0};
        Vec3 sum{};
        // Faces, less edges, plus corners.
        for (int kind = 1; kind < 8; ++kind)
            for (int corner = 0; corner < 8; ++corner) {
                if (corner & ~kind) continue;
                double at[3] = {double(i), double(j), double(k)}, weight = -1;
                for (int axis = 0; axis < 3; ++axis) {
                    if (!(kind >> axis & 1)) continue;
                    const bool high = corner >> axis & 1;
                    at[axis] = high ? 3 : 0;
                    weight *= high ? -p[axis] : p[axis] - 1;
                }
                sum += weight * side(at[0], at[1], at[2]);
            }
        return sum;
    };
    HexMesh mesh = block_of(lattice, [&](int i, int j, int k) {
        Vec3 moved = side(i, j, k);
        const bool inside = i % 3 && j % 3 && k % 3;
        if (inside) moved += 0.2 * Vec3{std::sin(5.0 * i + j), std::sin(3.0 * j + k), std::sin(2.0 * k + i)};
        return moved;
    });
    const HexSmoothing smoothing(mesh, {});
    smooth_mesh(mesh, smoothing, {0, 0, 1, 0, 0}, 3000);
    for (int k = 1; k < 3; ++k)
        for (int j = 1; j < 3; ++j)
            for (int i = 1; i < 3; ++i)
                EXPECT_LT(norm(mesh.position[lattice.number(i, j, k)] - inner(i, j, k)), 1e-10)
                    << i << " " << j << " " << k;
}

// One step between two layers of cells of lengths 1 and 2, by hand: volume weighted
// (1 (-0.5) + 2 (+1)) / 6 = 0.25, simple average
// (4 (-1) + 4 (+2)) / 14 = 2/7, equipotential 1/4 of it. None goes further
// than a quarter of its shortest edge, and two halves of a weight are not more than one whole.
TEST(HexSmoothing, OneStepIsWhatHandsFind)
{
    const Lattice lattice{{2, 2, 2}};
    const auto middle_after = [&](const NodeSmoothing& by) {
        HexMesh mesh =
            block_of(lattice, [](int i, int j, int k) { return Vec3(i == 2 ? 3.0 : i, 10.0 * j, 10.0 * k); });
        const HexSmoothing smoothing(mesh, {});
        smooth_mesh(mesh, smoothing, by, 1);
        return mesh.position[lattice.number(1, 1, 1)].x - 1;
    };
    EXPECT_NEAR(middle_after({0, 0.2, 0, 0, 0}), 0.2 * 0.25, 1e-14);
    EXPECT_NEAR(middle_after({0.2, 0, 0, 0, 0}), 0.2 * 2 / 7, 1e-14);
    // d(g22 g33) = 1e4 along x against g11 = 2.25 times 100 across, whose second derivatives are zero.
    EXPECT_NEAR(middle_after({0, 0, 0, 0.2, 0}), 0.2 * 0.5 * 1e4 / (2 * (1e4 + 2 * 225)), 1e-14);
    EXPECT_NEAR(middle_after({1, 0, 0, 0, 0}), 0.25, 1e-14);
    EXPECT_NEAR(middle_after({0.1, 0.1, 0, 0, 0}), 0.1 * 0.25 + 0.1 * 2 / 7, 1e-14);
}

} // namespace plash

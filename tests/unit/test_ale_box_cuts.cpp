#include "ale/coupling/box_cuts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

const BoxGrid& cut_grid()
{
    static const BoxGrid grid({{{0, 0.3, 0.7, 1, 1.5}, {0, 0.4, 0.9, 1.3}, {0, 0.2, 0.6, 1.1, 1.6}}});
    return grid;
}

/// A tetrahedron with outward normals.
std::vector<SurfaceTriangle> tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
    return {{{a, c, b}}, {{a, b, d}}, {{b, c, d}}, {{a, d, c}}};
}

template <class Visit>
void for_cut_grid(Visit&& visit)
{
    const BoxGrid& grid = cut_grid();
    for (int k = 0; k < grid.cells(2); ++k)
        for (int j = 0; j < grid.cells(1); ++j)
            for (int i = 0; i < grid.cells(0); ++i) visit(i, j, k);
}

} // namespace

// Open volumes add up to all but the tetrahedron, to the offset of the planes; cells close
// to round-off.
TEST(AleBoxCuts, OpenPartsAreAllButTheBody)
{
    const BoxGrid& grid = cut_grid();
    const Vec3 a{0.21, 0.33, 0.13}, b{1.12, 0.47, 0.31}, c{0.52, 1.09, 0.42}, d{0.63, 0.61, 1.37};
    const double volume = dot(cross(b - a, c - a), d - a) / 6;
    ASSERT_GT(volume, 0.1);
    BoxCuts cuts(grid);
    for (int repeat = 0; repeat < 2; ++repeat) cuts.find(grid, tetrahedron(a, b, c, d));
    // Along whichever axis edges are followed.
    for (const int along : {0, 1}) {
        BoxCuts others(grid, along);
        others.find(grid, tetrahedron(a, b, c, d));
        for_cut_grid([&](int i, int j, int k) {
            EXPECT_NEAR(others.open_share(i, j, k), cuts.open_share(i, j, k), 1e-5);
            for (int axis = 0; axis < 3; ++axis) {
                const BoxCuts::Face one = cuts.face(axis, i, j, k), other = others.face(axis, i, j, k);
                EXPECT_NEAR(other.open, one.open, 1e-5);
                if (one.open < 0.01) continue;
                for (int n = 0; n < 2; ++n) EXPECT_NEAR(other.middle[n], one.middle[n], 1e-4);
            }
        });
    }
    double open = 0;
    for_cut_grid([&](int i, int j, int k) { open += cuts.open_share(i, j, k) * grid.volume(i, j, k); });
    EXPECT_NEAR(open, 1.5 * 1.3 * 1.6 - volume, 1e-6 * volume);
    ASSERT_GT(cuts.cells().size(), 10u);
    for (const BoxCuts::Cell& cell : cuts.cells()) EXPECT_LT(norm(cuts.gap(cell)), 1e-12);
}

// A body that holds its fluid: the same with all normals turned, so that nothing is open but what was
// covered.
TEST(AleBoxCuts, InnerPartsAreWhatOuterOnesLeave)
{
    const BoxGrid& grid = cut_grid();
    const Vec3 a{0.21, 0.33, 0.13}, b{1.12, 0.47, 0.31}, c{0.52, 1.09, 0.42}, d{0.63, 0.61, 1.37};
    BoxCuts outer(grid), inner(grid);
    outer.find(grid, tetrahedron(a, b, c, d));
    std::vector<SurfaceTriangle> turned = tetrahedron(a, b, c, d);
    for (SurfaceTriangle& triangle : turned) std::swap(triangle.corner[1], triangle.corner[2]);
    inner.find(grid, turned);
    for_cut_grid([&](int i, int j, int k) {
        EXPECT_NEAR(outer.open_share(i, j, k) + inner.open_share(i, j, k), 1, 1e-12);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(outer.face(axis, i, j, k).open + inner.face(axis, i, j, k).open, 1, 1e-12);
    });
}

// A wall of slope 1 / 2 across a cell: shares and middles of its faces by hand.
TEST(AleBoxCuts, FacesHaveTheirMiddles)
{
    const BoxGrid grid = BoxGrid::uniform({0, 0, 0}, {1, 1, 2}, {1, 1, 2});
    // Open below z = 0.25 + 0.5 x, and ending beyond all sides.
    const auto at = [](double x, double y) { return Vec3{x, y, 0.25 + 0.5 * x}; };
    BoxCuts cuts(grid);
    cuts.find(grid, std::vector<SurfaceTriangle>{{{at(-1, -1), at(2, 2), at(2, -1)}},
                                                 {{at(-1, -1), at(-1, 2), at(2, 2)}}});
    EXPECT_NEAR(cuts.open_share(0, 0, 0), 0.5, 1e-6);
    EXPECT_NEAR(cuts.open_share(0, 0, 1), 0, 1e-6);
    EXPECT_NEAR(cuts.face(0, 0, 0, 0).open, 0.25, 1e-6);
    EXPECT_NEAR(cuts.face(0, 0, 0, 0).middle[1], 0.125, 1e-6);
    EXPECT_NEAR(cuts.face(0, 1, 0, 0).open, 0.75, 1e-6);
    EXPECT_NEAR(cuts.face(1, 0, 0, 0).open, 0.5, 1e-6);
    // Trapezium with sides 0.25 and 0.75: first moments 1/8 + 1/6, (1/16 + 1/8 + 1/12) / 2 over its area.
    EXPECT_NEAR(cuts.face(1, 0, 0, 0).middle[0], (1.0 / 8 + 1.0 / 6) / 0.5, 1e-6);
    EXPECT_NEAR(cuts.face(1, 0, 0, 0).middle[1], (1.0 / 16 + 1.0 / 8 + 1.0 / 12) / 2 / 0.5, 1e-6);
    EXPECT_EQ(cuts.face(2, 0, 0, 0).open, 1);
    EXPECT_EQ(cuts.face(2, 0, 0, 1).open, 0);
    EXPECT_TRUE(cuts.node_open(0, 0, 0));
    EXPECT_FALSE(cuts.node_open(0, 0, 1));
}

// A triangle's second moment about the origin, A / 12 (sum of v v^T over its corners + 9 c c^T with its
// middle c), is that of its pieces, whichever axis is followed.
TEST(AleBoxCuts, PiecesHaveTheirSpread)
{
    const BoxGrid& grid = cut_grid();
    const Vec3 a{0.21, 0.33, 0.13}, b{1.12, 0.47, 0.31}, c{0.52, 1.09, 0.42}, d{0.63, 0.61, 1.37};
    const std::vector<SurfaceTriangle> triangles = tetrahedron(a, b, c, d);
    for (const int axis : {0, 1, 2}) {
        BoxCuts cuts(grid, axis);
        cuts.find(grid, triangles);
        std::vector<Matrix3> sum(triangles.size());
        for (const BoxCuts::Cell& cell : cuts.cells())
            for (const BoxCuts::Piece& piece : cuts.pieces(cell)) {
                const Matrix3 mean = piece.spread + dyad(piece.middle, piece.middle);
                for (int row = 0; row < 3; ++row)
                    sum[piece.triangle].row[row] += norm(piece.area) * mean.row[row];
            }
        for (std::size_t n = 0; n < triangles.size(); ++n) {
            const auto& corner = triangles[n].corner;
            const double area = 0.5 * norm(cross(corner[1] - corner[0], corner[2] - corner[0]));
            const Vec3 middle = (1. / 3) * (corner[0] + corner[1] + corner[2]);
            Matrix3 wanted = dyad(9. * middle, middle);
            for (const Vec3& v : corner) wanted = wanted + dyad(v, v);
            for (int row = 0; row < 3; ++row)
                EXPECT_LT(norm(sum[n].row[row] - (area / 12) * wanted.row[row]), 1e-12) << axis;
        }
    }
}

} // namespace plash

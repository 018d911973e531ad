#include "output/cell_shape.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// Corners of the unit cube in LS-DYNA's order.
const Vec3 cube[8] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// Six times the signed volume of the tetrahedron of four corners of a cell.
double sixfold_volume(const Cell& cell, int a, int b, int c, int d)
{
    const Vec3 origin = cube[cell.corners[a]];
    return dot(cross(cube[cell.corners[b]] - origin, cube[cell.corners[c]] - origin),
               cube[cell.corners[d]] - origin);
}

} // namespace

TEST(CellShape, OfShells)
{
    const Cell quad = shell_cell({3, 4, 5, 6});
    EXPECT_EQ(quad.shape, CellShape::quad);
    EXPECT_EQ(quad.corner_count, 4);
    for (const auto& nodes : {std::array<Index, 4>{3, 4, 5, 5}, {3, 4, 4, 5}, {3, 3, 4, 5}, {3, 4, 5, 3}}) {
        const Cell triangle = shell_cell(nodes);
        EXPECT_EQ(triangle.shape, CellShape::triangle);
        ASSERT_EQ(triangle.corner_count, 3);
        Index first = 0; // the same turn from wherever it begins
        while (first < 3 && triangle.corners[first] != 3) ++first;
        EXPECT_EQ(triangle.corners[(first + 1) % 3], 4);
        EXPECT_EQ(triangle.corners[(first + 2) % 3], 5);
    }
}

// Orientation as VTK wants it: a tetrahedron's and a pyramid's base sees the apex, a wedge's first triangle
// looks away from the second (vtkWedge).
TEST(CellShape, OfSolids)
{
    EXPECT_EQ(solid_cell({0, 1, 2, 3, 4, 5, 6, 7}).shape, CellShape::hexahedron);
    for (const auto& nodes : {std::array<Index, 8>{0, 1, 2, 5, 5, 5, 5, 5}, {0, 1, 2, 2, 5, 5, 5, 5}}) {
        const Cell tetra = solid_cell(nodes);
        EXPECT_EQ(tetra.shape, CellShape::tetra);
        EXPECT_GT(sixfold_volume(tetra, 0, 1, 2, 3), 0);
    }
    const Cell pyramid = solid_cell({0, 1, 2, 3, 4, 4, 4, 4});
    EXPECT_EQ(pyramid.shape, CellShape::pyramid);
    EXPECT_GT(sixfold_volume(pyramid, 0, 1, 2, 4), 0);
    for (const auto& nodes : {std::array<Index, 8>{0, 1, 2, 3, 4, 4, 7, 7}, {0, 1, 2, 2, 4, 5, 6, 6}}) {
        const Cell wedge = solid_cell(nodes);
        EXPECT_EQ(wedge.shape, CellShape::wedge);
        EXPECT_EQ(wedge.corner_count, 6);
        for (int corner = 3; corner < 6; ++corner) EXPECT_LT(sixfold_volume(wedge, 0, 1, 2, corner), 0);
    }
    EXPECT_EQ(solid_cell({0, 1, 2, 3, 4, 5, 6, 6}).shape, CellShape::hexahedron);
}

} // namespace plash

#include "tests/support/splash_deck.h"

#include <fmt/format.h>
#include <fstream>

namespace plash::testing {

namespace {

constexpr const char* splash_head = R"(*KEYWORD
*TITLE
fluids and what couples them
*CONTROL_TERMINATION
0.012
*CONTROL_TIMESTEP
0,0.6
*CONTROL_ENERGY
2,2,2
*CONTROL_ALE
-1,1,2,-1
,,,,,1
*DATABASE_BINARY_D3PLOT
0.001
*DATABASE_BINARY_D3DUMP
100
*DATABASE_BINARY_RUNRSF
10,2
*DATABASE_GLSTAT
1e-4
*DATABASE_MATSUM
1e-4
*ALE_STRUCTURED_MESH
1,10,1,1
1,2,3
*ALE_STRUCTURED_MESH_CONTROL_POINTS
1
1,0
14,0.52
*ALE_STRUCTURED_MESH_CONTROL_POINTS
2
1,0
8,0.28
*ALE_STRUCTURED_MESH_CONTROL_POINTS
3
1,0
13,0.48
*ALE_MULTI-MATERIAL_GROUP
1,1
3,1
2,1
*PART
water
1,1,1,1
*PART
empty
2,1,2
*PART
oil
3,1,3,3
*PART
reservoir
4,4,3,3
*SECTION_SOLID
1,11
*SECTION_SOLID
4,11,4
*MAT_NULL
1,1000,-1e3
*EOS_LINEAR_POLYNOMIAL
1,0,2.5e6

*MAT_VACUUM
2,0
*MAT_NULL
3,800,-1e3,2.0
*EOS_LINEAR_POLYNOMIAL
3,0,2e6

*INITIAL_VOLUME_FRACTION_GEOMETRY
10,1,3,3
5,0,1
0,0,0,0.52,0.28,0.22
5,0,2
0,0,0.22,0.2,0.28,0.29
*ALE_REFERENCE_SYSTEM_GROUP
10,1,3,1
*ALE_REFERENCE_SYSTEM_CURVE
1
7,,,,7

*DEFINE_CURVE
7
0,0.3
1,0.5
*LOAD_BODY_Z
8,9.81
*DEFINE_CURVE
8
0,1
1,1
*PART
plate
20,20,20
*SECTION_SHELL
20,2
0.01,0.01,0.01,0.01
*MAT_ELASTIC
20,2700,7e9,0.3
*PART
lid
21,20,21
*MAT_RIGID
21,2700,7e10,0.3
,
,
*CONSTRAINED_LAGRANGE_IN_SOLID
20,10,1,1,2,4,2,1
0,0,0.1,0,0.3
*CONSTRAINED_LAGRANGE_IN_SOLID
21,1,1,0,2,5,3
0,0,0.1,0.2,0.3,1,0,0.4
,,,2,0.1
*SET_PART_LIST
1
3,4
*INITIAL_VELOCITY_GENERATION
20,2,,,,-4.0
*INITIAL_VELOCITY_GENERATION
21,2,,,,-1.0
)";

/// A patch of shells across z with nodes from `first` on; normals point down.
void add_plate(std::string& nodes, std::string& shells, int first, int part, double x, double y, double z,
               double side, int n)
{
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            nodes +=
                fmt::format("{},{},{},{}\n", first + i + (n + 1) * j, x + side * i / n, y + side * j / n, z);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = first + i + (n + 1) * j;
            shells +=
                fmt::format("{},{},{},{},{},{}\n", first + i + n * j, part, a, a + n + 1, a + n + 2, a + 1);
        }
}

} // namespace

void write_splash_deck(const std::filesystem::path& path)
{
    std::string nodes, shells, solids;
    add_plate(nodes, shells, 500001, 20, 0.16, 0.04, 0.225, 0.2, 4);
    add_plate(nodes, shells, 600001, 21, 1.06, 0.06, 0.18, 0.1, 3);
    // The oblique block: sheared and swelling, its lowest layer a reservoir.
    constexpr int n = 6, first = 700001;
    const auto at = [&](int i, int j, int k) { return first + i + (n + 1) * (j + (n + 1) * k); };
    int element = first;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const double u = i * 0.04, v = j * 0.04, w = k * 0.04;
                nodes += fmt::format("{},{:.9g},{:.9g},{:.9g}\n", at(i, j, k),
                                     1 + u * (1 + 0.4 * w) + 0.2 * w, v * (1 + 0.3 * u) - 0.1 * w, w);
                if (i == n || j == n || k == n) continue;
                solids +=
                    fmt::format("{},{},{},{},{},{},{},{},{},{}\n", element++, k == 0 ? 4 : 3, at(i, j, k),
                                at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
                                at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1));
            }
    std::ofstream(path) << splash_head << "*NODE\n"
                        << nodes << "*ELEMENT_SHELL\n"
                        << shells << "*ELEMENT_SOLID\n"
                        << solids << "*END\n";
}

} // namespace plash::testing

#include "tests/support/crash_deck.h"

#include <fmt/format.h>
#include <fstream>

namespace plash::testing {

namespace {

constexpr const char* head = R"(*KEYWORD
*TITLE
everything that a run carries from cycle to cycle
*CONTROL_TERMINATION
1.2
*CONTROL_ENERGY
2,2,2
*CONTROL_SHELL
20.0,1,-1,1
*DATABASE_BINARY_D3PLOT
0.1
*DATABASE_BINARY_D3DUMP
400
*DATABASE_BINARY_RUNRSF
40,2
*DATABASE_GLSTAT
0.01
*DATABASE_MATSUM
0.01
*DATABASE_NODOUT
0.01
*DATABASE_ELOUT
0.05
*DATABASE_SPCFORC
0.05
*DATABASE_BNDOUT
0.05
*DATABASE_RWFORC
0.01
*DATABASE_RCFORC
0.01
*DATABASE_SLEOUT
0.05
*DATABASE_NCFORC
0.1
*DATABASE_HISTORY_NODE
41,1001,2001
*DATABASE_HISTORY_SHELL
33,36
*DATABASE_HISTORY_SOLID
1001
*PART
sheet
1,1,1
*SECTION_SHELL
1,2,0.833,5
1.0,1.0,1.0,1.0
*MAT_PIECEWISE_LINEAR_PLASTICITY
1,7.8e-6,210.0,0.3,0.3,1.0,0.08
0.0,0.0,0
,
,
*PART
projectile
2,2,2
*SECTION_SOLID
2,1
*MAT_PLASTIC_KINEMATIC
2,7.8e-6,210.0,0.3,0.6,2.0,0.5
0.0,0.0,0.0
*PART
driven block
3,2,3
*MAT_RIGID
3,7.8e-6,210.0,0.3
,
,
*INITIAL_VELOCITY
2
30.0,0.0,-60.0
*SET_NODE_LIST
2
)";

constexpr const char* tail = R"(*SET_NODE_LIST
3
1,10,19,28,37,46,55,64,
73
*SET_NODE_LIST
4
9,18,27,36,45,54,63,72,
81
*BOUNDARY_SPC_SET
3,0,1,1,1,1,1,1
*DEFINE_CURVE
1
0.0,1.0
10.0,1.0
*DEFINE_CURVE
2
0.0,0.0
0.5,2.0
10.0,4.0
*BOUNDARY_PRESCRIBED_MOTION_SET
4,1,2,2,0.2
*BOUNDARY_PRESCRIBED_MOTION_RIGID
3,3,0,1,-10.0
3,5,0,2,0.5
*LOAD_NODE_POINT
77,3,2,0.02
*LOAD_BODY_Z
1,0.00981
*RIGIDWALL_PLANAR
0
0.0,0.0,-12.0,0.0,0.0,1.0,0.3
*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE
1,2,3,3
0.2,0.1,0.01
,
*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE
1,3,3,3
0.1,0.1
,
)";

/// A box of n x n x m bricks with nodes from `first` on.
void add_block(std::string& nodes, std::string& elements, int first, int part, double x, double y, double z,
               int n, int m)
{
    const auto at = [&](int i, int j, int k) { return first + i + (n + 1) * (j + (n + 1) * k); };
    for (int k = 0; k <= m; ++k) {
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                nodes += fmt::format("{},{},{},{}\n", at(i, j, k), x + 4.0 * i, y + 4.0 * j, z + 4.0 * k);
            }
        }
    }
    int element = first;
    for (int k = 0; k < m; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                elements +=
                    fmt::format("{},{},{},{},{},{},{},{},{},{}\n", element++, part, at(i, j, k),
                                at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
                                at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1));
            }
        }
    }
}

} // namespace

void write_crash_deck(const std::filesystem::path& path)
{
    constexpr int n = 8;
    std::string nodes, shells, solids, moving;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            nodes += fmt::format("{},{},{},0.0\n", 1 + i + (n + 1) * j, 5.0 * i, 5.0 * j);
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int a = 1 + i + (n + 1) * j;
            shells += fmt::format("{},1,{},{},{},{}\n", 1 + i + n * j, a, a + 1, a + n + 2, a + n + 1);
        }
    }
    add_block(nodes, solids, 1001, 2, 15.3, 14.1, 1.5, 2, 3);
    add_block(nodes, solids, 2001, 3, 3.2, 24.7, 6.0, 2, 1);
    for (int i = 0; i < 36; ++i) moving += fmt::format("{}{}", 1001 + i, i % 8 == 7 || i == 35 ? "\n" : ",");
    std::ofstream(path) << head << moving << tail << "*NODE\n"
                        << nodes << "*ELEMENT_SHELL\n"
                        << shells << "*ELEMENT_SOLID\n"
                        << solids << "*END\n";
}

} // namespace plash::testing

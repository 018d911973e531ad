#pragma once

#include <fmt/format.h>
#include <functional>
#include <string>

/// A deck of water under a rigid body, which the tests of --fluid run in all forms.
namespace plash::testing {

/// A box of one-point solids as water (part 1, sides held, floor a rigid wall) and a rigid block (part 2) of
/// a layer of solids that falls on it. Units: m, kg, s.
struct WaterDeck {
    double width = 0.04, depth = 0.04, height = 0.2; ///< of the water [length]
    int nx = 4, ny = 4, nz = 20;
    double sound = 100; ///< [velocity]
    double mass = 0.32; ///< of the block [mass]
    double speed = 1;   ///< of the block, downward [velocity]
    double gravity = 0; ///< [acceleration]
    double end = 4e-3;  ///< [time]
    double step_scale = 0.67;
    double tension_limit = 0; ///< PC
    /// Height of the block's lower face above the water [length]; it stands over the share `cover` of the
    /// width.
    std::function<double(double)> keel = [](double) { return 0.0; };
    double cover = 1;
    std::string more; ///< keywords that are added

    std::string text() const
    {
        std::string nodes = "*NODE\n", solids = "*ELEMENT_SOLID\n";
        const auto id = [&](int i, int j, int k) { return 1 + i + (nx + 1) * (j + (ny + 1) * k); };
        for (int k = 0; k <= nz; ++k)
            for (int j = 0; j <= ny; ++j)
                for (int i = 0; i <= nx; ++i) {
                    const bool x = i == 0 || i == nx, y = j == 0 || j == ny;
                    nodes += fmt::format("{},{:.10g},{:.10g},{:.10g},{}\n", id(i, j, k), width * i / nx,
                                         depth * j / ny, height * k / nz,
                                         x && y ? 4
                                         : x    ? 1
                                         : y    ? 2
                                                : 0);
                }
        int element = 0;
        const auto add_solids = [&](int part, int mx, int my, int mz, auto&& number) {
            for (int k = 0; k < mz; ++k)
                for (int j = 0; j < my; ++j)
                    for (int i = 0; i < mx; ++i)
                        solids +=
                            fmt::format("{},{},{},{},{},{},{},{},{},{}\n", ++element, part, number(i, j, k),
                                        number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k),
                                        number(i, j, k + 1), number(i + 1, j, k + 1),
                                        number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1));
        };
        add_solids(1, nx, ny, nz, id);
        const int first = id(nx, ny, nz) + 1;
        const auto block = [&](int i, int j, int k) { return first + i + (nx + 1) * (j + (ny + 1) * k); };
        const double thickness = height / nz, wide = cover * width;
        for (int k = 0; k <= 1; ++k)
            for (int j = 0; j <= ny; ++j)
                for (int i = 0; i <= nx; ++i) {
                    const double x = wide * i / nx;
                    nodes += fmt::format("{},{:.10g},{:.10g},{:.10g}\n", block(i, j, k), x, depth * j / ny,
                                         height + keel(x) + k * thickness);
                }
        add_solids(2, nx, ny, 1, block);
        return fmt::format(
                   "*KEYWORD\n*CONTROL_TERMINATION\n{}\n*CONTROL_TIMESTEP\n0,{}\n*CONTROL_ENERGY\n2,2,2\n"
                   "*PART\nwater\n1,1,1,1,1\n*SECTION_SOLID\n1,1\n*HOURGLASS\n1,1,1e-3\n"
                   "*MAT_NULL\n1,1000,{}\n*EOS_LINEAR_POLYNOMIAL\n1,0,{}\n\n"
                   "*PART\nblock\n2,2,2\n*SECTION_SOLID\n2,1\n"
                   "*MAT_RIGID\n2,{:.10g},1e9,0.3\n1,4,7\n\n"
                   "*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID\n7,block\n1,2,3,3\n\n\n1,0.1\n"
                   "*RIGIDWALL_PLANAR\n0\n0,0,0,0,0,1\n"
                   "*INITIAL_VELOCITY_RIGID_BODY\n2,0,0,{}\n",
                   end, step_scale, tension_limit, 1000 * sound * sound, mass / (wide * depth * thickness),
                   -speed) +
               (gravity > 0 ? fmt::format("*LOAD_BODY_Z\n1,{}\n*DEFINE_CURVE\n1\n0,1\n1e9,1\n", gravity)
                            : "") +
               more + nodes + solids + "*END\n";
    }
    /// A node of the block.
    int block_node() const { return 1 + (nx + 1) * (ny + 1) * (nz + 1); }
};

} // namespace plash::testing

#pragma once

#include "math/vector3.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

namespace plash::testing {

/// Writes keyword blocks of meshes for a test, in free format, and keeps count of ids.
struct DeckText {
    std::string text = "*KEYWORD\n";
    int nodes = 0, shells = 0, solids = 0;

    /// First of the ids of a block of nx x ny x nz bricks; x runs fastest.
    int block(int part, const Vec3& low, const Vec3& high, int nx, int ny, int nz)
    {
        const int first = nodes + 1;
        text += "*NODE\n";
        for (int k = 0; k <= nz; ++k) {
            for (int j = 0; j <= ny; ++j) {
                for (int i = 0; i <= nx; ++i) {
                    text += fmt::format("{},{:.10g},{:.10g},{:.10g}\n", ++nodes,
                                        low.x + (high.x - low.x) * i / nx, low.y + (high.y - low.y) * j / ny,
                                        low.z + (high.z - low.z) * k / nz);
                }
            }
        }
        text += "*ELEMENT_SOLID\n";
        for (int k = 0; k < nz; ++k) {
            for (int j = 0; j < ny; ++j) {
                for (int i = 0; i < nx; ++i) {
                    const int a = first + (k * (ny + 1) + j) * (nx + 1) + i, b = a + nx + 1;
                    const int up = (nx + 1) * (ny + 1);
                    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", ++solids, part, a, a + 1, b + 1, b,
                                        a + up, a + 1 + up, b + 1 + up, b + up);
                }
            }
        }
        return first;
    }

    /// A ball of n x n x n bricks: a cube whose layers are drawn towards spheres, fully so on the outside.
    int ball(int part, const Vec3& center, double radius, int n)
    {
        const auto start = text.size();
        const int first = block(part, {-1, -1, -1}, {1, 1, 1}, n, n, n);
        const auto elements = text.find("*ELEMENT_SOLID\n", start);
        std::string round = "*NODE\n";
        int id = first;
        for (int k = 0; k <= n; ++k) {
            for (int j = 0; j <= n; ++j) {
                for (int i = 0; i <= n; ++i) {
                    const Vec3 x{2.0 * i / n - 1, 2.0 * j / n - 1, 2.0 * k / n - 1};
                    const double layer = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
                    const double cube = 1 / std::sqrt(3.0), sphere = layer > 0 ? layer / norm(x) : cube;
                    const Vec3 place = center + (radius * ((1 - layer) * cube + layer * sphere)) * x;
                    round += fmt::format("{},{:.10g},{:.10g},{:.10g}\n", id++, place.x, place.y, place.z);
                }
            }
        }
        text.replace(start, elements - start, round);
        return first;
    }

    /// A sheet of nu x nv shells from `origin` along `u` and `v`; the normal is u x v.
    int sheet(int part, const Vec3& origin, const Vec3& u, const Vec3& v, int nu, int nv)
    {
        const int first = nodes + 1;
        text += "*NODE\n";
        for (int j = 0; j <= nv; ++j) {
            for (int i = 0; i <= nu; ++i) {
                const Vec3 x = origin + (double(i) / nu) * u + (double(j) / nv) * v;
                text += fmt::format("{},{:.10g},{:.10g},{:.10g}\n", ++nodes, x.x, x.y, x.z);
            }
        }
        text += "*ELEMENT_SHELL\n";
        for (int j = 0; j < nv; ++j) {
            for (int i = 0; i < nu; ++i) {
                const int a = first + j * (nu + 1) + i;
                text += fmt::format("{},{},{},{},{},{}\n", ++shells, part, a, a + 1, a + nu + 2, a + nu + 1);
            }
        }
        return first;
    }

    void part(int id, int section, int material)
    {
        text += fmt::format("*PART\np{}\n{},{},{}\n", id, id, section, material);
    }
};

} // namespace plash::testing

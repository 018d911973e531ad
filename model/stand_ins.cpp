#include "model/stand_ins.h"

namespace plash {

namespace {

/// visit(a, b, c) for the points of a triangle's lattice, by its three area coordinates.
template <class Visit>
void for_triangle(int per_edge, Visit&& visit)
{
    for (int i = 0; i < per_edge; ++i)
        for (int j = 0; i + j < per_edge; ++j) {
            const double a = (i + 1.0 / 3) / per_edge, b = (j + 1.0 / 3) / per_edge;
            visit(a, b, 1 - a - b);
        }
}

} // namespace

std::vector<std::array<double, 8>> stand_in_weights(const std::array<Index, 8>& nodes, int per_edge)
{
    const int n = per_edge;
    std::vector<std::array<double, 8>> weights;
    if (nodes[4] == nodes[3] && nodes[5] == nodes[3]) { // tetrahedron as 1 2 3 4 4 4 4 4
        for (int l = 0; l < n; ++l) {
            for (int i = 0; i + l < n; ++i)
                for (int j = 0; i + j + l < n; ++j) {
                    const double a = (i + 0.25) / n, b = (j + 0.25) / n, d = (l + 0.25) / n;
                    weights.push_back({a, b, 1 - a - b - d, d, 0, 0, 0, 0});
                }
        }
        return weights;
    }
    for (int k = 0; k < n; ++k) {
        const double t = (k + 0.5) / n;
        if (nodes[4] == nodes[5] && nodes[6] == nodes[7]) { // wedge with the triangles 1 2 5 and 4 3 7
            for_triangle(n, [&](double a, double b, double c) {
                weights.push_back({a * (1 - t), b * (1 - t), b * t, a * t, c * (1 - t), 0, c * t, 0});
            });
            continue;
        }
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double r = (i + 0.5) / n, s = (j + 0.5) / n;
                const double plane[] = {(1 - r) * (1 - s), r * (1 - s), r * s, (1 - r) * s};
                std::array<double, 8> all;
                for (int node = 0; node < 8; ++node) all[node] = plane[node % 4] * (node < 4 ? 1 - t : t);
                weights.push_back(all);
            }
    }
    return weights;
}

} // namespace plash

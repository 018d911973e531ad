#include "contact/solid_faces.h"

#include <algorithm>

namespace plash {

namespace {

using Corners = std::array<Index, 4>;

void append_face(const Corners& corners, Index solid, std::vector<SolidFace>& faces)
{
    Corners distinct{};
    int count = 0;
    for (Index node : corners) {
        if (std::find(distinct.begin(), distinct.begin() + count, node) == distinct.begin() + count) {
            distinct[count++] = node;
        }
    }
    if (count < 3) return;
    if (count == 3) distinct[3] = distinct[2];
    faces.push_back({distinct, solid, none});
}

} // namespace

std::array<Index, 4> face_key(std::array<Index, 4> nodes)
{
    const int count = nodes[3] == nodes[2] ? 3 : 4;
    for (int end = count; end > 1; --end) {
        for (int i = 1; i < end; ++i) {
            if (nodes[i] < nodes[i - 1]) std::swap(nodes[i], nodes[i - 1]);
        }
    }
    if (count == 3) nodes[3] = nodes[2];
    return nodes;
}

void append_faces(const std::array<Index, 8>& n, Index solid, std::vector<SolidFace>& faces)
{
    if (n[4] == n[3] && n[5] == n[3]) { // tetrahedron 1 2 3 4 4 4 4 4
        constexpr int triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        for (const auto& t : triangles) append_face({n[t[0]], n[t[1]], n[t[2]], n[t[2]]}, solid, faces);
        return;
    }
    constexpr int quads[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (const auto& q : quads) append_face({n[q[0]], n[q[1]], n[q[2]], n[q[3]]}, solid, faces);
}

void append_ten_node_faces(const std::array<Index, 10>& n, Index solid, std::vector<SolidFace>& faces)
{
    constexpr int triangles[4][6] = {
        {0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}};
    for (const auto& t : triangles) {
        const Index a = n[t[0]], b = n[t[1]], c = n[t[2]], ab = n[t[3]], bc = n[t[4]], ca = n[t[5]];
        for (const auto& [i, j, k] : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
            append_face({i, j, k, k}, solid, faces);
    }
}

std::vector<SolidFace> solid_faces(const Model& model)
{
    std::vector<SolidFace> faces;
    faces.reserve(6 * brick_count(model));
    for (Index brick = 0; brick < static_cast<Index>(brick_count(model)); ++brick) {
        if (const auto* ten = ten_nodes(model, brick))
            append_ten_node_faces(*ten, brick, faces);
        else
            append_faces(brick_nodes(model, brick), brick, faces);
    }
    std::vector<std::pair<Corners, Index>> keys(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
        keys[i] = {face_key(faces[i].nodes), static_cast<Index>(i)};
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i].first != keys[i - 1].first) continue;
        SolidFace& first = faces[keys[i - 1].second];
        SolidFace& second = faces[keys[i].second];
        first.neighbour = second.solid;
        second.neighbour = first.solid;
    }
    return faces;
}

} // namespace plash

#include "parser/outer_faces.h"

#include <algorithm>

namespace plash {
namespace {

using Face = std::array<Index, 4>;

/// Corners of the six faces of a hexahedron, normals outwards.
constexpr int hexahedron_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Those of a ten-node tetrahedron, four triangles a face.
constexpr int tetrahedron_faces[16][3] = {{0, 6, 4}, {2, 5, 6}, {1, 4, 5}, {6, 5, 4}, {0, 4, 7}, {1, 8, 4},
                                          {3, 7, 8}, {4, 8, 7}, {1, 5, 8}, {2, 9, 5}, {3, 8, 9}, {5, 9, 8},
                                          {2, 6, 9}, {0, 7, 6}, {3, 9, 7}, {6, 7, 9}};

/// The face without corners that repeat their neighbour; false when less than a triangle remains.
bool tidy(Face& face)
{
    Face kept{};
    int count = 0;
    for (int i = 0; i < 4; ++i)
        if (face[i] != face[(i + 1) % 4]) kept[count++] = face[i];
    if (count < 3) return false;
    if (count == 3) kept[3] = kept[2];
    face = kept;
    return true;
}

} // namespace

std::vector<Face> outer_faces(const Model& model, const std::vector<bool>& wanted)
{
    struct Entry {
        Face key; ///< sorted corners: the two solids at a face see the same ones
        Face face;
    };
    std::vector<Entry> entries;
    for (std::size_t solid = 0; solid < model.solids.size(); ++solid) {
        if (!wanted[solid]) continue;
        if (const auto* ten = ten_nodes(model, static_cast<Index>(solid))) {
            for (const auto& corners : tetrahedron_faces) {
                Face face;
                for (int i = 0; i < 4; ++i) face[i] = (*ten)[corners[std::min(i, 2)]];
                Entry entry{face, face};
                std::sort(entry.key.begin(), entry.key.end());
                entries.push_back(entry);
            }
            continue;
        }
        for (const auto& corners : hexahedron_faces) {
            Face face;
            for (int i = 0; i < 4; ++i) face[i] = model.solids.nodes[solid][corners[i]];
            if (!tidy(face)) continue;
            Entry entry{face, face};
            std::sort(entry.key.begin(), entry.key.end());
            entries.push_back(entry);
        }
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.key < b.key; });
    std::vector<Face> faces;
    for (std::size_t i = 0; i < entries.size();) {
        std::size_t end = i + 1;
        while (end < entries.size() && entries[end].key == entries[i].key) ++end;
        if (end == i + 1) faces.push_back(entries[i].face);
        i = end;
    }
    return faces;
}

} // namespace plash

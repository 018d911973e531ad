#include "ale/hex/hex_layout.h"

#include "core/parallel.h"

#include <algorithm>

namespace plash {

namespace {

void lay_out_nodes(HexLayout& layout, const HexMesh& mesh)
{
    const std::size_t nodes = padded(mesh.nodes() + 1);
    const auto nobody = static_cast<Index>(mesh.cells());
    layout.corner_count.resize(nodes, 1.0);
    for (std::size_t node = 0; node < mesh.nodes(); ++node) {
        const std::size_t begin = mesh.first_corner[node], end = mesh.first_corner[node + 1];
        layout.corner_count[node] = static_cast<double>(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            const Index cell = mesh.node_corner[i] / 8, corner = mesh.node_corner[i] % 8;
            // Its own number, unless another cell has that already.
            std::size_t column = corner;
            while (column < layout.corners.size() && layout.corners[column].cell.place[node] != nobody)
                column = std::max<std::size_t>(column + 1, 8);
            while (column >= layout.corners.size()) {
                HexLayout::Corner& added = layout.corners.emplace_back();
                added.cell.place.resize(mesh.nodes(), nobody);
                for (AlignedDoubles& component : added.area) component.resize(nodes, 0.0);
            }
            HexLayout::Corner& own = layout.corners[column];
            own.cell.place[node] = cell;
        }
    }
    for (HexLayout::Corner& corner : layout.corners) {
        corner.cell.place.resize(nodes, nobody);
        corner.cell.pad(nobody);
    }
}

/// Derivative of a cell's volume by one of its corners [length^2].
Vec3 corner_area(const HexMesh& mesh, std::size_t cell, int corner)
{
    const Index node = mesh.corners[cell][corner];
    Vec3 area{};
    for (int axis = 0; axis < 3; ++axis) {
        const int side = corner >> axis & 1;
        const HexFace& face = mesh.faces[mesh.cell_faces[cell][2 * axis + side]];
        const auto there = std::find(face.nodes.begin(), face.nodes.end(), node);
        area += (side == 1 ? 1.0 : -1.0) * face.area[there - face.nodes.begin()];
    }
    return area;
}

void lay_out_faces(HexLayout& layout, const HexMesh& mesh)
{
    for (int n = 0; n < 4; ++n) {
        for (const HexFace& face : mesh.faces) layout.face_nodes[n].place.push_back(face.nodes[n]);
        layout.face_nodes[n].pad(0);
    }
}

void lay_out_cells(HexLayout& layout, const HexMesh& mesh)
{
    const std::size_t cells = padded(mesh.cells() + 1);
    for (int side = 0; side < 6; ++side) {
        PlaceList &faces = layout.cell_faces[side], &neighbours = layout.neighbours[side];
        for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
            const Index number = mesh.cell_faces[cell][side];
            const Index next = side % 2 == 0 ? mesh.faces[number].below : mesh.faces[number].above;
            faces.place.push_back(number);
            neighbours.place.push_back(next == none ? static_cast<Index>(cell) : next);
        }
        faces.place.resize(cells, 0);
        faces.pad(0);
        neighbours.place.resize(cells, static_cast<Index>(mesh.cells()));
        neighbours.pad(0);
    }
    for (int corner = 0; corner < 8; ++corner) {
        for (std::size_t cell = 0; cell < mesh.cells(); ++cell)
            layout.cell_nodes[corner].place.push_back(mesh.corners[cell][corner]);
        layout.cell_nodes[corner].place.resize(cells, static_cast<Index>(mesh.nodes()));
        layout.cell_nodes[corner].pad(0);
    }
}

} // namespace

void HexLayout::close(const HexMesh& mesh, std::size_t number)
{
    const HexFace& face = mesh.faces[number];
    const Index cell = face.above == none ? face.below : face.above;
    const double outward = face.above == none ? 1 : -1;
    for (int n = 0; n < 4; ++n) {
        const Index node = face.nodes[n];
        const double area[3] = {face.area[n].x, face.area[n].y, face.area[n].z};
        const auto own = std::find_if(corners.begin(), corners.end(),
                                      [&](const Corner& corner) { return corner.cell.place[node] == cell; });
        for (int axis = 0; axis < 3; ++axis) {
            face_area[n][axis][number] = 0;
            outer_area[axis][node] -= outward * area[axis];
            own->area[axis][node] -= outward * area[axis];
        }
    }
}

HexLayout::HexLayout(const HexMesh& mesh)
{
    lay_out_nodes(*this, mesh);
    lay_out_faces(*this, mesh);
    lay_out_cells(*this, mesh);
    measure(mesh);
}

void HexLayout::measure(const HexMesh& mesh)
{
    const std::size_t nodes = padded(mesh.nodes() + 1), cells = padded(mesh.cells() + 1);
    for_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        for (Corner& column : corners) {
            for (std::size_t node = begin; node < end; ++node) {
                const Index cell = column.cell.place[node];
                if (cell == static_cast<Index>(mesh.cells())) continue;
                const HexCorners& own = mesh.corners[cell];
                const auto corner = std::find(own.begin(), own.end(), static_cast<Index>(node)) - own.begin();
                const Vec3 area = corner_area(mesh, cell, static_cast<int>(corner));
                column.area[0][node] = area.x;
                column.area[1][node] = area.y;
                column.area[2][node] = area.z;
            }
        }
    });
    for (AlignedDoubles& component : outer_area) component.assign(nodes, 0.0);
    for (int n = 0; n < 4; ++n)
        for (AlignedDoubles& component : face_area[n]) component.assign(padded(mesh.faces.size()), 0.0);
    for_chunks(mesh.faces.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (int n = 0; n < 4; ++n)
                for (int axis = 0; axis < 3; ++axis)
                    face_area[n][axis][i] = mesh.faces[i].area[n].*vector_component[axis];
    });
    for (const HexFace& face : mesh.faces) {
        if (face.below != none && face.above != none) continue;
        const double outward = face.above == none ? 1 : -1;
        for (int n = 0; n < 4; ++n)
            for (int axis = 0; axis < 3; ++axis)
                outer_area[axis][face.nodes[n]] += outward * face.area[n].*vector_component[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
        width[axis].assign(cells, 1.0);
        for (std::size_t cell = 0; cell < mesh.cells(); ++cell) width[axis][cell] = mesh.width[cell][axis];
    }
}

} // namespace plash

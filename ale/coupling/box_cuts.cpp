#include "ale/coupling/box_cuts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace plash {

namespace {

double along_axis(const Vec3& v, int axis)
{
    return v.*vector_component[axis];
}

} // namespace

BoxCuts::BoxCuts(const BoxGrid& grid, int axis)
    : axes_{(axis + 1) % 3, (axis + 2) % 3, axis},
      cells_along_{grid.cells(axes_[0]), grid.cells(axes_[1]), grid.cells(axes_[2])},
      stride_{grid.stride(axes_[0]), grid.stride(axes_[1]), grid.stride(axes_[2])},
      origin_(grid.at(0, 0, 0)),
      cell_entry_(grid.storage(), none),
      edge_entry_(grid.storage(), none),
      cell_columns_(column(0, cells_along_[1] + 1), {0, 0}),
      edge_columns_(cell_columns_)
{
    for (auto& entry : face_entry_) entry.assign(grid.storage(), none);
}

void BoxCuts::clear()
{
    for (const CellSum& sum : cell_sums_) {
        cell_entry_[at(sum.index[0], sum.index[1], sum.index[2])] = none;
        cell_columns_[column(sum.index[0], sum.index[1])] = {0, 0};
    }
    for (const EdgeSum& sum : edge_sums_) {
        edge_entry_[at(sum.index[0], sum.index[1], sum.index[2])] = none;
        edge_columns_[column(sum.index[0], sum.index[1])] = {0, 0};
    }
    for (int axis = 0; axis < 2; ++axis) {
        for (const FaceSum& sum : face_sums_[axis]) face_entry_[axis][sum.place] = none;
        face_sums_[axis].clear();
    }
    cell_sums_.clear();
    edge_sums_.clear();
    cells_.clear();
    pieces_.clear();
    found_.clear();
}

/// Surfaces often stand on planes of the mesh and end at its sides. Planes a little beside those of the grid,
/// the outermost a little within it, have neither, and what that changes is far below all other errors.
void BoxCuts::place_planes(const BoxGrid& grid)
{
    constexpr double offset[3] = {1.0e-7, 1.37e-7, 1.71e-7};
    for (int axis = 0; axis < 3; ++axis) {
        planes_[axis] = grid.planes(axes_[axis]);
        const double step = offset[axis] * grid.smallest_width(axes_[axis]);
        for (double& plane : planes_[axis]) plane += step;
        planes_[axis].back() -= 2 * step;
    }
}

void BoxCuts::find(const BoxGrid& grid, std::span<const SurfaceTriangle> triangles)
{
    clear();
    place_planes(grid);
    for (std::size_t number = 0; number < triangles.size(); ++number) {
        std::array<Vec3, 3> corner;
        for (int n = 0; n < 3; ++n) corner[n] = turned(triangles[number].corner[n]);
        Polygon polygon;
        polygon.count = 3;
        std::copy(corner.begin(), corner.end(), polygon.corner.begin());
        const Vec3 area = cross(corner[1] - corner[0], corner[2] - corner[0]);
        if (!(norm(area) > 0)) continue;
        std::array<int, 3> index{};
        cut(polygon, 0, index, static_cast<Index>(number), unit(area));
    }
    sort_columns();
    find_open_cells();
}

/// Cuts a polygon between the planes across one axis after the other (Sutherland & Hodgman 1974, Commun. ACM
/// 17, 32-42). Corners on a plane have exactly its coordinate.
void BoxCuts::cut(const Polygon& polygon, int axis, std::array<int, 3>& index, Index triangle,
                  const Vec3& normal)
{
    if (axis == 3) return add_piece(polygon, index, triangle, normal);
    const std::vector<double>& planes = planes_[axis];
    double low = along_axis(polygon.corner[0], axis), high = low;
    for (int n = 1; n < polygon.count; ++n) {
        low = std::min(low, along_axis(polygon.corner[n], axis));
        high = std::max(high, along_axis(polygon.corner[n], axis));
    }
    if (high <= planes.front() || low >= planes.back()) return;
    const auto clip = [&](const Polygon& from, double plane, double sign) {
        Polygon to;
        for (int n = 0; n < from.count; ++n) {
            const Vec3 &a = from.corner[n], &b = from.corner[(n + 1) % from.count];
            const double at_a = sign * (along_axis(a, axis) - plane),
                         at_b = sign * (along_axis(b, axis) - plane);
            if (at_a >= 0) to.corner[to.count++] = a;
            if ((at_a >= 0) == (at_b >= 0)) continue;
            Vec3 on = a + (at_a / (at_a - at_b)) * (b - a);
            on.*vector_component[axis] = plane;
            to.corner[to.count++] = on;
        }
        return to;
    };
    const auto first = std::upper_bound(planes.begin(), planes.end(), low) - planes.begin() - 1;
    for (int cell = std::max(static_cast<int>(first), 0); cell < cells_along_[axis] && planes[cell] < high;
         ++cell) {
        Polygon part = polygon;
        if (low < planes[cell]) part = clip(part, planes[cell], 1);
        if (part.count >= 3 && high > planes[cell + 1]) part = clip(part, planes[cell + 1], -1);
        if (part.count < 3) continue;
        index[axis] = cell;
        cut(part, axis + 1, index, triangle, normal);
    }
}

void BoxCuts::add_piece(const Polygon& polygon, const std::array<int, 3>& index, Index triangle,
                        const Vec3& normal)
{
    Piece piece{triangle, {}, {}, {}};
    double size = 0;
    const Vec3& from = polygon.corner[0];
    for (int n = 1; n + 1 < polygon.count; ++n) {
        const Vec3 b = polygon.corner[n] - from, c = polygon.corner[n + 1] - from;
        const Vec3 area = 0.5 * cross(b, c);
        const double share = dot(area, normal);
        piece.area += area;
        piece.middle += (share / 3) * (b + c);
        piece.spread = piece.spread + dyad((share / 12) * b, b) + dyad((share / 12) * c, c) +
                       dyad((share / 12) * (b + c), b + c);
        size += share;
    }
    const auto [i, j, k] = index;
    if (size > 0) {
        piece.middle = (1 / size) * piece.middle;
        for (Vec3& row : piece.spread.row) row = (1 / size) * row;
        piece.spread = piece.spread + dyad(-piece.middle, piece.middle);
        piece.middle += from;
        Index& entry = cell_entry_[at(i, j, k)];
        if (entry == none) {
            entry = static_cast<Index>(cell_sums_.size());
            cell_sums_.push_back({index});
        }
        CellSum& sum = cell_sums_[entry];
        const auto width = [&](int axis) {
            return planes_[axis][index[axis] + 1] - planes_[axis][index[axis]];
        };
        const double across = piece.area.z / (width(0) * width(1));
        sum.across += across;
        sum.times_rest += across * (1 - part(2, k, piece.middle.z));
        sum.moment[0] += across * part(0, i, piece.middle.x);
        sum.moment[1] += across * part(1, j, piece.middle.y);
        found_.push_back({at(i, j, k), piece});
    }
    // Faces belong to the cell above them, those of the upper sides of the box to ghosts.
    for (int n = 0; n < polygon.count; ++n) {
        const Vec3 &a = polygon.corner[n], &b = polygon.corner[(n + 1) % polygon.count];
        for (int axis = 0; axis < 2; ++axis) {
            for (int side = 0; side < 2; ++side) {
                if (side == 1 && index[axis] + 1 < cells_along_[axis]) continue;
                const double plane = planes_[axis][index[axis] + side];
                if (along_axis(a, axis) != plane || along_axis(b, axis) != plane) continue;
                std::array<int, 3> face = index;
                face[axis] += side;
                add_segment(axis, face, a, b, normal);
            }
        }
        for (int edge = 0; edge < 4; ++edge) {
            const int up[2] = {edge & 1, edge >> 1};
            std::array<int, 3> place = index;
            bool on = true;
            for (int axis = 0; axis < 2; ++axis) {
                on = on && !(up[axis] == 1 && index[axis] + 1 < cells_along_[axis]) &&
                     along_axis(a, axis) == planes_[axis][index[axis] + up[axis]];
                place[axis] += up[axis];
            }
            if (on) add_crossing(place, a, normal);
        }
    }
}

/// A segment in a face across the first or second axis, as a jump of what is open along the other of these.
void BoxCuts::add_segment(int axis, std::array<int, 3> index, const Vec3& a, const Vec3& b,
                          const Vec3& normal)
{
    const int other = 1 - axis;
    const double da = along_axis(b, other) - along_axis(a, other), dz = b.z - a.z;
    const double sign = dz * along_axis(normal, other) - da * normal.z > 0 ? 1 : -1;
    const double ya = part(other, index[other], along_axis(a, other)),
                 yb = part(other, index[other], along_axis(b, other)), za = part(2, index[2], a.z),
                 zb = part(2, index[2], b.z);
    const double jump = sign * (zb - za);
    const std::ptrdiff_t place = at(index[0], index[1], index[2]);
    Index& entry = face_entry_[axis][place];
    if (entry == none) {
        entry = static_cast<Index>(face_sums_[axis].size());
        face_sums_[axis].push_back({place});
    }
    FaceSum& sum = face_sums_[axis][entry];
    const double square = (ya * ya + ya * yb + yb * yb) / 3;
    const double product = (2 * ya * za + ya * zb + yb * za + 2 * yb * zb) / 6;
    sum.area += jump * (1 - 0.5 * (ya + yb));
    sum.moment[0] += jump * 0.5 * (1 - square);
    sum.moment[1] += jump * (0.5 * (za + zb) - product);
}

void BoxCuts::add_crossing(std::array<int, 3> index, const Vec3& point, const Vec3& normal)
{
    Index& entry = edge_entry_[at(index[0], index[1], index[2])];
    if (entry == none) {
        entry = static_cast<Index>(edge_sums_.size());
        edge_sums_.push_back({index});
    }
    EdgeSum& sum = edge_sums_[entry];
    const double step = normal.z > 0 ? 1 : -1, z = part(2, index[2], point.z);
    sum.step += step;
    sum.length += step * (1 - z);
    sum.moment += step * 0.5 * (1 - z * z);
}

void BoxCuts::sort_columns()
{
    const auto upward = [](const auto& a, const auto& b) {
        return std::tie(a.index[1], a.index[0], a.index[2]) < std::tie(b.index[1], b.index[0], b.index[2]);
    };
    const auto sort = [&](auto& sums, auto& columns, std::vector<Index>& entry) {
        std::sort(sums.begin(), sums.end(), upward);
        for (std::size_t n = 0; n < sums.size(); ++n) {
            const auto& index = sums[n].index;
            entry[at(index[0], index[1], index[2])] = static_cast<Index>(n);
            auto& [first, end] = columns[column(index[0], index[1])];
            if (end == 0) first = static_cast<Index>(n);
            end = static_cast<Index>(n + 1);
        }
    };
    sort(cell_sums_, cell_columns_, cell_entry_);
    sort(edge_sums_, edge_columns_, edge_entry_);
    if (!edge_sums_.empty()) start_ = edge_sums_.front().step < 0 ? 1 : 0;
    std::stable_sort(found_.begin(), found_.end(),
                     [](const LocatedPiece& a, const LocatedPiece& b) { return a.place < b.place; });
}

/// At the lower end of a cell.
BoxCuts::Level BoxCuts::level(int i, int j, int k) const
{
    Level level{start_, {0.5 * start_, 0.5 * start_}};
    const auto [first, end] = cell_columns_[column(i, j)];
    for (Index n = first; n < end && cell_sums_[n].index[2] < k; ++n) {
        level.open += cell_sums_[n].across;
        for (int axis = 0; axis < 2; ++axis) level.moment[axis] += cell_sums_[n].moment[axis];
    }
    return level;
}

bool BoxCuts::node_of(const std::array<int, 3>& index) const
{
    const auto [i, j, k] = index;
    double open = start_;
    const auto [first, end] = edge_columns_[column(i, j)];
    for (Index n = first; n < end && edge_sums_[n].index[2] < k; ++n) open += edge_sums_[n].step;
    return open > 0.5;
}

double BoxCuts::share_of(const std::array<int, 3>& index) const
{
    const auto [i, j, k] = index;
    double open = level(i, j, k).open;
    const Index entry = cell_entry_[at(i, j, k)];
    if (entry != none) open += cell_sums_[entry].times_rest;
    return open < 1e-9 ? 0 : std::min(open, 1.0);
}

BoxCuts::Face BoxCuts::face(int axis, int i, int j, int k) const
{
    const int own = static_cast<int>(std::find(axes_.begin(), axes_.end(), axis) - axes_.begin());
    Face face = face_of(own, turned(std::array{i, j, k}));
    const int a = own == 0 ? 1 : 0, b = own == 2 ? 1 : 2;
    if (axes_[a] > axes_[b]) std::swap(face.middle[0], face.middle[1]);
    return face;
}

BoxCuts::Face BoxCuts::face_of(int axis, const std::array<int, 3>& index) const
{
    const auto [i, j, k] = index;
    double open;
    std::array<double, 2> moment;
    if (axis == 2) {
        const Level below = level(i, j, k);
        open = below.open;
        moment = below.moment;
    } else {
        const double node = node_of(index) ? 1 : 0;
        open = node;
        moment = {0.5 * node, 0.5 * node};
        if (const Index entry = edge_entry_[at(i, j, k)]; entry != none) {
            open += edge_sums_[entry].length;
            moment[0] = 0.5 * open;
            moment[1] += edge_sums_[entry].moment;
        }
        if (const Index entry = face_entry_[axis][at(i, j, k)]; entry != none) {
            const FaceSum& sum = face_sums_[axis][entry];
            open += sum.area;
            for (int n = 0; n < 2; ++n) moment[n] += sum.moment[n];
        }
    }
    if (open < 1e-9) return {0, {0.5, 0.5}};
    Face face{std::min(open, 1.0), {}};
    for (int n = 0; n < 2; ++n) face.middle[n] = std::clamp(moment[n] / open, 0.0, 1.0);
    return face;
}

Vec3 BoxCuts::gap(const Cell& cell) const
{
    Vec3 sum{};
    for (const Piece& piece : pieces(cell)) sum += turned(piece.area);
    const std::array<int, 3> index = turned(cell.index);
    const auto width = [&](int axis) { return planes_[axis][index[axis] + 1] - planes_[axis][index[axis]]; };
    Vec3 gap;
    for (int axis = 0; axis < 3; ++axis) {
        std::array<int, 3> above = index;
        ++above[axis];
        const double area = width((axis + 1) % 3) * width((axis + 2) % 3);
        gap.*vector_component[axis] =
            face_of(axis, above).open - face_of(axis, index).open - along_axis(sum, axis) / area;
    }
    return turned_back(gap);
}

void BoxCuts::find_open_cells()
{
    for (std::size_t n = 0; n < found_.size(); ++n) {
        if (n == 0 || found_[n].place != found_[n - 1].place) {
            const auto index = cell_sums_[cell_entry_[found_[n].place]].index;
            std::array<int, 3> back;
            for (int axis = 0; axis < 3; ++axis) back[axes_[axis]] = index[axis];
            cells_.push_back({back, share_of(index), n, n});
        }
        cells_.back().last = n + 1;
        const Piece& piece = found_[n].piece;
        pieces_.push_back(
            {piece.triangle, turned_back(piece.area), turned_back(piece.middle), turned_back(piece.spread)});
    }
}

} // namespace plash

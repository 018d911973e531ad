#pragma once

#include "ale/box_grid.h"
#include "math/matrix3.h"
#include "model/record.h"

#include <span>

namespace plash {

/// A triangle of a surface; its normal by the order of the corners points into the fluid.
struct SurfaceTriangle {
    std::array<Vec3, 3> corner; ///< [length]
};

/// What a closed surface leaves open of the cells of a box: shares of their volumes and of their faces.
///
/// All shares are sums over the pieces of the triangles in the cells (divergence theorem), the segments in
/// which they cut the faces and the points in which they cut the edges, so that they are exact for the
/// triangles, the same for both cells of a face, and continuous as the surface moves; faces and pieces of a
/// cell close to round-off. Only what the surface cuts is visited. Edges along one axis and faces across it
/// are followed from the lower side of the box on, all of which lies on one side of the surface.
///
/// Inside, axes are turned so that this is the third.
class BoxCuts {
public:
    struct Piece {
        Index triangle;
        Vec3 area;      ///< along the normal [length^2]
        Vec3 middle;    ///< [length]
        Matrix3 spread; ///< mean of (x - middle) (x - middle)^T over it [length^2]
    };
    struct Cell {
        std::array<int, 3> index;
        double open;           ///< share of the volume
        std::size_t first = 0; ///< of its pieces
        std::size_t last = 0;
    };
    /// Open share of a face and its middle in the face, 0 to 1 along the two other axes in rising order.
    struct Face {
        double open = 1;
        std::array<double, 2> middle{0.5, 0.5};
    };

    /// axis  along which edges are followed
    explicit BoxCuts(const BoxGrid& grid, int axis = 2);

    void find(const BoxGrid& grid, std::span<const SurfaceTriangle> triangles);

    /// The cells in which there are pieces, by rising place.
    const std::vector<Cell>& cells() const { return cells_; }
    std::span<const Piece> pieces(const Cell& cell) const
    {
        return std::span(pieces_).subspan(cell.first, cell.last - cell.first);
    }
    /// Of any cell.
    double open_share(int i, int j, int k) const { return share_of(turned(std::array{i, j, k})); }
    /// The lower face of a cell across an axis; the index may be that of the ghost at the upper end.
    Face face(int axis, int i, int j, int k) const;
    bool node_open(int i, int j, int k) const { return node_of(turned(std::array{i, j, k})); }
    /// What the faces and pieces of a cell miss of closing along each axis, in areas of its faces: nothing
    /// where the surface is closed.
    Vec3 gap(const Cell& cell) const;

private:
    struct CellSum {
        std::array<int, 3> index;
        double across = 0;              ///< area along the third axis over that of the face
        double times_rest = 0;          ///< times what is above it in the cell
        std::array<double, 2> moment{}; ///< times its places along the first and second axis
    };
    struct FaceSum {
        std::ptrdiff_t place;
        double area = 0;
        std::array<double, 2> moment{};
    };
    struct EdgeSum {
        std::array<int, 3> index;
        double step = 0, length = 0, moment = 0;
    };
    struct LocatedPiece {
        std::ptrdiff_t place;
        Piece piece;
    };
    struct Polygon {
        int count = 0;
        std::array<Vec3, 12> corner;
    };
    /// Of a column, at the lower end of one of its cells: shares and moments.
    struct Level {
        double open;
        std::array<double, 2> moment;
    };

    std::array<int, 3> axes_; ///< of the box, in turned order
    std::array<int, 3> cells_along_;
    std::array<std::vector<double>, 3> planes_; ///< a little beside those of the grid
    std::array<std::ptrdiff_t, 3> stride_;
    std::ptrdiff_t origin_;
    double start_ = 1; ///< share that is open at the lower side
    std::vector<Cell> cells_;
    std::vector<Piece> pieces_;
    std::vector<LocatedPiece> found_;
    std::vector<CellSum> cell_sums_; ///< by column, upward
    std::vector<EdgeSum> edge_sums_;
    std::array<std::vector<FaceSum>, 2> face_sums_;
    std::vector<Index> cell_entry_, edge_entry_;
    std::array<std::vector<Index>, 2> face_entry_;
    std::vector<std::pair<Index, Index>> cell_columns_, edge_columns_; ///< first and end of their sums

    std::ptrdiff_t at(int i, int j, int k) const
    {
        return origin_ + i * stride_[0] + j * stride_[1] + k * stride_[2];
    }
    std::size_t column(int i, int j) const { return i + std::size_t(cells_along_[0] + 1) * j; }
    std::array<int, 3> turned(const std::array<int, 3>& index) const
    {
        return {index[axes_[0]], index[axes_[1]], index[axes_[2]]};
    }
    Vec3 turned(const Vec3& v) const
    {
        return {v.*vector_component[axes_[0]], v.*vector_component[axes_[1]], v.*vector_component[axes_[2]]};
    }
    Vec3 turned_back(const Vec3& v) const
    {
        Vec3 back;
        for (int n = 0; n < 3; ++n) back.*vector_component[axes_[n]] = v.*vector_component[n];
        return back;
    }
    Matrix3 turned_back(const Matrix3& m) const
    {
        Matrix3 back;
        for (int n = 0; n < 3; ++n) back.row[axes_[n]] = turned_back(m.row[n]);
        return back;
    }
    double share_of(const std::array<int, 3>& index) const;
    Face face_of(int axis, const std::array<int, 3>& index) const;
    bool node_of(const std::array<int, 3>& index) const;
    void clear();
    void place_planes(const BoxGrid& grid);
    void cut(const Polygon& polygon, int axis, std::array<int, 3>& index, Index triangle, const Vec3& normal);
    void add_piece(const Polygon& polygon, const std::array<int, 3>& index, Index triangle,
                   const Vec3& normal);
    void add_segment(int axis, std::array<int, 3> index, const Vec3& a, const Vec3& b, const Vec3& normal);
    void add_crossing(std::array<int, 3> index, const Vec3& point, const Vec3& normal);
    double part(int axis, int cell, double place) const
    {
        return (place - planes_[axis][cell]) / (planes_[axis][cell + 1] - planes_[axis][cell]);
    }
    Level level(int i, int j, int k) const;
    void sort_columns();
    void find_open_cells();
};

} // namespace plash

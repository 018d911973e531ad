#pragma once

#include "ale/fluid.h"

namespace plash {

/// Sum of the fractions of these fluids (bit g for fluid g) in a cell.
double filled_share(const Fluid& fluid, std::ptrdiff_t place, unsigned fluids);

/// Finds the faces behind a coupled surface through which its fluid may not leave the cells that the surface
/// cuts. Penalty springs hold the fluid at the surface itself, between the nodes of the cut cell; its nodes
/// behind the surface are held through their share of the springs alone, and whatever they move carries fluid
/// out of the cell. What has left would be behind the surface for ever.
///
/// A face is dry when all of it lies behind the plane through a point of the surface near by. Where it lies
/// before the plane of another point, the surface decides: around an inner corner of the fluid (points stand
/// before one another's planes) one plane is enough, around an outer one both must have the face behind them.
/// The cell beyond must be emptier than the cut one: where fluid stands on both sides of a surface, nothing
/// can be told from fractions.
class DryFaces {
public:
    explicit DryFaces(const Fluid& fluid) : entry_(fluid.fields.volume.size(), none) {}

    /// A point of the surface.
    struct Point {
        MeshPoint place;
        Vec3 position; ///< [length]
        Vec3 normal;   ///< unit, into the fluid
    };
    /// Adds the dry faces of a surface to those of the fluid's coming step.
    /// fluids  bit g for fluid g
    void find(Fluid& fluid, const std::vector<Point>& points, unsigned fluids);

private:
    struct Cell {
        std::ptrdiff_t place = 0;
        Vec3 origin; ///< the corner where all its axes begin [length]
        std::array<Vec3, 3> edges;
        std::array<bool, 6> open{}; ///< faces beyond which stands a cell that is emptier: 2 axis + side
        std::vector<const Point*> near;
    };
    std::vector<Index> entry_; ///< of each cell in cells_, by storage place
    std::vector<Cell> cells_;  ///< the first count_ of them; the others keep their memory
    std::size_t count_ = 0;

    void add_cell(const Fluid& fluid, const Point& point, unsigned fluids);
    void add_to(std::ptrdiff_t place, const Point& point);
};

} // namespace plash

#pragma once

#include "ale/coupling/dry_faces.h"

#include <optional>

namespace plash {

/// How far the interface of a coupled fluid stands behind the surface, from what fills the cells there. The
/// springs of a coupling know its sum over time alone, in which any error stays for ever: fluid that has
/// crept behind the floor of a floating body weighs on it like ballast.
///
/// Looked at are three cells in a row across the surface: the one of the point, the one before it, which must
/// be full, and the one behind, in the row that the normal is closest to. They hold as much as lies before
/// the planes through the points in them, or what more they hold is behind the surface. Along an edge of the
/// structure planes meet in a cell; they bound a structure that lies behind all of them (an outer corner of
/// the fluid) or behind any.
class InterfaceDepth {
public:
    struct Spring {
        double area = 0;      ///< [length^2]
        double stiffness = 0; ///< [force/length]
        double depth = 0;     ///< [length]
        double at_rest = 0;   ///< how much deeper than even_depth() it was at rest [length]
    };

    explicit InterfaceDepth(const Fluid& fluid) : entry_(fluid.fields.volume.size(), none) {}

    /// Collects the planes of the surface in the cells that are looked at for some of its points. The points
    /// must outlive what follows.
    /// asking  numbers of the points at which behind() will be asked
    void collect(const Fluid& fluid, const std::vector<DryFaces::Point>& points,
                 const std::vector<Index>& asking, unsigned fluids);
    /// Mean depth of the springs in a cell that one plane passes [length].
    std::optional<double> mean_depth(std::ptrdiff_t place) const;
    /// Takes the spring of a point into account. After collect().
    void count(const Fluid& fluid, const DryFaces::Point& point, const Spring& spring);
    /// Depth of the springs of one plane in the cell of a point, each by its stiffness: all of them as deep
    /// as that press as hard as they do, and hold no more energy [length].
    std::optional<double> even_depth(const Fluid& fluid, const DryFaces::Point& point) const;
    /// How much further the interface stands behind than the springs in the cell of the point know, all
    /// planes taken together: a cell along an edge of the structure does not tell which of them its fluid
    /// stands behind. Negative where it stands less far [length]; nothing where the cells do not tell.
    /// fluids  bit g for fluid g
    std::optional<double> unknown(const Fluid& fluid, const DryFaces::Point& point, unsigned fluids) const;

private:
    static constexpr int most_planes = 3;
    struct Cell {
        std::array<const DryFaces::Point*, most_planes> planes{};
        int count = 0;     ///< of planes; more than fit: most_planes + 1
        double before = 0; ///< share of the cell that lies before the surface; negative: unknown
        std::array<double, most_planes> area{};      ///< of the springs of each plane [length^2]
        std::array<double, most_planes> stiffness{}; ///< of those [force/length]
        std::array<double, most_planes>
            pressing{};   ///< of those, without what they are uneven at rest [force]
        double swept = 0; ///< sum of depth times area of all springs [length^3]
    };
    std::vector<Index> entry_; ///< of each cell in cells_, by storage place
    std::vector<std::ptrdiff_t> places_;
    std::vector<Cell> cells_;

    void need(std::ptrdiff_t place);
    std::optional<double> behind(const Fluid& fluid, const DryFaces::Point& point, unsigned fluids) const;
    static int plane_of(const Cell& cell, const Vec3& normal);
    const Cell* cell_at(std::ptrdiff_t place) const
    {
        return place < 0 || entry_[place] == none ? nullptr : &cells_[entry_[place]];
    }
};

/// How far one can go along a direction through a cell, of a box its width there [length].
double length_along(const std::array<Vec3, 3>& edges, const Vec3& direction);

/// Share of a cell that lies before the plane through a point in it.
double share_before_plane(const std::array<Vec3, 3>& edges, const std::array<double, 3>& part,
                          const Vec3& normal);

} // namespace plash

#pragma once

#include "core/state.h"
#include "model/model.h"

#include <vector>

namespace plash {

/// *DEFINE_SPH_ACTIVE_REGION: particles are computed between an inner and an outer surface that may go along
/// with a node. Others are asleep: they stand still, keep their pressure, and the awake ones see them as
/// neighbours, so that water does not run out of the region.
struct ActiveRegion {
    enum class Shape { box, cylinder, sphere };
    Shape shape = Shape::box;
    std::vector<Index> parts; ///< of the Model, that it is for
    Index node = none;        ///< that it follows; none: it stands
    Box inner{}, outer{};     ///< boxes
    Vec3 centre{}, axis{};    ///< cylinder: foot and unit axis; sphere: centre
    double least_radius = 0, largest_radius = 0;
    double least_height = 0, largest_height = 0; ///< cylinder: along the axis [length]

    /// Where a followed node has gone since the start.
    Vec3 travelled(const State& state, const std::vector<Vec3>& start) const
    {
        return node == none ? Vec3{} : state.position[node] - start[node];
    }

    /// Whether a particle at `position` is awake when the region has travelled so far.
    bool holds(const Vec3& position, const Vec3& travelled) const;
};

/// The regions of a Model. DeckError where a field makes no sense.
std::vector<ActiveRegion> active_regions_of(const Model& model);

} // namespace plash

#pragma once

#include "solver/fluids/mesh_planes.h"

#include <algorithm>
#include <map>
#include <type_traits>
#include <utility>

namespace plash {

/// What stands in the place of the old water.
struct NewWater {
    std::map<Index, std::vector<Index>> nodes; ///< by part that was water before: nodes of the new water
    std::vector<Index> mesh_parts;             ///< of an Eulerian mesh
    double spacing = 0;                        ///< of new particles [length]
    std::vector<std::string> lines;            ///< for the user
};

/// A number that no definition of a list has, nor any of these nodes or elements.
template <class List>
Id free_id(const List& list)
{
    Id largest = 0;
    for (const auto& entry : list) {
        if constexpr (std::is_same_v<typename List::value_type, Id>)
            largest = std::max(largest, entry);
        else
            largest = std::max(largest, entry.id);
    }
    return largest + 1;
}

/// A definition that the translation writes into the Model.
Record made_record(std::string_view keyword, Location where,
                   std::initializer_list<std::pair<const char*, double>> values);

/// An Eulerian mesh between planes that holds all water; cells that are not full of one fluid carry their
/// fractions (*INITIAL_VOLUME_FRACTION), all others start full or empty. Walls hold the nodes of its sides.
NewWater make_mesh_water(Model& model, const Water& water, const std::vector<WaterWall>& walls,
                         const MeshPlanes& planes);

/// Particles of the given spacing in the pieces of the marked parts; spacing 0: one in the middle of each
/// piece. Walls become symmetry planes.
NewWater make_particle_water(Model& model, const Water& water, const std::vector<bool>& changed,
                             const std::vector<WaterWall>& walls, double spacing);

/// A solid for each piece of the marked parts. Walls hold the nodes in their planes.
NewWater make_solid_water(Model& model, const Water& water, const std::vector<bool>& changed,
                          const std::vector<WaterWall>& walls);

} // namespace plash

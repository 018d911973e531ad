#pragma once

#include "model/model.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace plash {

/// What a d3plot database of a Model holds and in which order (LSTC, 'LS-DYNA Database Binary Output Files',
/// 2017). Readers search numbers, so nodes, elements and parts are sorted by their numbers.
struct D3plotLayout {
    /// Indices into the Model in the order of the database.
    std::vector<Index> nodes, solids, beams, shells, thick_shells, parts;
    std::vector<Index> particles; ///< by the numbers of their nodes

    int layers = 3;                  ///< MAXINT: through-thickness points of shells
    int beam_points = 0;             ///< BEAMIP: integration points of beams
    bool shell_stress = true;        ///< SIGFLG
    bool shell_strain = true;        ///< EPSFLG: plastic strain
    bool shell_forces = true;        ///< RLTFLG: resultants
    bool shell_extra = true;         ///< ENGFLG: thickness, internal energy
    int solid_variables = 0;         ///< NEIPH: history variables of solids, without those of Eulerian cells
    int shell_variables = 0;         ///< NEIPS: of each point of shells
    bool strains = false;            ///< STRFLG: one tensor for solids, two for shells and thick shells
    bool one_state_per_file = false; ///< IEVERP
    std::size_t walls = 0;
    /// Groups of an Eulerian mesh; with one, solids carry density and the share of each group as history
    /// variables, as LS-DYNA's ALE elements do. 0: no such mesh.
    std::size_t fluid_groups = 0;

    /// Place (from 1) of each node of the Model in the database.
    std::vector<std::uint32_t> node_places() const;

    /// Takes *DATABASE_EXTENT_BINARY into account.
    explicit D3plotLayout(const Model&);

    std::size_t global_words() const { return 6 + 7 * parts.size() + 4 * walls; }
    /// Those of Eulerian cells come first, at the numbers 1, 2 ... as in LS-DYNA.
    std::size_t solid_history() const
    {
        return std::max<std::size_t>(solid_variables, fluid_groups > 0 ? 1 + fluid_groups : 0);
    }
    std::size_t solid_words() const { return 7 + solid_history() + 6 * strains; }
    /// Of a point of a shell or thick shell: stress, plastic strain, history.
    std::size_t point_words() const { return 6 * shell_stress + shell_strain + shell_variables; }
    /// Resultants; shear stresses rs and tr, axial stress, plastic strain and axial strain of each point.
    std::size_t beam_words() const { return 6 + 5 * static_cast<std::size_t>(beam_points); }
    std::size_t thick_shell_words() const { return layers * point_words() + 12 * strains; }
    std::size_t shell_words() const
    {
        return layers * point_words() + 8 * shell_forces + 4 * shell_extra + 12 * strains;
    }
    /// Part; h, pressure, six stresses, strain, density, energy, neighbours, mass.
    std::size_t particle_words() const { return 14; }
    /// Words of a state after its time: globals; coordinates, velocities and accelerations; elements; which
    /// elements are left; particles.
    std::size_t state_words() const
    {
        return global_words() + 9 * nodes.size() + solid_words() * solids.size() +
               beam_words() * beams.size() + shell_words() * shells.size() +
               thick_shell_words() * thick_shells.size() + solids.size() + shells.size() + beams.size() +
               thick_shells.size() + particle_words() * particles.size();
    }
};

/// The 64 words that every reader starts from.
std::vector<std::uint32_t> d3plot_control(const Model&, const D3plotLayout&);

/// Appends coordinates, connectivities and numbers.
void put_mesh(std::vector<std::uint32_t>& words, const Model&, const D3plotLayout&);

/// Everything before the states: control block, coordinates and connectivities, numbers, titles.
std::vector<std::uint32_t> d3plot_geometry(const Model&, const D3plotLayout&);

} // namespace plash

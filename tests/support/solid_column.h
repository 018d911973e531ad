#pragma once

#include "solver/scene.h"
#include "tests/support/solid_block.h"

/// Plane waves in a column of solids.
namespace plash::testing {

/// A column of cells along x whose nodes move along x only.
struct Column : SolidBlock {
    Column(int cells, double length, Record fluid, Record eos)
        : SolidBlock({cells, 1, 1}, {length, length / cells, length / cells}, std::move(fluid))
    {
        model.equations_of_state.push_back(std::move(eos));
        model.parts[0].equation_of_state = 0;
        FixedNodes sideways;
        for (std::size_t n = 0; n < model.nodes.size(); ++n) sideways.nodes.push_back(static_cast<Index>(n));
        sideways.freedoms = 2 | 4;
        model.fixed_nodes.push_back(sideways);
    }

    /// Holds or drives the nodes of one end along x.
    void drive(int layer, double velocity)
    {
        model.curves.push_back({1, "", {}, {{0, 1e9}, {1, 1}}});
        PrescribedMotion motion;
        for (int k = 0; k <= 1; ++k)
            for (int j = 0; j <= 1; ++j) motion.nodes.push_back(node(layer, j, k));
        motion.direction = {1, 0, 0};
        motion.curve = 0;
        motion.scale = velocity;
        model.prescribed_motions.push_back(motion);
    }
};

/// State along a column.
struct Profile {
    std::vector<double> place, density, pressure, velocity; ///< by cell
    double balance = 0;
    double viscous = 0;
};

/// Of the cells of a column, at the end of a run.
inline Profile profile_of(const Column& column, Scene& scene, double reference_density)
{
    ElementResults results;
    results.solid_stress.resize(column.model.solids.size());
    for (const auto& term : scene.terms) term->collect(scene.state, results);
    Profile profile;
    const double start = column.model.nodes.position[1].x - column.model.nodes.position[0].x;
    for (int i = 0; i < column.count[0]; ++i) {
        const double left = scene.state.position[i].x, right = scene.state.position[i + 1].x;
        profile.place.push_back(0.5 * (left + right));
        profile.density.push_back(reference_density * start / (right - left));
        profile.pressure.push_back(-trace(results.solid_stress[i]) / 3);
        profile.velocity.push_back(0.5 * (scene.state.velocity[i].x + scene.state.velocity[i + 1].x));
    }
    profile.balance = scene.ledger.balance_error();
    profile.viscous = scene.ledger.bulk_viscosity;
    return profile;
}

} // namespace plash::testing

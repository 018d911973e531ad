#pragma once

#include "elements/thick_shell_groups.h"
#include "tests/support/bare_state.h"
#include "tests/support/solid_block.h"

/// Small meshes of thick shells for tests.
namespace plash::testing {

/// Turns the solids of a Model into thick shells with the given section.
inline void make_thick(Model& model, Record section)
{
    section.keyword = "SECTION_TSHELL";
    section.id = 1;
    model.sections = {std::move(section)};
    model.thick_shells.id = std::move(model.solids.id);
    model.thick_shells.part = std::move(model.solids.part);
    model.thick_shells.nodes = std::move(model.solids.nodes);
    model.solids = {};
}

/// Section of a formulation; the trapezoidal rule shows stresses at the faces.
inline Record thick_section(int formulation, int points, bool at_faces = false)
{
    return record_of("SECTION_TSHELL", 1,
                     {{"ELFORM", formulation},
                      {"SHRF", 5.0 / 6},
                      {"NIP", points},
                      {"QR", at_faces ? 1 : 0},
                      {"TSHEAR", 1}});
}

/// One step from rest in which every node moves as `displacement` says, taken on the geometry of mid-step.
struct ThickStep {
    State state;
    std::vector<std::unique_ptr<SolidGroup>> groups;
    ElementResults results;

    ThickStep(const Model& model, int layers, const std::function<Vec3(const Vec3&)>& displacement)
    {
        state = bare_state(model);
        groups = make_thick_shell_groups(model, state);
        for (std::size_t node = 0; node < state.size(); ++node) {
            const Vec3 u = displacement(model.nodes.position[node]);
            state.position[node] += 0.5 * u;
            state.velocity[node] = u;
        }
        state.clear_forces();
        Clock clock;
        clock.last_step = 1;
        results.thick_shell_layers = layers;
        results.thick_shell_stress.resize(layers * model.thick_shells.size());
        for (auto& group : groups) {
            group->add_forces(clock, state);
            group->collect(state, results);
        }
    }
};

} // namespace plash::testing

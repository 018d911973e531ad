#pragma once

#include "model/model.h"
#include "solver/scene.h"
#include "tests/support/each_cycle.h"
#include "tests/support/records.h"

#include <functional>
#include <utility>
#include <vector>

namespace plash {

/// A Model with one shell part (index 0), without nodes and elements yet.
/// section  fields of *SECTION_SHELL
inline Model shell_model(Record material, std::vector<std::pair<const char*, double>> section)
{
    Model model;
    model.materials.push_back(std::move(material));
    model.sections.push_back(make_record("SECTION_SHELL", std::move(section)));
    Part part;
    part.id = 1;
    part.title = "sheet";
    part.section = 0;
    part.material = 0;
    model.parts.push_back(part);
    model.controls.time.step_scale = 0.9;
    return model;
}

inline Index add_node(Model& model, const Vec3& position)
{
    model.nodes.id.push_back(static_cast<Id>(model.nodes.size()) + 1);
    model.nodes.position.push_back(position);
    return static_cast<Index>(model.nodes.size()) - 1;
}

inline void add_shell(Model& model, const std::array<Index, 4>& nodes)
{
    model.shells.id.push_back(static_cast<Id>(model.shells.size()) + 1);
    model.shells.part.push_back(0);
    model.shells.nodes.push_back(nodes);
}

/// nx x ny quadrilaterals; place(i, j) gives the node positions. Node (i, j) has index j * (nx + 1) + i.
inline void add_grid(Model& model, int nx, int ny, const std::function<Vec3(int, int)>& place)
{
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) add_node(model, place(i, j));
    const auto node = [nx](int i, int j) { return static_cast<Index>(j * (nx + 1) + i); };
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            add_shell(model, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
        }
}

/// Makes two triangles of every quadrilateral; the diagonal alternates from one to the next.
inline void cut_into_triangles(Model& model)
{
    const ShellElements quadrilaterals = std::exchange(model.shells, {});
    for (std::size_t i = 0; i < quadrilaterals.size(); ++i) {
        const auto [a, b, c, d] = quadrilaterals.nodes[i];
        const bool other = i % 2;
        add_shell(model, other ? std::array<Index, 4>{a, b, d, d} : std::array<Index, 4>{a, b, c, c});
        add_shell(model, other ? std::array<Index, 4>{b, c, d, d} : std::array<Index, 4>{a, c, d, d});
    }
}

/// Holds freedoms (bits as FreedomMask) of nodes.
inline void hold(Model& model, std::vector<Index> nodes, FreedomMask freedoms)
{
    FixedNodes fixed;
    fixed.nodes = std::move(nodes);
    fixed.freedoms = freedoms;
    model.fixed_nodes.push_back(std::move(fixed));
}

/// Damping proportional to mass for tests that look for a static answer: force = -rate m v.
class MassDamping : public Term {
public:
    explicit MassDamping(double rate) : rate_(rate) {}
    std::string_view name() const override { return "damping"; }
    void add_forces(const Clock&, State& state) override
    {
        for (std::size_t node = 0; node < state.size(); ++node) {
            state.force[node] -= (rate_ * state.mass[node]) * state.velocity[node];
            state.moment[node] -= (rate_ * state.inertia[node]) * state.angular_velocity[node];
        }
    }

private:
    double rate_;
};

} // namespace plash

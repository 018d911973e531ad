#pragma once

#include "elements/solid_groups.h"
#include "solver/explicit_loop.h"
#include "tests/support/bare_state.h"

#include <cmath>
#include <functional>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>

/// Small meshes of solids, built in memory, for tests.
namespace plash::testing {

/// A record with the given numbers.
inline Record record_of(std::string keyword, Id id,
                        std::initializer_list<std::pair<const char*, double>> values)
{
    Record record;
    record.keyword = std::move(keyword);
    record.id = id;
    for (const auto& [name, value] : values) {
        record.fields.push_back({name, value, "", true, false, {}});
    }
    return record;
}

/// A Model with one part of one-point solids on a box of count[0] x count[1] x count[2] cells.
struct SolidBlock {
    Model model;
    std::array<int, 3> count;

    SolidBlock(std::array<int, 3> cells, Vec3 size, Record material) : count(cells)
    {
        for (int k = 0; k <= count[2]; ++k)
            for (int j = 0; j <= count[1]; ++j)
                for (int i = 0; i <= count[0]; ++i) {
                    model.nodes.id.push_back(static_cast<Id>(model.nodes.id.size()) + 1);
                    model.nodes.position.push_back(
                        {size.x * i / count[0], size.y * j / count[1], size.z * k / count[2]});
                }
        for (int k = 0; k < count[2]; ++k)
            for (int j = 0; j < count[1]; ++j)
                for (int i = 0; i < count[0]; ++i) {
                    model.solids.id.push_back(static_cast<Id>(model.solids.id.size()) + 1);
                    model.solids.part.push_back(0);
                    model.solids.nodes.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                                                  node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                                                  node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
                }
        model.sections.push_back(record_of("SECTION_SOLID", 1, {{"ELFORM", 1}}));
        model.materials.push_back(std::move(material));
        Part part;
        part.id = 1;
        part.title = "block";
        part.section = 0;
        part.material = 0;
        model.parts.push_back(part);
        model.controls.time.end_time = 1e30;
    }

    Index node(int i, int j, int k) const { return (k * (count[1] + 1) + j) * (count[0] + 1) + i; }

    bool on_surface(Index n) const
    {
        const int i = n % (count[0] + 1), j = n / (count[0] + 1) % (count[1] + 1),
                  k = n / ((count[0] + 1) * (count[1] + 1));
        return i == 0 || j == 0 || k == 0 || i == count[0] || j == count[1] || k == count[2];
    }

    /// Moves every inner node by up to `amplitude` in each direction, always the same way.
    void distort(double amplitude)
    {
        std::mt19937 random(7);
        const auto shift = [&] { return amplitude * (random() / 2147483648.0 - 1.0); };
        for (std::size_t n = 0; n < model.nodes.size(); ++n) {
            const Vec3 by{shift(), shift(), shift()};
            if (!on_surface(static_cast<Index>(n))) model.nodes.position[n] += by;
        }
    }

    void set_hourglass(int type, double coefficient = 0.1)
    {
        model.controls.elements.hourglass_type = type;
        model.controls.elements.hourglass_coefficient = coefficient;
    }

    void set_viscosity(double quadratic, double linear)
    {
        model.controls.elements.quadratic_viscosity = quadratic;
        model.controls.elements.linear_viscosity = linear;
    }

    /// Velocities at t = 0 by place, as the deck's initial velocities.
    void set_velocity(const std::function<Vec3(const Vec3&)>& velocity)
    {
        for (std::size_t n = 0; n < model.nodes.size(); ++n) {
            InitialVelocity initial;
            initial.nodes = {static_cast<Index>(n)};
            initial.translation = velocity(model.nodes.position[n]);
            model.initial_velocities.push_back(initial);
        }
    }

    State state() const { return bare_state(model); }
};

/// Solid results of all terms.
inline ElementResults solid_results(const Model& model, const State& state,
                                    std::vector<std::unique_ptr<SolidGroup>>& groups)
{
    ElementResults results;
    results.solid_stress.resize(model.solids.size());
    results.solid_plastic_strain.resize(model.solids.size());
    results.solid_deleted.resize(model.solids.size());
    results.part_motion.resize(model.parts.size());
    for (const auto& group : groups) group->collect(state, results);
    return results;
}

} // namespace plash::testing

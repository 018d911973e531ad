#pragma once

#include "core/term.h"
#include "model/model.h"
#include "solver/scene.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace plash::testing {

/// Builds Models of plates and blocks for contact tests, one elastic material and one section a part.
class ContactModel {
public:
    Model model;

    Index add_part(double density, double young_modulus, double shell_thickness,
                   const char* material = "MAT_ELASTIC")
    {
        const Index number = static_cast<Index>(model.parts.size());
        Record law;
        law.keyword = material;
        law.fields = {number_field("RO", density), number_field("E", young_modulus), number_field("PR", 0.3)};
        model.materials.push_back(law);
        Record section;
        section.keyword = shell_thickness > 0 ? "SECTION_SHELL" : "SECTION_SOLID";
        if (shell_thickness > 0) section.fields = {number_field("T1", shell_thickness)};
        model.sections.push_back(section);
        Part part;
        part.id = number + 1;
        part.material = part.section = number;
        model.parts.push_back(part);
        return number;
    }

    Index add_node(const Vec3& place)
    {
        model.nodes.id.push_back(static_cast<Id>(model.nodes.size()) + 1);
        model.nodes.position.push_back(place);
        return static_cast<Index>(model.nodes.size()) - 1;
    }

    Index add_shell(Index part, std::array<Index, 4> nodes)
    {
        model.shells.id.push_back(static_cast<Id>(model.shells.size()) + 1);
        model.shells.part.push_back(part);
        model.shells.nodes.push_back(nodes);
        return static_cast<Index>(model.shells.size()) - 1;
    }

    Index add_solid(Index part, std::array<Index, 8> nodes)
    {
        model.solids.id.push_back(static_cast<Id>(model.solids.size()) + 1);
        model.solids.part.push_back(part);
        model.solids.nodes.push_back(nodes);
        return static_cast<Index>(model.solids.size()) - 1;
    }

    /// Quadrilaterals over (i / columns, j / rows) mapped by `place`. Returns the first node; node (i, j) is
    /// first + j (columns + 1) + i.
    Index add_sheet(Index part, int columns, int rows, const std::function<Vec3(double, double)>& place)
    {
        const Index first = static_cast<Index>(model.nodes.size());
        for (int j = 0; j <= rows; ++j) {
            for (int i = 0; i <= columns; ++i) add_node(place(double(i) / columns, double(j) / rows));
        }
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                const Index corner = first + j * (columns + 1) + i;
                add_shell(part, {corner, corner + 1, corner + columns + 2, corner + columns + 1});
            }
        }
        return first;
    }

    /// A block of hexahedra from `low` to `high`. Returns the first node; x runs fastest, then y, then z.
    Index add_block(Index part, const Vec3& low, const Vec3& high, std::array<int, 3> count)
    {
        const Index first = static_cast<Index>(model.nodes.size());
        const auto [nx, ny, nz] = count;
        for (int k = 0; k <= nz; ++k) {
            for (int j = 0; j <= ny; ++j) {
                for (int i = 0; i <= nx; ++i) {
                    add_node({low.x + (high.x - low.x) * i / nx, low.y + (high.y - low.y) * j / ny,
                              low.z + (high.z - low.z) * k / nz});
                }
            }
        }
        const auto node = [&, nx = nx, ny = ny](int i, int j, int k) {
            return first + (k * (ny + 1) + j) * (nx + 1) + i;
        };
        for (int k = 0; k < nz; ++k) {
            for (int j = 0; j < ny; ++j) {
                for (int i = 0; i < nx; ++i) {
                    add_solid(part, {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                                     node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                                     node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
                }
            }
        }
        return first;
    }

    /// State at the start with the masses of the elements.
    State state() const;

private:
    static Record::Field number_field(const char* name, double value)
    {
        Record::Field field;
        field.name = name;
        field.value = value;
        return field;
    }
};

/// Linear springs between pairs of nodes: an elastic body without elements.
class Springs : public Term {
public:
    struct Spring {
        Index a, b;
        double stiffness, length;
    };
    std::vector<Spring> springs;

    void add(const Model& model, Index a, Index b, double stiffness)
    {
        springs.push_back({a, b, stiffness, norm(model.nodes.position[b] - model.nodes.position[a])});
    }
    /// All edges and diagonals of the solids.
    void add_solids(const Model& model, double stiffness);

    std::string_view name() const override { return "springs"; }
    void add_forces(const Clock&, State& state) override
    {
        energy_ = 0;
        for (const Spring& spring : springs) {
            const Vec3 reach = state.position[spring.b] - state.position[spring.a];
            const double length = norm(reach), stretch = length - spring.length;
            const Vec3 force = (spring.stiffness * stretch / length) * reach;
            state.force[spring.a] += force;
            state.force[spring.b] -= force;
            energy_ += 0.5 * spring.stiffness * stretch * stretch;
        }
    }
    void report(EnergyLedger& ledger) const override { ledger.internal += energy_; }

private:
    double energy_ = 0;
};

/// Calls a function in every cycle once all forces are summed.
class Watch : public Term {
public:
    explicit Watch(std::function<void(const Clock&, const State&)> look) : look_(std::move(look)) {}
    std::string_view name() const override { return "watch"; }
    void constrain(const Clock& clock, State& state) override { look_(clock, state); }

private:
    std::function<void(const Clock&, const State&)> look_;
};

/// Gives the run its step.
class FixedStep : public Term {
public:
    explicit FixedStep(double step) : step_(step) {}
    std::string_view name() const override { return "step"; }
    StepVote stable_step() const override { return {step_, "test", 0, 0}; }

private:
    double step_;
};

} // namespace plash::testing

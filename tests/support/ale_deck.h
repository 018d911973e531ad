#pragma once

#include "ale/coupling/fluid_coupling.h"
#include "ale/fluid_term.h"
#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/each_cycle.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <fmt/format.h>
#include <fstream>
#include <functional>

/// Decks with Eulerian meshes as text, and their runs.
namespace plash::testing {

/// *ALE_STRUCTURED_MESH 1 as part 10 with equal cells.
inline std::string structured_mesh(std::array<double, 3> low, std::array<double, 3> high,
                                   std::array<int, 3> cells)
{
    std::string text = "*ALE_STRUCTURED_MESH\n1,10,1,1\n1,2,3\n";
    for (int axis = 0; axis < 3; ++axis)
        text += fmt::format("*ALE_STRUCTURED_MESH_CONTROL_POINTS\n{}\n1,{}\n{},{}\n", axis + 1, low[axis],
                            cells[axis] + 1, high[axis]);
    return text;
}

/// Parts 1 (a liquid, pressure K mu) and 2 (empty space) as groups 1 and 2; E0 and more stay zero.
inline std::string liquid_and_void(double density, double speed_of_sound, double lowest_pressure = -1e4)
{
    return fmt::format("*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n"
                       "*PART\nliquid\n1,1,1,1\n*PART\nempty\n2,1,2\n*SECTION_SOLID\n1,11\n"
                       "*MAT_NULL\n1,{},{}\n*EOS_LINEAR_POLYNOMIAL\n1,0,{}\n\n*MAT_VACUUM\n2,0\n",
                       density, lowest_pressure, density * speed_of_sound * speed_of_sound);
}

/// Group 1 in a box, group 2 elsewhere in the mesh part 10.
inline std::string liquid_in_box(std::array<double, 3> low, std::array<double, 3> high)
{
    return fmt::format("*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n5,0,1\n{},{},{},{},{},{}\n", low[0],
                       low[1], low[2], high[0], high[1], high[2]);
}

inline std::string gravity(double down)
{
    return fmt::format("*LOAD_BODY_Z\n1,{}\n*DEFINE_CURVE\n1\n0,1\n1e9,1\n", down);
}

/// *CONTROL_ALE with walls that let fluid slip along, and the end of the deck.
inline std::string closed(double end_time, double step_scale = 0.67)
{
    return fmt::format(
        "*CONTROL_ALE\n-1,1,2,-1\n,,,,,2\n*CONTROL_TERMINATION\n{}\n*CONTROL_TIMESTEP\n0,{}\n*END\n",
        end_time, step_scale);
}

/// A rigid plane patch of shells, nodes from `first`, between corner, corner + a and corner + b.
inline std::string shell_patch(int part, int& first, Vec3 corner, Vec3 a, Vec3 b, int along_a, int along_b)
{
    std::string nodes = "*NODE\n", shells = "*ELEMENT_SHELL\n";
    const auto number = [&](int i, int j) { return first + i + j * (along_a + 1); };
    for (int j = 0; j <= along_b; ++j) {
        for (int i = 0; i <= along_a; ++i) {
            const Vec3 x = corner + (double(i) / along_a) * a + (double(j) / along_b) * b;
            nodes += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", number(i, j), x.x, x.y, x.z);
            if (i < along_a && j < along_b)
                shells += fmt::format("{},{},{},{},{},{}\n", number(i, j), part, number(i, j),
                                      number(i + 1, j), number(i + 1, j + 1), number(i, j + 1));
        }
    }
    first += (along_a + 1) * (along_b + 1);
    return nodes + shells;
}

/// A deck that has been read and stands ready to run.
class EulerianRun {
public:
    explicit EulerianRun(const std::string& text)
    {
        const TemporaryFolder folder;
        std::ofstream(folder / "deck.k") << "*KEYWORD\n" << text;
        read_ = read_model(folder / "deck.k");
        for (const Message& error : read_.report.errors) ADD_FAILURE() << to_text(error, read_.model);
        for (const Message& message : unsupported_keywords(read_.report))
            ADD_FAILURE() << to_text(message, read_.model);
        scene_ = std::make_unique<Scene>(make_scene(read_.model));
    }

    /// To the deck's end, or to `until`; watch(clock, state) is called in every cycle.
    Outcome run(const std::function<void(const Clock&, const State&)>& watch = {})
    {
        Recorders recorders;
        if (watch) recorders.push_back(std::make_unique<EachCycle>(watch));
        const Outcome outcome = plash::run(*scene_, recorders);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        return outcome;
    }

    Scene& scene() { return *scene_; }
    const Model& model() const { return read_.model; }

    template <class T>
    T& term()
    {
        for (auto& term : scene_->terms)
            if (T* found = dynamic_cast<T*>(term.get())) return *found;
        throw std::runtime_error("the scene has no such term");
    }

private:
    ReadResult read_;
    std::unique_ptr<Scene> scene_;
};

/// Volume of the first fluid, in all cells or in those for which `wanted(centre)` holds.
inline double liquid_volume(const BoxFluid& fluid, const std::function<bool(Vec3)>& wanted = {})
{
    double sum = 0;
    const BoxGrid& grid = fluid.grid;
    for (int k = 0; k < grid.cells(2); ++k)
        for (int j = 0; j < grid.cells(1); ++j)
            for (int i = 0; i < grid.cells(0); ++i) {
                const Vec3 centre{grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)};
                if (wanted && !wanted(centre)) continue;
                const AlignedDoubles& fraction = fluid.fields.groups[0].fraction;
                sum += (fraction.empty() ? 1.0 : fraction[grid.at(i, j, k)]) * grid.volume(i, j, k);
            }
    return sum;
}

} // namespace plash::testing

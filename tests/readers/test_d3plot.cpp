#include "output/d3plot.h"
#include "tests/readers/small_model.h"
#include "tests/readers/vtk_d3plot.h"
#include "tests/support/shared_files.h"
#include "tests/support/temporary_folder.h"

#include <cmath>
#include <gtest/gtest.h>

/// Databases written by D3plotRecorder and read back with VTK's vtkLSDynaReader, an independent reader.
namespace plash {

using testing::read_with_vtk;
using testing::small_model;
using testing::SnapshotFixture;
using testing::TemporaryFolder;
using testing::VtkD3plot;
using testing::VtkPart;

namespace {

/// Single precision: seven digits.
constexpr double digits = 1e-6;

/// What the made-up term says of element e (index of the Model), layer or component c, at time t.
double stress_of(Index element, int layer, int component, double time)
{
    return 100 * (element + 1) + 10 * layer + component + 1000 * time;
}

void set_stress(SymmetricTensor<double>& s, Index element, int layer, double time)
{
    s = {stress_of(element, layer, 0, time), stress_of(element, layer, 1, time),
         stress_of(element, layer, 2, time), stress_of(element, layer, 3, time),
         stress_of(element, layer, 4, time), stress_of(element, layer, 5, time)};
}

void add_made_up_results(SnapshotFixture& fixture)
{
    fixture.add_results().fill = [&](const State&, ElementResults& r) {
        const double t = fixture.clock.time;
        if (r.solid_stress.empty()) return;
        for (Index e = 0; e < 3; ++e) {
            set_stress(r.solid_stress[e], e, 0, t);
            r.solid_plastic_strain[e] = 0.5 + e;
            for (int layer = 0; layer < r.shell_layers; ++layer) {
                set_stress(r.shell_stress[e * r.shell_layers + layer], e, layer, t);
                r.shell_plastic_strain[e * r.shell_layers + layer] = e + 0.25 * layer;
            }
            for (int c = 0; c < 8; ++c) r.shell_resultants[e][c] = 10 * e + c;
            r.shell_thickness[e] = 1.5 + e;
            r.shell_internal_energy[e] = 7 + e;
        }
        r.shell_deleted[1] = t > 0.15;
        r.solid_deleted[0] = t > 0.25;
        r.part_motion[0] = {2, 4, {6, 0, 0}, 0, 0};
    };
}

Vec3 moved(const Vec3& x, double t)
{
    return {x.x + t, x.y, x.z + 2 * t * x.x};
}

/// States at t = 0, 0.1, 0.2, 0.3.
void write_states(SnapshotFixture& fixture, Recorder& recorder, int count = 4)
{
    for (int n = 0; n < count; ++n) {
        const double t = 0.1 * n;
        fixture.clock = {t, n > 0 ? 0.1 : 0, 0.1, n};
        for (std::size_t i = 0; i < fixture.state.size(); ++i) {
            fixture.state.position[i] = moved(fixture.model.nodes.position[i], t);
            fixture.state.velocity[i] = {1.0 * i, t, -1};
            fixture.state.force[i] = {0, 0.5 * i, 0};
        }
        recorder.write(fixture.snapshot());
    }
}

std::string database(const TemporaryFolder& folder)
{
    return folder / "d3plot";
}

void expect_near(const Vec3& a, const Vec3& b)
{
    EXPECT_NEAR(a.x, b.x, digits * (1 + std::abs(b.x)));
    EXPECT_NEAR(a.y, b.y, digits * (1 + std::abs(b.y)));
    EXPECT_NEAR(a.z, b.z, digits * (1 + std::abs(b.z)));
}

/// The node of the Model that a point of a part is, by its undeformed place.
Index node_of(const Model& model, const VtkPart& part, std::size_t point)
{
    const Vec3 start = part.position[point] - part.deflection[point];
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        if (norm(model.nodes.position[node] - start) < 1e-3) return static_cast<Index>(node);
    }
    throw std::runtime_error("a point that is no node");
}

template <class Container, class Value>
Index index_of(const Container& values, const Value& value)
{
    return static_cast<Index>(std::find(values.begin(), values.end(), value) - values.begin());
}

} // namespace

TEST(D3plot, GivesTimesPartsAndMotion)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_made_up_results(fixture);
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
    write_states(fixture, recorder);

    const VtkD3plot read = read_with_vtk(database(folder), 2);
    ASSERT_EQ(read.time_steps, 4);
    for (int n = 0; n < 4; ++n) EXPECT_NEAR(read.times[n], 0.1 * n, digits);
    EXPECT_EQ(read.nodes, 12);
    ASSERT_EQ(read.parts.size(), 3u);

    for (const VtkPart& part : read.parts) {
        for (std::size_t i = 0; i < part.position.size(); ++i) {
            const Index node = node_of(fixture.model, part, i);
            const Vec3 start = fixture.model.nodes.position[node];
            expect_near(part.position[i], moved(start, 0.2));
            expect_near(part.deflection[i], moved(start, 0.2) - start);
            expect_near(part.acceleration[i], {0, 0.5 * node, 0});
            expect_near(part.velocity[i], {1.0 * node, 0.2 - 0.1 * 0.5 * node, -1}); // at n-1/2
        }
    }
}

TEST(D3plot, KeepsElementsWithTheirNodesAndNumbers)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_made_up_results(fixture);
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
    write_states(fixture, recorder, 1);
    const VtkD3plot read = read_with_vtk(database(folder), 0);
    const Model& model = fixture.model;

    const auto expect_corners = [&](const VtkPart& part, std::size_t cell, const auto& nodes) {
        // VTK makes a tetrahedron of a solid whose last five corners are one.
        const bool tetrahedron = nodes.size() == 8 && nodes[3] == nodes[7];
        ASSERT_EQ(part.corners[cell].size(), tetrahedron ? 4 : nodes.size());
        for (std::size_t c = 0; c < part.corners[cell].size(); ++c) {
            EXPECT_EQ(node_of(model, part, part.corners[cell][c]), nodes[c]);
        }
    };
    for (const char* name : {"blocks", "tetrahedron"}) {
        const VtkPart& part = read.part(name);
        EXPECT_EQ(part.element_ids.size(), name[0] == 'b' ? 2u : 1u);
        for (std::size_t cell = 0; cell < part.element_ids.size(); ++cell) {
            const Index solid = index_of(model.solids.id, part.element_ids[cell]);
            ASSERT_LT(solid, 3) << "unknown solid number " << part.element_ids[cell];
            EXPECT_EQ(model.parts[model.solids.part[solid]].title, name);
            expect_corners(part, cell, model.solids.nodes[solid]);
        }
    }
    const VtkPart& sheets = read.part("sheets");
    ASSERT_EQ(sheets.element_ids.size(), 3u);
    for (std::size_t cell = 0; cell < 3; ++cell) {
        const Index shell = index_of(model.shells.id, sheets.element_ids[cell]);
        ASSERT_LT(shell, 3) << "unknown shell number " << sheets.element_ids[cell];
        expect_corners(sheets, cell, model.shells.nodes[shell]);
    }
}

/// A part without elements, whose number stands before all others (decks have them; that of an Eulerian
/// mesh's materials has none): VTK's reader broke down on them.
TEST(D3plot, ReadersBearPartsWithoutElements)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    Part empty;
    empty.id = 1;
    for (Part& part : fixture.model.parts) part.id += 1;
    fixture.model.parts.push_back(empty);
    add_made_up_results(fixture);
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
    write_states(fixture, recorder, 1);
    const VtkD3plot read = read_with_vtk(database(folder), 0);
    EXPECT_EQ(read.part("blocks").element_ids.size(), 2u);
    EXPECT_EQ(read.part("sheets").element_ids.size(), 3u);
}

TEST(D3plot, GivesStressesAndShellResults)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_made_up_results(fixture);
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
    write_states(fixture, recorder);
    const VtkD3plot read = read_with_vtk(database(folder), 1);
    const Model& model = fixture.model;

    const auto expect_stress = [&](const std::vector<double>& row, Index element, int layer) {
        ASSERT_EQ(row.size(), 6u);
        // VTK 9.1 keeps LS-DYNA's order xx, yy, zz, xy, yz, zx.
        for (int c = 0; c < 6; ++c) EXPECT_NEAR(row[c], stress_of(element, layer, c, 0.1), 1e3 * digits);
    };
    for (const char* name : {"blocks", "tetrahedron"}) {
        const VtkPart& part = read.part(name);
        for (std::size_t cell = 0; cell < part.element_ids.size(); ++cell) {
            const Index solid = index_of(model.solids.id, part.element_ids[cell]);
            expect_stress(part.cell_values.at("Stress")[cell], solid, 0);
            EXPECT_NEAR(part.cell_values.at("EffPlastStrn")[cell][0], 0.5 + solid, 10 * digits);
        }
    }
    const VtkPart& sheets = read.part("sheets");
    const char* const surfaces[] = {"", "InnerSurf", "OuterSurf"};
    for (std::size_t cell = 0; cell < sheets.element_ids.size(); ++cell) {
        const Index shell = index_of(model.shells.id, sheets.element_ids[cell]);
        for (int layer = 0; layer < 3; ++layer) {
            expect_stress(sheets.cell_values.at(std::string("Stress") + surfaces[layer])[cell], shell, layer);
            EXPECT_NEAR(sheets.cell_values.at(std::string("EffPlastStrn") + surfaces[layer])[cell][0],
                        shell + 0.25 * layer, 10 * digits);
        }
        // The database has the moments first. VTK 9.1 names them NormalResultant: in LS-DYNA's own cantilever
        // those are the ones that reach 0.0436 at the support, where the normal force is zero.
        const auto& bending = sheets.cell_values.at("NormalResultant")[cell];
        const auto& shear = sheets.cell_values.at("ShearResultant")[cell];
        const auto& normal = sheets.cell_values.at("BendingResultant")[cell];
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(bending[c], 10 * shell + c, 100 * digits);
        for (int c = 0; c < 2; ++c) EXPECT_NEAR(shear[c], 10 * shell + 3 + c, 100 * digits);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(normal[c], 10 * shell + 5 + c, 100 * digits);
        EXPECT_NEAR(sheets.cell_values.at("Thickness")[cell][0], 1.5 + shell, 10 * digits);
        EXPECT_NEAR(sheets.cell_values.at("InternalEnergy")[cell][0], 7 + shell, 100 * digits);
    }
}

/// Beams stand between solids and shells, with their ends, resultants and points, and leave when they erode;
/// what stands behind them keeps its place.
TEST(D3plot, GivesBeams)
{
    for (const int points : {0, 2}) {
        TemporaryFolder folder;
        SnapshotFixture fixture = small_model(true);
        if (points > 0) fixture.model.controls.output.extent = {{"BEAMIP", points}};
        add_made_up_results(fixture);
        fixture.add_results().fill = [&](const State&, ElementResults& r) {
            if (r.beams.empty()) return;
            ASSERT_EQ(r.beam_points, points);
            for (Index beam = 0; beam < 2; ++beam) {
                const double b = 100 * beam;
                r.beams[beam] = {b + 1, b + 2, b + 3, b + 4, b + 5, b + 6, 0, 0};
                for (int point = 0; point < points; ++point)
                    r.beam_stress[beam * points + point] = {b + 7, b + 8, b + 9, 0.5 + beam + point};
            }
            r.beam_deleted[1] = fixture.clock.time > 0.15;
        };
        D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
        write_states(fixture, recorder);
        const VtkD3plot read = read_with_vtk(database(folder), 1);
        const VtkPart& rods = read.part("rods");
        EXPECT_EQ(rods.element_ids, (std::vector<Id>{60, 61}));
        for (std::size_t cell = 0; cell < 2; ++cell) {
            const Index beam = index_of(fixture.model.beams.id, rods.element_ids[cell]);
            for (int end = 0; end < 2; ++end) {
                EXPECT_EQ(node_of(fixture.model, rods, rods.corners[cell].at(end)),
                          fixture.model.beams.nodes[beam][end]);
            }
            const double b = 100 * beam;
            EXPECT_NEAR(rods.cell_values.at("AxialForce")[cell][0], b + 1, 1e3 * digits);
            EXPECT_NEAR(rods.cell_values.at("ShearResultant")[cell][1], b + 3, 1e3 * digits);
            EXPECT_NEAR(rods.cell_values.at("BendingResultant")[cell][0], b + 4, 1e3 * digits);
            EXPECT_NEAR(rods.cell_values.at("TorsionResultant")[cell][0], b + 6, 1e3 * digits);
        }
        const VtkPart& sheets = read.part("sheets");
        EXPECT_EQ(sheets.element_ids, (std::vector<Id>{7, 8, 9}));
        EXPECT_NEAR(sheets.cell_values.at("Thickness")[0][0], 1.5 + 2, 10 * digits);
        const VtkD3plot later = read_with_vtk(database(folder), 2);
        EXPECT_EQ(later.part("rods").element_ids, (std::vector<Id>{61}));
        EXPECT_EQ(later.part("sheets").element_ids, (std::vector<Id>{7, 9}));
    }
}

/// Thick shells stand behind the solids, with the stresses of their layers, and leave when they erode.
TEST(D3plot, GivesThickShells)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    Model& model = fixture.model;
    Part part;
    part.id = 12;
    part.title = "stack";
    model.parts.push_back(part);
    model.thick_shells.id = {41, 40};
    model.thick_shells.part = {3, 3};
    model.thick_shells.nodes = {{0, 1, 3, 2, 4, 5, 7, 6}, {4, 5, 7, 6, 8, 9, 11, 10}};
    fixture.start();
    add_made_up_results(fixture);
    fixture.add_results().fill = [&](const State&, ElementResults& r) {
        if (r.thick_shell_stress.empty()) return;
        for (Index e = 0; e < 2; ++e) {
            for (int layer = 0; layer < 3; ++layer) {
                set_stress(r.thick_shell_stress[e * 3 + layer], e + 5, layer, fixture.clock.time);
                r.thick_shell_plastic_strain[e * 3 + layer] = e + 0.25 * layer;
            }
        }
        r.thick_shell_deleted[0] = fixture.clock.time > 0.15;
    };
    D3plotRecorder recorder(model, Schedule(0.1), database(folder));
    write_states(fixture, recorder);
    const VtkD3plot read = read_with_vtk(database(folder), 1);
    const VtkPart& stack = read.part("stack");
    EXPECT_EQ(stack.element_ids, (std::vector<Id>{40, 41}));
    for (std::size_t cell = 0; cell < 2; ++cell) {
        const Index shell = index_of(model.thick_shells.id, stack.element_ids[cell]);
        for (int corner = 0; corner < 8; ++corner) {
            EXPECT_EQ(node_of(model, stack, stack.corners[cell].at(corner)),
                      model.thick_shells.nodes[shell][corner]);
        }
        // The database has middle, inner and outer layer one after the other.
        const auto& stress = stack.cell_values.at("Stress")[cell];
        for (int c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], stress_of(shell + 5, 0, c, 0.1), 1e4 * digits);
    }
    // What stands behind keeps its place, and so do solids.
    EXPECT_EQ(read.part("sheets").element_ids, (std::vector<Id>{7, 8, 9}));
    EXPECT_NEAR(read.part("sheets").cell_values.at("Thickness")[0][0], 1.5 + 2, 10 * digits);
    EXPECT_EQ(read.part("blocks").element_ids, (std::vector<Id>{501, 502}));
    const VtkD3plot later = read_with_vtk(database(folder), 2);
    EXPECT_EQ(later.part("stack").element_ids, (std::vector<Id>{40}));
    EXPECT_EQ(later.part("sheets").element_ids, (std::vector<Id>{7, 9}));
}

TEST(D3plot, LeavesOutWhatHasEroded)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_made_up_results(fixture);
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
    write_states(fixture, recorder);
    EXPECT_EQ(read_with_vtk(database(folder), 1).part("sheets").element_ids, (std::vector<Id>{7, 8, 9}));
    EXPECT_EQ(read_with_vtk(database(folder), 2).part("sheets").element_ids, (std::vector<Id>{7, 9}));
    EXPECT_EQ(read_with_vtk(database(folder), 2).part("blocks").element_ids, (std::vector<Id>{501, 502}));
    EXPECT_EQ(read_with_vtk(database(folder), 3).part("blocks").element_ids, (std::vector<Id>{501}));
}

TEST(D3plot, ContinuesInFurtherFiles)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_made_up_results(fixture);
    {
        // A longer family of an earlier run must not lengthen this one.
        D3plotRecorder older(fixture.model, Schedule(0.1), database(folder), 1);
        write_states(fixture, older, 6);
    }
    const std::size_t words = D3plotLayout(fixture.model).state_words() + 1;
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder), 2 * words + 1);
    write_states(fixture, recorder, 5);
    EXPECT_TRUE(std::filesystem::exists(folder / "d3plot03"));
    EXPECT_FALSE(std::filesystem::exists(folder / "d3plot04"));
    const VtkD3plot read = read_with_vtk(database(folder), 4);
    ASSERT_EQ(read.time_steps, 5);
    EXPECT_NEAR(read.part("sheets").cell_values.at("Stress")[0][0], stress_of(2, 0, 0, 0.4), 1e3 * digits);
}

TEST(D3plot, IsReadableAfterEveryState)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    add_made_up_results(fixture);
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
    write_states(fixture, recorder, 1);
    EXPECT_EQ(read_with_vtk(database(folder), 0).time_steps, 1);
    write_states(fixture, recorder, 3);
    EXPECT_EQ(read_with_vtk(database(folder), 0).time_steps, 3);
}

TEST(D3plot, IsReadableWhenTheWriterStopsInTheMiddleOfAState)
{
    TemporaryFolder folder;
    Model sheet; // large enough that half a state goes to disk
    const Index side = 150;
    for (Index i = 0; i < side * side; ++i) {
        sheet.nodes.id.push_back(i + 1);
        sheet.nodes.position.push_back({1.0 * (i % side), 1.0 * (i / side), 0});
    }
    sheet.parts.resize(1);
    for (Index i = 0; i + side + 1 < side * side; ++i) {
        sheet.shells.id.push_back(i + 1);
        sheet.shells.part.push_back(0);
        sheet.shells.nodes.push_back({i, i + 1, i + side + 1, i + side});
    }
    const D3plotLayout layout(sheet);
    D3plotFamily family(database(folder), std::size_t{1} << 30, false);
    family.write_geometry(d3plot_geometry(sheet, layout));
    for (int state = 0; state < 2; ++state) {
        family.begin_state(0.1 * state, layout.state_words());
        const std::size_t count = state == 0 ? layout.state_words() : layout.state_words() / 2;
        for (std::size_t i = 0; i < count; ++i) family.put(1);
        if (state == 0) family.end_state();
    }
    EXPECT_GT(std::filesystem::file_size(folder / "d3plot01"), 4.8 * layout.state_words());
    EXPECT_EQ(read_with_vtk(database(folder), 0).time_steps, 1);
}

TEST(D3plot, HonoursTheExtentThatTheDeckAsksFor)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    fixture.model.controls.output.extent = {{"MAXINT", 2}, {"RLTFLG", 2}, {"IEVERP", 1}};
    fixture.model.rigid_walls.resize(2); // their forces and places enter the global words
    fixture.add_results().fill = [](const State&, ElementResults& r) {
        if (r.shell_stress.empty()) return;
        ASSERT_EQ(r.shell_layers, 2);
        r.shell_stress[2 * 2 + 1].zx = 5;
    };
    D3plotRecorder recorder(fixture.model, Schedule(0.1), database(folder));
    write_states(fixture, recorder, 2);
    EXPECT_TRUE(std::filesystem::exists(folder / "d3plot02"));
    const VtkD3plot read = read_with_vtk(database(folder), 1);
    ASSERT_EQ(read.time_steps, 2);
    const VtkPart& sheets = read.part("sheets");
    EXPECT_FALSE(sheets.cell_values.contains("BendingResultant"));
    EXPECT_FALSE(sheets.cell_values.contains("StressOuterSurf"));
    EXPECT_NEAR(sheets.cell_values.at("StressInnerSurf")[0][5], 5, 10 * digits); // shell 7 comes first
}

/// NEIPH, NEIPS and STRFLG lengthen the words of solids, shells and thick shells; what stands behind each of
/// them keeps its place.
TEST(D3plot, GivesHistoryVariablesAndStrains)
{
    TemporaryFolder folder;
    SnapshotFixture fixture = small_model();
    Model& model = fixture.model;
    model.controls.output.extent = {{"NEIPH", 2}, {"NEIPS", 3}, {"STRFLG", 1}};
    Part part;
    part.id = 12;
    part.title = "stack";
    model.parts.push_back(part);
    model.thick_shells.id = {41};
    model.thick_shells.part = {3};
    model.thick_shells.nodes = {{0, 1, 3, 2, 4, 5, 7, 6}};
    fixture.start();
    add_made_up_results(fixture);
    const auto tensor = [](double base) {
        return SymmetricTensor<double>{base, base + 1, base + 2, base + 3, base + 4, base + 5};
    };
    fixture.add_results().fill = [&](const State&, ElementResults& r) {
        if (r.solid_stress.empty()) return;
        ASSERT_EQ(r.solid_history_size, 2);
        ASSERT_EQ(r.shell_history_size, 3);
        for (Index e = 0; e < 3; ++e) {
            for (int i = 0; i < 2; ++i) r.solid_history[2 * e + i] = 10 * e + i;
            r.solid_strain[e] = tensor(100 * e);
            for (int layer = 0; layer < 3; ++layer)
                for (int i = 0; i < 3; ++i)
                    r.shell_history[(3 * e + layer) * 3 + i] = 100 * e + 10 * layer + i;
            r.shell_strain[e] = {tensor(20 * e), tensor(20 * e + 10)};
        }
        for (int layer = 0; layer < 3; ++layer) {
            set_stress(r.thick_shell_stress[layer], 7, layer, 0);
            for (int i = 0; i < 3; ++i) r.thick_shell_history[3 * layer + i] = 10 * layer + i;
        }
        r.thick_shell_strain[0] = {tensor(3), tensor(13)};
    };
    D3plotRecorder recorder(model, Schedule(0.1), database(folder));
    write_states(fixture, recorder, 2);
    const VtkD3plot read = read_with_vtk(database(folder), 1);
    const auto expect_row = [](const std::vector<double>& row, double first, std::size_t count) {
        ASSERT_EQ(row.size(), count);
        for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(row[i], first + i, 1e3 * digits);
    };
    const VtkPart& blocks = read.part("blocks");
    for (std::size_t cell = 0; cell < blocks.element_ids.size(); ++cell) {
        const Index solid = index_of(model.solids.id, blocks.element_ids[cell]);
        expect_row(blocks.cell_values.at("Strain")[cell], 100 * solid, 6);
        const auto& history = blocks.cell_values.at("IntPtData")[cell];
        ASSERT_GE(history.size(), 2u);
        EXPECT_NEAR(history[0], 10 * solid, digits);
        EXPECT_NEAR(history[1], 10 * solid + 1, 10 * digits);
    }
    const VtkPart& sheets = read.part("sheets");
    const char* const surfaces[] = {"", "InnerSurf", "OuterSurf"};
    for (std::size_t cell = 0; cell < sheets.element_ids.size(); ++cell) {
        const Index shell = index_of(model.shells.id, sheets.element_ids[cell]);
        for (int layer = 0; layer < 3; ++layer)
            expect_row(sheets.cell_values.at(std::string("IntPtData") + surfaces[layer])[cell],
                       100 * shell + 10 * layer, 3);
        expect_row(sheets.cell_values.at("StrainInnerSurf")[cell], 20 * shell, 6);
        expect_row(sheets.cell_values.at("StrainOuterSurf")[cell], 20 * shell + 10, 6);
        EXPECT_NEAR(sheets.cell_values.at("Thickness")[cell][0], 1.5 + shell, 10 * digits);
        EXPECT_NEAR(sheets.cell_values.at("InternalEnergy")[cell][0], 7 + shell, 100 * digits);
    }
    const VtkPart& stack = read.part("stack");
    expect_row(stack.cell_values.at("StrainInnerSurf")[0], 3, 6);
    expect_row(stack.cell_values.at("StrainOuterSurf")[0], 13, 6);
}

// LS-DYNA's own database through the same reader, so that the reader is known to be used rightly. Reference:
// ../shared/decks/RESULTS.md and nodout beside the deck (node 5 at t = 9.99864).
TEST(D3plot, ReaderUnderstandsTheDatabaseOfLsDyna)
{
    const auto path = testing::shared_file("decks/targets/shell_cantilever_nip3/d3plot");
    PLASH_NEED_SHARED(path);
    const VtkD3plot read = read_with_vtk(path, 10);
    EXPECT_EQ(read.time_steps, 12);
    EXPECT_NEAR(read.times[10], 9.99864, 1e-5);
    const VtkPart& sheet = read.part("Sheet");
    EXPECT_EQ(sheet.element_ids.size(), 90u);
    std::size_t tip = 0; // node 5 started at (300, 30, 0)
    while (norm(sheet.position.at(tip) - sheet.deflection[tip] - Vec3{300, 30, 0}) > 1e-3) ++tip;
    EXPECT_NEAR(sheet.deflection[tip].x, -5.47187, 1e-4);
    EXPECT_NEAR(sheet.deflection[tip].z, -38.6306, 1e-4);
}

} // namespace plash

#include "ale/coupling/cut_coupling.h"
#include "solver/fluids/translate.h"
#include "tests/support/ale_deck.h"
#include "tests/support/ale_samples.h"
#include "tests/support/deck_run.h"
#include "tests/support/each_cycle.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

/// *CONTROL_DYNAMIC_RELAXATION IDRFLG = 5: nothing is accelerated when the run begins.
namespace plash::static_starts {

namespace {

constexpr double fall = 9.81;
constexpr double bound = 1e-4; // of fall, for everything that moves
const std::string statics = "*CONTROL_DYNAMIC_RELAXATION\n250,0.001,0.995,0,0,0,0,5\n";
const std::string weight = "*LOAD_BODY_Z\n1,9.81\n*DEFINE_CURVE\n1,2\n0,1\n1e9,1\n"; // acts in both phases
const std::string one_cycle = "*CONTROL_TERMINATION\n1,1\n";

/// What the first cycle of a run sees, over fall [-].
double largest_acceleration(const Clock& clock, const State& state)
{
    double largest = 0;
    for (const Vec3& v : state.velocity)
        for (const auto component : vector_component)
            largest = std::max(largest, std::abs(v.*component) / clock.velocity_step() / fall);
    return largest;
}

/// The same of a deck without an Eulerian mesh.
double first_unrest(testing::DeckRun& deck)
{
    double largest = 1;
    Recorders recorders;
    recorders.push_back(std::make_unique<EachCycle>([&](const Clock& clock, const State& state) {
        if (clock.cycle == 0) largest = largest_acceleration(clock, state);
    }));
    deck.outcome = run(*deck.scene, recorders);
    EXPECT_EQ(deck.outcome.termination, Outcome::Termination::normal) << deck.outcome.message;
    return largest;
}

/// A basin of Lagrangian water of 4 x 4 x 8 cubes of 0.1 between slipping walls.
/// shaken  nodes inside stand off by up to this share of a cube along each axis
std::string basin_of_solids(double shaken = 0, int hourglass_control = 1)
{
    constexpr int across = 4, layers = 8;
    std::minstd_rand random(1);
    std::string nodes = "*NODE\n", solids = "*ELEMENT_SOLID\n", fixed = "*BOUNDARY_SPC_NODE\n";
    const auto number = [&](int i, int j, int k) { return 1 + i + (across + 1) * (j + (across + 1) * k); };
    for (int k = 0; k <= layers; ++k)
        for (int j = 0; j <= across; ++j)
            for (int i = 0; i <= across; ++i) {
                const int n = number(i, j, k);
                const auto place = [&](int step, bool on_side) {
                    return 0.1 * (step + (on_side ? 0 : shaken * (2.0 * random() / random.max() - 1)));
                };
                const double x = place(i, i % across == 0), y = place(j, j % across == 0);
                nodes += fmt::format("{},{:.9g},{:.9g},{:.9g}\n", n, x, y, place(k, k % layers == 0));
                fixed += fmt::format("{},0,{},{},{},0,0,0\n", n, int(i % across == 0), int(j % across == 0),
                                     int(k == 0));
                if (i == across || j == across || k == layers) continue;
                solids += fmt::format("{},1,{},{},{},{},{},{},{},{}\n", n, n, number(i + 1, j, k),
                                      number(i + 1, j + 1, k), number(i, j + 1, k), number(i, j, k + 1),
                                      number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1),
                                      number(i, j + 1, k + 1));
            }
    return "*KEYWORD\n" + one_cycle + "*PART\nwater\n1,1,1,1,1\n*SECTION_SOLID\n1,1\n*HOURGLASS\n1," +
           fmt::format("{},{}\n", hourglass_control, hourglass_control == 4 ? 0.1 : 1e-3) +
           "*MAT_NULL\n1,1000,-1e20\n*EOS_GRUNEISEN\n1,1484,1.75,0,0,0.28\n0,1\n" + weight + statics + nodes +
           solids + fixed + "*END\n";
}

/// A basin of particles 0.4 x 0.4 x 0.6 between mirrors, 0.1 apart.
std::string basin_of_particles()
{
    std::string deck = "*KEYWORD\n" + one_cycle +
                       "*PART\nwater\n1,1,1,1\n*SECTION_SPH\n1,1.5\n*PLASH_SPH_FORMULATION\n4,0.1\n"
                       "*MAT_NULL\n1,1000,-1e20\n*EOS_MURNAGHAN\n1,7.0,228571\n"
                       "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n0.4,0,0,-1,0,0\n0,0,0,0,1,0\n"
                       "0,0.4,0,0,-1,0\n0,0,0,0,0,1\n" +
                       weight + statics;
    std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
    for (int n = 0; n < 96; ++n) {
        nodes += fmt::format("{},{},{},{}\n", n + 1, 0.05 + 0.1 * (n % 4), 0.05 + 0.1 * (n / 4 % 4),
                             0.05 + 0.1 * (n / 16));
        elements += fmt::format("{},1,1.0\n", n + 1);
    }
    return deck + nodes + elements + "*END\n";
}

/// Largest acceleration of the structure and of the water at the start, over fall.
struct Unrest {
    double structure = 0, water = 0;
};

/// Water: nodes of the mesh with a thousandth of the heaviest one's mass or more.
Unrest unrest_of(testing::EulerianRun& run)
{
    Unrest unrest;
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    const Outcome outcome = run.run([&](const Clock& clock, const State& state) {
        if (clock.cycle == 0) unrest.structure = largest_acceleration(clock, state);
        if (clock.cycle != 1) return;
        const AlignedDoubles& mass = fluid.fields.node_mass;
        const double heaviest = *std::max_element(mass.begin(), mass.end());
        for (const auto& component : fluid.fields.velocity)
            for (std::size_t place = 0; place < mass.size(); ++place)
                if (mass[place] > 1e-3 * heaviest)
                    unrest.water =
                        std::max(unrest.water, std::abs(component[place]) / clock.last_step / fall);
    });
    const RelaxationOutcome& start = outcome.relaxation;
    EXPECT_NEAR(start.fluid_acceleration, unrest.water, 1e-6 + 0.01 * unrest.water);
    EXPECT_EQ(start.converged, std::max(unrest.structure, unrest.water) < bound);
    return unrest;
}

std::string hydrostatic(double level)
{
    return fmt::format("*NODE\n90000,0,0,{}\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n*INITIAL_HYDROSTATIC_ALE\n"
                       "10,1,5,9.81\n90000,1\n",
                       level);
}

/// A mesh 0.4 wide of 16 cells along each edge.
std::string tank_of_cells()
{
    return testing::structured_mesh({0, 0, 0}, {0.4, 0.4, 0.4}, {16, 16, 16}) +
           testing::liquid_and_void(1000, 1500);
}

} // namespace

// Regular layers carry their weight exactly. Measured 2e-7 g, 73 sums of forces; 1 g without the static
// start.
TEST(StaticStart, LagrangianWaterRests)
{
    const Threads one(1);
    testing::DeckRun run(basin_of_solids());
    const double unrest = first_unrest(run);
    const RelaxationOutcome& start = run.outcome.relaxation;
    EXPECT_TRUE(start.statics && start.converged);
    EXPECT_NEAR(start.first_acceleration, 1, 1e-6);
    EXPECT_LT(start.last_acceleration, bound);
    EXPECT_LT(unrest, bound);
    // The column is shorter by rho g H^2 / (2 K): layers with lumped masses sum up to just this.
    const double shortening = 1000 * fall * 0.8 * 0.8 / (2 * 1000 * 1484.0 * 1484.0);
    EXPECT_NEAR(0.8 - run.scene->state.position.back().z, shortening, 1e-4 * shortening);
}

// Particles find the places at which their kernels bear the weight. Measured below 1e-5 g; with the depth's
// pressures alone the free surface, where the sums of the kernel end, is not in balance.
TEST(StaticStart, ParticlesRest)
{
    const Threads one(1);
    testing::DeckRun run(basin_of_particles());
    const double unrest = first_unrest(run);
    const RelaxationOutcome& start = run.outcome.relaxation;
    EXPECT_TRUE(start.converged);
    EXPECT_NEAR(start.first_acceleration, 1, 1e-6);
    EXPECT_LT(start.last_acceleration, bound);
    EXPECT_LT(unrest, bound);
    for (std::size_t node = 0; node < run.scene->state.size();
         ++node) // rho g H^2 / (2 K) is 1e-3 of the depth
        EXPECT_LT(norm(run.scene->state.position[node] - run.read->model.nodes.position[node]), 0.02);
}

// A strip of shells, clamped at one end, hangs by rho t g L^4 / (8 E I) (Euler and Bernoulli). Ten elements
// that bend with a rotation constant in each, and shear: within 1 %.
TEST(StaticStart, StripHangsAsBeamTheorySays)
{
    const Threads one(1);
    std::string nodes = "*NODE\n", shells = "*ELEMENT_SHELL\n";
    for (int i = 0; i <= 10; ++i)
        nodes += fmt::format("{},{},0,0\n{},{},0.1,0\n", 2 * i + 1, 0.1 * i, 2 * i + 2, 0.1 * i);
    for (int i = 0; i < 10; ++i)
        shells += fmt::format("{},1,{},{},{},{}\n", i + 1, 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2);
    testing::DeckRun run("*KEYWORD\n" + one_cycle +
                         "*PART\nstrip\n1,1,1\n*SECTION_SHELL\n1,2\n0.02,0.02,0.02,0.02\n"
                         "*MAT_ELASTIC\n1,7800,2e11,0.0\n*BOUNDARY_SPC_NODE\n1,0,1,1,1,1,1,1\n"
                         "2,0,1,1,1,1,1,1\n" +
                         weight + statics + nodes + shells + "*END\n");
    run.go();
    EXPECT_LT(run.outcome.relaxation.last_acceleration, bound);
    const double theory = 7800 * fall * 12 / (8 * 2e11 * 0.02 * 0.02);
    EXPECT_NEAR(-run.scene->state.position.back().z, theory, 0.01 * theory);
}

/// A rigid box without a lid that floats in an Eulerian tank.
/// off   by how much it stands beside faces of cells, along each axis [length]
/// room  between its sides and floor and the water of the deck's filling [length]
std::string floating_box(const Vec3& off, bool cut_cells, double level = 0.25, double end = 2e-5,
                         double room = 0)
{
    constexpr double side = 0.15;
    const Vec3 o = Vec3{0.125, 0.125, 0.175} + off, x{side, 0, 0}, y{0, side, 0}, z{0, 0, side};
    int first = 100000;
    const auto patch = [&](Vec3 corner, Vec3 a, Vec3 b) {
        return testing::shell_patch(20, first, corner, a, b, 6, 6);
    };
    std::string shells = patch(o, y, x); // floor, outward; then both sides along x and y
    shells += patch(o, z, y);
    shells += patch(o + x, y, z);
    shells += patch(o, x, z);
    shells += patch(o + y, z, x);
    return tank_of_cells() + "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n" +
           fmt::format("5,0,1\n0,0,0,1,1,{}\n5,0,2\n{},{},{},{},{},1\n", level, o.x - room, o.y - room,
                       o.z - room, o.x + side + room, o.y + side + room) +
           hydrostatic(level) +
           fmt::format("*PART\nbox\n20,20,20\n*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n"
                       "*MAT_RIGID\n20,{},2e11,0.3\n1,4,7\n\n"
                       "*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,2,4,2,1\n0,0,0.1,0,0.3,0,0,0.2\n",
                       3000 * (level - o.z) / side) +
           (cut_cells ? "*PLASH_ALE_FORMULATION\n0,1\n" : "") + shells + weight + statics +
           testing::closed(end);
}

// With its floor and walls on faces of cells. Measured: box 1e-9 g, water 2e-6 g.
TEST(StaticStart, BoxFloatsAtRest)
{
    const Threads one(1);
    testing::EulerianRun run(floating_box({}, false));
    const Unrest unrest = unrest_of(run);
    EXPECT_LT(unrest.structure, bound);
    EXPECT_LT(unrest.water, bound);
}

// Its floor and walls anywhere in the cells that they cut, level or not with them: 0.4 of a cell beside their
// faces, on their faces, and all but on them; a fifth, and a fiftieth, of the uppermost layer of cells wet.
// Cuts are known to round-off, and so are the pressures. While faces of cut cells spared the light nodes at
// the level and those of whole cells behind them did not: 0.165 and 0.57 g. Measured: box 2e-7 g; water 3e-8
// to 7e-7 g, and after 200 cycles 2e-9 of a velocity (g times the time is 0.02).
TEST(StaticStart, BoxFloatsAtRestInCutCells)
{
    const Threads one(1);
    const std::tuple<Vec3, double, double> cases[] = {{{0.01, 0.01, 0.01}, 0.25, 2e-3},
                                                      {{0.01, 0.01, 0.01}, 0.24, 2e-5},
                                                      {{}, 0.25, 2e-5},
                                                      {{1e-4, -1e-5, 0.0124}, 0.255, 2e-5},
                                                      {{1e-5, 1e-5, 1e-5}, 0.2505, 2e-5}};
    for (const auto& [off, level, end] : cases) {
        testing::EulerianRun run(floating_box(off, true, level, end));
        const Unrest unrest = unrest_of(run);
        EXPECT_LT(unrest.structure, 0.01 * bound);
        EXPECT_LT(unrest.water, 0.01 * bound);
        const FluidFields& fields = run.term<EulerianFluid>().fluid().fields;
        const double heaviest = *std::max_element(fields.node_mass.begin(), fields.node_mass.end());
        for (std::size_t place = 0; place < fields.node_mass.size(); ++place)
            for (const AlignedDoubles& component : fields.velocity)
                ASSERT_TRUE(std::abs(component[place]) < bound * fall * end ||
                            fields.node_mass[place] < 1e-3 * heaviest);
    }
}

// Water at rest reaches to the surface, though the deck's filling leaves 0.3 of a cell before it: the run
// says so.
TEST(StaticStart, WaterReachesToTheSurfaceThatCutsItsCells)
{
    const Threads one(1);
    testing::EulerianRun run(floating_box({0.01, 0.01, 0.01}, true, 0.25, 2e-5, 0.3 * 0.025));
    const std::vector<std::string> notices = run.term<CutCoupling>().notices(run.scene().state);
    ASSERT_EQ(notices.size(), 2u);
    EXPECT_NE(notices[1].find("differs from that by up to 0.51 "), std::string::npos) << notices[1];
    EXPECT_LT(unrest_of(run).water, 0.01 * bound);
    testing::EulerianRun fitting(floating_box({0.01, 0.01, 0.01}, true));
    EXPECT_EQ(fitting.term<CutCoupling>().notices(fitting.scene().state).size(), 1u);
}

// Springs hand the water's pressure to nodes by the places of their points: where edges and corners of a box
// cut cells no pressures of these have such sums. The start says so.
TEST(StaticStart, WaterThatDoesNotRestIsNamed)
{
    const Threads one(1);
    testing::EulerianRun run(floating_box({0.01, 0.01, 0.01}, false));
    const Unrest unrest = unrest_of(run);
    EXPECT_LT(unrest.structure, bound);
    EXPECT_GT(unrest.water, 1);
}

/// A tank of elastic walls, clamped along their edges, on a rigid floor, full of Eulerian water half a cell
/// high and more. Its walls move outward by `bulge` at least.
/// off  of them beside faces [length]
void expect_tank_at_rest(double thickness, double bulge, double water, bool cut_cells = false, double off = 0)
{
    const Threads one(1);
    constexpr double side = 0.2;
    const double low = 0.1 + off, level = low + 0.15;
    constexpr int elements = 8, of_patch = (elements + 1) * (elements + 1);
    int first = 100000;
    const Vec3 o{low, low, low}, x{side, 0, 0}, y{0, side, 0}, z{0, 0, side};
    std::string text = testing::shell_patch(21, first, o, x, y, elements, elements);
    std::string fixed = "*BOUNDARY_SPC_NODE\n";
    const std::tuple<Vec3, Vec3, Vec3, bool> walls[] = {// along them, upward or the other way round
                                                        {o, y, z, true},
                                                        {o + x, z, y, false},
                                                        {o, z, x, false},
                                                        {o + y, x, z, true}};
    for (const auto& [corner, a, b, along_first] : walls) {
        for (int n = 0; n < of_patch; ++n) {
            const int i = n % (elements + 1), j = n / (elements + 1);
            const int along = along_first ? i : j, up = along_first ? j : i;
            if (up == 0 || along % elements == 0) fixed += fmt::format("{},0,1,1,1,1,1,1\n", first + n);
        }
        text += testing::shell_patch(20, first, corner, a, b, elements, elements);
    }
    testing::EulerianRun run(
        tank_of_cells() + testing::liquid_in_box({low, low, low}, {low + side, low + side, level}) +
        hydrostatic(level) + "*PART\nwalls\n20,20,20\n*SECTION_SHELL\n20,2\n" +
        fmt::format("{0},{0},{0},{0}\n", thickness) +
        "*MAT_ELASTIC\n20,7800,2e11,0.3\n*PART\nfloor\n21,20,21\n*MAT_RIGID\n21,7800,2e11,0.3\n1,7,7\n\n"
        "*SET_PART_LIST\n30\n20,21\n"
        "*CONSTRAINED_LAGRANGE_IN_SOLID\n30,10,0,1,2,4,2,1\n0,0,0.1,0,0.3,0,0,0.2\n" +
        (cut_cells ? "*PLASH_ALE_FORMULATION\n0,1\n" : "") + text + fixed + weight + statics +
        testing::closed(2e-5));
    const Unrest unrest = unrest_of(run);
    EXPECT_LT(unrest.structure, bound);
    EXPECT_LT(unrest.water, water);
    double outward = 0; // the walls do bear the water
    for (std::size_t node = 0; node < run.scene().state.size(); ++node)
        outward = std::max(outward, run.scene().state.position[node].x - run.model().nodes.position[node].x);
    EXPECT_GT(outward, bulge);
}

// Measured: walls 2e-7 g, water 9e-6 g; about 225 sums of forces.
TEST(StaticStart, ElasticTankRestsWithItsWater)
{
    expect_tank_at_rest(0.01, 1e-8, bound);
}
// Walls that move by 1.2e-6 slope by 5e-5, which the faces of the water's cells do not: 1.04e-3 g in the
// water.
TEST(StaticStart, ThinTankRestsWithItsWater)
{
    expect_tank_at_rest(0.002, 1e-6, 1.5e-3);
}

// Cuts follow the slope. Walls 0.4 of a cell from faces, and on faces, which they cross as they bulge by
// 8e-6; measured: walls 6e-6 g, water 4e-8 and 2e-7 g. While pieces of the walls bore pressures by those in
// their middles, crossing a face changed what nodes bear, and walls on faces stayed at 0.88 g.
TEST(StaticStart, ThinTankRestsWithItsWaterInCutCells)
{
    for (const double off : {0.01, 0.}) expect_tank_at_rest(0.002, 1e-6, bound, true, off);
}

// Water on a distorted mesh: nodes stand off by up to a tenth of a cell. Pressures constant in cells cannot
// carry the weight of lumped masses there: with the nodes where they are the least largest acceleration over
// all pressures is 0.044 g (linear programming), that of the smallest sum of squares 0.062 g. Measured 0.055
// g. Stiffness against hourglassing (IHQ = 4) gives every node a place at rest. Measured 7e-9 g, 334 sums.
TEST(StaticStart, DistortedWaterRestsAsFarAsPressuresCarryIt)
{
    const Threads one(1);
    testing::DeckRun bare(basin_of_solids(0.1, 1));
    first_unrest(bare);
    EXPECT_FALSE(bare.outcome.relaxation.converged);
    EXPECT_LT(bare.outcome.relaxation.last_acceleration, 0.062);
    EXPECT_LT(bare.outcome.relaxation.cycles, 10000);
    testing::DeckRun stiff(basin_of_solids(0.1, 4));
    EXPECT_LT(first_unrest(stiff), bound);
    EXPECT_TRUE(stiff.outcome.relaxation.converged);
    EXPECT_LT(stiff.outcome.relaxation.cycles, 1000);
}

// The hydrostatic start of an Eulerian mesh goes with its water into both other forms.
TEST(StaticStart, HydrostaticWaterRestsInEveryForm)
{
    const Threads one(1);
    const std::string deck = "*KEYWORD\n" + testing::structured_mesh({0, 0, 0}, {0.4, 0.4, 0.6}, {4, 4, 6}) +
                             testing::liquid_and_void(1000, 50, -1e20) +
                             testing::liquid_in_box({0, 0, 0}, {1, 1, 0.5}) + hydrostatic(0.5) +
                             testing::gravity(fall) + testing::closed(1e-6);
    for (const char* form : {"sph", "lagrange"}) {
        ReadResult read = read_model_text("deck.k", deck);
        const std::vector<std::string> lines = translate_fluid(read.model, fluid_choice_of(read.model, form));
        EXPECT_EQ(lines.back(), "  *INITIAL_HYDROSTATIC_ALE became a static start (IDRFLG = 5)") << form;
        Scene scene = make_scene(read.model);
        Recorders recorders;
        const Outcome outcome = run(scene, recorders);
        EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        EXPECT_NEAR(outcome.relaxation.first_acceleration, 1, 1e-6) << form;
        EXPECT_LT(outcome.relaxation.last_acceleration, bound) << form;
    }
}

} // namespace plash::static_starts

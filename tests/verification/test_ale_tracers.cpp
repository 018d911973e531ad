#include "ale/tracers.h"
#include "output/history_reader.h"
#include "output/recorders.h"
#include "output/trhist.h"
#include "tests/support/ale_deck.h"
#include "tests/support/lsda_reader.h"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

namespace plash {

namespace {

using testing::EulerianRun;
using Rows = std::vector<ElementResults::Tracer>;

Rows tracers_now(EulerianRun& run)
{
    ElementResults results;
    results.tracers_wanted = true;
    run.term<Tracers>().collect(run.scene().state, results);
    return results.tracers;
}

constexpr const char* trhist = "*DATABASE_TRHIST\n0.01,3\n";

} // namespace

// A liquid that flows as a whole, everywhere with the same velocity, through a mesh with open sides: a tracer
// of the material goes v t, to round-off; one that is fixed in space, or tied to a mesh that stands, stays;
// one that begins later goes from then on; one that has flowed out of the mesh is not active any more.
TEST(AleTracers, GoExactlyWithUniformFlow)
{
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 0.5, 0.5}, {20, 10, 10}) +
                    testing::liquid_and_void(1000, 100) +
                    "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n5,0,1,8,2,-1\n-1,-1,-1,2,2,2\n"
                    "*DATABASE_TRACER\n0,0,0.11,0.2,0.3,1\n0,1,0.11,0.2,0.3\n0,2,0.11,0.2,0.3\n"
                    "0.02,0,0.11,0.2,0.3\n0,0,0.9,0.2,0.3\n0,1,3,0.2,0.3\n" +
                    std::string(trhist) +
                    "*CONTROL_ALE\n-1,1,2,-1\n*CONTROL_TERMINATION\n0.05\n*CONTROL_TIMESTEP\n0,0.5\n*END\n");
    const double end = run.run().clock.time;
    const Rows rows = tracers_now(run);
    ASSERT_EQ(rows.size(), 6);
    const auto expect_at = [](const Vec3& place, Vec3 wanted) {
        EXPECT_NEAR(place.x, wanted.x, 1e-12);
        EXPECT_NEAR(place.y, wanted.y, 1e-12);
        EXPECT_NEAR(place.z, wanted.z, 1e-12);
    };
    expect_at(rows[0].place, {0.11 + 8 * end, 0.2 + 2 * end, 0.3 - end});
    EXPECT_TRUE(rows[0].active);
    EXPECT_NEAR(rows[0].velocity.x, 8, 1e-11);
    EXPECT_NEAR(rows[0].density, 1000, 1e-8);
    EXPECT_NEAR(rows[0].relative_volume, 1, 1e-11);
    expect_at(rows[1].place, {0.11, 0.2, 0.3});
    EXPECT_NEAR(rows[1].velocity.x, 8, 1e-11);
    expect_at(rows[2].place, {0.11, 0.2, 0.3});
    EXPECT_NEAR(rows[3].place.x, 0.11 + 8 * (end - 0.02), 8 * 5e-4); // begins with a cycle, of less than 5e-4
    EXPECT_FALSE(rows[4].active);
    EXPECT_GT(rows[4].place.x, 1);
    EXPECT_FALSE(rows[5].active);
    EXPECT_EQ(run.term<Tracers>().notices(run.scene().state).size(), 2); // beside the mesh: then and now
}

// A velocity field that turns rigidly and steadily: trilinear velocities are exact, so what is left is the
// error of the steps in time. After a turn the circle closes with an error that falls with their square:
// Heun's phase errs by z^2/6 of the angle with z = angle of a step, 2 pi r z^2 / 6 in place.
TEST(AleTracers, CircleClosesWithTheSquareOfTheStep)
{
    const auto miss_after_a_turn = [](int steps) {
        EulerianRun run(testing::structured_mesh({-1, -1, 0}, {1, 1, 0.2}, {10, 10, 1}) +
                        testing::liquid_and_void(1000, 100) +
                        testing::liquid_in_box({-2, -2, -1}, {2, 2, 1}) +
                        "*DATABASE_TRACER\n0,0,0.6,0.1,0.05\n" + trhist + testing::closed(1));
        EulerianFluid& term = run.term<EulerianFluid>();
        Clock clock;
        State& state = run.scene().state;
        term.add_forces(clock, state); // fills the mesh and weighs its nodes
        Fluid& fluid = term.fluid();
        for (std::size_t number = 0; number < term.block().nodes.size(); ++number) {
            const Vec3& x = run.model().nodes.position[term.block().nodes[number]];
            const std::ptrdiff_t place = fluid.node_place(number);
            fluid.fields.velocity[0][place] = -2 * std::numbers::pi * x.y;
            fluid.fields.velocity[1][place] = 2 * std::numbers::pi * x.x;
        }
        Tracers& tracers = run.term<Tracers>();
        clock.step = 1.0 / steps;
        for (int step = 0; step < steps; ++step) {
            tracers.add_forces(clock, state);
            tracers.after_motion(clock, state);
            clock.time += clock.step;
        }
        return norm(tracers_now(run).front().place - Vec3{0.6, 0.1, 0.05});
    };
    const double coarse = miss_after_a_turn(50), fine = miss_after_a_turn(100);
    const double angle = 2 * std::numbers::pi / 50;
    EXPECT_NEAR(coarse, 2 * std::numbers::pi * std::hypot(0.6, 0.1) * angle * angle / 6, 0.05 * coarse);
    EXPECT_NEAR(coarse / fine, 4, 0.1);
}

// Water at rest, 10 m deep in cells of half a metre: stress, density and relative volume at points that lie
// anywhere within their cells are those of the hydrostatic column (K mu: p = K (exp(rho g h / K) - 1)), as
// near as linear interpolation between cells can tell; in text, binout and history.h5 alike.
TEST(AleTracers, FeelTheHydrostaticPressure)
{
    const testing::TemporaryFolder folder;
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, 1, 12}, {2, 2, 24}) +
                    testing::liquid_and_void(1000, 1000) + testing::liquid_in_box({0, 0, 0}, {1, 1, 10}) +
                    "*NODE\n90000,0,0,10\n90001,0.6,0.3,7.1\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n"
                    "*INITIAL_HYDROSTATIC_ALE\n10,1,5,9.81\n90000,1\n"
                    "*DATABASE_TRACER\n0,1,0.3,0.3,4.37\n0,0,0.7,0.6,8.81,1\n0,1,0.3,0.3,11\n"
                    "*DATABASE_TRACER_ALE\n90001,1,1\n" +
                    std::string(trhist) + testing::gravity(9.81) + testing::closed(0.02));
    Recorders recorders;
    for (auto& recorder : make_recorders(run.model(), folder.path().string()))
        recorders.push_back(std::move(recorder));
    const Outcome outcome = plash::run(run.scene(), recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    recorders.clear();
    const double stiffness = 1e9;
    const auto pressure_at = [&](double z) {
        return stiffness * std::expm1(1000 * 9.81 * (10 - z) / stiffness);
    };
    const Rows rows = tracers_now(run);
    ASSERT_EQ(rows.size(), 4);
    for (const auto& [row, z] : {std::pair(0, 4.37), std::pair(1, 8.81), std::pair(3, 7.1)}) {
        EXPECT_TRUE(rows[row].active);
        EXPECT_NEAR(-rows[row].stress.zz, pressure_at(z), 2e-4 * 1000 * 9.81) << z; // 0.2 mm of water
        EXPECT_NEAR(rows[row].stress.xx, rows[row].stress.zz, 1e-9);
        EXPECT_NEAR(rows[row].density, 1000 * (1 + pressure_at(z) / stiffness), 1e-6);
        EXPECT_NEAR(rows[row].relative_volume * rows[row].density, 1000, 1e-9);
    }
    EXPECT_FALSE(rows[2].active); // in the void

    const std::string text = bytes_of(folder / "trhist");
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "Tracer particle file");
    int count = 0, columns = 0;
    lines >> count >> columns;
    EXPECT_EQ(count, 4);
    EXPECT_EQ(columns, 16);
    for (int skip = 0; skip < 4; ++skip) std::getline(lines, line);
    EXPECT_EQ(line, "efp rho rvol active");
    std::vector<double> numbers;
    for (double value; lines >> value;) numbers.push_back(value);
    ASSERT_EQ(numbers.size() % (1 + 4 * 16), 0);
    EXPECT_EQ(numbers.size() / (1 + 4 * 16), 3); // at 0, 0.01 and 0.02
    const std::size_t last = numbers.size() - 4 * 16;
    EXPECT_NEAR(numbers[last + 2], 4.37, 1e-6);
    EXPECT_NEAR(numbers[last + 8], rows[0].stress.zz, 1e-6 * -rows[0].stress.zz);
    EXPECT_EQ(numbers[last + 15], 1);
    EXPECT_EQ(numbers[last + 32 + 15], 0);

    const auto arrays = testing::read_lsda(bytes_of(folder / "binout0000"));
    ASSERT_TRUE(arrays.contains("/trhist/d000003/sz"));
    EXPECT_NEAR(arrays.at("/trhist/d000003/sz").reals()[0], rows[0].stress.zz, 1e-3);
    EXPECT_EQ(arrays.at("/trhist/d000003/active").wholes()[2], 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "history.h5"));
}

// A solid whose nodes are drawn apart along x at speeds that grow linearly: a tracer of the material keeps
// its share of the length, stress is (lambda + 2 mu) ln(stretch) in the midst of uniaxial strain, density
// falls with the volume; one that is fixed in space sees the material pass, until it has passed.
TEST(AleTracers, GoWithASolid)
{
    std::string deck = "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,7800,2e11,0.3\n*NODE\n";
    std::string driven;
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                const int node = 1 + i + 2 * j + 4 * k;
                deck += fmt::format("{},{},{},{}\n", node, 1 + i, j, k);
                for (int axis = 1; axis <= 3; ++axis)
                    driven += fmt::format("{},{},0,1,{}\n", node, axis, axis == 1 ? 1 + i : 0);
            }
    deck += "*ELEMENT_SOLID\n1,1,1,2,4,3,5,6,8,7\n*BOUNDARY_PRESCRIBED_MOTION_NODE\n" + driven +
            "*DEFINE_CURVE\n1\n0,1\n1,1\n*DATABASE_TRACER\n0,0,1.25,0.5,0.125\n0,1,1.25,0.5,0.5\n"
            "0,1,1.001,0.5,0.5\n" +
            trhist + "*CONTROL_TERMINATION\n0.01\n*END\n";
    EulerianRun run(deck);
    Rows rows, first;
    const testing::TemporaryFolder folder;
    Recorders recorders;
    struct Keep final : Recorder {
        Rows &rows, &first;
        Keep(Rows& r, Rows& f) : rows(r), first(f) {}
        double next_time() const override { return 0; }
        void write(const Snapshot&) override {}
        void finish(const Snapshot& snapshot) override { rows = tracer_states(snapshot); }
    };
    recorders.push_back(std::make_unique<Keep>(rows, first));
    const Outcome outcome = plash::run(run.scene(), recorders);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    const double end = outcome.clock.time;
    ASSERT_EQ(rows.size(), 3);
    EXPECT_NEAR(rows[0].place.x, 1.25 + end * 1.25, 1e-9);
    EXPECT_NEAR(rows[0].place.y, 0.5, 1e-12);
    EXPECT_NEAR(rows[0].place.z, 0.125, 1e-12);
    EXPECT_NEAR(rows[0].velocity.x, 1.25, 1e-9);
    const double lame = 2e11 * 0.3 / (1.3 * 0.4), shear = 2e11 / 2.6;
    const double stress = (lame + 2 * shear) * std::log(1 + end);
    EXPECT_NEAR(rows[0].stress.xx, stress, 1e-4 * stress); // of the steps of the stress update
    EXPECT_NEAR(rows[0].relative_volume, 1 + end, 1e-9);
    EXPECT_NEAR(rows[0].density, 7800 / (1 + end), 1e-5);
    EXPECT_TRUE(rows[0].active);
    EXPECT_EQ(rows[1].place.x, 1.25);
    EXPECT_NEAR(rows[1].velocity.x, 1.25 / (1 + end), 1e-9); // what is there now came from x / (1 + t)
    EXPECT_NEAR(rows[1].stress.xx, stress, 1e-4 * stress);
    EXPECT_FALSE(rows[2].active);
    EXPECT_EQ(rows[2].stress.xx, 0);
}

} // namespace plash

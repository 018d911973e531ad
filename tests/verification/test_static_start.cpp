#include "tests/support/ale_deck.h"
#include "tests/support/deck_run.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

/// *CONTROL_DYNAMIC_RELAXATION IDRFLG = 5: nothing is accelerated when the run begins.
namespace plash::static_starts {

namespace {

constexpr double fall = 9.81;
const std::string statics = "*CONTROL_DYNAMIC_RELAXATION\n250,0.001,0.995,0,0,0,0,5\n";
const std::string weight = "*LOAD_BODY_Z\n1,9.81\n*DEFINE_CURVE\n1,2\n0,1\n1e9,1\n"; // acts in both phases

/// What the first cycle of the run sees [acceleration].
double largest_acceleration(const Clock& clock, const State& state)
{
    double largest = 0;
    for (const Vec3& v : state.velocity)
        for (const auto component : vector_component)
            largest = std::max(largest, std::abs(v.*component) / clock.velocity_step());
    return largest;
}

/// Largest acceleration of the structure and of the water, and where the first node stands.
struct Unrest {
    double structure = 0, water = 0, first_height = 0, fastest = 0;
    long sums = 0;
};

Unrest unrest_of(testing::EulerianRun& run)
{
    Unrest unrest;
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    // Nodes with next to no water fall as spray does.
    const auto fastest = [&] {
        const AlignedDoubles& mass = fluid.fields.node_mass;
        const double heaviest = *std::max_element(mass.begin(), mass.end());
        double largest = 0;
        for (const auto& component : fluid.fields.velocity)
            for (std::size_t place = 0; place < mass.size(); ++place)
                if (mass[place] > 1e-3 * heaviest) largest = std::max(largest, std::abs(component[place]));
        return largest;
    };
    const Outcome outcome = run.run([&](const Clock& clock, const State& state) {
        if (clock.cycle == 0 && !clock.relaxing) unrest.structure = largest_acceleration(clock, state);
        if (clock.cycle == 1) {
            unrest.water = fastest() / clock.last_step;
        }
        if (clock.cycle > 0 && clock.cycle < 8) {//DBG
            const BoxFluid& box = run.term<EulerianFluid>().box();
            double f = fastest();
            int shown = 0;
            for (std::size_t n = 0; n < box.node_count(); ++n) {
                const auto place = box.node_place(n);
                const Index node = run.term<EulerianFluid>().block().nodes[n];
                for (int a = 0; a < 3; ++a)
                    if (std::abs(box.fields.velocity[a][place]) > 0.9 * f && box.fields.node_mass[place] > 1e-5 && ++shown < 5) printf("DBG %ld axis %d %.3g g at %.4f %.4f %.4f mass %.3g\n", clock.cycle, a, box.fields.velocity[a][place] / clock.time / fall, state.position[node].x, state.position[node].y, state.position[node].z, box.fields.node_mass[place]);
            }
        }//DBG
    });
    unrest.fastest = fastest();
    unrest.sums = outcome.relaxation.cycles;
    EXPECT_TRUE(outcome.relaxation.converged);
    return unrest;
}

/// A tank 0.4 wide of 16 cells along each edge, filled to a level, in which a rigid box without a lid, 0.15
/// wide, floats with its floor at a height.
Unrest floating_box(double floor, double weighs_as_floor_at, double low = 0.125)
{
    constexpr double side = 0.15, level = 0.25;
    constexpr int elements = 6;
    const double sunk = (level - weighs_as_floor_at) / side;
    int first = 100000;
    const Vec3 o{low, low, floor}, x{side, 0, 0}, y{0, side, 0}, z{0, 0, side};
    const auto patch = [&](Vec3 corner, Vec3 a, Vec3 b) {
        return testing::shell_patch(20, first, corner, a, b, elements, elements);
    };
    std::string shells = patch(o, y, x); // floor, outward; then both sides along x and y
    shells += patch(o, z, y);
    shells += patch(o + x, y, z);
    shells += patch(o, x, z);
    shells += patch(o + y, z, x);
    testing::EulerianRun run(
        testing::structured_mesh({0, 0, 0}, {0.4, 0.4, 0.4}, {16, 16, 16}) +
        testing::liquid_and_void(1000, 1500) + "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n" +
        fmt::format("5,0,1\n0,0,0,1,1,{}\n5,0,2\n{},{},{},{},{},1\n", level, low, low, floor, low + side,
                    low + side) +
        fmt::format("*NODE\n90000,0,0,{}\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n*INITIAL_HYDROSTATIC_ALE\n"
                    "10,1,5,9.81\n90000,1\n",
                    level) +
        fmt::format("*PART\nstructure\n20,20,20\n*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n"
                    "*MAT_RIGID\n20,{},2e11,0.3\n1,4,7\n\n"
                    "*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,2,4,2,1\n0,0,0.1,0,0.3,0,0,0.2\n",
                    3000 * sunk) +
        shells + weight + statics + testing::closed(2e-4));
    return unrest_of(run);
}

} // namespace

TEST(StaticStart, FloatingBox)
{
    for (auto [floor, as, low] : {std::tuple(0.175, 0.175, 0.125), std::tuple(0.165, 0.165, 0.125), std::tuple(0.175, 0.175, 0.1275)}) {
        const Unrest unrest = floating_box(floor, as, low);
        printf("floor %g as %g low %g: structure %.2e g water %.2e g, fastest %.2e sums %ld\n", floor, as, low, unrest.structure / fall, unrest.water / fall, unrest.fastest, unrest.sums);
    }
}

TEST(StaticStart, ElasticTank)
{
    constexpr double side = 0.2, low = 0.1, level = 0.25;
    constexpr int elements = 8;
    int first = 100000;
    const Vec3 o{low, low, low}, x{side, 0, 0}, y{0, side, 0}, z{0, 0, side};
    const auto patch = [&](int part, Vec3 corner, Vec3 a, Vec3 b) {
        return testing::shell_patch(part, first, corner, a, b, elements, elements);
    };
    std::string shells = patch(21, o, x, y);
    for (const auto& [corner, a, b] : {std::tuple(o, y, z), std::tuple(o + x, z, y), std::tuple(o, z, x), std::tuple(o + y, x, z)})
        shells += patch(20, corner, a, b);
    std::string fixed = "*BOUNDARY_SPC_NODE\n";
    for (int wall = 1; wall < 5; ++wall)
        for (int j = 0; j <= elements; ++j)
            for (int i = 0; i <= elements; ++i) {
                const int across = wall == 1 || wall == 4 ? i : j, up = wall == 1 || wall == 4 ? j : i;
                if (up == 0 || across == 0 || across == elements)
                    fixed += fmt::format("{},0,1,1,1,1,1,1\n", 100000 + wall * (elements + 1) * (elements + 1) + j * (elements + 1) + i);
            }
    testing::EulerianRun run(
        testing::structured_mesh({0, 0, 0}, {0.4, 0.4, 0.4}, {16, 16, 16}) +
        testing::liquid_and_void(1000, 1500) + testing::liquid_in_box({low, low, low}, {low + side, low + side, level}) +
        fmt::format("*NODE\n90000,0,0,{}\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n*INITIAL_HYDROSTATIC_ALE\n"
                    "10,1,5,9.81\n90000,1\n",
                    level) +
        "*PART\nwalls\n20,20,20\n*SECTION_SHELL\n20,2\n0.002,0.002,0.002,0.002\n*MAT_ELASTIC\n20,7800,2e11,0.3\n"
        "*PART\nfloor\n21,20,21\n*MAT_RIGID\n21,7800,2e11,0.3\n1,7,7\n\n"
        "*SET_PART_LIST\n30\n20,21\n*CONSTRAINED_LAGRANGE_IN_SOLID\n30,10,0,1,2,4,2,1\n0,0,0.1,0,0.3,0,0,0.2\n" +
        shells + fixed + weight + statics + testing::closed(2e-4));
    const Unrest unrest = unrest_of(run);
    printf("tank: structure %.2e g water %.2e g, fastest %.2e sums %ld; reference\n", unrest.structure / fall, unrest.water / fall, unrest.fastest, unrest.sums);
}

} // namespace plash::static_starts

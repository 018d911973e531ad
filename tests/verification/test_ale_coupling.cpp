#include "tests/support/ale_deck.h"
#include "tests/support/ale_samples.h"
#include "tests/support/flat_wedge.h"

#include <gtest/gtest.h>
#include <numbers>

#include <cmath>

namespace plash {

namespace {

using testing::EulerianRun;

/// Part 20: a rigid shell, and its coupling with the mesh part 10 and the densest group.
std::string rigid_part(double density, int fixed_translations, int fixed_rotations,
                       const std::string& options)
{
    return fmt::format("*PART\nstructure\n20,20,20\n*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n"
                       "*MAT_RIGID\n20,{},2e11,0.3\n1,{},{}\n\n"
                       "*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,{}\n",
                       density, fixed_translations, fixed_rotations, options);
}

/// A tube along x, liquid at rest from x = 0.2 on, and a piston that starts into it with a given speed.
struct Piston {
    double pressure = 0, expected = 0, energy_error = 0;
};

/// place  of the plane of its shells [length]
Piston push(const std::string& coupling, double speed, double place = 0.2)
{
    constexpr double density = 1000, sound = 1500, side = 0.02, end = 3e-4;
    int first = 100000;
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {1, side, side}, {100, 2, 2}) +
                    testing::liquid_and_void(density, sound) +
                    testing::liquid_in_box({0.2, 0, 0}, {1, side, side}) + rigid_part(7800, 5, 7, coupling) +
                    testing::shell_patch(20, first, {place, 0, 0}, {0, side, 0}, {0, 0, side}, 1, 1) +
                    fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,1,0,2\n*DEFINE_CURVE\n2\n0,{}\n1,{}\n",
                                speed, speed) +
                    testing::closed(end));
    double impulse = 0, span = 0;
    const SurfaceCoupling& coupled = run.term<SurfaceCoupling>();
    run.run([&](const Clock& clock, const State&) {
        if (clock.time < 1e-4 || clock.time > 3e-4) return;
        impulse -= coupled.force().x * clock.step;
        span += clock.step;
    });
    // Pressure linear in density: rho0 c^2 mu; the shock runs at Us with Us (Us - v) = c^2.
    const double shock = 0.5 * speed + std::sqrt(0.25 * speed * speed + sound * sound);
    return {impulse / span / (side * side), density * shock * speed, run.scene().ledger.balance_error()};
}

/// A rigid box without a lid, its shells facing inward, `elements` along each edge.
std::string open_box(double low_x, double low_z, double side, int elements)
{
    int first = 100000;
    const Vec3 o{low_x, low_x, low_z}, x{side, 0, 0}, y{0, side, 0}, z{0, 0, side};
    return testing::shell_patch(20, first, o, x, y, elements, elements) +     // floor
           testing::shell_patch(20, first, o, y, z, elements, elements) +     // low x
           testing::shell_patch(20, first, o + x, z, y, elements, elements) + // high x
           testing::shell_patch(20, first, o, z, x, elements, elements) +     // low y
           testing::shell_patch(20, first, o + y, x, z, elements, elements);  // high y
}

/// Walls of a full box.
struct FullBox {
    double inward = 0;         ///< how far they stand inside the planes of the mesh [cells]
    int direction = 1;         ///< DIREC of the coupling
    bool leak_control = false; ///< ILEAK
    double push = 0;           ///< initial speed of an elastic box without gravity; else it is rigid and held
};

/// A closed box of 4 x 4 x 4 cells with walls on planes of the mesh, wholly full of water: kinetic energy of
/// all in the end over that of the start, or over that of water that falls freely as long.
double motion_in_full_box(FullBox box, double end)
{
    constexpr double cell = 0.00625, side = 4 * cell, sound = 1484, gravity = 9.81, thickness = 0.012;
    const double low = box.inward * cell, length = side - 2 * low;
    int first = 100000;
    const Vec3 o{low, low, low}, x{length, 0, 0}, y{0, length, 0}, z{0, 0, length};
    std::string shells;
    const auto patch = [&](Vec3 corner, Vec3 a, Vec3 b) {
        shells += testing::shell_patch(20, first, corner, a, b, 4, 4);
    };
    patch(o, x, y); // all normals inward
    patch(o, y, z);
    patch(o, z, x);
    patch(o + x, z, y);
    patch(o + y, x, z);
    patch(o + z, y, x);
    const bool pushed = box.push != 0;
    const std::string law =
        pushed ? "*MAT_ELASTIC\n20,940,1.1e9,0.4\n" : "*MAT_RIGID\n20,940,1.1e9,0.3\n1,7,7\n\n";
    const std::string motion = pushed ? fmt::format("*INITIAL_VELOCITY_GENERATION\n20,2,0,{}\n", box.push)
                                      : testing::gravity(gravity);
    EulerianRun run(testing::structured_mesh({-3 * cell, -3 * cell, -3 * cell},
                                             {7 * cell, 7 * cell, 7 * cell}, {10, 10, 10}) +
                    testing::liquid_and_void(1000, sound, -1) +
                    testing::liquid_in_box({0, 0, 0}, {side, side, side}) +
                    fmt::format("*PART\nbox\n20,20,20\n*SECTION_SHELL\n20,2,,5\n{}\n", thickness) + law +
                    fmt::format("*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,0,4,{},1\n0,0,0.1\n,,,{},0.1\n",
                                box.direction, box.leak_control ? 2 : 0) +
                    shells + motion + testing::closed(end));
    double kinetic = 0;
    run.run([&](const Clock&, const State&) { kinetic = run.scene().ledger.kinetic; });
    const double falling = 0.5 * 1000 * side * side * side * std::pow(gravity * end, 2);
    const double moving = 0.5 * 940 * 6 * side * side * thickness * box.push * box.push;
    return kinetic / (pushed ? moving : falling);
}

/// How a box of water moves: along an axis (0: not at all) at a speed that it reaches after 0.05 s.
struct Ride {
    int axis = 0;
    double speed = 0;
};

/// Share of the water that has left a box of 6 cells in `end` under gravity. The box stands somewhere between
/// the planes of the mesh; the water reaches up to two thirds of it.
double leak(int elements_per_edge, const std::string& coupling, double end, Ride ride = {})
{
    constexpr double cell = 0.02, side = 0.12, low = 0.0674, low_z = 0.0474;
    constexpr int held[] = {7, 5, 6, 4}; // all translations but that along the axis
    std::string drive;
    if (ride.axis != 0)
        drive = fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,{},0,2\n"
                            "*DEFINE_CURVE\n2\n0,0\n0.05,{}\n10,{}\n",
                            ride.axis, ride.speed, ride.speed);
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {0.28, 0.26, 0.22}, {14, 13, 11}) +
                    testing::liquid_and_void(1000, 60) +
                    testing::liquid_in_box({low, low, low_z}, {low + side, low + side, low_z + 0.08}) +
                    rigid_part(7800, held[ride.axis], 7, coupling) +
                    open_box(low, low_z, side, elements_per_edge) + drive + testing::gravity(9.81) +
                    testing::closed(end));
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    const double before = testing::liquid_volume(fluid);
    EXPECT_NEAR(before, side * side * 0.08, 1e-12 * before);
    run.run();
    const double way = ride.speed * (end - 0.025);
    const double x = low + (ride.axis == 1 ? way : 0), z = low_z + (ride.axis == 3 ? way : 0);
    const double outside = testing::liquid_volume(fluid, [&](Vec3 c) {
        const auto beyond = [&](double v, double from) {
            return v < from - 0.5 * cell || v > from + side + 0.5 * cell;
        };
        return beyond(c.x, x) || beyond(c.y, low) || c.z < z - 0.5 * cell;
    });
    return outside / before;
}

/// How a wedge enters water: slope of the force in time, and largest pressure.
struct Entry {
    double slope = 0; ///< of the force of the whole wedge over rho V^3, from half of the run to its end
    double peak = 0;  ///< over rho V^2 / 2
};

/// Mean pressure of a flow that only grows, by place over time: the coupling's forces on the rows of nodes of
/// a wedge, over the last quarter of the run, in intervals of the place that are a cell wide in the end.
class SelfSimilarPressure {
public:
    SelfSimilarPressure(const SurfaceCoupling& coupling, std::size_t first_node, std::size_t nodes, int rows,
                        double cell, double end)
        : coupling_(coupling), first_node_(first_node), rows_(rows), cell_(cell), end_(end)
    {
        results_.coupling_force.resize(nodes);
    }

    void take(const Clock& clock, const State& state)
    {
        if (clock.time < 0.75 * end_) return;
        std::fill(results_.coupling_force.begin(), results_.coupling_force.end(), Vec3{});
        coupling_.collect(state, results_);
        for (int row = 1; row < rows_; ++row) {
            const std::size_t node = first_node_ + 2 * row;
            const double force = results_.coupling_force[node].z + results_.coupling_force[node + 1].z;
            const auto interval = static_cast<std::size_t>(row * end_ / clock.time);
            sums_.resize(std::max(sums_.size(), interval + 1));
            sums_[interval].impulse += clock.step * force / (cell_ * cell_);
            sums_[interval].span += clock.step;
        }
    }

    double largest() const
    {
        double largest = 0;
        for (const Sum& sum : sums_)
            if (sum.span > 0) largest = std::max(largest, sum.impulse / sum.span);
        return largest;
    }

private:
    struct Sum {
        double impulse = 0, span = 0;
    };
    const SurfaceCoupling& coupling_;
    std::size_t first_node_;
    int rows_;
    double cell_, end_;
    ElementResults results_;
    std::vector<Sum> sums_;
};

/// Half of a wedge that enters water at rest with constant speed. Lengths by the half width at which the
/// wedge cuts the undisturbed surface in the end, on which there are `cells`. sound  speed of sound over that
/// of the wedge; far  where the side walls of the tank stand; its floor lies nearly as deep
Entry enter(double deadrise_degrees, int cells, double sound, double far = 36,
            const std::string& coupling = "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.5")
{
    const double deep = 8.0 / 9 * far;
    constexpr double density = 1000, speed = 1;
    const double rise = std::tan(deadrise_degrees * std::numbers::pi / 180), end = rise, cell = 1.0 / cells;
    const int fine = 2 * cells, above = cells, below = cells;
    std::string mesh = "*ALE_STRUCTURED_MESH\n1,10,1,1\n1,2,3\n";
    // Fine cells as far as the jet gets, then growing ones up to walls far away.
    const auto growing = [&](double length) {
        return static_cast<int>(std::log(1 + 0.1 * length / cell) / std::log(1.1));
    };
    const int outer = growing(far - 2), deeper = growing(deep - 1);
    mesh += fmt::format("*ALE_STRUCTURED_MESH_CONTROL_POINTS\n1\n1,0\n{},2,0.1\n{},{}\n", fine + 1,
                        fine + 1 + outer, far);
    mesh += fmt::format("*ALE_STRUCTURED_MESH_CONTROL_POINTS\n2\n1,0\n2,{}\n", cell);
    mesh += fmt::format("*ALE_STRUCTURED_MESH_CONTROL_POINTS\n3\n1,{},-0.1\n{},-1\n{},0\n{},1\n", -deep,
                        deeper + 1, deeper + 1 + below, deeper + 1 + below + above);
    int first = 1000000;
    const double length = 2;
    EulerianRun run(
        mesh + testing::liquid_and_void(density, sound) +
        testing::liquid_in_box({0, -1, -deep}, {far, 1, 0}) + rigid_part(7800, 4, 7, coupling) +
        testing::shell_patch(20, first, {0, 0, 0}, {0, cell, 0}, {length, 0, length * rise}, 1,
                             static_cast<int>(length * cells)) +
        fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n20,3,0,2\n*DEFINE_CURVE\n2\n0,{}\n10,{}\n", -speed,
                    -speed) +
        testing::closed(end));
    const SurfaceCoupling& coupled = run.term<SurfaceCoupling>();
    const auto& ids = run.model().nodes.id;
    const std::size_t apex = std::find(ids.begin(), ids.end(), 1000000) - ids.begin();
    SelfSimilarPressure pressure(coupled, apex, ids.size(), static_cast<int>(length * cells), cell, end);
    double tt = 0, ft = 0; // least squares through the origin
    run.run([&](const Clock& clock, const State& state) {
        pressure.take(clock, state);
        if (clock.time < 0.5 * end) return;
        const double force = 2 * coupled.force().z / cell;
        tt += clock.step * clock.time * clock.time;
        ft += clock.step * clock.time * force;
    });
    return {ft / tt / (density * speed * speed * speed),
            pressure.largest() / (0.5 * density * speed * speed)};
}

} // namespace

// Similarity solution (Dobrovol'skaya 1969; computed afresh for shared/reference/wedge): F / (rho V^3 t) in
// water without end. Walls at 9 times and a floor at 8 times the half width add 2.2 to 3.5 %.
TEST(AleCoupling, WedgeEntersWithTheForceOfTheSimilaritySolution)
{
    const Threads one(1);
    // Measured: -1.8 % and 0.0 % on 20 cells, -1.1 % and +0.7 % on 40.
    EXPECT_NEAR(enter(30, 20, 60).slope / 14.023, 1, 0.03);
    EXPECT_NEAR(enter(45, 20, 60).slope / 3.4486, 1, 0.03);
}

// The solution is that of incompressible water. The edge of the wetted width runs at pi / (2 tan(deadrise))
// times the wedge's speed (Wagner 1932), 9 times at 10 degrees: with 60 times as the speed of sound the flow
// is at Mach 0.15 there, and a tenth of the force is missing. Force measured: 1.002, 0.989, 1.007. The
// largest pressure over rho V^2 / 2 stands near the root of the spray, at 45 degrees at the apex.
TEST(AleCoupling, WedgesFeelForceAndPressureOfTheSimilaritySolution)
{
    const Threads one(1);
    struct Case {
        double deadrise, sound, force, pressure;
    };
    for (const Case& wedge :
         {Case{20, 300, 42.280, 17.74}, Case{30, 60, 14.023, 6.8957}, Case{45, 60, 3.4486, 2.7055}}) {
        const Entry entry = enter(wedge.deadrise, 40, wedge.sound);
        EXPECT_NEAR(entry.slope / wedge.force, 1, 0.03) << wedge.deadrise;
        EXPECT_NEAR(entry.peak / wedge.pressure, 1, 0.08) << wedge.deadrise;
    }
}

// Measured 1.028 (20 cells: 0.932, 80 cells: 0.989).
TEST(AleCoupling, WedgeOfTenDegreesFeelsTheForceOfTheSimilaritySolution)
{
    const Threads one(1);
    EXPECT_NEAR(enter(10, 40, 300).slope / 213.001, 1, 0.03);
}

// The jet is a third of a cell thick on cubes, so that the largest pressure depends on the height of the
// cells: on 40 cubes across even the mean of the exact pressure over the cell at the wedge misses 8 %
// (docs/results/eulerian.md). Here cells are cubes and half as high in a band around the root of the spray.
// Shells of half a cell and intervals as wide see 0.932 of the exact one.
TEST(AleCoupling, LargestPressureOfTheWedgeOfTenDegreesConvergesWithTheHeightOfTheCells)
{
    const Threads one(1);
    constexpr double exact = 0.932;
    const auto pressure = [](double flat) {
        testing::FlatWedge wedge;
        wedge.flat = flat;
        wedge.growth = 0.2;
        const testing::FlatWedgeEntry entry = testing::enter_flat_wedge(wedge);
        EXPECT_NEAR(entry.force, 1, 0.03) << flat;
        return entry.halves.largest(1.4).first / exact; // at the root of the spray, which runs at 1.55
    };
    EXPECT_NEAR(pressure(1), 0.70, 0.03);
    EXPECT_NEAR(pressure(2), 0.81, 0.03);
}

// Shells of half a cell: what stands near the root is the largest pressure (measured 0.65 of the exact peak,
// at 1.54). While single springs strayed in a cell, 0.87 of it stood at 0.04, near the apex, where the flow
// has none, and the force was 1.033.
TEST(AleCoupling, ShellsFinerThanCellsFeelTheLargestPressureAtTheRoot)
{
    const Threads one(1);
    testing::FlatWedge wedge;
    wedge.flat = 1;
    const testing::FlatWedgeEntry entry = testing::enter_flat_wedge(wedge);
    EXPECT_NEAR(entry.force, 1, 0.04);
    const auto [pressure, place] = entry.halves.largest();
    EXPECT_NEAR(place, 1.55, 0.03);
    EXPECT_NEAR(pressure, 0.65, 0.02);
}

// One Lagrangian element for two thirds of a cell, a cell, six cells.
TEST(AleCoupling, BoxOfWaterIsTight)
{
    const Threads one(1);
    for (const int elements : {12, 6, 1})
        EXPECT_LT(leak(elements, "2,4,1,1\n0,0,0.1,0,0.02", 0.5), 1e-4) << elements << " elements an edge";
}

// The same in compression only (DIREC = 2). Points that press one by one let 1.1e-5, 3.3e-4 and 6.1e-3
// through.
TEST(AleCoupling, BoxOfWaterIsTightInCompression)
{
    const Threads one(1);
    for (const int elements : {12, 6, 1})
        EXPECT_LT(leak(elements, "2,4,2,1\n0,0,0.1,0,0.02", 0.1), 1e-4) << elements << " an edge";
}

// The cells of the waterline are less than half full; there points let go where FRCMIN is not met, and leak
// control shakes the fluid. Without dry faces (ale/coupling/dry_faces.h) 5.1e-4, 4.2e-4 and 1.4e-4 leave.
TEST(AleCoupling, BoxOfWaterIsTightInCompressionWhereItIsHalfFull)
{
    const Threads one(1);
    for (const int elements : {12, 6, 1})
        EXPECT_LT(leak(elements, "2,4,2,1\n0,0,0.1,0,0.3\n,,,2,0.1", 0.1), 1e-4) << elements << " an edge";
}

// Walls that move by more than half a cell, or by 1.4 cells, without leak control. Without dry faces 8e-4
// leave the box of one element on its way aside, and 5e-3 when it is lifted.
TEST(AleCoupling, BoxOfWaterThatMovesIsTight)
{
    const Threads one(1);
    for (const int elements : {12, 6, 1})
        EXPECT_LT(leak(elements, "2,4,1,1\n0,0,0.1,0,0.02", 0.3, {1, 0.1}), 1e-4) << elements << " an edge";
    EXPECT_LT(leak(1, "2,4,2,1\n0,0,0.1,0,0.3", 0.3, {3, 0.04}), 1e-4);
}

// Where a wall that recedes stands in the last tenth of a cell, that cell is full. While full cells gave out
// whatever their nodes moved, the water ran up to 1.4 mm ahead of the wall into the next: 6.2e-4, 1.2e-3 and
// 2.7e-3.
TEST(AleCoupling, BoxOfWaterThatMovesIsTightWhereverItsWallsStand)
{
    const Threads one(1);
    for (const int elements : {12, 6, 1})
        EXPECT_LT(leak(elements, "2,4,1,1\n0,0,0.1,0,0.02", 0.34, {1, 0.1}), 1e-4) << elements << " an edge";
}

// Walls that stand on the planes of the mesh, as those of a mesh made for its tank do. While dry faces gave
// full cells back for nothing what had moved through them, the water's vibrations grew by a factor of e in 24
// cycles, up to 2e11 times the energy of free fall; while leak control and the correction of penetrations
// took the waves of a wall for leaks, by one in a few hundred.
TEST(AleCoupling, WaterRestsInAFullBoxOnPlanesOfTheMesh)
{
    const Threads one(1);
    for (const int direction : {1, 2})
        for (const bool leak_control : {false, true})
            for (const double inward : {0.0, 0.001})
                EXPECT_LT(motion_in_full_box({inward, direction, leak_control}, 0.003), 1e-3)
                    << direction << ' ' << leak_control << ' ' << inward;
}

// An elastic box takes its water along, on springs without dampers.
TEST(AleCoupling, FullBoxOnPlanesOfTheMeshKeepsItsEnergy)
{
    const Threads one(1);
    for (const bool leak_control : {false, true})
        EXPECT_LT(motion_in_full_box({0, 2, leak_control, 0.1}, 0.005), 1) << leak_control;
}

namespace {

/// A box without a lid floats with a share `sunk` of its height below the surface when it weighs that share
/// of the water that it could hold out: Archimedes. It starts 0.6 cells of 25 mm too high and bobs; how much
/// deeper it lies in the mean over the last of 3 s [cells], in a tank of `cells` along each edge.
double surplus_draught(int cells, const std::string& coupling, double sunk = 0.5, double balance = 1e-4)
{
    constexpr double side = 0.15, low = 0.1275, level = 0.2625;
    const double start = level - sunk * side + 0.015;
    const double cell = 0.4 / cells;
    const int elements = static_cast<int>(std::round(side / cell));
    int first = 100000;
    const Vec3 o{low, low, start}, x{side, 0, 0}, y{0, side, 0}, z{0, 0, side};
    const auto patch = [&](Vec3 corner, Vec3 a, Vec3 b) {
        return testing::shell_patch(20, first, corner, a, b, elements, elements);
    };
    std::string shells = patch(o, y, x); // floor, outward; then both sides along x and y
    shells += patch(o, z, y);
    shells += patch(o + x, y, z);
    shells += patch(o, x, z);
    shells += patch(o + y, z, x);
    // Mass 1000 x 0.15^2 x 0.15 sunk on five sides 10 mm thick.
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {0.4, 0.4, 0.4}, {cells, cells, cells}) +
                    testing::liquid_and_void(1000, 20) + "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n" +
                    fmt::format("5,0,1\n0,0,0,1,1,{}\n5,0,2\n{},{},{},{},{},1\n", level, low, low, start,
                                low + side, low + side) +
                    rigid_part(3000 * sunk, 4, 7, coupling) + shells + testing::gravity(9.81) +
                    testing::closed(3));
    const auto& ids = run.model().nodes.id;
    const std::size_t corner = std::find(ids.begin(), ids.end(), 100000) - ids.begin();
    double sum = 0, span = 0;
    run.run([&](const Clock& clock, const State& state) {
        if (clock.time < 2) return;
        sum += state.position[corner].z * clock.step;
        span += clock.step;
    });
    // Fluid and structure take the works of the springs over spans that differ by half a step.
    EXPECT_LT(run.scene().ledger.balance_error(), balance);
    // The water that fills the tank around the box rises by what the box displaces more than at the start.
    const double floor = sum / span, water = level * (0.16 - side * side) + start * side * side;
    const double surface = (water - floor * side * side) / (0.16 - side * side);
    return (surface - floor - sunk * side) / cell;
}

} // namespace

// Within half a cell on any mesh (measured 0.35 and 0.06 cells too deep). While penetrations were summed up
// over time alone, water crept behind the floor, and the box sank by 1.7 cells of 50 mm, 0.55 of 25 mm.
TEST(AleCoupling, BoxFloatsAtItsDraught)
{
    const Threads one(1);
    for (const int cells : {8, 16})
        EXPECT_NEAR(surplus_draught(cells, "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.2"), 0, 0.5) << cells << " cells";
    EXPECT_NEAR(surplus_draught(16, "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.2\n,,,2,0.1"), 0, 0.5) << "leak control";
}

// A lighter box, and a heavier one on springs without dampers: measured 0.07 and 0.14 cells too deep, balance
// of the latter 1.4e-4.
TEST(AleCoupling, BoxesOfOtherMassesFloatAtTheirDraughts)
{
    const Threads one(1);
    EXPECT_NEAR(surplus_draught(16, "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.2", 0.3), 0, 0.5);
    EXPECT_NEAR(surplus_draught(16, "2,4,1,1\n0,0,0.1,0,0.3,0,0,0", 0.7, 2e-4), 0, 0.5);
}

// Behind the plane shock the pressure is rho Us v, but the coupling's spring lets the fluid start softly:
// with stiffness k = PFAC rho c^2 / h and damper b = 2 DAMP rho c sqrt(PFAC / 2) by area against the fluid's
// impedance rho c,
//   p(t) / p_shock = 1 - exp(-t / T) / (1 + b / (rho c)),   T = (rho c + b) / k.
// CTYPE 2 is the same with PFAC = 1 and critical damping. The mean over two thirds of the run must agree; the
// mesh spreads the shock over some cells, which changes the start.
TEST(AleCoupling, PistonFeelsThePressureBehindTheShock)
{
    struct Form {
        const char* options;
        double penalty, damping;
    };
    for (const Form& form :
         {Form{"2,4,2,1\n0,0,0.1,0,0.3", 0.1, 0}, Form{"2,4,1,1\n0,0,0.1,0,0.3", 0.1, 0},
          Form{"3,5,2,1\n0,0,0.05,0,0.3,0,0,0.5", 0.05, 0.5}, Form{"2,2,1,1\n0,0,0.1,0,0.3", 1, 1}}) {
        const Piston piston = push(form.options, 5);
        constexpr double cell = 0.01, sound = 1500, begin = 1e-4, end = 3e-4;
        const double damper = 2 * form.damping * std::sqrt(0.5 * form.penalty);
        const double lag = (1 + damper) * cell / (form.penalty * sound);
        const double missing =
            lag / (end - begin) * (std::exp(-begin / lag) - std::exp(-end / lag)) / (1 + damper);
        EXPECT_NEAR(piston.pressure / piston.expected, 1 - missing, 0.02) << form.options;
        EXPECT_LT(piston.energy_error, 1e-6) << form.options;
    }
}

/// Shells of 10 mm: with THKF the water meets their face, with their thickness, twice it, or 4 mm.
TEST(AleCoupling, ThickPistonPushesWithItsFace)
{
    const std::string penalty = "2,4,2,1\n0,0,0.1,0,0.3", thick = penalty + "\n0\n0,0,0,0,0,0,";
    const double thin = push(penalty, 5).pressure;
    EXPECT_NEAR(push(thick + "1", 5, 0.195).pressure, thin, 1e-9 * thin);
    EXPECT_NEAR(push(thick + "2", 5, 0.19).pressure, thin, 1e-9 * thin);
    EXPECT_NEAR(push(thick + "-0.004", 5, 0.198).pressure, thin, 1e-9 * thin);
    EXPECT_NEAR(push(thick + "4", 5, 0.18).pressure, thin, 1e-9 * thin);
    EXPECT_EQ(push(penalty, 5, 0.18).pressure, 0); // its plane does not reach the water
}

namespace {

/// Cells that the surface cuts in place of springs.
const std::string by_cut_cells = "2,4,1,1\n\n*PLASH_ALE_FORMULATION\n0,1";

} // namespace

// Measured: nothing is lost. While what passed between parts of cells that have joined was shared with the
// void at the waterline, 9e-5 stayed behind a wall that went aside; while what was left in covered cells
// stayed there, up to 2e-9, with the wall's speed.
TEST(AleCutCells, BoxOfWaterIsTight)
{
    const Threads one(1);
    for (const int elements : {12, 1}) {
        EXPECT_LT(leak(elements, by_cut_cells, 0.2), 1e-9) << elements << " an edge";
        EXPECT_LT(leak(elements, by_cut_cells, 0.3, {1, 0.1}), 1e-12) << elements << " an edge";
        EXPECT_LT(leak(elements, by_cut_cells, 0.3, {3, 0.04}), 1e-9) << elements << " an edge";
    }
}

// Measured 0.012 and 0.009 cells too deep.
TEST(AleCutCells, BoxFloatsAtItsDraught)
{
    const Threads one(1);
    for (const int cells : {8, 16})
        EXPECT_NEAR(surplus_draught(cells, by_cut_cells), 0, 0.05) << cells << " cells";
}

// Measured 1.003, 0.998, 0.986, 1.001 on 20 cells, where springs have 0.932, 0.992, 0.982, 0.999.
TEST(AleCutCells, WedgesFeelTheForceOfTheSimilaritySolution)
{
    const Threads one(1);
    EXPECT_NEAR(enter(10, 20, 300, 36, by_cut_cells).slope / 213.001, 1, 0.02);
    EXPECT_NEAR(enter(20, 20, 300, 36, by_cut_cells).slope / 42.280, 1, 0.02);
    EXPECT_NEAR(enter(30, 20, 60, 36, by_cut_cells).slope / 14.023, 1, 0.02);
    EXPECT_NEAR(enter(45, 20, 60, 36, by_cut_cells).slope / 3.4486, 1, 0.02);
}

// Half a plane tank with a box at its draught, floor and side within cells. Measured 0.001 g at first, and
// 0.05 mm in 0.2 s; with springs 0.24 g and 0.5 mm.
TEST(AleCutCells, BoxStartsAtRestWhereverItsFloorStands)
{
    const Threads one(1);
    constexpr double cell = 0.0125, half = 0.0775, draught = 0.075, low = 0.185, level = 0.26, height = 0.225;
    int first = 100000;
    const Vec3 corner{0, 0, low}, along{0, cell, 0}, floor{half, 0, 0}, up{0, 0, height};
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {16 * cell, cell, 32 * cell}, {16, 1, 32}) +
                    testing::liquid_and_void(1000, 20) + testing::liquid_in_box({0, 0, 0}, {1, 1, level}) +
                    fmt::format("5,0,2\n0,0,{},{},1,1\n", low, half) +
                    rigid_part(1000 * draught * half / (half + height) / 0.01, 4, 7, by_cut_cells) +
                    testing::shell_patch(20, first, corner, along, floor, 1, 12) +
                    testing::shell_patch(20, first, corner + floor, along, up, 1, 36) +
                    fmt::format("*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n*NODE\n90000,0,0,{}\n"
                                "*INITIAL_HYDROSTATIC_ALE\n10,1,5,9.81\n90000,1\n",
                                level) +
                    testing::gravity(9.81) + testing::closed(0.2));
    const auto& ids = run.model().nodes.id;
    const std::size_t node = std::find(ids.begin(), ids.end(), 100000) - ids.begin();
    double furthest = 0;
    run.run([&](const Clock&, const State& state) {
        furthest = std::max(furthest, std::abs(state.position[node].z - low));
    });
    EXPECT_LT(furthest, 1e-4);
}

// Where the surface spans the mesh across another axis than z, and nothing softens the start of the shock.
TEST(AleCutCells, PistonFeelsThePressureBehindTheShock)
{
    const Piston piston = push(by_cut_cells, 5);
    EXPECT_NEAR(piston.pressure / piston.expected, 1, 0.001); // 0.99995
    EXPECT_LT(piston.energy_error, 1e-9);                     // 4e-13
}

// A plate that ends in the liquid bounds no body: it does not say which side is open.
TEST(AleCutCells, WantAClosedSurface)
{
    int first = 100000;
    try {
        const EulerianRun run(
            testing::structured_mesh({0, 0, 0}, {1, 1, 1}, {10, 10, 10}) +
            testing::liquid_and_void(1000, 100) + testing::liquid_in_box({0, 0, 0}, {1, 1, 0.8}) +
            rigid_part(7800, 4, 7, by_cut_cells) +
            testing::shell_patch(20, first, {0.33, 0.33, 0.44}, {0.4, 0, 0}, {0, 0.4, 0}, 2, 2) +
            testing::closed(1e-3));
        FAIL() << "nobody complained";
    } catch (const DeckError& error) {
        EXPECT_NE(std::string(error.what()).find("is not closed in the fluid"), std::string::npos)
            << error.what();
    }
}

} // namespace plash

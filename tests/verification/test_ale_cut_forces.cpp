#include "tests/support/ale_deck.h"
#include "tests/support/ale_samples.h"

#include <gtest/gtest.h>

/// What one elastic quadrilateral that cuts cells of the fluid does and feels, in the first cycle.
namespace plash::cut_forces {

namespace {

using testing::EulerianRun;

constexpr double cell = 0.1, density = 1000, sound = 100, stiffness = density * sound * sound, pressure = 1e5;

/// Full of water under `pressure` at rest: C0 of the equation of state is that, whatever the density.
std::string pressed_water()
{
    return fmt::format("*ALE_MULTI-MATERIAL_GROUP\n1,1\n2,1\n*PART\nwater\n1,1,1,1\n*PART\nempty\n2,1,2\n"
                       "*SECTION_SOLID\n1,11\n*MAT_NULL\n1,{},-1e4\n*EOS_LINEAR_POLYNOMIAL\n1,{},{}\n\n"
                       "*MAT_VACUUM\n2,0\n",
                       density, pressure, stiffness);
}

struct Nodal {
    double step = 0;          ///< largest stable one of the cut cells [time]
    std::vector<Vec3> forces; ///< of the water on the plate's nodes [force]
};

/// A tube along x of `across` x `across` cells with an elastic plate across it at 5.7 cells, which is made of
/// `shells` x `shells` quadrilaterals. Water stands before it where y and z are below `wet`.
Nodal first_cycle(int across, int shells, double mass, double wet)
{
    const Threads one(1);
    constexpr int first = 100000;
    constexpr double thickness = 0.01, place = 0.57;
    const double side = across * cell;
    int next = first;
    const std::string plate =
        testing::shell_patch(20, next, {place, 0, 0}, {0, 0, side}, {0, side, 0}, shells, shells);
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {8 * cell, side, side}, {8, across, across}) +
                    pressed_water() + testing::liquid_in_box({0, 0, 0}, {place, wet, wet}) +
                    fmt::format("*PART\nplate\n20,20,20\n*SECTION_SHELL\n20,2\n{0},{0},{0},{0}\n"
                                "*MAT_ELASTIC\n20,{1},1e9,0.3\n"
                                "*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,2,4,1,1\n\n"
                                "*PLASH_ALE_FORMULATION\n0,1\n",
                                thickness, mass / (side * side * thickness)) +
                    plate + testing::closed(1e-6));
    Nodal result;
    const auto& ids = run.model().nodes.id;
    const std::size_t corner = std::find(ids.begin(), ids.end(), first) - ids.begin();
    const SurfaceCoupling& coupling = run.term<SurfaceCoupling>();
    run.run([&](const Clock& clock, const State& state) {
        if (clock.cycle > 0) return;
        ElementResults all;
        all.coupling_force.resize(ids.size());
        coupling.collect(state, all);
        result.step = coupling.stable_step().step;
        result.forces.assign(all.coupling_force.begin() + corner,
                             all.coupling_force.begin() + corner + (next - first));
    });
    return result;
}

} // namespace

// Water of volume V and stiffness K presses nodes of mass m by areas A, which adds K / V sum(A^2 / m) to the
// square of its frequency; the square of the largest step is 1.5 over that. Where plate and cell end
// together all nodes move alike, whatever the number of quadrilaterals: A^2 / M of the plate.
// One quadrilateral across four cells: the quarter of it in a cell hands 7/48, twice 1/24 and 1/48 of the
// whole area to its corners (see below).
TEST(AleCutForces, MassesOfTheSurfaceCountForTheStep)
{
    constexpr double heavy = 1e6, light = 0.05, volume = 0.7 * cell * cell * cell, area = cell * cell;
    const auto added = [&](int across, int shells) {
        const double side = across * cell;
        const double with = first_cycle(across, shells, light, side).step,
                     without = first_cycle(across, shells, heavy, side).step;
        return (1 / (with * with) - 1 / (without * without)) * 1.5 * volume / stiffness;
    };
    const double moves = 1 / light - 1 / heavy;
    EXPECT_NEAR(added(1, 1) / (area * area * moves), 1, 1e-5);
    EXPECT_NEAR(added(1, 2) / (area * area * moves), 1, 1e-5);
    const double shared = 16 * area * area * 4 * (7 * 7 + 2 * 2 * 2 + 1) / (48. * 48);
    EXPECT_NEAR(added(2, 1) / (shared * moves), 1, 1e-5);
}

// A quadrilateral is four triangles around its middle, which goes with the mean of the corners. Water before
// a quarter of it presses two halves of such triangles. In each the shape function of the corner there has
// the mean (1 + 1/2 + 1/4) / 3, those of the two next ones 1/4 and 1/12 in turn, that of the opposite one
// 1/12. Cuts stand 1e-7 of a cell beside the planes of the mesh, which is up to 1e-7 of the stiffness as
// pressure: 1e-5.
TEST(AleCutForces, QuadrilateralsBearPressureByTheTrianglesAroundTheirMiddle)
{
    const Nodal plate = first_cycle(2, 1, 1, cell);
    const double whole = pressure * 4 * cell * cell;
    const double wanted[4] = {7. / 48, 2. / 48, 2. / 48, 1. / 48};
    ASSERT_EQ(plate.forces.size(), 4u);
    for (int n = 0; n < 4; ++n) {
        EXPECT_NEAR(plate.forces[n].x / whole, wanted[n], 1e-5) << n;
        EXPECT_NEAR(plate.forces[n].y / whole, 0, 1e-9) << n;
        EXPECT_NEAR(plate.forces[n].z / whole, 0, 1e-9) << n;
    }
}

// A floor of one quadrilateral that is not plane: a corner stands 0.4 of a cell above the others. Below its
// four triangles lies a quarter of that (below two with one of the diagonals a sixth or a third).
TEST(AleCutForces, BentQuadrilateralsLeaveOpenWhatIsBesideTheirFourTriangles)
{
    const Threads one(1);
    constexpr double low = 0.23, raised = 0.04, level = 0.6;
    EulerianRun run(testing::structured_mesh({0, 0, 0}, {cell, cell, 8 * cell}, {1, 1, 8}) +
                    testing::liquid_and_void(density, sound) +
                    testing::liquid_in_box({0, 0, 0.2}, {cell, cell, level}) +
                    fmt::format("*NODE\n90000,0,0,{0}\n*DEFINE_VECTOR\n5,0,0,0,0,0,-1\n"
                                "*INITIAL_HYDROSTATIC_ALE\n10,1,5,9.81\n90000,1\n"
                                "*PART\nfloor\n20,20,20\n*SECTION_SHELL\n20,2\n0.01,0.01,0.01,0.01\n"
                                "*MAT_ELASTIC\n20,7800,2e11,0.3\n"
                                "*CONSTRAINED_LAGRANGE_IN_SOLID\n20,10,1,1,2,4,1,1\n\n"
                                "*PLASH_ALE_FORMULATION\n0,1\n"
                                "*NODE\n1001,0,0,{2}\n1002,{3},0,{1}\n1003,{3},{3},{1}\n1004,0,{3},{1}\n"
                                "*ELEMENT_SHELL\n1001,20,1001,1002,1003,1004\n",
                                level, low, low + raised, cell) +
                    testing::gravity(9.81) + testing::closed(1e-6));
    const BoxFluid& fluid = run.term<EulerianFluid>().box();
    const double open = fluid.fields.groups[0].fraction[fluid.grid.at(0, 0, 2)];
    EXPECT_NEAR(open, (0.3 - low - raised / 4) / cell, 1e-6);
}

} // namespace plash::cut_forces

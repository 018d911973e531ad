#include "tests/support/ale_deck.h"
#include "tests/support/ale_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

/// Walls along which fluid slips and that are oblique to the global axes (EBC = 2).
namespace plash {

namespace {

using testing::EulerianRun;

/// Nodes and hexahedra of part 10 as text; nodes at one place are one.
class Hexahedra {
public:
    void block(std::array<int, 3> cells, const std::function<Vec3(double, double, double)>& at)
    {
        for (int k = 0; k < cells[2]; ++k)
            for (int j = 0; j < cells[1]; ++j)
                for (int i = 0; i < cells[0]; ++i) {
                    solids_ += fmt::format("{},10", ++count_);
                    for (const int corner : {0, 1, 3, 2, 4, 5, 7, 6})
                        solids_ += fmt::format(",{}", node(at(double(i + (corner & 1)) / cells[0],
                                                              double(j + (corner >> 1 & 1)) / cells[1],
                                                              double(k + (corner >> 2)) / cells[2])));
                    solids_ += '\n';
                }
    }
    int count() const { return count_; }
    std::string text() const
    {
        return "*PART\nmesh\n10,10,1\n*SECTION_SOLID\n10,11\n*NODE\n" + nodes_ + "*ELEMENT_SOLID\n" + solids_;
    }

private:
    int count_ = 0;
    std::string nodes_, solids_;
    std::map<std::array<long long, 3>, std::size_t> known_;

    std::size_t node(const Vec3& x)
    {
        const std::array<long long, 3> key{std::llround(1e7 * x.x), std::llround(1e7 * x.y),
                                           std::llround(1e7 * x.z)};
        const auto [found, added] = known_.try_emplace(key, known_.size() + 1);
        if (added) nodes_ += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", found->second, x.x, x.y, x.z);
        return found->second;
    }
};

struct Dam {
    double kinetic = 0, reach = 0, balance = 0;
    bool box = false;
};

/// A dam of 4 x 8 cells in a tank of 12 x 2 x 10, turned by an angle about the vertical.
Dam break_dam(double angle)
{
    constexpr double cell = 0.02;
    Hexahedra mesh;
    mesh.block({12, 2, 10}, [&](double u, double v, double w) {
        const double x = 12 * cell * u, y = 2 * cell * v;
        return Vec3{x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle),
                    10 * cell * w};
    });
    std::string fractions = "*INITIAL_VOLUME_FRACTION\n";
    for (int number = 0; number < mesh.count(); ++number) {
        const bool wet = number % 12 < 4 && number / 24 < 8;
        fractions += fmt::format("{},{},{}\n", number + 1, wet ? 1 : 0, wet ? 0 : 1);
    }
    EulerianRun run(mesh.text() + testing::liquid_and_void(1000, 40) + fractions + testing::gravity(9.81) +
                    testing::closed(0.2));
    run.run();
    const EulerianFluid& term = run.term<EulerianFluid>();
    const Fluid& fluid = term.fluid();
    Dam dam;
    dam.kinetic = fluid.energies().kinetic;
    dam.balance = run.scene().ledger.balance_error();
    dam.box = term.block().is_box();
    for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
        const FluidCell own = fluid.cell(number);
        Vec3 middle{};
        for (const Vec3& point : own.points) middle += 0.125 * point;
        dam.reach += fluid.fields.groups[0].mass[own.place] *
                     (middle.x * std::cos(angle) + middle.y * std::sin(angle)) / fluid.total_mass(0);
    }
    EXPECT_FALSE(fluid.open_sides);
    EXPECT_NEAR(fluid.total_mass(0), 1000 * 64 * cell * cell * cell, 1e-9);
    return dam;
}

} // namespace

// The same dam in a tank that stands askew, whose cells are hexahedra on walls across no axis.
TEST(AleSlip, DamBreaksInATurnedTankAsInAStraightOne)
{
    const Threads one(1);
    const Dam straight = break_dam(0), turned = break_dam(std::numbers::pi / 6);
    EXPECT_TRUE(straight.box && !turned.box);
    EXPECT_NEAR(turned.kinetic, straight.kinetic, 1e-4 * straight.kinetic);
    EXPECT_NEAR(turned.reach, straight.reach, 1e-5 * straight.reach);
    EXPECT_NEAR(turned.balance, straight.balance, 1e-4);
}

// A horizontal pipe of radius 1, half full, in which water sloshes: omega^2 a / g = 1.3557 (McIver 1989, J.
// Fluid Mech. 201, 243-257), on an O-grid with curved walls that nothing passes.
TEST(AleSlip, WaterSloshesInAPipe)
{
    const Threads one(1);
    constexpr double pi = std::numbers::pi, core = 0.45, g = 9.81, tilt = 0.1;
    Hexahedra mesh;
    mesh.block({12, 12, 1}, [&](double u, double v, double w) {
        return Vec3{core * (2 * u - 1), core * (2 * v - 1), 0.1 * w};
    });
    for (int side = 0; side < 4; ++side)
        mesh.block({12, 8, 1}, [&](double u, double v, double w) {
            const double angle = pi / 4 * (2 * u - 1);
            const Vec3 inner{core * (2 * u - 1), core, 0}, outer{std::sin(angle), std::cos(angle), 0};
            Vec3 point = (1 - v) * inner + v * outer;
            for (int turn = 0; turn < side; ++turn) point = {point.y, -point.x, 0};
            point.z = 0.1 * w;
            return point;
        });
    EulerianRun run(mesh.text() + testing::liquid_and_void(1000, 40) +
                    testing::liquid_in_box({-2, -2, -1}, {2, 0, 1}) +
                    fmt::format("*LOAD_BODY_X\n1,{}\n*LOAD_BODY_Y\n1,{}\n*DEFINE_CURVE\n1\n0,1\n1e9,1\n",
                                g * std::sin(tilt), g * std::cos(tilt)) +
                    testing::closed(4));
    const Fluid& fluid = run.term<EulerianFluid>().fluid();
    EXPECT_FALSE(fluid.open_sides);
    std::vector<double> middles(fluid.cell_count());
    for (std::size_t number = 0; number < middles.size(); ++number)
        for (const Vec3& point : fluid.cell(number).points) middles[number] += 0.125 * point.x;
    const double mass = fluid.total_mass(0);
    // The centre of a half disc, 4 / (3 pi) below the axis, swings about the vertical.
    const double rest = -4 / (3 * pi) * std::sin(tilt);
    std::vector<double> crossings;
    double last = 0, last_time = 0;
    run.run([&](const Clock& clock, const State&) {
        double aside = -rest;
        for (std::size_t number = 0; number < middles.size(); ++number)
            aside += fluid.fields.groups[0].mass[fluid.cell(number).place] * middles[number] / mass;
        if (last * aside < 0)
            crossings.push_back(last_time + (clock.time - last_time) * last / (last - aside));
        last = aside;
        last_time = clock.time;
    });
    ASSERT_GE(crossings.size(), 4u);
    const double period = 2 * (crossings[3] - crossings[0]) / 3;
    EXPECT_NEAR(period / (2 * pi / std::sqrt(1.3557 * g)), 1, 0.02);
    EXPECT_NEAR(fluid.total_mass(0), mass, 1e-10 * mass);
    EXPECT_LT(run.scene().ledger.balance_error(), 1e-4);
}

} // namespace plash

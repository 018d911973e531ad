// *LOAD_BLAST_ENHANCED: what an explosion gives a body.

#include "conditions/air_blast.h"
#include "conditions/blast_loads.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

using testing::DeckRun;

/// One system of units: what a kilogram, a metre, a second, a pascal are in it.
struct Units {
    int number;
    double mass, length, time, pressure;
    double density() const { return mass / (length * length * length); }
};

/// A cube of a metre, heavy, its face at x = 0 ten metres from 100 kg of TNT in front of it.
std::string cube_before_a_charge(const Units& u, const std::string& blast, double end)
{
    testing::DeckText deck;
    deck.text +=
        fmt::format("*CONTROL_TERMINATION\n{:.12g},0\n*CONTROL_TIMESTEP\n0,0.01\n*PART\ncube\n1,1,1\n"
                    "*SECTION_SOLID\n1,2\n*MAT_ELASTIC\n1,{:.12g},{:.12g},0.3\n",
                    end * u.time, 1000 * u.density(), 1e9 * u.pressure);
    deck.block(1, {0, 0, 0}, Vec3{1, 1, 1} * u.length, 1, 1, 1);
    return deck.text + blast + "*LOAD_BLAST_SEGMENT\n7,1,5,7,3\n*END\n";
}

std::string charge(const Units& u, double x, double y, double z)
{
    return fmt::format(
        "*LOAD_BLAST_ENHANCED\n7,{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{},2\n0,0,0,0,0,0,1\n", 100 * u.mass,
        x * u.length, y * u.length, z * u.length, 0.001 * u.time, u.number);
}

Vec3 momentum(const State& state)
{
    Vec3 sum{};
    for (std::size_t n = 0; n < state.velocity.size(); ++n) sum += state.mass[n] * state.velocity[n];
    return sum;
}

} // namespace

// The whole positive phase on a square metre: its impulse, and nothing before the time of arrival, in all
// systems of units.
TEST(BlastLoads, GiveTheirImpulse)
{
    const double root = std::cbrt(100 / 0.45359237);
    const AirBlast blast = air_blast(Burst::air, 10 / 0.3048 / root);
    const double wanted = blast.reflected_impulse * root * 6894.757293168 * 1e-3; // Pa s
    const double arrival = 1e-3 * blast.arrival * root + 0.001, duration = 1e-3 * blast.duration * root;
    for (const Units& u : {Units{2, 1, 1, 1, 1}, Units{4, 1e3, 100, 1e6, 1e-11}, Units{6, 1, 1e3, 1e3, 1e-9},
                           Units{7, 1e-3, 1e3, 1, 1e-6}, Units{8, 1e3, 1e3, 1e3, 1e-6}}) {
        DeckRun run(cube_before_a_charge(u, charge(u, -10, 0.5, 0.5), arrival + 1.05 * duration));
        ASSERT_TRUE(run.scene);
        double first = 0;
        run.watch([&](const Clock& clock, const State& state) {
            if (first == 0 && norm(momentum(state)) > 0) first = clock.time;
        });
        run.go();
        const double unit = u.mass * u.length / u.time;
        // Cut off at the arrival by the trapezoid of one step, and the cube goes away a little.
        EXPECT_NEAR(momentum(run.scene->state).x / unit, wanted, 2e-3 * wanted) << u.number;
        EXPECT_NEAR(first / u.time, arrival, 3e-5) << u.number; // a step or two
        EXPECT_LT(run.scene->ledger.balance_error(), 1e-3) << u.number;
    }
}

// A face that looks away feels the incident wave alone.
TEST(BlastLoads, FacesThatLookAwayFeelTheIncidentWave)
{
    const Units u{2, 1, 1, 1, 1};
    const double root = std::cbrt(100 / 0.45359237);
    const AirBlast blast = air_blast(Burst::air, 10 / 0.3048 / root);
    const double wanted = blast.incident_impulse * root * 6.894757293168;
    DeckRun run(cube_before_a_charge(u, charge(u, 10, 0.5, 0.5),
                                     0.001 + 1e-3 * root * (blast.arrival + 1.05 * blast.duration)));
    ASSERT_TRUE(run.scene);
    run.go();
    EXPECT_NEAR(momentum(run.scene->state).x, wanted, 2e-3 * wanted);
}

} // namespace plash

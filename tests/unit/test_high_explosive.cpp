#include "eos/jwl.h"
#include "tests/support/solid_column.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace plash {

using testing::Column;
using testing::record_of;

namespace {

// TNT, SI: Dobratz & Crawford (1985), LLNL Explosives Handbook, UCRL-52997.
constexpr double tnt_density = 1630, tnt_energy = 7.0e9;

Record tnt_products()
{
    return record_of("EOS_JWL", 1,
                     {{"A", 371.2e9},
                      {"B", 3.231e9},
                      {"R1", 4.15},
                      {"R2", 0.95},
                      {"OMEG", 0.30},
                      {"E0", tnt_energy},
                      {"VO", 1}});
}

/// Detonation without loss: the slowest wave that the products' Hugoniot allows (Chapman 1899, Jouguet 1905).
struct Jouguet {
    double volume = 1, pressure = 0, speed = 0, particle = 0, energy = 0;
};

Jouguet jouguet_of(const Jwl& eos)
{
    const auto at = [&](double volume) {
        // E = E0 + p (1 - V) / 2 and p = cold + warm E.
        const auto response = eos.evaluate(1 / volume);
        Jouguet state;
        state.volume = volume;
        state.pressure =
            (response.cold + response.warm * eos.energy) / (1 - 0.5 * response.warm * (1 - volume));
        state.speed = std::sqrt(state.pressure / (tnt_density * (1 - volume)));
        state.particle = state.speed * (1 - volume);
        state.energy = eos.energy + 0.5 * state.pressure * (1 - volume);
        return state;
    };
    double low = 0.5, high = 0.95;
    for (int i = 0; i < 200; ++i) { // ternary search
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (at(a).speed < at(b).speed)
            high = b;
        else
            low = a;
    }
    return at(0.5 * (low + high));
}

Record tnt(const Jouguet& state, double beta, std::initializer_list<std::pair<const char*, double>> more = {})
{
    Record record =
        record_of("MAT_HIGH_EXPLOSIVE_BURN", 1,
                  {{"RO", tnt_density}, {"D", state.speed}, {"PCJ", state.pressure}, {"BETA", beta}});
    for (const auto& [name, value] : more) record.fields.push_back({name, value, "", true, false, {}});
    return record;
}

/// One cube of explosive of side 1 whose volume is driven.
struct Cube {
    testing::SolidBlock block;
    State state;
    std::vector<std::unique_ptr<SolidGroup>> groups;
    Clock clock;

    Cube(Record material, double lighting_time) : block({1, 1, 1}, {1, 1, 1}, std::move(material))
    {
        block.model.equations_of_state.push_back(tnt_products());
        block.model.parts[0].equation_of_state = 0;
        block.model.others.push_back(
            record_of("INITIAL_DETONATION", 0,
                      {{"PID", 1}, {"X", 0.5}, {"Y", 0.5}, {"Z", 0.5}, {"LT", lighting_time}}));
        block.set_viscosity(1e-30, 1e-30);
        state = block.state();
        groups = make_solid_groups(block.model, state);
    }

    /// To a place for every node, in steps of time.
    void move(const std::function<Vec3(const Vec3&)>& to, double time, int steps)
    {
        clock.last_step = time / steps;
        const auto before = state.position;
        for (int i = 1; i <= steps; ++i) {
            const double share = static_cast<double>(i) / steps;
            for (std::size_t n = 0; n < state.size(); ++n) {
                const Vec3 next = before[n] + share * (to(block.model.nodes.position[n]) - before[n]);
                state.velocity[n] = (1 / clock.last_step) * (next - state.position[n]);
                state.position[n] = next;
            }
            state.clear_forces();
            groups[0]->add_forces(clock, state);
        }
    }
    ElementResults results() { return testing::solid_results(block.model, state, groups); }
    double pressure() { return -trace(results().solid_stress[0]) / 3; }
};

Vec3 stay(const Vec3& x)
{
    return x;
}

Vec3 squeezed(const Vec3& x, double by)
{
    return {x.x * (1 - by), x.y, x.z};
}

} // namespace

/// The numbers of the handbook: 6930 m/s and 21.0 GPa.
TEST(HighExplosive, JwlOfTntHasItsDetonation)
{
    const Jouguet state = jouguet_of(Jwl::from_record(tnt_products(), tnt_density));
    EXPECT_NEAR(state.speed, 6930, 0.003 * 6930);
    EXPECT_NEAR(state.pressure, 21.0e9, 0.01 * 21.0e9);
}

/// At rest: nothing until the light arrives, then 2/3 D A / v t of the pressure of the products.
TEST(HighExplosive, BurnsByProgram)
{
    const Jouguet cj = jouguet_of(Jwl::from_record(tnt_products(), tnt_density));
    Cube cube(tnt(cj, 2), 1e-5);
    cube.move(stay, 0.99e-5, 10);
    EXPECT_EQ(cube.pressure(), 0);
    const double whole = Jwl::from_record(tnt_products(), tnt_density).evaluate(1.0).pressure(tnt_energy);
    const double later = 1e-4;
    cube.move(stay, later + 0.01e-5, 100);
    const double share = 2.0 / 3 * cj.speed * later;
    EXPECT_NEAR(share, 0.46, 0.01);
    EXPECT_NEAR(cube.pressure(), share * whole, 1e-10 * whole);
    EXPECT_NEAR(cube.results().solid_plastic_strain[0], share, 1e-12); // the burnt share stands there
    cube.move(stay, 2e-4, 10);
    EXPECT_NEAR(cube.pressure(), whole, 1e-10 * whole);
}

/// BETA = 1: half of the compression of the detonation burns half, and what has burnt does not come back.
TEST(HighExplosive, BurnsByCompression)
{
    const Jouguet cj = jouguet_of(Jwl::from_record(tnt_products(), tnt_density));
    Cube cube(tnt(cj, 1), 0);
    cube.move(stay, 1, 3);
    EXPECT_EQ(cube.pressure(), 0); // no program
    cube.move([&](const Vec3& x) { return squeezed(x, 0.5 * (1 - cj.volume)); }, 1, 50);
    EXPECT_NEAR(cube.results().solid_plastic_strain[0], 0.5, 1e-12);
    cube.move(stay, 1, 50);
    EXPECT_NEAR(cube.results().solid_plastic_strain[0], 0.5, 1e-12);
    EXPECT_GT(cube.pressure(), 0);
}

/// BETA = 2 with K, G and SIGY: a solid before it burns, a gas when it has.
TEST(HighExplosive, IsASolidBeforeItBurns)
{
    const Jouguet cj = jouguet_of(Jwl::from_record(tnt_products(), tnt_density));
    const double bulk = 10e9, shear = 4e9, yield = 0.2e9;
    Cube cube(tnt(cj, 2, {{"K", bulk}, {"G", shear}, {"SIGY", yield}}), 10);
    cube.move([](const Vec3& x) { return squeezed(x, 0.02); }, 1, 20);
    EXPECT_NEAR(cube.pressure(), bulk * (1 / 0.98 - 1), 1e-3);
    cube.move([](const Vec3& x) { return squeezed(x, 0.02) + Vec3{0.1 * x.y, 0, 0}; }, 1, 50);
    EXPECT_NEAR(von_mises_stress(cube.results().solid_stress[0]), yield, 1e-6 * yield);
    cube.move([](const Vec3& x) { return squeezed(x, 0.02) + Vec3{0.1 * x.y, 0, 0}; }, 9, 10);
    EXPECT_NEAR(von_mises_stress(cube.results().solid_stress[0]), 0, 1e-3);
    EXPECT_GT(cube.pressure(), 5e9);
}

namespace {

/// A bar of TNT that is lit at its left end.
struct Bar : Column {
    Jouguet cj;
    static constexpr double length = 0.1;

    explicit Bar(int cells)
        : Column(cells, length, tnt(jouguet_of(Jwl::from_record(tnt_products(), tnt_density)), 2),
                 tnt_products()),
          cj(jouguet_of(Jwl::from_record(tnt_products(), tnt_density)))
    {
        model.others.push_back(record_of("INITIAL_DETONATION", 0, {{"PID", 0}}));
    }

    /// Until the front is at a share of the length.
    std::pair<testing::Profile, double> burnt_to(double share)
    {
        model.controls.time.end_time = share * length / cj.speed;
        model.controls.time.step_scale = 0.6;
        Scene scene = make_scene(model);
        Recorders none_recorded;
        const Outcome outcome = run(scene, none_recorded);
        return {testing::profile_of(*this, scene, tnt_density), outcome.clock.time};
    }
};

double mean_between(const testing::Profile& profile, double from, double to)
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < profile.place.size(); ++i) {
        if (profile.place[i] < from || profile.place[i] > to) continue;
        sum += profile.pressure[i];
        ++count;
    }
    return sum / count;
}

} // namespace

/// Followed by a piston with the particle velocity of the detonation: all that has burnt stands at the
/// Chapman-Jouguet pressure.
TEST(Detonation, DrivenBarStandsAtTheChapmanJouguetPressure)
{
    Bar bar(200);
    bar.drive(0, bar.cj.particle);
    const auto [profile, time] = bar.burnt_to(0.8);
    const double piston = bar.cj.particle * time, front = bar.cj.speed * time;
    const double found =
        mean_between(profile, piston + 0.2 * (front - piston), piston + 0.85 * (front - piston));
    EXPECT_NEAR(found, bar.cj.pressure, 0.01 * bar.cj.pressure);
    // Where the pressure passes half: the front is where it has to be, within two cells.
    std::size_t i = profile.place.size() - 1;
    while (profile.pressure[i] < 0.5 * bar.cj.pressure) --i;
    EXPECT_NEAR(profile.place[i], front, 2.0 * Bar::length / 200);
}

/// From a wall: Taylor's wave (G. I. Taylor 1950, Proc. R. Soc. Lond. A 200, 235), a fan x / t = u + c along
/// the isentrope of the products down to rest. The isentrope is integrated here in small steps.
TEST(Detonation, WalledBarFollowsTaylorsWave)
{
    const Jwl eos = Jwl::from_record(tnt_products(), tnt_density);
    Bar bar(400);
    bar.drive(0, 0);
    const auto [profile, time] = bar.burnt_to(0.9);
    double volume = bar.cj.volume, energy = bar.cj.energy, particle = bar.cj.particle;
    double pressure = bar.cj.pressure;
    std::vector<std::pair<double, double>> fan; // x / t, pressure
    while (particle > 0) {
        const double step = 1e-5;
        const auto speed_at = [&](double v, double e) {
            const auto response = eos.evaluate(1 / v);
            const double p = response.pressure(e);
            // c^2 = dp/drho; rho0 dp/drho = stiffness.
            return std::pair(std::sqrt(response.stiffness(1 / v, p, e) / tnt_density), p);
        };
        const auto [c, p] = speed_at(volume, energy);
        fan.emplace_back(particle + c, p);
        const auto [c_middle, p_middle] = speed_at(volume + 0.5 * step, energy - 0.5 * step * p);
        particle -= c_middle * step / (volume + 0.5 * step);
        energy -= p_middle * step;
        volume += step;
        pressure = p;
    }
    EXPECT_NEAR(fan.front().first, bar.cj.speed, 1e-3 * bar.cj.speed); // Jouguet's condition
    EXPECT_NEAR(mean_between(profile, 0.1 * fan.back().first * time, 0.8 * fan.back().first * time), pressure,
                0.01 * pressure);
    for (const double share : {0.3, 0.6, 0.8}) {
        const double ray = fan.back().first + share * (bar.cj.speed - fan.back().first);
        std::size_t k = 0;
        while (k + 1 < fan.size() && fan[k].first > ray) ++k;
        const double found = mean_between(profile, (ray * time) - 1e-3, (ray * time) + 1e-3);
        EXPECT_NEAR(found, fan[k].second, 0.02 * fan[k].second) << share;
    }
}

TEST(HighExplosive, RefusesWhatItDoesNotHave)
{
    const Jouguet cj = jouguet_of(Jwl::from_record(tnt_products(), tnt_density));
    EXPECT_THROW(Cube(tnt(cj, 3), 0), DeckError);
    testing::SolidBlock block({1, 1, 1}, {1, 1, 1}, tnt(cj, 0));
    State state = block.state();
    EXPECT_THROW(make_solid_groups(block.model, state), DeckError); // no equation of state
    block.model.equations_of_state.push_back(tnt_products());
    block.model.parts[0].equation_of_state = 0;
    block.model.others.push_back(record_of("INITIAL_DETONATION", 0, {{"PID", -1}}));
    EXPECT_THROW(make_solid_groups(block.model, state), DeckError);
}

} // namespace plash

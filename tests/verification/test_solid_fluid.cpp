#include "tests/paths.h"
#include "tests/support/solid_column.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace plash {

using testing::Column;
using testing::Profile;
using testing::profile_of;
using testing::record_of;
using testing::solid_results;
using testing::SolidBlock;

namespace {

nlohmann::json reference()
{
    return nlohmann::json::parse(std::ifstream(PLASH_SOURCE_DIR "/tests/reference/analytic.json"));
}

/// Place where the pressure falls through half of `high`, from the left.
double front(const Profile& profile, double high)
{
    std::size_t i = profile.place.size() - 1;
    while (i > 0 && profile.pressure[i - 1] < 0.5 * high) --i;
    const double share =
        (0.5 * high - profile.pressure[i - 1]) / (profile.pressure[i] - profile.pressure[i - 1]);
    return profile.place[i - 1] + share * (profile.place[i] - profile.place[i - 1]);
}

double mean(const std::vector<double>& values, const std::vector<double>& place, double from, double to)
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (place[i] < from || place[i] > to) continue;
        sum += values[i];
        ++count;
    }
    return sum / count;
}

/// Drives a piston into a column of water and looks at the shock that runs ahead of it.
/// piston_speed, front_speed [length/time]; pressure  behind the front [stress]
void expect_shock(const Record& equation_of_state, double density, double piston_speed, double front_speed,
                  double pressure)
{
    Column column(200, 1.0, record_of("MAT_NULL", 1, {{"RO", density}}), equation_of_state);
    column.drive(0, piston_speed);
    const auto at = [&](double time) {
        column.model.controls.time.end_time = time;
        Scene scene = make_scene(column.model);
        Recorders none_recorded;
        const Outcome outcome = run(scene, none_recorded);
        return std::pair(profile_of(column, scene, density), outcome.clock.time);
    };
    const auto [early, early_time] = at(0.35 / front_speed);
    const auto [late, late_time] = at(0.75 / front_speed);
    // Difference of two times, so that the start-up at the piston drops out.
    const double speed_found = (front(late, pressure) - front(early, pressure)) / (late_time - early_time);
    EXPECT_NEAR(speed_found, front_speed, 2e-3 * front_speed);
    const double from = piston_speed * late_time + 0.1;
    EXPECT_NEAR(mean(late.pressure, late.place, from, 0.6), pressure, 2e-3 * pressure);
    // Behind the front mass is conserved.
    EXPECT_NEAR(mean(late.density, late.place, from, 0.6),
                density * front_speed / (front_speed - piston_speed), 1e-3 * density);
    EXPECT_GT(late.viscous, 0);
    // The balance is exact for a constant step; here the step shrinks while the shock forms.
    EXPECT_LT(late.balance, 2e-3);
}

} // namespace

TEST(Shock, PistonInWaterDrivesTheHugoniotOfGruneisen)
{
    for (const char* name : {"shah2015_seed002", "song_seed001"}) {
        const auto water = reference()["water_eos"][name];
        const Record equation = record_of("EOS_GRUNEISEN", 1,
                                          {{"C", water["C"]},
                                           {"S1", water["S1"]},
                                           {"S2", water["S2"]},
                                           {"S3", water["S3"]},
                                           {"GAMMA0", water["gamma0"]},
                                           {"A", water["a"]}});
        for (const char* speed : {"100", "300"}) {
            SCOPED_TRACE(std::string(name) + ", up " + speed);
            expect_shock(equation, water["rho0"], std::stod(speed), water["hugoniot"][speed]["Us"],
                         1e6 * double(water["hugoniot"][speed]["p_MPa"]));
        }
    }
}

/// Tait's water: the shock speed follows from the jumps of mass and momentum, K0 (r^gamma - 1) =
/// rho0 up^2 r / (r - 1) with the compression r = Us / (Us - up).
TEST(Shock, PistonInWaterDrivesTheShockOfMurnaghan)
{
    const double density = 1000, stiffness = density * 1500.0 * 1500.0 / 7;
    for (double piston : {100.0, 300.0}) {
        double low = 1, high = 2;
        for (int i = 0; i < 100; ++i) {
            const double r = 0.5 * (low + high);
            const bool beyond = stiffness * (std::pow(r, 7) - 1) * (r - 1) > density * piston * piston * r;
            (beyond ? high : low) = r;
        }
        const double front_speed = piston * low / (low - 1);
        SCOPED_TRACE(piston);
        expect_shock(record_of("EOS_MURNAGHAN", 1, {{"GAMMA", 7}, {"K0", stiffness}}), density, piston,
                     front_speed, density * front_speed * piston);
    }
}

TEST(Shock, PlanarNohStopsAndHeatsTheGas)
{
    const auto exact = reference()["noh_gamma5/3"]["planar"];
    const double gamma = 5.0 / 3;
    const auto run_noh = [&](int cells) {
        Column column(cells, 1.0, record_of("MAT_NULL", 1, {{"RO", 1}}),
                      record_of("EOS_LINEAR_POLYNOMIAL", 1, {{"C4", gamma - 1}, {"C5", gamma - 1}}));
        column.set_velocity([](const Vec3& x) { return Vec3{x.x > 0 ? -1.0 : 0.0, 0, 0}; });
        column.drive(0, 0);
        column.model.controls.time.end_time = 0.6;
        column.model.controls.time.step_scale = 0.6;
        Scene scene = make_scene(column.model);
        Recorders none_recorded;
        run(scene, none_recorded);
        return profile_of(column, scene, 1);
    };
    const Profile coarse = run_noh(100), fine = run_noh(400);
    // The shock stands at t / 3 = 0.2. Near the wall is wall heating, the known error of every artificial
    // viscosity (Noh 1987).
    EXPECT_NEAR(mean(fine.density, fine.place, 0.05, 0.15), exact["rho"], 0.01 * double(exact["rho"]));
    EXPECT_NEAR(mean(fine.pressure, fine.place, 0.05, 0.15), exact["p"], 0.01 * double(exact["p"]));
    EXPECT_NEAR(front(fine, exact["p"]), 0.2, 0.003);
    const auto error = [&](const Profile& p) {
        double sum = 0;
        for (std::size_t i = 0; i < p.place.size(); ++i) {
            sum += std::abs(p.density[i] - (p.place[i] < 0.2 ? 4.0 : 1.0)) / p.density[i];
        }
        return sum / static_cast<double>(p.place.size());
    };
    // First order at the shock and the wall: a quarter of the cell, about a quarter of the error.
    EXPECT_LT(error(fine), 0.35 * error(coarse));
    EXPECT_LT(fine.balance, 0.01);
}

TEST(Shock, SodTubeHasItsStarRegion)
{
    const auto exact = reference()["sod_gamma1.4"];
    const double gamma = 1.4, time = 0.2;
    // Left and right gas are two parts with their own reference density and energy.
    Column column(400, 1.0, record_of("MAT_NULL", 1, {{"RO", 1}}),
                  record_of("EOS_LINEAR_POLYNOMIAL", 1, {{"C4", gamma - 1}, {"C5", gamma - 1}, {"E0", 2.5}}));
    column.model.materials.push_back(record_of("MAT_NULL", 2, {{"RO", 0.125}}));
    column.model.equations_of_state.push_back(
        record_of("EOS_LINEAR_POLYNOMIAL", 2, {{"C4", gamma - 1}, {"C5", gamma - 1}, {"E0", 0.25}}));
    Part right = column.model.parts[0];
    right.id = 2;
    right.material = 1;
    right.equation_of_state = 1;
    column.model.parts.push_back(right);
    for (std::size_t i = 200; i < 400; ++i) column.model.solids.part[i] = 1;
    column.drive(0, 0);
    column.drive(400, 0);
    column.model.controls.time.end_time = time;
    Scene scene = make_scene(column.model);
    Recorders none_recorded;
    const Outcome outcome = run(scene, none_recorded);
    const Profile profile = profile_of(column, scene, 1);
    const double contact = 0.5 + outcome.clock.time * double(exact["u_star"]);
    const double shock = 0.5 + outcome.clock.time * double(exact["shock_speed"]);
    const double p_star = exact["p_star"];
    EXPECT_NEAR(mean(profile.pressure, profile.place, contact - 0.1, shock - 0.03), p_star, 0.005 * p_star);
    EXPECT_NEAR(mean(profile.velocity, profile.place, contact - 0.1, shock - 0.03), exact["u_star"], 0.005);
    EXPECT_NEAR(mean(profile.density, profile.place, contact - 0.1, contact - 0.01), exact["rho_star_left"],
                0.01);
    // The right gas has an eighth of the reference density.
    EXPECT_NEAR(mean(profile.density, profile.place, contact + 0.02, shock - 0.03) / 8,
                exact["rho_star_right"], 0.004);
    double place = shock;
    for (std::size_t i = profile.place.size() - 1; i > 0; --i) {
        if (profile.pressure[i - 1] < 0.5 * (p_star + 0.1)) continue;
        place = profile.place[i];
        break;
    }
    EXPECT_NEAR(place, shock, 0.005);
    EXPECT_LT(profile.balance, 2e-3);
}

TEST(Fluid, ViscosityShearsByItsRate)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, record_of("MAT_NULL", 1, {{"RO", 1000}, {"MU", 3}}));
    block.model.equations_of_state.push_back(record_of("EOS_LINEAR_POLYNOMIAL", 1, {{"C1", 2e9}}));
    block.model.parts[0].equation_of_state = 0;
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1e-6;
    for (std::size_t n = 0; n < state.size(); ++n) {
        state.velocity[n] = {50 * state.position[n].z, 0, 0};
        state.position[n] += 1e-6 * state.velocity[n];
    }
    groups[0]->add_forces(clock, state);
    const auto stress = solid_results(block.model, state, groups).solid_stress[0];
    EXPECT_NEAR(stress.zx, 3 * 50, 1e-9);
    EXPECT_NEAR(trace(stress), 0, 1e-3); // shear changes no volume; 2e9 times round-off
}

TEST(Fluid, IsErodedAtTheVolumesOfItsCard)
{
    for (double stretch : {1.3, 0.7}) {
        SolidBlock block({2, 1, 1}, {2, 1, 1},
                         record_of("MAT_NULL", 1, {{"RO", 1000}, {"TEROD", 1.2}, {"CEROD", 0.8}}));
        block.model.equations_of_state.push_back(record_of("EOS_LINEAR_POLYNOMIAL", 1, {{"C1", 2e9}}));
        block.model.parts[0].equation_of_state = 0;
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        // Only the second element changes its volume.
        for (std::size_t n = 0; n < state.size(); ++n) {
            if (state.position[n].x > 1.5) state.position[n].x = 1 + stretch;
        }
        Clock clock;
        clock.last_step = 1;
        groups[0]->add_forces(clock, state);
        state.clear_forces();
        groups[0]->add_forces(clock, state);
        const auto results = solid_results(block.model, state, groups);
        EXPECT_EQ(results.solid_deleted[0], 0);
        EXPECT_EQ(results.solid_deleted[1], 1);
        EXPECT_EQ(state.deletions, 1);
        EXPECT_EQ(state.deleted_solids[1], 1);
        for (std::size_t n = 0; n < state.size(); ++n) EXPECT_EQ(norm(state.force[n]), 0) << n;
    }
}

} // namespace plash

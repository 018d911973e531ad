#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "sph/particle_body.h"
#include "tests/support/particle_setup.h"
#include "tests/support/read_text.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

/// *INITIAL_STRESS_DEPTH: water and soil that carry their own weight from the first step on.
namespace plash::depth_cases {

namespace {

constexpr double density = 1000, gravity = 9.81, sound = 40, spacing = 0.1; // kg, m, s
constexpr int across = 8, high = 10;                                        // a basin 1 m deep

/// A basin of particles between walls, from z = 0 up; `start` is what it knows of its weight.
std::string basin(const std::string& start)
{
    std::string deck = fmt::format(
        "*KEYWORD\n*CONTROL_TERMINATION\n0.2\n*CONTROL_TIMESTEP\n0,0.5\n*PART\nwater\n1,1,1,1\n*SECTION_SPH\n"
        "1,1.5\n*PLASH_SPH_FORMULATION\n4,0.1\n*MAT_NULL\n1,{},-1e20\n*EOS_MURNAGHAN\n1,7.0,{}\n"
        "*LOAD_BODY_Z\n1,{}\n*DEFINE_CURVE\n1\n0,1\n100,1\n*BOUNDARY_SPH_SYMMETRY_PLANE\n"
        "0,0,0,1,0,0\n{},0,0,-1,0,0\n0,0,0,0,1,0\n0,{},0,0,-1,0\n0,0,0,0,0,1\n",
        density, density * sound * sound / 7, gravity, across * spacing, across * spacing);
    std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
    int number = 0;
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j)
            for (int k = 0; k < high; ++k) {
                nodes += fmt::format("{},{},{},{}\n", ++number, (i + 0.5) * spacing, (j + 0.5) * spacing,
                                     (k + 0.5) * spacing);
                elements += fmt::format("{},1,{}\n", number, density * spacing * spacing * spacing);
            }
    return deck + start + nodes + elements + "*END\n";
}

/// Largest vertical velocity of the mean of all particles over a run: that of the basin as a whole
/// [length/time].
double swing(const std::string& start)
{
    const Model model = testing::model_of_text(basin(start));
    Scene scene = make_scene(model);
    double largest = 0;
    add_particle_probe(scene, [&](const Clock&, const State& state) {
        double mean = 0;
        for (const Vec3& v : state.velocity) mean += v.z / static_cast<double>(state.size());
        largest = std::max(largest, std::abs(mean));
    });
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_LT(scene.ledger.balance_error(), 0.01);
    return largest;
}

const std::string weight = fmt::format("*INITIAL_STRESS_DEPTH\n1,{},{},1\n", density* gravity, high* spacing);

} // namespace

TEST(SphDepth, PressureIsThatOfTheWaterAbove)
{
    const Model model = testing::model_of_text(basin(weight));
    const Scene scene = make_scene(model);
    const ParticleArrays& a = dynamic_cast<const ParticleBody&>(*scene.terms.at(0)).arrays();
    for (Index p = 0; p < a.real_count(); ++p) {
        const double pressure = density * gravity * (high * spacing - a.motion[p].position.z);
        EXPECT_NEAR(a.pressure(p), pressure, 1e-9 * density * gravity);
        // Tait: p = B ((rho / rho0)^7 - 1)
        EXPECT_NEAR(a.density(p), density * std::pow(1 + 7 * pressure / (density * sound * sound), 1.0 / 7),
                    1e-9 * density);
    }
}

/// Water that starts without pressure falls until its own sound has told it of the floor, on average at
/// g H / (2 c), and goes on swinging. What is left with its weight is the free surface, where the sums of the
/// kernel end.
TEST(SphDepth, WaterStartsAtRest)
{
    const double falling = swing(""), resting = swing(weight);
    EXPECT_NEAR(falling, 0.5 * gravity * high * spacing / sound, 0.05 * falling); // 0.1225 for 0.1226
    EXPECT_LT(resting, 0.05 * falling);                                           // 3 % as measured
}

TEST(SphDepth, SaysWhatItCannotGive)
{
    EXPECT_EQ(testing::complaint_about(basin("*INITIAL_STRESS_DEPTH\n1,9810,1,0.5\n")),
              "*INITIAL_STRESS_DEPTH: the particles of part 1 must be a fluid, and KFACT must be 1, as "
              "pressure acts alike");
    EXPECT_EQ(testing::complaint_about(basin("*PART\nempty\n2,1,1,1\n*INITIAL_STRESS_DEPTH\n2,9810,1,1\n")),
              "*INITIAL_STRESS_DEPTH: part 2 has neither Lagrangian solids nor particles");
}

} // namespace plash::depth_cases

#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/paths.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

/// Quick runs of decks under examples/ (those that take seconds).
namespace plash {

namespace {

ReadResult read_example(const std::string& name, std::vector<std::pair<std::string, std::string>> parameters)
{
    ReadResult read =
        read_model(std::string(PLASH_SOURCE_DIR) + "/examples/" + name, {std::move(parameters)});
    EXPECT_TRUE(read.ok);
    EXPECT_TRUE(unsupported_keywords(read.report).empty());
    return read;
}

/// Solid angle of a triangle as seen from the origin (Van Oosterom & Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c)
{
    const double la = norm(a), lb = norm(b), lc = norm(c);
    return 2 *
           std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Particles that the closed surface of all shells does not go around.
int particles_outside(const Scene& scene)
{
    int count = 0;
    for (const auto& particle : scene.model.particles.node) {
        const Vec3& x = scene.state.position[particle];
        double angle = 0;
        for (const auto& shell : scene.model.shells.nodes) {
            const auto corner = [&](int i) { return scene.state.position[shell[i]] - x; };
            angle +=
                solid_angle(corner(0), corner(1), corner(2)) + solid_angle(corner(0), corner(2), corner(3));
        }
        count += angle < 2 * std::numbers::pi;
    }
    return count;
}

} // namespace

/// The case of the paper in which particles burst through the tank's wall: the block comes at 10 m/s.
TEST(ExampleDecks, NoWaterBurstsThroughTheBarrierAtTenMetresASecond)
{
    for (const char* fill : {"50", "100"}) {
        const ReadResult read =
            read_example("water_barrier/barrier.k", {{"FILL", fill}, {"SPEED", "10e3"}, {"END", "0.003"}});
        Scene scene = make_scene(read.model);
        EXPECT_EQ(particles_outside(scene), 0);
        Recorders nobody;
        const Outcome outcome = run(scene, nobody);
        ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
        EXPECT_EQ(particles_outside(scene), 0) << fill;
        // 1 kg at 10 m/s; 0.004 % of balance with the full tank as measured over 5 ms.
        EXPECT_NEAR(scene.ledger.initial_total, 0.5e-3 * 1e4 * 1e4, 5); // the density has four digits
        EXPECT_LT(scene.ledger.balance_error(), 2e-4);
        // The block has hit: tank and water have several per cent of its energy.
        EXPECT_GT(scene.ledger.internal, 1e-3 * scene.ledger.initial_total);
    }
}

} // namespace plash

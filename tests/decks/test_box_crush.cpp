#include "contact/surface_contact.h"
#include "parser/read_model.h"
#include "solver/explicit_loop.h"
#include "solver/scene.h"
#include "tests/support/contact_model.h"
#include "tests/support/shared_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace plash {

namespace {

struct PeerRow {
    double time = 0, internal = 0, kinetic = 0, momentum = 0;
};

/// The peer's curve: time, internal and kinetic energy, momentum along z.
std::vector<PeerRow> peer_curve(const std::filesystem::path& path)
{
    std::vector<PeerRow> rows;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#' || line[0] == 't') continue;
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream words(line);
        PeerRow row;
        words >> row.time >> row.internal >> row.kinetic >> row.momentum;
        rows.push_back(row);
    }
    return rows;
}

struct Crush {
    double absorbed = 0; ///< what the motion has lost, so that hourglass energy counts on both sides [energy]
    double force = 0;    ///< mean, of the wall [force]
    double sliding = 0;  ///< at the end, over the internal energy
    double friction = 0; ///< what of it friction has taken
};

/// A square tube folds at 15 m/s against a wall, 29,000 cycles of self-contact.
Crush crush(const ReadResult& read)
{
    Scene scene = make_scene(read.model);
    const auto momentum = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < scene.state.size(); ++i) {
            sum += scene.state.mass[i] * scene.state.velocity[i].z;
        }
        return sum;
    };
    const double before = momentum();
    double least_sliding = 0;
    scene.terms.push_back(std::make_unique<testing::Watch>(
        [&](const Clock&, const State&) { least_sliding = std::min(least_sliding, scene.ledger.sliding); }));
    Recorders nothing;
    const Outcome outcome = run(scene, nothing);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    EXPECT_LT(scene.ledger.balance_error(), 1e-3);
    double friction = 0;
    for (const auto& term : scene.terms)
        if (const auto* contact = dynamic_cast<const SurfaceContact*>(term.get()))
            friction += contact->friction_energy();
    // Contact takes energy; it used to give the shells 0.03 of theirs when the first fold snapped through.
    EXPECT_GT(least_sliding, -1e-4 * scene.ledger.internal);
    return {scene.ledger.initial_total - scene.ledger.kinetic, (momentum() - before) / outcome.clock.time,
            scene.ledger.sliding / scene.ledger.internal, friction / scene.ledger.internal};
}

/// The same of the open peer with one of its shells, which differ by 15 % in absorbed energy (10.27 and 11.80
/// J x 1e6).
Crush crush_of_peer(const std::string& shell)
{
    const auto rows = peer_curve(testing::shared_file("decks/peer_runs/box_crush_1280_" + shell + ".csv"));
    EXPECT_GT(rows.size(), 100u);
    const PeerRow &first = rows.front(), &last = rows.back();
    return {first.kinetic - last.kinetic, (last.momentum - first.momentum) / last.time, 0, 0};
}

} // namespace

TEST(BoxCrush, TubeOf1280ShellsFoldsAsThePeersDo)
{
    const auto deck = testing::shared_file("decks/peer_runs/box_crush_1280.k");
    PLASH_NEED_SHARED(deck);
    const ReadResult read = read_model(deck.string());
    ASSERT_TRUE(read.ok);
    EXPECT_TRUE(unsupported_keywords(read.report).empty());
    const Crush found = crush(read), soft = crush_of_peer("belytschko_tsay"),
                stiff = crush_of_peer("physical_hourglass_quad");
    EXPECT_NEAR(found.absorbed / soft.absorbed, 1, 0.15);
    EXPECT_NEAR(found.absorbed / stiff.absorbed, 1, 0.15);
    EXPECT_NEAR(found.force / stiff.force, 1, 0.15);
    EXPECT_NEAR(found.friction, 0.0098, 0.0015);
    EXPECT_LT(found.sliding - found.friction, 0.022); // 0.0195; 0.001 of it by damping, 0.008 held at the end
}

/// The peer's Belytschko-Tsay quad has hourglass coefficients of 0.01 and does not read those of the deck
/// (0.1 of type 4, of which 10 % of the absorbed energy is hourglass energy and the mean force 53.1 kN
/// instead of 45.4). With 0.01 the forces are comparable; without hourglass modes at all (ELFORM 16) it
/// is 44.3 kN.
TEST(BoxCrush, MeanForceOfThePeersSofterShellWithItsHourglassControl)
{
    const auto deck = testing::shared_file("decks/peer_runs/box_crush_1280.k");
    PLASH_NEED_SHARED(deck);
    ReadResult read = read_model(deck.string());
    read.model.controls.elements.hourglass_coefficient = 0.01;
    EXPECT_NEAR(crush(read).force / crush_of_peer("belytschko_tsay").force, 1, 0.15);
}

/// Without friction and damping all that contact has taken is what pressed segments hold, or lost: 0.013,
/// where it was 0.027 while forces between bent segments had no energy.
TEST(BoxCrush, SlidingEnergyOfTheTubeWithoutFrictionIsSmall)
{
    const auto deck = testing::shared_file("decks/peer_runs/box_crush_1280.k");
    PLASH_NEED_SHARED(deck);
    ReadResult read = read_model(deck.string());
    Contact& contact = read.model.contacts.at(0);
    contact.static_friction = contact.dynamic_friction = contact.damping = 0;
    const Crush found = crush(read);
    EXPECT_LT(found.sliding, 0.02);
    EXPECT_GT(found.sliding, 0.005) << "something is pressed";
}

} // namespace plash

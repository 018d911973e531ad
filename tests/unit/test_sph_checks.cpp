#include "solver/scene.h"
#include "tests/support/read_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

/// What decks with particles are told before they run.
namespace plash {

namespace {

struct CheckedDeck {
    double mass = 1e-6;       ///< of each of 5 x 5 x 5 particles of 1e-9 in density, 10 apart
    double disorder = 0;      ///< by which they are moved to and fro, in spacings
    int layers = 5;           ///< along z
    double plate = 60;        ///< z of a shell above the particles
    std::string motion = {};  ///< keywords
    std::string contact = {}; ///< likewise
};

std::string text_of_deck(const CheckedDeck& deck)
{
    std::string text = "*KEYWORD\n*CONTROL_TERMINATION\n1\n*PART\nwater\n1,7,3,4\n*SECTION_SPH\n7\n"
                       "*MAT_NULL\n3,1e-9,-1,1e-9\n*EOS_GRUNEISEN\n4,1.48e6,1.92,,,0.1\n\n"
                       "*PART\nplate\n2,8,20\n*SECTION_SHELL\n8\n1\n*MAT_ELASTIC\n20,8e-9,2e5,0.3\n";
    text += fmt::format(
        "*NODE\n1,0,0,{0}\n2,50,0,{0}\n3,50,50,{0}\n4,0,50,{0}\n*ELEMENT_SHELL\n1,2,1,2,3,4\n", deck.plate);
    std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
    int id = 100;
    unsigned random = 1;
    const auto jitter = [&] {
        random = random * 1664525u + 1013904223u;
        return deck.disorder * 10 * ((random >> 8) / double(1 << 24) - 0.5);
    };
    for (int i = 0; i < 25 * deck.layers; ++i, ++id) {
        nodes += fmt::format("{},{:.4f},{:.4f},{:.4f}\n", id, 10 * (i % 5) + jitter(),
                             10 * (i / 5 % 5) + jitter(), 10 * (i / 25) + jitter());
        elements += fmt::format("{},1,{:g}\n", id, deck.mass);
    }
    return text + deck.motion + deck.contact + nodes + elements + "*END\n";
}

std::vector<std::string> notices_of(const CheckedDeck& deck)
{
    const Model model = testing::model_of_text(text_of_deck(deck));
    const Scene scene = make_scene(model);
    std::vector<std::string> all;
    for (const auto& term : scene.terms)
        for (const std::string& line : term->notices(scene.state)) all.push_back(line);
    return all;
}

const std::string contact = "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n\n\n";

} // namespace

TEST(SphChecks, MassesThatDoNotFitTheSpacingAreNamed)
{
    EXPECT_TRUE(notices_of({.contact = contact}).empty());
    // A lattice with corners, edges and faces tells 1 +- a factor of 2 from anything beyond.
    EXPECT_TRUE(notices_of({.mass = 1.9e-6, .contact = contact}).empty());
    EXPECT_TRUE(notices_of({.mass = 0.51e-6, .contact = contact}).empty());
    EXPECT_EQ(notices_of({.mass = 1e-9, .contact = contact}),
              std::vector<std::string>{
                  "the particles of part 1 have a mass of 1e-09 (median), 0.001 times the 1e-06 that their "
                  "spacing of 10 gives at the density 1e-09: is the unit of one of them wrong?"});
    EXPECT_EQ(notices_of({.mass = 0.49e-6, .contact = contact}).size(), 1u);
    // Most of these stand on faces and edges, whose sixth neighbour is sqrt(2) spacings away.
    EXPECT_EQ(notices_of({.mass = 5.9e-6, .contact = contact}).size(), 1u);
    EXPECT_EQ(notices_of({.mass = 1e-3, .contact = contact}).size(), 1u);
}

TEST(SphChecks, DisorderAndThinSheetsAreNotTakenForWrongMasses)
{
    EXPECT_TRUE(notices_of({.disorder = 0.8, .contact = contact}).empty());
    EXPECT_TRUE(notices_of({.layers = 1, .contact = contact}).empty());
    EXPECT_TRUE(notices_of({.mass = -1000, .contact = contact}).empty()); // by volume
    EXPECT_EQ(notices_of({.mass = -1, .contact = contact}).size(), 1u);
}

TEST(SphChecks, ParticlesInNoContactAreNamedWhereABodyIsNear)
{
    const std::string alone =
        "the particles of part 1 are in no contact that sees particles (single surfaces "
        "do not): nothing keeps them from passing through part 2";
    EXPECT_EQ(notices_of({}), std::vector<std::string>{alone});
    EXPECT_EQ(notices_of({.contact = "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,0,5,0\n\n\n"}),
              std::vector<std::string>{alone});
    EXPECT_TRUE(notices_of({.contact = contact}).empty());
    const std::string by_nodes =
        "*SET_NODE_LIST\n9\n100,101,102\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n9,2,4,3\n\n\n";
    EXPECT_TRUE(notices_of({.contact = by_nodes}).empty());
}

TEST(SphChecks, BodiesFarAwayCountWhenTheParticlesFlyAtThem)
{
    const auto flying = [](double speed) {
        return fmt::format("*INITIAL_VELOCITY_GENERATION\n1,2,0,0,0,{:g}\n\n", speed);
    };
    EXPECT_TRUE(notices_of({.plate = 1000}).empty());
    EXPECT_EQ(notices_of({.plate = 1000, .motion = flying(1000)}).size(), 1u);
    EXPECT_TRUE(notices_of({.plate = 1000, .motion = flying(900)}).empty()); // gets to 940 by the end
    EXPECT_TRUE(notices_of({.plate = 1000, .motion = flying(-1000)}).empty());
}

} // namespace plash

#include "elements/beam_integration.h"
#include "solver/scene.h"
#include "tests/support/beam_model.h"
#include "tests/support/deck_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plash {

namespace {

BeamSection section_with(std::vector<std::pair<const char*, double>> rule, double ts = 0, double tt = 0)
{
    Model model = beam_model(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 1}, {"PR", 0}}),
                             {{"ELFORM", 1}, {"QR/IRID", -3}, {"TS1", ts}, {"TT1", tt}}, 1, 1);
    rule.insert(rule.begin(), {"IRID", 3});
    model.others.push_back(make_record("INTEGRATION_BEAM", std::move(rule)));
    return beam_section(model, model.parts[0]);
}

} // namespace

TEST(BeamIntegration, StandardSectionsHaveExactAreasAndMoments)
{
    // The W section of a column: W = 0.1732, TF = 0.0157, D = 0.3634, TW = 0.0091.
    const double w = 0.1732, tf = 0.0157, d = 0.3634, tw = 0.0091, inner = d - 2 * tf;
    const BeamSection column = section_with({{"ICST", 1}, {"D1", w}, {"D2", tf}, {"D3", d}, {"D4", tw}});
    EXPECT_NEAR(column.area, 2 * w * tf + inner * tw, 1e-15);
    EXPECT_NEAR(column.inertia_s, (w * d * d * d - (w - tw) * inner * inner * inner) / 12, 1e-16);
    EXPECT_NEAR(column.inertia_t, (2 * tf * w * w * w + inner * tw * tw * tw) / 12, 1e-16);
    EXPECT_EQ(column.points.size(), 24u);

    const BeamSection tube = section_with({{"ICST", 5}, {"D1", 4}, {"D2", 0.5}, {"D3", 6}, {"D4", 0.25}});
    EXPECT_NEAR(tube.area, 4 * 6 - 3.5 * 5, 1e-12);
    EXPECT_NEAR(tube.inertia_s, (4 * 216 - 3.5 * 125) / 12, 1e-11);
    EXPECT_NEAR(tube.inertia_t, (6 * 64 - 5 * 3.5 * 3.5 * 3.5) / 12, 1e-11);

    const double pi = std::numbers::pi;
    const BeamSection rod = section_with({{"ICST", 8}, {"D1", 2}});
    EXPECT_NEAR(rod.area, 4 * pi, 1e-12);
    EXPECT_NEAR(rod.inertia_s, pi * 16 / 4, 1e-11);
    const BeamSection pipe = section_with({{"ICST", 9}, {"D1", 2}, {"D2", 1}});
    EXPECT_NEAR(pipe.inertia_t, pi * 15 / 4, 1e-11);
}

TEST(BeamIntegration, PointsOfADeckReachTheSection)
{
    // Two flanges of a sandwich, 2 wide (TS) and 6 deep (TT), of which a tenth is there; weights in any
    // scale.
    const testing::DeckRun deck("*KEYWORD\n*NODE\n1,0,0,0\n2,10,0,0\n3,0,0,10\n*ELEMENT_BEAM\n1,1,1,2,3\n"
                                "*PART\nbeam\n1,1,1\n*SECTION_BEAM\n1,1,1.0,-4\n2.0,2.0,6.0,6.0\n"
                                "*INTEGRATION_BEAM\n4,4,0.1\n1,1,3\n-1,1,3\n1,-1,3\n-1,-1,3\n"
                                "*MAT_ELASTIC\n1,1,1,0\n*CONTROL_TERMINATION\n1\n*END\n");
    const Model& model = deck.scene->model;
    const BeamSection section = beam_section(model, model.parts[0]);
    EXPECT_NEAR(section.area, 1.2, 1e-14);
    ASSERT_EQ(section.points.size(), 4u);
    EXPECT_NEAR(section.inertia_s, 1.2 * 9, 1e-13);
    EXPECT_NEAR(section.inertia_t, 1.2 * 1, 1e-13);
    EXPECT_NEAR(section.points[1].s, -1, 1e-15);
    EXPECT_NEAR(section.points[1].t, 3, 1e-15);
    EXPECT_NEAR(section.points[1].share, 0.25, 1e-15);
}

TEST(BeamIntegration, WhatIsNotThereIsNamed)
{
    EXPECT_THROW(section_with({{"ICST", 2}, {"D1", 4}, {"D2", 0.5}, {"D3", 6}, {"D4", 0.25}}), DeckError);
    EXPECT_THROW(section_with({{"ICST", 1}, {"D1", 4}, {"D2", 3.5}, {"D3", 6}, {"D4", 0.25}}), DeckError);
    Model model = beam_model(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 1}, {"PR", 0}}),
                             {{"ELFORM", 1}, {"QR/IRID", -9}, {"TS1", 1}}, 1, 1);
    EXPECT_THROW(beam_section(model, model.parts[0]), DeckError);
}

TEST(InitialBeamStress, StandsAtTheStartAndIsInBalanceWithItself)
{
    // A stretched beam between two held nodes: the force of the first cycle is that of its stresses.
    const auto force_of = [](const std::string& card, const std::string& section) {
        testing::DeckRun deck("*KEYWORD\n*NODE\n1,0,0,0\n2,10,0,0\n3,0,0,10\n*ELEMENT_BEAM\n1,1,1,2,3\n"
                              "*PART\nbeam\n1,1,1\n*SECTION_BEAM\n" +
                              section + "*MAT_PLASTIC_KINEMATIC\n1,1,100,0,50,1\n" +
                              "*BOUNDARY_SPC_NODE\n1,0,1,1,1,1,1,1\n2,0,1,1,1,1,1,1\n"
                              "*INITIAL_STRESS_BEAM\n" +
                              card + "*CONTROL_TERMINATION\n0.5\n*END\n");
        deck.go();
        ElementResults results;
        results.beams.resize(1);
        for (const auto& term : deck.scene->terms) term->collect(deck.scene->state, results);
        return results.beams[0];
    };
    const std::string four = "1,1,1.0,2\n2.0,2.0,6.0,6.0\n";
    // 2 x 2 Gauss points in the order (s, t) = (-, -), (-, +), (+, -), (+, +)
    const auto bent = force_of("1,2,4,1\n9\n11\n9\n11\n", four);
    EXPECT_NEAR(bent.axial, 12 * 10, 1e-10);
    EXPECT_NEAR(bent.moment_s, 12 * 3 / std::sqrt(3.0), 1e-10); // sum of t sigma dA
    EXPECT_NEAR(bent.moment_t, 0, 1e-10);
    EXPECT_NEAR(force_of("1,0,0\n24\n", four).axial, 24, 1e-12);
    EXPECT_NEAR(force_of("1,0,0\n24\n", "1,3\n2.0\n").axial, 24, 1e-12);
}

} // namespace plash

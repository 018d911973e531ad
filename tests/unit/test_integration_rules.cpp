#include "elements/shell_settings.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

/// The rule that a section with QR/IRID = -7 gets from a card of *INTEGRATION_SHELL.
ThicknessRule rule_of(double option, const std::vector<double>& rows, double id = 7)
{
    Model model = shell_model(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 1}, {"PR", 0}}),
                              {{"ELFORM", 2}, {"T1", 1}, {"QR/IRID", -7}});
    Record card =
        make_record("INTEGRATION_SHELL",
                    {{"IRID", id}, {"NIP", rows.empty() ? 4.0 : rows.size() / 3.0}, {"ESOP", option}});
    if (!rows.empty())
        card.tables.push_back({{"S", "WF", "PID"}, rows, {}, std::vector<int>(rows.size() / 3, 5), false});
    model.others.push_back(card);
    return shell_settings(model, 0, 1, 1, 0).rule;
}

} // namespace

TEST(IntegrationShell, GivesPlacesAndWeightsFromTheBottom)
{
    const ThicknessRule rule = rule_of(0, {0.5, 0.3, 0, -0.8, 0.2, 0, 0, 0.1, 0});
    EXPECT_EQ(rule.place, (std::vector<double>{-0.8, 0, 0.5}));
    ASSERT_EQ(rule.size(), 3); // weights sum to one
    EXPECT_NEAR(rule.weight[0], 0.2 / 0.6, 1e-15);
    EXPECT_NEAR(rule.weight[2], 0.3 / 0.6, 1e-15);
}

TEST(IntegrationShell, CutsTheThicknessIntoEqualLayers)
{
    const ThicknessRule rule = rule_of(1, {});
    EXPECT_EQ(rule.place, (std::vector<double>{-0.75, -0.25, 0.25, 0.75}));
    for (double weight : rule.weight) EXPECT_EQ(weight, 0.25);
}

TEST(IntegrationShell, WrongPointsAreRefused)
{
    EXPECT_THROW(rule_of(0, {1.5, 1, 0}), DeckError);
    EXPECT_THROW(rule_of(0, {0, 0, 0}), DeckError);
    EXPECT_THROW(rule_of(0, {0, 1, 3}), DeckError); // a material of its own
    EXPECT_THROW(rule_of(0, {0, 1, 0}, 8), DeckError);
}

} // namespace plash

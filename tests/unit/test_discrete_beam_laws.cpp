#include "materials/discrete_beam_law.h"
#include "tests/support/beam_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace plash {

namespace {

/// Forces of one freedom along a path of ways, each reached in one step with the given rate.
std::vector<double> forces_along(const DiscreteBeamLaw& law, const std::vector<double>& ways, int freedom = 0,
                                 double rate = 0, double start_length = 10)
{
    DiscreteBeamPoint point;
    point.start_length = start_length;
    std::vector<double> forces;
    for (double way : ways) {
        point.way[freedom] = way;
        point.rate[freedom] = rate;
        point.length = start_length + way;
        law.advance({&point, 1}, 0, 1);
        forces.push_back(point.force[freedom]);
    }
    return forces;
}

void expect_all_near(const std::vector<double>& found, const std::vector<double>& wanted, double tolerance)
{
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], wanted[i], tolerance) << "step " << i;
}

} // namespace

TEST(DiscreteBeamLaws, LinearHasPreloadStiffnessAndDamping)
{
    const Model model;
    const auto law = make_discrete_beam_law(
        make_record("MAT_LINEAR_ELASTIC_DISCRETE_BEAM", {{"RO", 2}, {"TKS", 3}, {"TDS", 0.5}, {"FOS", 7}}),
        model);
    expect_all_near(forces_along(*law, {0, 1, -2}, 1, 4), {9, 12, 3}, 1e-14);
    expect_all_near(forces_along(*law, {1}, 0, 4), {0}, 0); // no stiffness there
    EXPECT_EQ(law->stiffness({})[1], 3);
    EXPECT_EQ(law->damping({})[1], 0.5);
    EXPECT_EQ(law->density, 2);
}

TEST(DiscreteBeamLaws, NonlinearFollowsItsCurvesInBothSensesAndFails)
{
    Model model;
    add_curve(model, {0, 1, 2}, {0, 10, 12});
    add_curve(model, {-1, 1}, {-5, 5});
    const auto law =
        make_discrete_beam_law(make_record("MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM",
                                           {{"LCIDTR", 1}, {"LCIDTDR", 2}, {"UFAILR", 1.6}, {"FFAILS", 1}}),
                               model);
    expect_all_near(forces_along(*law, {0.5, 1.5, -1.5}, 0, 0.2), {6, 12, -10}, 1e-13);
    EXPECT_EQ(law->stiffness({})[0], 10);
    EXPECT_EQ(law->damping({})[0], 5);
    DiscreteBeamPoint point;
    point.way[0] = 1.59;
    law->advance({&point, 1}, 0, 1);
    EXPECT_FALSE(point.failed);
    point.way[0] = -1.61;
    law->advance({&point, 1}, 0, 1);
    EXPECT_TRUE(point.failed);
}

TEST(DiscreteBeamLaws, PlasticReturnsToItsYieldCurveExactlyInOneStepOrMany)
{
    Model model;
    add_curve(model, {0, 1, 2, 3}, {10, 14, 15, 5}); // hardens twice, then softens
    const auto law = make_discrete_beam_law(
        make_record("MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", {{"TKT", 20}, {"LCPDT", 1}}), model);
    // K (way - p) = yield(p): way 0.5 -> p = 0, 10; way 1.7 -> p = 1: 14; way 2.75 -> p = 2: 15.
    expect_all_near(forces_along(*law, {0.5, 1.7, 2.75, 2.25, 2.0}, 2), {10, 14, 15, 5, 0}, 1e-12);
    std::vector<double> ways;
    for (int i = 1; i <= 55; ++i) ways.push_back(0.05 * i);
    EXPECT_NEAR(forces_along(*law, ways, 2).back(), 15, 1e-12); // the same in 55 steps
    // Yields at the same force the other way round: p = 2 after 2.75, then from 2.0 down by 15 / 20 and on.
    const auto back = forces_along(*law, {2.75, 2.0 - 15.0 / 20, 2.0 - 15.0 / 20 - 0.5}, 2);
    EXPECT_NEAR(back[1], -15, 1e-12);
    EXPECT_NEAR(back[2], -5, 1e-12); // p grows by 1 while K (way + ...) : softening of 10 over p from 2 to 3
}

TEST(DiscreteBeamLaws, HydraulicDamperAddsGasAndOrifice)
{
    Model model;
    add_curve(model, {0, 10}, {2, 2});
    const auto law = make_discrete_beam_law(
        make_record(
            "MAT_HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM",
            {{"CO", 4}, {"N", 1.4}, {"P0", 3}, {"PA", 1}, {"AP", 2}, {"KH", 8}, {"LCID", 1}, {"FR", 0.25}}),
        model);
    ASSERT_TRUE(law->along_nodes);
    // Shortened by 1 at a rate of 0.5: 8 (0.5 / 2)^2 + (3 (4 / 3)^1.4 - 1) 2, compressive.
    const double gas = (3 * std::pow(4.0 / 3, 1.4) - 1) * 2;
    expect_all_near(forces_along(*law, {-1}, 0, -0.5), {-(0.5 + gas)}, 1e-13);
    expect_all_near(forces_along(*law, {-1}, 0, 0.5), {0.25 * 0.5 - gas},
                    1e-13); // lengthens: the valve opens
    // dF/dway at rest, by differences
    DiscreteBeamPoint point;
    point.way[0] = -1;
    const auto two = forces_along(*law, {-1 - 1e-6, -1 + 1e-6});
    EXPECT_NEAR(law->stiffness(point)[0], (two[1] - two[0]) / 2e-6, 1e-6);
}

TEST(DiscreteBeamLaws, SidDamperClosesItsOrificesAsThePistonPassesThem)
{
    // Values of tests/reference/sid_damper.py, whose sums over strips are good to 1e-6.
    Model model;
    add_curve(model, {0, 1, 2}, {0, 3, 8});
    add_curve(model, {0, 1}, {0.2, 0.3});
    Record material = make_record("MAT_SID_DAMPER_DISCRETE_BEAM", {{"ST", 6.5},
                                                                   {"D", 4},
                                                                   {"R", 0.4},
                                                                   {"H", 0.15},
                                                                   {"K", 2},
                                                                   {"C", 0.6},
                                                                   {"STF", 50},
                                                                   {"RHOF", 1.2},
                                                                   {"C1", 0.3},
                                                                   {"C2", 0.5},
                                                                   {"LCIDF", 1},
                                                                   {"LCIDD", 2},
                                                                   {"S0", 0.1}});
    Table table;
    table.columns = {"ORFLOC", "ORFRAD", "SF", "DC"};
    table.values = {2, 0, 1.5, 7, 4, 0.5, 1, 0, 4.6, 0, 1, 0};
    table.lines = {1, 2, 3};
    material.tables.push_back(table);
    Record with_inertia = material;
    with_inertia.fields.push_back({"C3", 0.5, "", true, false, {}});
    EXPECT_THROW(make_discrete_beam_law(with_inertia, model), DeckError);
    const auto law = make_discrete_beam_law(material, model);
    ASSERT_TRUE(law->along_nodes);
    EXPECT_NE(law->notice.find("segment of height H = 0.15"), std::string::npos) << law->notice;
    const auto at = [&](double length, double rate) {
        return forces_along(*law, {length - 6}, 0, rate, 6).front();
    };
    for (const auto& [length, rate, force] : {std::array{6.0, -0.5, -984.21595},
                                              {4.7, -0.5, -1215.31107},
                                              {4.1, 0.7, 6295.45799},
                                              {2.3, -0.2, -2495.64141},
                                              {1.95, -0.2, -11479.68639},
                                              {1.62, -0.01, -3980.53128}})
        EXPECT_NEAR(at(length, rate), force, 1e-5 * std::abs(force)) << length;
    // Bottomed out: beyond the stroke, and where the last orifice, at 2 - 0.4, has closed.
    EXPECT_NEAR(at(6.7, 0.1), 50 * 0.2 + 7 * 0.1, 1e-12);
    EXPECT_NEAR(at(1.5, -0.1), -50 * 0.1 - 7 * 0.1, 1e-12);
    // The damping that the step sees is dF/dV.
    DiscreteBeamPoint point;
    point.length = 4.1;
    point.way[0] = -1.9;
    point.rate[0] = 0.7;
    EXPECT_NEAR(law->damping(point)[0], (at(4.1, 0.7 + 1e-5) - at(4.1, 0.7 - 1e-5)) / 2e-5, 1e-4);
    EXPECT_EQ(law->stiffness(point)[0], 50);
    point.length = 1.5;
    EXPECT_EQ(law->damping(point)[0], 7);
    const auto with = [&](std::string_view name, double value) {
        Record changed = material;
        for (Record::Field& field : changed.fields)
            if (field.name == name) field.value = value;
        return make_discrete_beam_law(changed, model);
    };
    EXPECT_EQ(with("STF", 5)->stiffness(point)[0], 1.5 * 5); // SF times the steepest slope of LCIDF
    EXPECT_THROW(with("K", -1), DeckError);
    EXPECT_THROW(with("C", 10), DeckError); // the fluid would drive the piston
}

TEST(DiscreteBeamLaws, CableCarriesTensionAloneAndHoldsItsPreload)
{
    Model model;
    add_curve(model, {0, 0.1, 0.2}, {0, 50, 60});
    const auto make = [&](std::vector<std::pair<const char*, double>> fields, double area, double offset) {
        auto law = make_discrete_beam_law(make_record("MAT_CABLE_DISCRETE_BEAM", std::move(fields)), model);
        law->area = area;
        law->length_offset = offset;
        return law;
    };
    // K = E A / (L - OFFSET) = 100 * 2 / 8, from a length of 8 on.
    expect_all_near(forces_along(*make({{"E", 100}}, 2, 2), {-4, -2, 0, 1}), {0, 0, 50, 75}, 1e-12);
    expect_all_near(forces_along(*make({{"E", -5}, {"F0", 3}}, 2, 0), {-1, 0, 2}), {0, 3, 13}, 1e-12);
    expect_all_near(forces_along(*make({{"LCID", 1}}, 2, 0), {-1, 0.5, 1.5}), {0, 50, 110}, 1e-12);
    // F0 alone until TMAXF0 while the ramp lasts; from there on elastic about the length reached.
    const auto law = make({{"E", -5}, {"F0", 4}, {"TMAXF0", 2}, {"TRAMP", 1}}, 1, 0);
    DiscreteBeamPoint point;
    point.start_length = 10;
    const auto at = [&](double time, double length) {
        point.length = length;
        law->advance({&point, 1}, time, 0.1);
        return point.force[0];
    };
    EXPECT_NEAR(at(0.5, 9.5), 2, 1e-13);
    EXPECT_NEAR(at(2, 9), 4, 1e-13);
    EXPECT_NEAR(at(2.1, 9), 4, 1e-13);
    EXPECT_NEAR(at(3, 9.2), 5, 1e-13);
    EXPECT_NEAR(at(3.5, 8), 0, 1e-13);
}

TEST(DiscreteBeamLaws, SpringsOf074And094)
{
    Model model;
    add_curve(model, {0, 1, 3}, {0, 4, 6});
    add_curve(model, {0, 10}, {0, 20});
    add_curve(model, {0, 4}, {1, 3});
    const auto elastic = make_discrete_beam_law(make_record("MAT_ELASTIC_SPRING_DISCRETE_BEAM", {{"K", 2},
                                                                                                 {"F0", 1},
                                                                                                 {"D", 0.5},
                                                                                                 {"FLCID", 1},
                                                                                                 {"HLCID", 2},
                                                                                                 {"GLCID", 3},
                                                                                                 {"C1", 0.1},
                                                                                                 {"C2", 0.2},
                                                                                                 {"DLE", 1}}),
                                                model);
    const double v = 3, f = 2 * 5; // K f(2)
    const double wanted = 1 + f * (1 + 0.1 * v + 0.2 * std::log(3.0)) + 0.5 * v + 2 * 6;
    expect_all_near(forces_along(*elastic, {2}, 0, v), {wanted}, 1e-12);
    EXPECT_EQ(elastic->stiffness({})[0], 8);

    add_curve(model, {0, 1}, {5, 5});
    const auto plastic = make_discrete_beam_law(
        make_record("MAT_INELASTIC_SPRING_DISCRETE_BEAM", {{"K", 10}, {"FLCID", 4}, {"TDF", 3}}), model);
    expect_all_near(forces_along(*plastic, {0.3, 0.8, 0.6, -0.4, -0.5}), {3, 5, 3, -5, -5}, 1e-12);
}

TEST(DiscreteBeamLaws, SixSpringsTakeTheMaterialsOfTheirParts)
{
    Model model;
    model.materials.push_back(make_record("MAT_ELASTIC_SPRING_DISCRETE_BEAM", {{"K", 6}}));
    Part part;
    part.id = 30;
    part.material = 0;
    model.parts.push_back(part);
    const auto law =
        make_discrete_beam_law(make_record("MAT_ELASTIC_6DOF_SPRING_DISCRETE_BEAM", {{"RPIDS", 30}}), model);
    expect_all_near(forces_along(*law, {0.5}, 4), {3}, 1e-14);
    expect_all_near(forces_along(*law, {0.5}, 0), {0}, 0);
    EXPECT_THROW(make_discrete_beam_law(
                     make_record("MAT_INELASTIC_6DOF_SPRING_DISCRETE_BEAM", {{"RPIDS", 30}}), model),
                 DeckError);
}

TEST(DiscreteBeamLaws, GeneralUnloadsAsItsOptionSays)
{
    Model model;
    add_curve(model, {0, 2}, {0, 10});
    add_curve(model, {0, 2}, {0, 4});
    const auto make = [&](double option, double offset) {
        return make_discrete_beam_law(
            make_record("MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", {{"IUNLD", option},
                                                                     {"KT", 20},
                                                                     {"OFFSET", offset},
                                                                     {"LCIDTR", 1},
                                                                     {"LCIDTUR", 2},
                                                                     {"UTFAILR", 1.9},
                                                                     {"UCFAILR", 1.2}}),
            model);
    };
    expect_all_near(forces_along(*make(0, 0), {1, 0.5, -1}), {5, 2.5, -5}, 1e-13);
    // From 5 at 1 down with 20 to 2 at 1 - 0.15 - ..., then along the lower curve 2 way.
    expect_all_near(forces_along(*make(2, 0), {1, 0.95, 0.5, 0.55, 1}), {5, 4, 1, 2, 5}, 1e-13);
    // Permanent way 0.5: zero there, quadratic up to 5 at 1.
    expect_all_near(forces_along(*make(3, 0.5), {1, 0.75, 0.4, 1.5}), {5, 1.25, 0, 7.5}, 1e-13);
    const auto law = make(0, 0);
    DiscreteBeamPoint point;
    point.way[0] = -1.1;
    law->advance({&point, 1}, 0, 1);
    EXPECT_FALSE(point.failed);
    point.way[0] = -1.21;
    law->advance({&point, 1}, 0, 1);
    EXPECT_TRUE(point.failed);
    EXPECT_THROW(make(1, 0), DeckError);
}

} // namespace plash

#include "elements/shell_groups.h"
#include "elements/solid_groups.h"
#include "tests/support/bare_state.h"
#include "tests/support/shell_model.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plash {

using testing::record_of;
using testing::SolidBlock;

namespace {

/// A card of stresses: rows of xx, yy, zz, xy, yz, zx, plastic strain, and for shells the place in front.
Record stress_card(const char* keyword, const char* id_field, Id id, bool with_place,
                   const std::vector<std::vector<double>>& rows)
{
    Record record = make_record(keyword, {{id_field, static_cast<double>(id)}});
    Table table;
    table.columns = {"SIGXX", "SIGYY", "SIGZZ", "SIGXY", "SIGYZ", "SIGZX", "EPS"};
    if (with_place) table.columns.insert(table.columns.begin(), "T");
    for (const auto& row : rows) {
        table.values.insert(table.values.end(), row.begin(), row.end());
        table.lines.push_back(1);
    }
    record.tables.push_back(table);
    return record;
}

Record metal()
{
    return record_of("MAT_PIECEWISE_LINEAR_PLASTICITY", 1,
                     {{"RO", 7.8e-6}, {"E", 210}, {"PR", 0.3}, {"SIGY", 0.3}, {"ETAN", 1}});
}

} // namespace

/// Forces of a cube under a given stress are stress times a quarter of the faces' areas; the plastic strain
/// shows, and the yield surface knows of it.
TEST(InitialStress, SolidsStartUnderTheirStress)
{
    for (double formulation : {1, 2, -1}) {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, metal());
        block.model.sections[0] = record_of("SECTION_SOLID", 1, {{"ELFORM", formulation}});
        block.model.others.push_back(stress_card("INITIAL_STRESS_SOLID", "EID", 1, false,
                                                 {{0.1, -0.05, 0.02, 0.03, -0.04, 0.01, 0.2}}));
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        Clock clock;
        groups[0]->add_forces(clock, state);
        const Vec3& f = state.force[block.node(1, 1, 1)]; // pulled back by the stress
        EXPECT_NEAR(f.x, -0.25 * (0.1 + 0.03 + 0.01), 1e-13);
        EXPECT_NEAR(f.y, -0.25 * (0.03 - 0.05 - 0.04), 1e-13);
        EXPECT_NEAR(f.z, -0.25 * (0.01 - 0.04 + 0.02), 1e-13);
        const auto results = testing::solid_results(block.model, state, groups);
        EXPECT_NEAR(results.solid_stress[0].yz, -0.04, 1e-14);
        EXPECT_NEAR(results.solid_plastic_strain[0], 0.2, 1e-14);
        // Sheared far: the flow stress of 20 % and more, not that of virgin metal.
        clock.last_step = 1;
        for (int i = 0; i < 20; ++i) {
            for (std::size_t n = 0; n < state.size(); ++n) {
                state.velocity[n] = {1e-3 * block.model.nodes.position[n].y, 0, 0};
                state.position[n] += state.velocity[n];
            }
            state.clear_forces();
            groups[0]->add_forces(clock, state);
        }
        const auto end = testing::solid_results(block.model, state, groups);
        const double strain = end.solid_plastic_strain[0];
        EXPECT_GT(strain, 0.205);
        EXPECT_NEAR(von_mises_stress(end.solid_stress[0]), 0.3 + strain * 210 / 209.0, 1e-6);
    }
}

/// *INITIAL_STRESS_DEPTH: the stress of the middle of each solid, x and y by KFACT.
TEST(InitialStress, GrowsWithTheDepth)
{
    SolidBlock block({1, 1, 2}, {1, 1, 2}, metal());
    block.model.others.push_back(
        record_of("INITIAL_STRESS_DEPTH", 0, {{"PID", 1}, {"RO_G", 0.02}, {"ZDATUM", 3}, {"KFACT", 0.4}}));
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    const auto results = testing::solid_results(block.model, state, groups);
    for (int layer = 0; layer < 2; ++layer) {
        const double vertical = 0.02 * (layer + 0.5 - 3); // solids 1 high, from z = 0
        EXPECT_NEAR(results.solid_stress[layer].zz, vertical, 1e-14);
        EXPECT_NEAR(results.solid_stress[layer].xx, 0.4 * vertical, 1e-14);
        EXPECT_NEAR(results.solid_stress[layer].yy, 0.4 * vertical, 1e-14);
    }
}

/// Eight points, each with its own stress, in the order of the corners: bending about z. The corner forces
/// are the exact integrals of a stress that is linear in y: for sxx = y (2 y - 1 at the points) the couple of
/// the upper and lower nodes.
TEST(InitialStress, EachPointOfAFullSolidHasItsOwn)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, metal());
    block.model.sections[0] = record_of("SECTION_SOLID", 1, {{"ELFORM", 2}});
    std::vector<std::vector<double>> rows;
    const double place = 1 / std::sqrt(3.0);
    for (const int sign : {-1, -1, 1, 1, -1, -1, 1, 1}) { // y of the corners 1 to 8
        // A deviator, so that the mean pressure has no part in it.
        rows.push_back({0.01 * sign * place, -0.005 * sign * place, -0.005 * sign * place, 0, 0, 0, 0});
    }
    block.model.others.push_back(stress_card("INITIAL_STRESS_SOLID", "EID", 1, false, rows));
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    groups[0]->add_forces(Clock{}, state);
    // Integral over the face x = 1 of 0.01 (2 y - 1) N: at y = 1 (1/2)(1/6) 0.01.
    EXPECT_NEAR(state.force[block.node(1, 1, 0)].x, -0.01 / 12, 1e-12);
    EXPECT_NEAR(state.force[block.node(1, 0, 0)].x, 0.01 / 12, 1e-12);
    EXPECT_NEAR(state.force[block.node(0, 1, 1)].x, 0.01 / 12, 1e-12);
}

TEST(InitialStress, SetsReachTheirElementsAndOtherLawsRefuse)
{
    SolidBlock block({2, 1, 1}, {2, 1, 1}, metal());
    block.model.solid_sets.push_back({9, "", {1}});
    block.model.others.push_back(
        stress_card("INITIAL_STRESS_SOLID_SET", "SID", 9, false, {{0.1, 0, 0, 0, 0, 0, 0}}));
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    const auto results = testing::solid_results(block.model, state, groups);
    EXPECT_EQ(results.solid_stress[0].xx, 0);
    EXPECT_EQ(results.solid_stress[1].xx, 0.1);

    block.model.materials[0] = record_of("MAT_BLATZ-KO_RUBBER", 1, {{"RO", 1e-6}, {"G", 1}});
    State other = block.state();
    EXPECT_THROW(make_solid_groups(block.model, other), DeckError);
}

/// A shell turned by 30 degrees about z: stresses come in global axes; two layers make a line through the
/// thickness (membrane force and bending moment).
TEST(InitialStress, ShellsStartUnderTheirStress)
{
    const double angle = std::numbers::pi / 6, c = std::cos(angle), s = std::sin(angle), thickness = 0.5;
    for (double formulation : {2, 16}) {
        Model model = shell_model(metal(), {{"ELFORM", formulation}, {"NIP", 3}, {"T1", thickness}});
        add_grid(model, 1, 1, [&](int i, int j) { return Vec3{c * i - s * j, s * i + c * j, 0}; });
        // 0.02 at the bottom and 0.06 at the top along side 1-2.
        const auto row = [&](double place, double value) {
            return std::vector<double>{place, value * c * c, value * s * s, 0, value * c * s, 0, 0, 0.01};
        };
        model.others.push_back(
            stress_card("INITIAL_STRESS_SHELL", "EID", 1, true, {row(-1, 0.02), row(1, 0.06)}));
        State state = bare_state(model);
        auto groups = make_shell_groups(model, state);
        groups[0]->add_forces(Clock{}, state);
        const Vec3 along{c, s, 0}, across{-s, c, 0};
        EXPECT_NEAR(dot(state.force[1], along), -0.04 * thickness / 2, 1e-14);
        EXPECT_NEAR(dot(state.force[1], across), 0, 1e-14);
        // Moment by length: slope 0.02 per half thickness, times t^2 / 6, at two nodes of a side of length
        // one.
        EXPECT_NEAR(std::abs(dot(state.moment[1], across)), 0.02 * thickness * thickness / 6 / 2, 1e-14);
        ElementResults results;
        results.shell_layers = 3;
        results.shell_stress.resize(3);
        results.shell_plastic_strain.resize(3);
        groups[0]->collect(state, results);
        EXPECT_NEAR(results.shell_stress[0].xx, 0.04 * c * c, 1e-14); // the middle
        EXPECT_NEAR(results.shell_plastic_strain[2], 0.01, 1e-14);
    }
}

} // namespace plash

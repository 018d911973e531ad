#include "elements/shell_groups.h"
#include "elements/solid_groups.h"
#include "tests/support/bare_state.h"
#include "tests/support/deck_run.h"
#include "tests/support/shell_model.h"
#include "tests/support/ten_node_block.h"
#include "tests/support/thick_block.h"

#include <gtest/gtest.h>

#include <cmath>

/// Strains (STRFLG) and history variables (NEIPH, NEIPS) as element groups hand them to result files, where
/// the motion says what they have to be.
namespace plash {

using testing::make_thick;
using testing::record_of;
using testing::SolidBlock;
using testing::thick_section;

namespace {

using Strain = SymmetricTensor<double>;

void expect_strain(const Strain& found, const Strain& wanted, double tolerance)
{
    EXPECT_NEAR(found.xx, wanted.xx, tolerance);
    EXPECT_NEAR(found.yy, wanted.yy, tolerance);
    EXPECT_NEAR(found.zz, wanted.zz, tolerance);
    EXPECT_NEAR(found.xy, wanted.xy, tolerance);
    EXPECT_NEAR(found.yz, wanted.yz, tolerance);
    EXPECT_NEAR(found.zx, wanted.zx, tolerance);
}

Record elastic(double young = 1000, double poisson = 0.3)
{
    return record_of("MAT_ELASTIC", 1, {{"RO", 1}, {"E", young}, {"PR", poisson}});
}

/// Takes the nodes along a path x(x at the start, s) in equal steps of s from 0 to 1.
template <class Group, class Path>
void follow(const Model& model, State& state, std::vector<std::unique_ptr<Group>>& groups, Path&& path,
            int steps)
{
    Clock clock;
    clock.last_step = 1e-3;
    clock.cycle = 2;
    for (int step = 1; step <= steps; ++step) {
        for (std::size_t node = 0; node < state.size(); ++node) {
            const Vec3& start = model.nodes.position[node];
            const Vec3 next = path(start, static_cast<double>(step) / steps);
            state.velocity[node] = (1 / clock.last_step) * (next - state.position[node]);
            state.position[node] = next;
        }
        state.clear_forces();
        for (auto& group : groups) group->add_forces(clock, state);
    }
}

Vec3 about_z(const Vec3& x, double angle)
{
    return {std::cos(angle) * x.x - std::sin(angle) * x.y, std::sin(angle) * x.x + std::cos(angle) * x.y,
            x.z};
}

Strain strain_of_first_solid(const Model& model, const State& state,
                             std::vector<std::unique_ptr<SolidGroup>>& groups)
{
    ElementResults results;
    results.solid_strain.resize(model.solids.size());
    for (auto& group : groups) group->collect(state, results);
    return results.solid_strain[0];
}

} // namespace

/// Stretched to 1.5 times its length, sheared a little, then turned by 90 degrees: the sum of the increments
/// is the logarithm (each step of the hundred is off by its cube over 12), and turns with the block to
/// round-off.
TEST(StrainResults, SolidsShowLogarithmsThatTurnWithThem)
{
    for (const int formulation : {1, 2, -1, 16, 17}) {
        SCOPED_TRACE(formulation);
        SolidBlock block({2, 2, 1}, {2, 2, 1}, elastic());
        block.model.controls.output.extent = {{"STRFLG", 1}};
        if (formulation > 3) {
            testing::cut_into_ten_node_tetrahedra(block.model, formulation);
        } else {
            block.model.sections[0] =
                record_of("SECTION_SOLID", 1, {{"ELFORM", static_cast<double>(formulation)}});
        }
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        follow(
            block.model, state, groups,
            [](const Vec3& x, double s) {
                return Vec3{(1 + 0.5 * s) * x.x, x.y, x.z};
            },
            100);
        const double log = std::log(1.5);
        expect_strain(strain_of_first_solid(block.model, state, groups), {log, 0, 0, 0, 0, 0}, 1e-6);
        const Strain before = strain_of_first_solid(block.model, state, groups);
        follow(
            block.model, state, groups,
            [](const Vec3& x, double s) {
                return about_z({1.5 * x.x, x.y, x.z}, 0.5 * s * 3.14159265358979324);
            },
            25);
        expect_strain(strain_of_first_solid(block.model, state, groups),
                      {before.yy, before.xx, before.zz, -before.xy, before.zx, -before.yz}, 1e-12);
    }
}

TEST(StrainResults, AreKeptOnlyWhereTheDeckAsksForThem)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, elastic());
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    follow(
        block.model, state, groups, [](const Vec3& x, double s) { return (1 + 0.1 * s) * x; }, 1);
    expect_strain(strain_of_first_solid(block.model, state, groups), {}, 0);
}

/// A strip that is stretched by e and bent to the curvature k: e -+ k z at the innermost and the outermost
/// point, Poisson's ratio through the thickness; then turned about z.
TEST(StrainResults, ShellsShowTheirInnermostAndOutermostPoints)
{
    const double e = 1e-5, k = 2e-4, thickness = 0.1, nu = 0.3;
    for (const int formulation : {2, 16, 4}) {
        SCOPED_TRACE(formulation);
        Model model =
            shell_model(elastic(1000, nu), {{"ELFORM", formulation}, {"NIP", 3}, {"T1", thickness}});
        model.controls.output.extent = {{"STRFLG", 1}};
        add_grid(model, 1, 1, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
        if (formulation == 4) cut_into_triangles(model);
        State state = bare_state(model);
        state.need_rotation();
        auto groups = make_shell_groups(model, state);
        Clock clock;
        clock.last_step = 1;
        clock.cycle = 2;
        // Deflection k x^2 / 2 has the slope k x, a rotation of -k x about y; top fibres shorten.
        for (std::size_t node = 0; node < state.size(); ++node) {
            const Vec3& x = model.nodes.position[node];
            state.velocity[node] = {e * x.x, 0, 0.5 * k * x.x * x.x};
            state.angular_velocity[node] = {0, -k * x.x, 0};
            state.position[node] += 0.5 * state.velocity[node]; // taken on the geometry of mid-step
        }
        state.clear_forces();
        for (auto& group : groups) group->add_forces(clock, state);
        ElementResults results;
        results.shell_strain.resize(model.shells.size());
        for (auto& group : groups) group->collect(state, results);
        const double z = 0.5 * thickness * std::sqrt(0.6); // Gauss point
        for (const int side : {0, 1}) {
            const double along = e - (side == 0 ? -z : z) * k;
            // Second order: the slope of the element (k / 2) times the deflection.
            expect_strain(results.shell_strain[0][side], {along, 0, -nu / (1 - nu) * along, 0, 0, 0}, 2e-8);
        }
        follow(
            model, state, groups, [](const Vec3& x, double s) { return about_z(x, 1.5707963267948966 * s); },
            20);
        for (auto& group : groups) group->collect(state, results);
        EXPECT_NEAR(results.shell_strain[0][0].yy, e + z * k, 2e-5);
    }
}

/// The same of thick shells, with stresses of shells (1) and of solids (3, 5).
TEST(StrainResults, ThickShellsShowTheirInnermostAndOutermostPoints)
{
    const double e = 1e-4, k = 1e-4;
    for (const int formulation : {1, 2, 3, 5}) {
        SCOPED_TRACE(formulation);
        SolidBlock block({1, 1, 1}, {1, 1, 1}, elastic(1000, 0));
        make_thick(block.model, thick_section(formulation, 3, false));
        block.model.controls.output.extent = {{"STRFLG", 1}};
        testing::ThickStep step(block.model, 3, [&](const Vec3& x) {
            return Vec3{e * (x.x - 0.5) - k * (x.x - 0.5) * (x.z - 0.5), 0, 0};
        });
        ElementResults results;
        results.thick_shell_strain.resize(1);
        for (auto& group : step.groups) group->collect(step.state, results);
        const double z = 0.5 * std::sqrt(0.6);
        EXPECT_NEAR(results.thick_shell_strain[0][0].xx, e + k * z, 1e-8);
        EXPECT_NEAR(results.thick_shell_strain[0][1].xx, e - k * z, 1e-8);
    }
}

/// *INITIAL_STRAIN_SOLID and _SHELL (in global axes) are where they begin, and change no stress.
TEST(StrainResults, BeginWhereTheDeckSays)
{
    const Strain given{0.01, -0.02, 0.03, 0.004, -0.005, 0.006};
    SolidBlock block({1, 1, 1}, {1, 1, 1}, elastic());
    block.model.controls.output.extent = {{"STRFLG", 1}};
    block.model.others.push_back(record_of("INITIAL_STRAIN_SOLID", 0,
                                           {{"EID", 1},
                                            {"EPSXX", given.xx},
                                            {"EPSYY", given.yy},
                                            {"EPSZZ", given.zz},
                                            {"EPSXY", given.xy},
                                            {"EPSYZ", given.yz},
                                            {"EPSZX", given.zx}}));
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    ElementResults results;
    results.solid_strain.resize(1);
    results.solid_stress.resize(1);
    groups[0]->collect(state, results);
    expect_strain(results.solid_strain[0], given, 0);
    expect_strain(results.solid_stress[0], {}, 0);

    Model model = shell_model(elastic(), {{"ELFORM", 2}, {"NIP", 2}, {"T1", 0.1}});
    model.controls.output.extent = {{"STRFLG", 1}};
    add_grid(model, 1, 1, [](int i, int j) { return about_z(Vec3{1.0 * i, 1.0 * j, 0}, 0.3); });
    Record record = record_of("INITIAL_STRAIN_SHELL", 0, {{"EID", 1}, {"NPLANE", 1}, {"NTHICK", 2}});
    Table table;
    table.columns = {"EPSXX", "EPSYY", "EPSZZ", "EPSXY", "EPSYZ", "EPSZX", "T"};
    const double place = 1 / std::sqrt(3.0); // of the two Gauss points
    table.values = {given.xx, given.yy, given.zz, given.xy, given.yz, given.zx, -place,
                    0,        0,        0,        0,        0,        0,        place};
    record.tables.push_back(table);
    model.others.push_back(record);
    State shells = bare_state(model);
    auto shell_groups = make_shell_groups(model, shells);
    results.shell_strain.resize(1);
    for (auto& group : shell_groups) group->collect(shells, results);
    expect_strain(results.shell_strain[0][0], given, 1e-16);
    expect_strain(results.shell_strain[0][1], {}, 1e-16);
}

/// *INITIAL_STRAIN_SHELL_SET gives strains of the lower and the upper surface, unless T says otherwise.
TEST(StrainResults, OfSetsOfShellsBeginWhereTheDeckSays)
{
    testing::DeckRun run("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*DATABASE_EXTENT_BINARY\n0,0,3,1\n"
                         "*PART\nsheet\n1,1,1\n*SECTION_SHELL\n1,2,1.0,3\n0.1,0.1,0.1,0.1\n"
                         "*MAT_ELASTIC\n1,1.0,1000.0,0.3\n"
                         "*NODE\n1,0.0,0.0,0.0\n2,1.0,0.0,0.0\n3,2.0,0.0,0.0\n4,0.0,1.0,0.0\n5,1.0,1.0,0.0\n"
                         "6,2.0,1.0,0.0\n*ELEMENT_SHELL\n7,1,1,2,5,4\n8,1,2,3,6,5\n"
                         "*SET_SHELL_LIST\n9\n8\n"
                         "*INITIAL_STRAIN_SHELL_SET\n9,,,0\n0.01,0.02,0.03,0.04,0.05,0.06\n"
                         "-0.01,-0.02,-0.03,-0.04,-0.05,-0.06\n*END\n");
    ElementResults results;
    results.shell_strain.resize(2);
    for (const auto& term : run.scene->terms) term->collect(run.scene->state, results);
    const Strain outermost{-0.01, -0.02, -0.03, -0.04, -0.05, -0.06};
    const double inside = std::sqrt(0.6); // of the Gauss points; the card speaks of the surfaces
    for (int side : {0, 1}) {
        expect_strain(results.shell_strain[0][side], {}, 0);
        expect_strain(results.shell_strain[1][side], (side == 0 ? -inside : inside) * outermost, 1e-15);
    }
}

/// *INITIAL_STRAIN_TSHELL likewise, whichever way the shell lies.
TEST(StrainResults, OfThickShellsBeginWhereTheDeckSays)
{
    testing::DeckRun run("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*DATABASE_EXTENT_BINARY\n0,0,3,1\n"
                         "*PART\nsheet\n1,1,1\n*SECTION_TSHELL\n1,1,1.0,3\n*MAT_ELASTIC\n1,1.0,1000.0,0.3\n"
                         "*NODE\n1,0.0,0.0,0.0\n2,0.8,0.6,0.0\n3,0.2,1.4,0.0\n4,-0.6,0.8,0.0\n"
                         "5,0.0,0.0,0.1\n6,0.8,0.6,0.1\n7,0.2,1.4,0.1\n8,-0.6,0.8,0.1\n"
                         "*ELEMENT_TSHELL\n5,1,1,2,3,4,5,6,7,8\n"
                         "*INITIAL_STRAIN_TSHELL\n5\n0.01,0.02,0.03,0.04,0.05,0.06\n"
                         "-0.01,-0.02,-0.03,-0.04,-0.05,-0.06\n*END\n");
    ElementResults results;
    results.thick_shell_strain.resize(1);
    for (const auto& term : run.scene->terms) term->collect(run.scene->state, results);
    const Strain outermost{-0.01, -0.02, -0.03, -0.04, -0.05, -0.06};
    const double inside = std::sqrt(0.6);
    for (int side : {0, 1})
        expect_strain(results.thick_shell_strain[0][side], (side == 0 ? -inside : inside) * outermost, 1e-15);
}

/// *MAT_003 with kinematic hardening shows its back stress: the stress lies at the distance SIGY from it.
TEST(HistoryResults, OfKinematicHardeningAreTheBackStress)
{
    const double yield = 2;
    for (const int formulation : {1, 2}) {
        SCOPED_TRACE(formulation);
        SolidBlock block({1, 1, 1}, {1, 1, 1},
                         record_of("MAT_PLASTIC_KINEMATIC", 1,
                                   {{"RO", 1}, {"E", 1000}, {"PR", 0.3}, {"SIGY", yield}, {"ETAN", 200}}));
        block.model.sections[0] =
            record_of("SECTION_SOLID", 1, {{"ELFORM", static_cast<double>(formulation)}});
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        follow(
            block.model, state, groups,
            [](const Vec3& x, double s) {
                return Vec3{x.x + 0.02 * s * x.x + 0.01 * s * x.y, x.y, x.z};
            },
            50);
        ElementResults results;
        results.solid_stress.resize(1);
        results.solid_plastic_strain.resize(1);
        results.solid_history_size = 6; // one more than there are
        results.solid_history.resize(6);
        groups[0]->collect(state, results);
        EXPECT_GT(results.solid_plastic_strain[0], 0.01);
        const double* h = results.solid_history.data();
        EXPECT_GT(h[0], 0.5);
        const Strain back{h[0], h[1], -h[0] - h[1], h[2], h[3], h[4]};
        const Strain distance = deviator(results.solid_stress[0]) - back;
        EXPECT_NEAR(std::sqrt(1.5 * contract(distance, distance)), yield, 1e-9);
        EXPECT_EQ(h[5], 0);
    }
}

/// *MAT_081: the damage is number 2, of shells too: 1 - stress over the stress without damage.
TEST(HistoryResults, OfDamageAreTheShareOfTheStressThatIsGone)
{
    const auto stress_and_damage = [](double onset) {
        Model model = shell_model(record_of("MAT_PLASTICITY_WITH_DAMAGE", 1,
                                            {{"RO", 1},
                                             {"E", 1000},
                                             {"PR", 0.3},
                                             {"SIGY", 2},
                                             {"ETAN", 10},
                                             {"EPPF", onset},
                                             {"EPPFR", onset + 0.1}}),
                                  {{"ELFORM", 2}, {"NIP", 2}, {"T1", 0.1}});
        add_grid(model, 1, 1, [](int i, int j) { return Vec3{1.0 * i, 1.0 * j, 0}; });
        State state = bare_state(model);
        state.need_rotation();
        auto groups = make_shell_groups(model, state);
        follow(
            model, state, groups,
            [](const Vec3& x, double s) {
                return Vec3{(1 + 0.05 * s) * x.x, x.y, 0};
            },
            50);
        ElementResults results;
        results.shell_layers = 3;
        results.shell_stress.resize(3);
        results.shell_history_size = 2;
        results.shell_history.resize(6);
        for (auto& group : groups) group->collect(state, results);
        return std::array{results.shell_stress[0].xx, results.shell_history[1], results.shell_history[3]};
    };
    const auto damaged = stress_and_damage(0.01), whole = stress_and_damage(1);
    EXPECT_NEAR(whole[1], 0, 0);
    EXPECT_GT(damaged[1], 0.2);
    EXPECT_NEAR(damaged[0] / whole[0], 1 - damaged[1], 1e-9);
    EXPECT_NEAR(damaged[2], damaged[1], 1e-12); // the inner layer, as the middle one
}

} // namespace plash

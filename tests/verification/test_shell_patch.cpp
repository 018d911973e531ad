#include "elements/shell_fully_integrated.h"
#include "elements/shell_groups.h"
#include "elements/shell_settings.h"
#include "elements/shell_triangle.h"
#include "materials/elastic.h"
#include "solver/explicit_loop.h"
#include "tests/support/bare_state.h"
#include "tests/support/shell_model.h"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>
#include <type_traits>

namespace plash {

namespace {

template <class Lane>
CornerPattern<Lane> pattern_of(const Vector3<Lane> (&corner)[4])
{
    return plash::pattern_of(corner[0], corner[1], corner[2], corner[3]);
}

constexpr double patch_young_modulus = 1e6, patch_poisson_ratio = 0.25, patch_thickness = 0.001;

/// The five-element patch of MacNeal & Harder (1985), Finite Elements in Analysis and Design 1, 3-20:
/// 0.24 x 0.12, t = 0.001, E = 1e6, nu = 0.25; nodes 0-3 outside, 4-7 inside.
Model patch_model(std::vector<std::pair<const char*, double>> section)
{
    Model model = shell_model(
        make_record("MAT_ELASTIC", {{"RO", 1}, {"E", patch_young_modulus}, {"PR", patch_poisson_ratio}}),
        section);
    for (const Vec3& place :
         {Vec3{0, 0, 0}, Vec3{0.24, 0, 0}, Vec3{0.24, 0.12, 0}, Vec3{0, 0.12, 0}, Vec3{0.04, 0.02, 0},
          Vec3{0.18, 0.03, 0}, Vec3{0.16, 0.08, 0}, Vec3{0.08, 0.08, 0}}) {
        add_node(model, place);
    }
    for (const std::array<Index, 4>& nodes :
         {std::array<Index, 4>{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}) {
        add_shell(model, nodes);
    }
    return model;
}

/// Runs one step of the patch in which every node moves and turns as the fields say, and gives the results.
ElementResults deform(const Model& model, State& state, double time_step,
                      const std::function<Vec3(const Vec3&)>& displacement,
                      const std::function<Vec3(const Vec3&)>& rotation)
{
    state = bare_state(model);
    auto groups = make_shell_groups(model, state);
    for (std::size_t node = 0; node < state.size(); ++node) {
        const Vec3 u = displacement(model.nodes.position[node]);
        // The kernel works on mid-step geometry: put the initial geometry there.
        state.position[node] += 0.5 * u;
        state.velocity[node] = (1 / time_step) * u;
        state.angular_velocity[node] = (1 / time_step) * rotation(model.nodes.position[node]);
    }
    state.clear_forces();
    Clock clock;
    clock.last_step = time_step;
    ElementResults results;
    results.shell_layers = 2;
    results.shell_stress.resize(2 * model.shells.size());
    results.shell_resultants.resize(model.shells.size());
    for (auto& group : groups) {
        group->add_forces(clock, state);
        group->collect(state, results);
    }
    return results;
}

} // namespace

/// Formulations on the patch: quadrilaterals as they are, triangles by cutting each in two.
struct PatchCase {
    int formulation;
    bool triangles;
};
constexpr PatchCase patch_cases[] = {{2, false}, {2, true}, {4, true}, {16, false}};

Model patch_model(const PatchCase& which)
{
    Model model =
        patch_model({{"ELFORM", which.formulation}, {"NIP", 2}, {"SHRF", 5.0 / 6}, {"T1", patch_thickness}});
    if (which.triangles) cut_into_triangles(model);
    return model;
}

TEST(ShellPatch, MembraneStateIsUniformAndInnerNodesAreInBalance)
{
    for (const PatchCase& which : patch_cases) {
        SCOPED_TRACE(which.formulation);
        const Model model = patch_model(which);
        State state;
        // u = 1e-3 (x + y / 2), v = 1e-3 (y + x / 2): sigma_x = sigma_y = 1333, tau = 400 (MacNeal & Harder);
        // scaled by 1e-6 so that the change of geometry over the step is round-off.
        const double size = 1e-9;
        const auto results = deform(
            model, state, 1.0,
            [&](const Vec3& x) {
                return Vec3{size * (x.x + x.y / 2), size * (x.y + x.x / 2), 0};
            },
            [](const Vec3&) { return Vec3{}; });
        const double normal = size * patch_young_modulus / (1 - patch_poisson_ratio);
        const double shear = size * patch_young_modulus / (2 * (1 + patch_poisson_ratio));
        for (const auto& stress : results.shell_stress) {
            EXPECT_NEAR(stress.xx, normal, 1e-8 * normal);
            EXPECT_NEAR(stress.yy, normal, 1e-8 * normal);
            EXPECT_NEAR(stress.xy, shear, 1e-8 * normal);
        }
        const double force = normal * patch_thickness * 0.1;
        for (int node = 4; node < 8; ++node) {
            EXPECT_LT(norm(state.force[node]), 1e-8 * force);
            EXPECT_LT(norm(state.moment[node]), 1e-8 * force * 0.1);
        }
    }
}

namespace {

/// w = (x^2 + x y + y^2) / 2 and the rotations of its normals, scaled so that the geometry stays what it is:
/// the bending and twisting of MacNeal & Harder, m_x = m_y = 1.111e-7, m_xy = 3.333e-8 for w of 1e-3 as
/// large.
constexpr double bending_size = 1e-9;
Vec3 bent(const Vec3& x)
{
    return {0, 0, bending_size * (x.x * x.x + x.x * x.y + x.y * x.y) / 2};
}
Vec3 bent_normals(const Vec3& x)
{
    return {bending_size * (x.x / 2 + x.y), -bending_size * (x.x + x.y / 2), 0};
}
constexpr double bending_moment = 1.1111111111e-7 * bending_size / 1e-3;
constexpr double twisting_moment = bending_moment * 0.3;

} // namespace

TEST(ShellPatch, QuadraticDeflectionGivesUniformMoments)
{
    for (const PatchCase& which : patch_cases) {
        SCOPED_TRACE(which.formulation);
        Model model = patch_model(which);
        State state;
        const auto results = deform(model, state, 1.0, bent, bent_normals);
        for (const auto& r : results.shell_resultants) {
            // The frame follows the first side, so compare what does not depend on it: trace and determinant.
            EXPECT_NEAR(r[0] + r[1], -2 * bending_moment, 1e-8 * bending_moment);
            EXPECT_NEAR(r[0] * r[1] - r[2] * r[2],
                        bending_moment * bending_moment - twisting_moment * twisting_moment,
                        1e-7 * bending_moment * bending_moment);
        }
    }
}

TEST(ShellPatch, BendingIsInBalanceWhereShearIsSampledAtTheSides)
{
    for (const PatchCase& which : patch_cases) {
        SCOPED_TRACE(which.formulation);
        Model model = patch_model(which);
        if (which.formulation == 2 && which.triangles) model.controls.elements.sort_triangles = 1;
        model.controls.elements.warping =
            1; // the quadrilateral of one point samples at the sides with BWC = 1
        model.controls.elements.hourglass_coefficient = 0; // viscosity would answer to the deflection
        State state;
        const auto results = deform(model, state, 1.0, bent, bent_normals);
        for (const auto& r : results.shell_resultants) {
            // Shear force against moment over the element's length: without side sampling 1e4 times as large.
            EXPECT_LT(std::abs(r[3]) + std::abs(r[4]), 1e-6 * bending_moment / 0.1);
        }
        for (int node = 4; node < 8; ++node) {
            EXPECT_LT(std::abs(state.force[node].z), 1e-6 * bending_moment);
            EXPECT_LT(norm(state.moment[node]), 1e-6 * bending_moment * 0.1);
        }
    }
}

template <class Formulation>
class ShellRotation : public ::testing::Test {};
using Formulations = ::testing::Types<BelytschkoTsay, C0Triangle, FullyIntegratedShell>;
TYPED_TEST_SUITE(ShellRotation, Formulations);

TYPED_TEST(ShellRotation, AFullTurnInPlaneAndOutOfItLeavesTheStressAlone)
{
    constexpr int columns = TypeParam::plane_points;
    constexpr bool triangle = std::is_same_v<TypeParam, C0Triangle>;
    const ThicknessRule rule = gauss_rule(2);
    ShellSettings settings;
    settings.rule = rule;
    settings.wave_speed = 5000;
    settings.density = 7.8e-6;
    settings.stiffness = {210, 80, 1, 0.04};
    const Elastic law{7.8e-6, 210, 0.3};
    for (const auto& [axis, height, warping] : {std::tuple{Vec3{0, 0, 1}, 0.0, false},
                                                {Vec3{0, 1, 0}, 0.0, false},
                                                {unit(Vec3{1, 2, 3}), 0.0, false},
                                                {unit(Vec3{1, 2, 3}), 1.5, false},
                                                {unit(Vec3{1, 2, 3}), 1.5, true}}) {
        settings.warping = warping;
        std::vector<double> record(shell_record::points + columns * 2 * shell_record::history);
        record[shell_record::thickness] = record[shell_record::mass_factor] = 1;
        using namespace shell_record;
        for (int point = 0; point < 2 * columns; ++point) record[points + point * history + stress_xx] = 0.3;
        Vec3 start[4] = {{0, 0, height}, {11, 1, 0}, {12, 9, height}, {1, 10, 0}};
        if (triangle) start[3] = start[2];
        constexpr int steps = 1000;
        const double angle = 2 * std::numbers::pi / steps;
        const auto turned = [&](const Vec3& x, int step) {
            const double a = angle * step;
            return std::cos(a) * x + std::sin(a) * cross(axis, x) + (1 - std::cos(a)) * dot(axis, x) * axis;
        };
        double hourglass_work = 0;
        for (int step = 1; step <= steps; ++step) {
            Vec3 x[4], v[4], w[4];
            for (int corner = 0; corner < 4; ++corner) {
                x[corner] = turned(start[corner], step);
                v[corner] = x[corner] - turned(start[corner], step - 1);
                w[corner] = angle * axis;
            }
            hourglass_work += TypeParam::template step<double>(settings, law, pattern_of(x), pattern_of(v),
                                                               pattern_of(w), 1.0, record.data())
                                  .hourglass_work;
        }
        EXPECT_LT(std::abs(hourglass_work), 1e-24);
        for (int point = 0; point < 2 * columns; ++point) {
            const double* stress = record.data() + points + point * history;
            // The warping terms weigh nodal rotations against chords too: see below, times the fibres' tilt.
            const double tolerance = height != 0 && (warping || columns > 1) ? 5e-5 : 1e-11;
            EXPECT_NEAR(stress[stress_xx], 0.3, tolerance);
            EXPECT_NEAR(stress[stress_yy], 0, tolerance);
            EXPECT_NEAR(stress[stress_xy], 0, tolerance);
            // Nodal rotations turn by the angle a, chords of mid-step by 2 tan(a / 2): the difference is a
            // transverse shear of a^3 / 12 a step, 2.1e-5 in 1000 steps, of second order in the step.
            EXPECT_NEAR(stress[stress_yz], 0, 1.05 * steps * std::pow(angle, 3) / 12 * 80.8);
            EXPECT_NEAR(stress[stress_zx], 0, 1.05 * steps * std::pow(angle, 3) / 12 * 80.8);
        }
    }
}

} // namespace plash

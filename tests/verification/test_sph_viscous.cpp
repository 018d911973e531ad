#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

/// Viscous flows in the plane with exact solutions.
namespace plash::viscous_cases {

namespace {

/// Accelerates every particle along x.
class Drive : public Term {
public:
    explicit Drive(double acceleration) : acceleration_(acceleration) {}
    std::string_view name() const override { return "drive"; }
    void add_forces(const Clock&, State& state) override
    {
        for (std::size_t i = 0; i < state.size(); ++i) state.force[i].x += acceleration_ * state.mass[i];
    }

private:
    double acceleration_;
};

} // namespace

/// Flow between two plates at rest, driven by a body force from rest: the parabola v = F y (L - y) / (2 nu),
/// reached within exp(-pi^2 nu t / L^2). With VISC 1 (Morris et al. 1997); central forces, whose Laplacian
/// lacks 11 % on a lattice, end 7 % too fast. The step is that which the particles ask for, and viscosity
/// alone limits it: without its vote the run blows up.
TEST(SphViscous, PoiseuilleFlowHasItsParabola)
{
    const int rows = 16;
    const double width = 1, spacing = width / rows, viscosity = 0.1, force = 0.08;
    const double fastest = force / (8 * viscosity); // 0.1
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.kernel = Kernel::wendland_c2;
    world.options.viscosity = {0, 0};
    world.options.laminar_by_velocity = true;
    world.options.periods = {{{0, 0, 0}, {8 * spacing, 0, 0}}};
    world.options.mirrors = {{{0, 0, 0}, {0, 1, 0}, true, {}}, {{0, width, 0}, {0, -1, 0}, true, {}}};
    const auto positions = lattice({0, 0, 0}, 8, rows, 1, spacing);
    auto& part = world.add_part(TestLinear(1, 20 * fastest), positions, spacing * spacing, 1.5 * spacing);
    part.constants.laminar_viscosity = viscosity;
    world.open_state();
    world.model.controls.time.step_scale = 0.9;
    world.model.controls.time.end_time = 5; // exp(-pi^2 / 2) = 0.7 % are missing
    Scene scene = world.make_scene_of_particles();
    scene.terms.push_back(std::make_unique<Drive>(force));
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    double sum = 0, worst = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double y = scene.state.position[i].y;
        const double exact = force / (2 * viscosity) * y * (width - y);
        worst = std::max(worst, std::abs(scene.state.velocity[i].x - exact));
        sum += std::pow(scene.state.velocity[i].x - exact, 2);
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(positions.size())), 0.01 * fastest); // 0.4 % as measured
    EXPECT_LT(worst, 0.02 * fastest);
}

namespace {

struct StartedPlate {
    double worst_velocity = 0, work_error = 0, balance_error = 0; ///< the latter two relative
};

/// A plate that starts at U = 1 beside fluid at rest (Stokes' first problem): v = erfc(y / (2 sqrt(nu t))),
/// and the plate has done the work 2 sqrt(nu t / pi) by area. in_space  three dimensions, between two mirrors
StartedPlate start_plate(bool in_space)
{
    const int rows = 32, columns = 8, layers = in_space ? 4 : 1;
    const double spacing = 1.0 / rows, viscosity = 1.0 / 400, end = 2;
    ParticleWorld world;
    world.options.dimension = in_space ? 3 : 2;
    world.options.kernel = Kernel::wendland_c2;
    world.options.viscosity = {0, 0};
    world.options.volume_weighted = world.options.renormalised = true;
    world.options.laminar_by_velocity = true;
    world.options.periods = {{{0, 0, 0}, {columns * spacing, 0, 0}}};
    world.options.mirrors = {{{0, 0, 0}, {0, 1, 0}, true, {1, 0, 0}}, {{0, 1, 0}, {0, -1, 0}, true, {}}};
    if (in_space) {
        world.options.mirrors.push_back({{0, 0, 0}, {0, 0, 1}});
        world.options.mirrors.push_back({{0, 0, layers * spacing}, {0, 0, -1}});
    }
    const auto positions = lattice({0, 0, 0}, columns, rows, layers, spacing);
    const double size = in_space ? spacing * spacing * spacing : spacing * spacing;
    auto& part = world.add_part(TestLinear(1, 10), positions, size, 1.5 * spacing);
    part.constants.laminar_viscosity = viscosity;
    world.open_state();
    world.model.controls.time.step_scale = 0.8;
    world.model.controls.time.end_time = end;
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    StartedPlate result;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double exact = std::erfc(scene.state.position[i].y / (2 * std::sqrt(viscosity * end)));
        result.worst_velocity = std::max(result.worst_velocity, std::abs(scene.state.velocity[i].x - exact));
    }
    const double area = columns * spacing * (in_space ? layers * spacing : 1);
    const double work = 2 * std::sqrt(viscosity * end / M_PI) * area;
    result.work_error = std::abs(scene.ledger.external_work / work - 1);
    result.balance_error = scene.ledger.balance_error();
    return result;
}

} // namespace

/// The fluid's velocity is curved right up to the plate; with images that mirror it (without
/// Images::bend_at_walls) it lags behind by 1.2 % of U three rows deep.
TEST(SphViscous, StartingPlateDrivesTheFluidAlongTheErrorFunction)
{
    for (const bool in_space : {false, true}) {
        const StartedPlate plate = start_plate(in_space);
        EXPECT_LT(plate.worst_velocity, 0.005) << in_space; // 0.0038 as measured in the plane
        EXPECT_LT(plate.work_error, 0.015) << in_space;     // 0.9 %
        EXPECT_LT(plate.balance_error, 1e-4) << in_space;
    }
}

namespace {

/// Kinetic energy of Taylor & Green's vortices, U = 1 in a periodic square of side 1, at time 0.5 over that
/// at the start; exactly exp(-16 pi^2 nu t).
double vortices_left(double viscosity, bool renormalised, double shifting)
{
    const int side = 40;
    const double spacing = 1.0 / side;
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.kernel = Kernel::wendland_c2;
    world.options.viscosity = {0, 0};
    world.options.volume_weighted = world.options.renormalised = renormalised;
    world.options.density_diffusion = renormalised ? 0 : 0.1;
    world.options.shifting = shifting;
    world.options.periods = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 1, 0}}};
    const auto positions = lattice({0, 0, 0}, side, side, 1, spacing);
    auto& part = world.add_part(TestLinear(1, 10), positions, spacing * spacing, 2 * spacing);
    part.constants.laminar_viscosity = viscosity;
    world.open_state();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double x = 2 * M_PI * positions[i].x, y = 2 * M_PI * positions[i].y;
        world.state.velocity[i] = {-std::cos(x) * std::sin(y), std::sin(x) * std::cos(y), 0};
    }
    world.model.controls.time.step_scale = 0.4;
    world.model.controls.time.end_time = 0.5;
    Scene scene = world.make_scene_of_particles();
    double start = 0, end = 0;
    for (const Vec3& v : scene.state.velocity) start += dot(v, v);
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    EXPECT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    for (const Vec3& v : scene.state.velocity) end += dot(v, v);
    return end / start;
}

} // namespace

/// Particles gather along the stretching axes and spend energy by it (0.36 are left of 0.454 without
/// shifting); shifting keeps them apart, corrected gradients (FORM 6) bear with what is left of the disorder.
TEST(SphViscous, TaylorGreenVorticesDecayByViscosity)
{
    const double viscosity = 0.01; // Re = 100
    const double exact = std::exp(-16 * M_PI * M_PI * viscosity * 0.5);
    EXPECT_NEAR(vortices_left(viscosity, true, 1), exact, 0.02 * exact);
    EXPECT_NEAR(vortices_left(viscosity, false, 2), exact, 0.05 * exact);
}

/// A lid drives the fluid in a square cavity, Re 100, from rest to steady flow; the velocity along the lid on
/// the vertical centre line. Reference: finite differences (psi-omega, second order, 129^2 and 257^2
/// extrapolated), which Ghia, Ghia & Shin (1982) confirm to 0.006. FORM 6, SHIFT 1, VISC 1.
TEST(SphViscous, LidDrivenCavityHasItsProfile)
{
    const int side = 24;
    const double spacing = 1.0 / side, smoothing = 1.5 * spacing;
    const auto wall = [](const Vec3& point, const Vec3& normal, double velocity) {
        return MirrorPlane{point, normal, true, {velocity, 0, 0}};
    };
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.kernel = Kernel::wendland_c2;
    world.options.viscosity = {0, 0};
    world.options.volume_weighted = world.options.renormalised = true;
    world.options.shifting = 1;
    world.options.laminar_by_velocity = true;
    world.options.mirrors = {wall({0, 0, 0}, {1, 0, 0}, 0), wall({1, 0, 0}, {-1, 0, 0}, 0),
                             wall({0, 0, 0}, {0, 1, 0}, 0), wall({0, 1, 0}, {0, -1, 0}, 1)};
    const auto positions = lattice({0, 0, 0}, side, side, 1, spacing);
    world.add_part(TestLinear(1, 10), positions, spacing * spacing, smoothing).constants.laminar_viscosity =
        0.01;
    world.open_state();
    world.model.controls.time.step_scale = 0.8;
    world.model.controls.time.end_time = 10;
    Scene scene = world.make_scene_of_particles();

    constexpr double reference[][2] = {
        {0.9531, 0.69101},  {0.8516, 0.23654},  {0.7344, 0.00418},  {0.6172, -0.13880}, {0.5, -0.20914},
        {0.4531, -0.21397}, {0.2813, -0.15767}, {0.1719, -0.10174}, {0.1016, -0.06443}, {0.0703, -0.04662}};
    double mean[std::size(reference)] = {}, duration = 0;
    add_particle_probe(scene, [&](const Clock& clock, const State&) {
        if (clock.time < 7) return;
        for (std::size_t k = 0; k < std::size(reference); ++k) {
            double sum = 0, weight = 0;
            for (const MotionRecord& particle : world.body->arrays().motion) { // behind the walls, too
                const double x = particle.position.x - 0.5, y = particle.position.y - reference[k][0];
                const double w = WendlandC2::value(std::hypot(x, y) / (1.3 * spacing));
                sum += w * particle.velocity.x;
                weight += w;
            }
            mean[k] += sum / weight * clock.last_step;
        }
        duration += clock.last_step;
    });
    Recorders nobody;
    const Outcome outcome = run(scene, nobody);
    ASSERT_EQ(outcome.termination, Outcome::Termination::normal) << outcome.message;
    // 0.8 % of the lid's velocity as measured.
    for (std::size_t k = 0; k < std::size(reference); ++k) {
        EXPECT_NEAR(mean[k] / duration, reference[k][1], 0.012) << "y = " << reference[k][0];
    }
    // Nothing comes in but by the lid, whose work is booked; most of it has become heat by now.
    EXPECT_GT(scene.ledger.external_work, 20 * scene.ledger.kinetic);
    EXPECT_LT(scene.ledger.balance_error(), 0.005);
}

} // namespace plash::viscous_cases

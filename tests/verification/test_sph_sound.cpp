#include "tests/support/particle_setup.h"

#include <gtest/gtest.h>

/// A standing sound wave of one wavelength in a periodic box, sound speed and density 1, on a lattice.
namespace plash {

namespace {

constexpr double wave_number = 2 * M_PI;

/// Amplitude of the velocity wave at each half step.
class WaveProbe : public Term {
public:
    explicit WaveProbe(const std::vector<Vec3>& start) : start_(start) {}
    std::string_view name() const override { return "probe"; }
    void add_forces(const Clock& clock, State& state) override
    {
        double sum = 0;
        for (std::size_t i = 0; i < start_.size(); ++i) {
            sum += std::sin(wave_number * start_[i].x) * state.velocity[i].x;
        }
        time.push_back(clock.time - 0.5 * clock.last_step);
        amplitude.push_back(2 * sum / static_cast<double>(start_.size()));
    }
    std::vector<double> time, amplitude;

private:
    const std::vector<Vec3>& start_;
};

struct Wave {
    double speed = 0;      ///< from the first and the last zero
    double decay_rate = 0; ///< of the amplitude, from the first and the last extremum
    double balance_error = 0;
};

Wave run_wave(Kernel kernel, int dimension, int per_wavelength, double smoothing_ratio, double viscosity)
{
    ParticleWorld world;
    world.options.kernel = kernel;
    world.options.dimension = dimension;
    world.options.viscosity = {0, 0};
    const double spacing = 1.0 / per_wavelength, width = 8 * spacing;
    const bool space = dimension == 3;
    const auto positions =
        lattice({0, 0, space ? 0 : -spacing / 2}, per_wavelength, 8, space ? 8 : 1, spacing);
    world.options.periods = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, width, 0}}};
    if (space) world.options.periods.push_back({{0, 0, 0}, {0, 0, width}});
    auto& part =
        world.add_part(TestLinear(1, 1), positions, std::pow(spacing, dimension), smoothing_ratio * spacing);
    part.constants.laminar_viscosity = viscosity;
    world.open_state();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        world.state.velocity[i].x = 1e-4 * std::sin(wave_number * positions[i].x);
    }
    world.model.controls.time.step_scale = 0.3;
    world.model.controls.time.end_time = 4;
    Scene scene = world.make_scene_of_particles();
    auto term = std::make_unique<WaveProbe>(positions);
    const WaveProbe& probe = *term;
    scene.terms.push_back(std::move(term));
    Recorders nobody;
    run(scene, nobody);

    Wave wave;
    wave.balance_error = scene.ledger.balance_error();
    const auto& a = probe.amplitude;
    std::vector<double> zeros, extrema;
    for (std::size_t i = 1; i + 1 < a.size(); ++i) {
        if (a[i] * a[i + 1] < 0) {
            zeros.push_back(probe.time[i] + (probe.time[i + 1] - probe.time[i]) * a[i] / (a[i] - a[i + 1]));
        }
        if (std::abs(a[i]) > std::abs(a[i - 1]) && std::abs(a[i]) >= std::abs(a[i + 1]))
            extrema.push_back(a[i]);
    }
    const double half_period = (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
    wave.speed = 0.5 / half_period;
    wave.decay_rate = std::log(std::abs(extrema.front() / extrema.back())) /
                      (half_period * static_cast<double>(extrema.size() - 1));
    return wave;
}

/// Speed that the lattice gives a wave: the sums of continuity and momentum have the symbol
/// sum of V |grad W| x sin(k x) / r each.
double lattice_speed(Kernel kernel, int dimension, int per_wavelength, double smoothing_ratio)
{
    return with_kernel(kernel, [&]<class K>(K) {
        const double spacing = 1.0 / per_wavelength, h = smoothing_ratio * spacing;
        const int reach = static_cast<int>(K::support * smoothing_ratio) + 1,
                  deep = dimension == 3 ? reach : 0;
        double sum = 0;
        for (int i = -reach; i <= reach; ++i)
            for (int j = -reach; j <= reach; ++j)
                for (int k = -deep; k <= deep; ++k) {
                    const double r = spacing * std::sqrt(i * i + j * j + k * k), x = i * spacing;
                    if (r == 0) continue;
                    const double gradient =
                        K::norm(dimension) / std::pow(h, dimension + 1) * K::slope(r / h) / r;
                    sum -= std::pow(spacing, dimension) * gradient * x * std::sin(wave_number * x);
                }
        return sum / wave_number;
    });
}

/// Kinetic energy that density diffusion leaves of a standing wave after a while; `shift` moves the wave
/// against the periodic planes, in spacings.
double diffused_wave(int shift)
{
    const int per_wavelength = 20;
    const double spacing = 1.0 / per_wavelength;
    ParticleWorld world;
    world.options.dimension = 2;
    world.options.viscosity = {0, 0};
    world.options.density_diffusion = 0.5;
    world.options.periods = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 8 * spacing, 0}}};
    const auto positions = lattice({0, 0, -spacing / 2}, per_wavelength, 8, 1, spacing);
    world.add_part(TestLinear(1, 1), positions, spacing * spacing, 1.3 * spacing);
    world.open_state();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        world.state.velocity[i].x = 1e-4 * std::sin(wave_number * (positions[i].x + shift * spacing));
    }
    world.model.controls.time.step_scale = 0.3;
    world.model.controls.time.end_time = 1.1;
    Scene scene = world.make_scene_of_particles();
    Recorders nobody;
    run(scene, nobody);
    double energy = 0;
    for (const Vec3& v : scene.state.velocity) energy += dot(v, v);
    return energy / (0.5e-8 * static_cast<double>(positions.size()));
}

} // namespace

TEST(SphSound, DensityDiffusesThroughPeriodicPlanes)
{
    const double node_at_the_plane = diffused_wave(0);
    EXPECT_LT(node_at_the_plane, 0.9) << "the wave must have lost something";
    EXPECT_GT(node_at_the_plane, 0.1);
    // Sums go another way round the particles: round-off, and estimates of 1 / r to eight digits.
    EXPECT_NEAR(diffused_wave(5), node_at_the_plane, 1e-6 * node_at_the_plane);
}

TEST(SphSound, TravelsAtTheSpeedThatTheLatticeAllows)
{
    for (const auto& [kernel, dimension, ratio] :
         {std::tuple{Kernel::cubic_spline, 2, 1.2}, std::tuple{Kernel::cubic_spline, 3, 1.2},
          std::tuple{Kernel::wendland_c2, 2, 2.0}, std::tuple{Kernel::quintic_spline, 3, 1.0}}) {
        const double expected = lattice_speed(kernel, dimension, 24, ratio);
        const Wave wave = run_wave(kernel, dimension, 24, ratio, 0);
        // Central difference in time raises the frequency by (omega dt)^2 / 24 < 1e-3.
        EXPECT_NEAR(wave.speed, expected, 1e-3) << "dimension " << dimension << ", h / spacing " << ratio;
        EXPECT_LT(wave.balance_error, 1e-5);
    }
}

TEST(SphSound, SpeedErrorFallsWithTheSquareOfTheSmoothingLength)
{
    // A wide kernel, so that the lattice's own error (0.1 % at h = 2 spacings) stays small.
    const double coarse = 1 - run_wave(Kernel::wendland_c2, 2, 24, 2.0, 0).speed;
    const double fine = 1 - run_wave(Kernel::wendland_c2, 2, 48, 2.0, 0).speed;
    EXPECT_LT(fine, 0.012);
    EXPECT_GT(coarse / fine, 3.2);
}

TEST(SphSound, LaminarViscosityDampsAtTheAnalyticRate)
{
    // Central pair forces have the bulk viscosity 5/3 of the shear viscosity (in space; Monaghan & Cleary
    // 1999), so that the longitudinal viscosity is 3 mu, and the amplitude decays with 3 nu k^2 / 2.
    const double viscosity = 1e-3, expected = 1.5 * viscosity * wave_number * wave_number;
    for (int dimension : {2, 3}) {
        const Wave wave = run_wave(Kernel::cubic_spline, dimension, 32, 1.2, viscosity);
        EXPECT_NEAR(wave.decay_rate, expected, 0.08 * expected) << "the lattice's error at h = 1.2 spacings";
    }
}

} // namespace plash

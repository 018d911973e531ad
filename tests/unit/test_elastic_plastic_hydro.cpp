#include "materials/elastic_plastic_hydro.h"
#include "tests/support/records.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// Units: mm, ms, kg, GPa.
constexpr double hydro_shear = 46;

ElasticPlasticHydro metal(std::vector<std::pair<const char*, double>> more,
                          const char* keyword = "MAT_ELASTIC_PLASTIC_HYDRO")
{
    more.push_back({"RO", 8.9e-6});
    more.push_back({"G", hydro_shear});
    return ElasticPlasticHydro::from_record(make_record(keyword, std::move(more)), Model{});
}

/// Shear stress after a simple shear at a pressure.
double sheared(const ElasticPlasticHydro& law, double engineering_strain, double pressure,
               double* plastic = nullptr)
{
    double history[ElasticPlasticHydro::history_size] = {};
    SymmetricTensor<double> shear{};
    const int steps = 50;
    for (int i = 0; i < steps; ++i) {
        law.update_deviator(shear, SymmetricTensor<double>{0, 0, 0, 0.5 * engineering_strain / steps, 0, 0},
                            pressure, HistoryView<double>{history}, 1.0);
    }
    if (plastic) *plastic = history[ElasticPlasticHydro::plastic_strain];
    return shear.xy;
}

/// A cube of one solid with law and equation of state that is stretched by `strain` along x in steps:
/// pressure and axial stress at the end.
struct Stretched {
    double pressure, axial;
};
Stretched stretched(Record material, std::initializer_list<double> strains)
{
    testing::SolidBlock block({1, 1, 1}, {1, 1, 1}, std::move(material));
    block.model.equations_of_state.push_back(testing::record_of("EOS_LINEAR_POLYNOMIAL", 1, {{"C1", 130}}));
    block.model.parts[0].equation_of_state = 0;
    block.set_viscosity(1e-30, 1e-30);
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1;
    double before = 0;
    for (const double strain : strains) {
        const int steps = 20;
        for (int i = 1; i <= steps; ++i) {
            const double now = before + (strain - before) * i / steps;
            for (std::size_t n = 0; n < state.size(); ++n) {
                const double x = block.model.nodes.position[n].x * (1 + now);
                state.velocity[n] = {x - state.position[n].x, 0, 0};
                state.position[n].x = x;
            }
            state.clear_forces();
            groups[0]->add_forces(clock, state);
        }
        before = strain;
    }
    const auto stress = testing::solid_results(block.model, state, groups).solid_stress[0];
    return {-(stress.xx + stress.yy + stress.zz) / 3, stress.xx};
}

} // namespace

TEST(ElasticPlasticHydro, HardensLinearlyAndWithPressure)
{
    const double sigma = 0.1, hardening = 0.5, a1 = 0.04, a2 = 0.01, p = 2;
    const double yield = sigma + p * (a1 + a2 * p);
    const auto law = metal({{"SIG0", sigma}, {"EH", hardening}, {"A1", a1}, {"A2", a2}},
                           "MAT_ELASTIC_PLASTIC_HYDRO_SPALL");
    // Simple shear: equivalent strain g / sqrt(3) = plastic + q / 3 G, q = yield + EH plastic.
    const double g = 0.2, plastic = (g / std::sqrt(3.0) - yield / (3 * hydro_shear)) /
                                    (1 + hardening / (3 * hydro_shear));
    double found = 0;
    EXPECT_NEAR(sheared(law, g, p, &found), (yield + hardening * plastic) / std::sqrt(3.0), 1e-13);
    EXPECT_NEAR(found, plastic, 1e-14);
    // In tension the pressure does nothing.
    const double loose =
        (g / std::sqrt(3.0) - sigma / (3 * hydro_shear)) / (1 + hardening / (3 * hydro_shear));
    EXPECT_NEAR(sheared(law, g, -p), (sigma + hardening * loose) / std::sqrt(3.0), 1e-13);
    EXPECT_NEAR(sheared(law, 1e-4, p), hydro_shear * 1e-4, 1e-15);
}

TEST(ElasticPlasticHydro, FollowsItsPoints)
{
    const auto law =
        metal({{"EPS1", 0}, {"EPS2", 0.05}, {"EPS3", 0.2}, {"ES1", 0.1}, {"ES2", 0.2}, {"ES3", 0.23}});
    double plastic = 0;
    const double stress = sheared(law, 0.2, 0, &plastic);
    EXPECT_GT(plastic, 0.05);
    EXPECT_NEAR(std::sqrt(3.0) * stress, 0.2 + (plastic - 0.05) * 0.2, 1e-12);
    EXPECT_NEAR(plastic + stress / std::sqrt(3.0) / hydro_shear, 0.2 / std::sqrt(3.0), 1e-12);
}

TEST(ElasticPlasticHydro, FailsAtItsStrain)
{
    const auto law = metal({{"SIGY", 0.1}, {"FS", 0.1}});
    double history[ElasticPlasticHydro::history_size] = {0.0999, 0};
    EXPECT_FALSE(law.failed(HistoryView<double>{history}));
    history[0] = 0.1;
    EXPECT_TRUE(law.failed(HistoryView<double>{history}));
}

/// Pulled in uniaxial strain beyond PC, and closed again: the pressure limit keeps PC and the deviator, the
/// spall models leave rubble.
TEST(ElasticPlasticHydro, SpallsInThreeWays)
{
    const double cutoff = -0.5, sigma = 0.2;
    const auto material = [&](double model) {
        return testing::record_of(
            "MAT_ELASTIC_PLASTIC_HYDRO_SPALL", 1,
            {{"RO", 8.9e-6}, {"G", hydro_shear}, {"SIG0", sigma}, {"PC", cutoff}, {"SPALL", model}});
    };
    // mu = 1 / V - 1: 0.004 of stretch gives -0.518; the axial stress reaches 0.5 at 0.0029 already.
    const double mild = 0.003;
    const double p = 130 * (1 / (1 + mild) - 1); // -0.389
    EXPECT_NEAR(stretched(material(1), {mild}).axial, -p + 2.0 / 3 * sigma, 1e-6);
    EXPECT_NEAR(stretched(material(2), {mild}).axial, 0, 1e-12);
    EXPECT_NEAR(stretched(material(3), {mild}).axial, -p + 2.0 / 3 * sigma, 1e-6);
    const Stretched limit = stretched(material(1), {0.006});
    EXPECT_NEAR(limit.pressure, cutoff, 1e-12);
    EXPECT_NEAR(limit.axial, 0.5 + 2.0 / 3 * sigma, 1e-9);
    EXPECT_NEAR(stretched(material(3), {0.006}).axial, 0, 1e-12);
    // Closed and pressed: pressure again, without strength.
    const Stretched pressed = stretched(material(3), {0.006, -0.01});
    EXPECT_NEAR(pressed.pressure, 130 * (1 / 0.99 - 1), 1e-9);
    EXPECT_NEAR(pressed.axial, -pressed.pressure, 1e-9);
}

TEST(ElasticPlasticHydro, NeedsAnEquationOfState)
{
    testing::SolidBlock block(
        {1, 1, 1}, {1, 1, 1},
        testing::record_of("MAT_ELASTIC_PLASTIC_HYDRO", 1, {{"RO", 1}, {"G", 1}, {"SIGY", 1}}));
    State state = block.state();
    EXPECT_THROW(make_solid_groups(block.model, state), DeckError);
}

} // namespace plash

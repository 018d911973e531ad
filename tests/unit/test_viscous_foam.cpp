#include "materials/low_density_viscous_foam.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

// mm, ms, kg, GPa
Model foam_curves()
{
    Model model;
    model.curves.push_back({1, "", {}, {{0, 0.5, 0.8}, {0, 1e-3, 1e-2}}});
    return model;
}

Record foam_card(std::vector<std::pair<const char*, double>> more, std::vector<double> series)
{
    more.insert(more.end(), {{"RO", 1e-7}, {"E", 0.01}, {"LCID", 1}, {"HU", 1}, {"TC", 1e20}});
    Record record = make_record("MAT_LOW_DENSITY_VISCOUS_FOAM", std::move(more));
    if (!series.empty()) record.tables.push_back({{"GI", "BETAI", "REF"}, std::move(series), {}, {}});
    return record;
}

/// A point that is stretched along x at a constant logarithmic rate for a time, in steps: stress at the end.
template <class Law>
SymmetricTensor<double> stretched(const Law& law, double rate, double time, int steps, int still = 0,
                                  double pause = 0)
{
    std::vector<double> history(Law::history_size);
    SymmetricTensor<double> stress{};
    double logarithm = 0;
    const auto go = [&](double increment, double step) {
        logarithm += increment;
        Tensor3<double> f{};
        f.xx = std::exp(logarithm);
        f.yy = f.zz = 1;
        law.update(stress, law.stretches(f), SymmetricTensor<double>{increment, 0, 0, 0, 0, 0},
                   HistoryView<double>{history.data()}, step);
    };
    for (int i = 0; i < steps; ++i) go(rate * time / steps, time / steps);
    for (int i = 0; i < still; ++i) go(0, pause / still);
    return stress;
}

} // namespace

/// Ramp and pause: GI r / BETAI (1 - exp(-BETAI t)) beside the foam, then it fades; exact for any number of
/// steps. In compression the foam's own part is its curve.
TEST(LowDensityViscousFoam, AddsItsSeriesToTheFoam)
{
    const LowDensityViscousFoam<6> law =
        viscous_foam(foam_card({}, {0.02, 0.5, 0, 0.01, 5, 0}), foam_curves());
    const double rate = -0.3, time = 1.5, pause = 0.8;
    const auto part = [&](double g, double b) { return g * rate / b * (1 - std::exp(-b * time)); };
    const double stretch = std::exp(rate * time), nominal = 2e-3 * (1 - stretch);
    for (int steps : {1, 10}) {
        const auto stress = stretched(law, rate, time, steps);
        EXPECT_NEAR(stress.xx, -nominal + part(0.02, 0.5) + part(0.01, 5), 1e-15) << steps;
        EXPECT_NEAR(stress.yy, 0, 1e-18); // no lateral coupling
        const auto later = stretched(law, rate, time, steps, steps, pause);
        EXPECT_NEAR(later.xx,
                    -nominal + part(0.02, 0.5) * std::exp(-0.5 * pause) +
                        part(0.01, 5) * std::exp(-5 * pause),
                    1e-15);
    }
}

TEST(LowDensityViscousFoam, IsTheFoamAloneWithoutSeries)
{
    const LowDensityViscousFoam<6> law = viscous_foam(foam_card({}, {}), foam_curves());
    EXPECT_NEAR(stretched(law, 0.1, 1, 4).xx, 0.01 * (std::exp(0.1) - 1) * 1, 1e-17); // E in tension, area 1
    EXPECT_NEAR(law.wave_modulus(law.stretches(Tensor3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1})), 0.01, 1e-15);
}

TEST(LowDensityFoam, HasARelaxingModulusOfItsOwn)
{
    const auto law = relaxing_foam(foam_card({{"ED", 0.03}, {"BETA1", 2}}, {}), foam_curves());
    const double rate = 0.2, time = 0.7;
    EXPECT_NEAR(stretched(law, rate, time, 3).xx,
                0.01 * (std::exp(rate * time) - 1) + 0.03 * rate / 2 * (1 - std::exp(-2 * time)), 1e-15);
}

/// Sheared simply: the series carry GI times the tensor strain.
TEST(LowDensityViscousFoam, ItsSeriesShearWithHalfTheEngineeringStrain)
{
    const LowDensityViscousFoam<6> law = viscous_foam(foam_card({}, {0.02, 0, 0}), foam_curves());
    std::vector<double> history(LowDensityViscousFoam<6>::history_size);
    SymmetricTensor<double> stress{};
    const double g = 1e-6;
    law.update(stress, law.stretches(Tensor3<double>{1, g, 0, 0, 1, 0, 0, 0, 1}),
               SymmetricTensor<double>{0, 0, 0, 0.5 * g, 0, 0}, HistoryView<double>{history.data()}, 1.0);
    // Foam: principal strains g/2 in tension (E) and compression (slope 0.002 of the curve).
    EXPECT_NEAR(stress.xy, 0.5 * g * 0.02 + 0.5 * (0.01 + 0.002) * 0.5 * g, 1e-4 * 0.5 * g * 0.02);
}

TEST(LowDensityViscousFoam, RefusesWhatItDoesNotHave)
{
    EXPECT_THROW(viscous_foam(foam_card({{"LCID2", 1}}, {}), foam_curves()), DeckError);
    EXPECT_THROW(viscous_foam(foam_card({}, {-1, 0, 0}), foam_curves()), DeckError);
    EXPECT_THROW(viscous_foam(foam_card({}, {1, 0, 1}), foam_curves()), DeckError);
}

} // namespace plash

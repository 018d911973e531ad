#include "eos/gruneisen.h"
#include "eos/memory.h"
#include "eos/pore_collapse.h"
#include "eos/tabulated_compaction.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

using testing::record_of;

namespace {

/// Loads along C, unloads along K of the largest compaction.
Record soil_table(double gamma = 0, double warm = 0)
{
    return record_of("EOS_TABULATED_COMPACTION", 1,
                     {{"GAMA", gamma},
                      {"EV1", 0},
                      {"EV2", -0.1},
                      {"EV3", -0.3},
                      {"C1", 0},
                      {"C2", 1},
                      {"C3", 7},
                      {"T1", warm},
                      {"T2", warm},
                      {"T3", warm},
                      {"K1", 20},
                      {"K2", 30},
                      {"K3", 70},
                      {"V0", 1}});
}

/// Cold pressure of an equation of state that remembers, along a way of compressions.
template <class Eos>
double pressure_after(const Eos& eos, std::initializer_list<double> compressions)
{
    double memory = 1, pressure = 0;
    for (double compression : compressions) pressure = respond_and_remember(eos, compression, &memory).cold;
    return pressure;
}

Model pore_curves()
{
    Model model;
    // Virgin: stiff, collapsing from 0.02 to 0.2; crushed: the solid, from 0.15 on. They meet at 0.2.
    model.curves.push_back({1, "", {}, {{-0.1, 0.02, 0.2, 0.4}, {-5, 1, 2, 10}}});
    model.curves.push_back({2, "", {}, {{0, 0.15, 0.2, 0.4}, {-6, 0, 2, 10}}});
    return model;
}

PoreCollapse porous(std::initializer_list<std::pair<const char*, double>> more = {})
{
    Record record = record_of("EOS_TENSOR_PORE_COLLAPSE", 1, more);
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"NLD", 1}, {"NCR", 2}, {"MU1", 0.02}, {"MU2", 0.2}, {"IE0", 0}, {"EC0", 0}})
        record.fields.push_back({name, value, "", true, false, {}});
    return PoreCollapse::from_record(record, pore_curves());
}

} // namespace

TEST(TabulatedCompaction, LoadsAlongItsTableAndUnloadsAlongItsModulus)
{
    const auto eos = TabulatedCompaction::from_record(soil_table(), Model{});
    const auto c = [](double compaction) { return std::exp(compaction); };
    EXPECT_NEAR(pressure_after(eos, {c(0.05)}), 0.5, 1e-14);
    EXPECT_NEAR(pressure_after(eos, {c(0.2)}), 4, 1e-14);
    // At 0.2 K is 50, and the table's slope 30.
    EXPECT_NEAR(pressure_after(eos, {c(0.2), c(0.18)}), 4 - 50 * 0.02, 1e-13);
    EXPECT_NEAR(pressure_after(eos, {c(0.2), c(0.18), c(0.19)}), 4 - 50 * 0.01, 1e-13);
    EXPECT_NEAR(pressure_after(eos, {c(0.2), c(0.1), c(0.25)}), 5.5, 1e-13);
    EXPECT_NEAR(pressure_after(eos, {c(0.4)}), 10, 1e-13); // with its last slope
    EXPECT_NEAR(pressure_after(eos, {c(-0.01)}), -20 * 0.01, 1e-14);
    EXPECT_NEAR(eos.evaluate(c(0.2), c(0.2)).cold_slope, 50 / c(0.2), 1e-12); // of the steeper way
    const auto warm = TabulatedCompaction::from_record(soil_table(0.5, 2), Model{});
    EXPECT_NEAR(warm.evaluate(c(0.1), c(0.2)).warm, 1, 1e-14);
}

/// In a cube of a null material: compressed, let go to the cut-off, compressed again. The work that is left
/// inside is that of the way along the table less that of the unloading.
TEST(TabulatedCompaction, RemembersInTheElement)
{
    testing::SolidBlock block({1, 1, 1}, {1, 1, 1}, record_of("MAT_NULL", 1, {{"RO", 1}, {"PC", -0.1}}));
    block.model.equations_of_state.push_back(soil_table());
    block.model.parts[0].equation_of_state = 0;
    block.set_viscosity(1e-30, 1e-30);
    for (int formulation : {1, 2}) {
        block.model.sections[0] = record_of("SECTION_SOLID", 1, {{"ELFORM", double(formulation)}});
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        Clock clock;
        clock.last_step = 1;
        double at = 0;
        const auto pressure = [&](double compaction) {
            const int steps = 400;
            const double before = at;
            for (int i = 1; i <= steps; ++i) {
                at = before + (compaction - before) * i / steps;
                for (std::size_t n = 0; n < state.size(); ++n) {
                    const double x = block.model.nodes.position[n].x * std::exp(-at);
                    state.velocity[n] = {x - state.position[n].x, 0, 0};
                    state.position[n].x = x;
                }
                state.clear_forces();
                groups[0]->add_forces(clock, state);
            }
            return -trace(testing::solid_results(block.model, state, groups).solid_stress[0]) / 3;
        };
        const auto energy = [&] {
            EnergyLedger ledger;
            ledger.open_cycle(1);
            groups[0]->report(ledger);
            ledger.close_cycle();
            return ledger.internal;
        };
        EXPECT_NEAR(pressure(0.2), 4, 1e-9) << formulation;
        // Work: integral of p exp(-e) de along the table.
        const auto integral = [](double from, double to, double value, double slope) { // p = value at from
            const double a = value - slope * from;
            const auto whole = [&](double e) { return -(a + slope * (e + 1)) * std::exp(-e); };
            return whole(to) - whole(from);
        };
        const double loaded = integral(0, 0.1, 0, 10) + integral(0.1, 0.2, 1, 30);
        EXPECT_NEAR(energy(), loaded, 1e-4 * loaded);
        EXPECT_NEAR(pressure(0.15), 1.5, 1e-9);
        EXPECT_NEAR(energy(), loaded - integral(0.15, 0.2, 1.5, 50), 1e-4 * loaded);
        EXPECT_NEAR(pressure(0.1), -0.1, 1e-9); // PC
        EXPECT_NEAR(pressure(0.3), 7, 1e-9);
    }
}

TEST(PoreCollapse, FollowsVirginPartlyCrushedAndCrushedCurves)
{
    const PoreCollapse eos = porous();
    EXPECT_NEAR(pressure_after(eos, {1.01}), 0.5, 1e-13);
    EXPECT_NEAR(pressure_after(eos, {1.01, 0.99}), -0.5, 1e-13); // elastic before the pores go
    EXPECT_NEAR(pressure_after(eos, {1.11}), 1.5, 1e-13);
    // b of c(b) = 1.5 is 0.1875; on the way back c((1 + b) (1 + mu) / (1 + m) - 1).
    const double stretch = 1.1875 / 1.11;
    EXPECT_NEAR(pressure_after(eos, {1.11, 1.10}), 40 * (stretch * 1.10 - 1 - 0.15), 1e-12);
    EXPECT_NEAR(pressure_after(eos, {1.11, 1.06}), 40 * (stretch * 1.06 - 1 - 0.15), 1e-12);
    EXPECT_NEAR(pressure_after(eos, {1.11, 1.10, 1.11}), 1.5, 1e-12);
    EXPECT_NEAR(pressure_after(eos, {1.11, 1.10, 1.15}), 1 + 0.13 / 0.18, 1e-12);
    EXPECT_NEAR(pressure_after(eos, {1.3}), 6, 1e-12);
    EXPECT_NEAR(pressure_after(eos, {1.3, 1.18}), 40 * 0.03, 1e-12);
    EXPECT_NEAR(eos.bulk_modulus, 50, 1e-12);
    EXPECT_NEAR(porous({{"EC0", 0.25}}).relative_volume, 0.8, 1e-15);
    EXPECT_THROW(porous({{"MU2", 0.01}}), DeckError);
    EXPECT_THROW(porous({{"MU2", 0.1}}), DeckError); // the curves do not meet there
}

/// With S1 = 2 the denominator vanishes at mu = 1. The shock is ten times as fast as sound at z = 0.45; from
/// there the pressure goes on along its tangent: it rises, and is finite.
TEST(Gruneisen, GoesOnAlongItsTangentBeforeItsPole)
{
    const Gruneisen eos = Gruneisen::from_record(
        record_of("EOS_GRUNEISEN", 1, {{"C", 1500}, {"S1", 2}, {"GAMMA0", 0.5}, {"V0", 1}}), 1000);
    const double limit = 0.45 / 0.55;
    EXPECT_NEAR(eos.largest, limit, 1e-12);
    const auto edge = eos.evaluate(1 + limit);
    EXPECT_NEAR(edge.cold / (1000.0 * 1500 * 1500), limit * (1 + 0.75 * limit) / std::pow(1 - limit, 2),
                1e-9);
    double before = edge.cold;
    for (double mu : {0.9, 0.999, 1.0, 1.001, 2.0, 5.0}) {
        const auto at = eos.evaluate(1 + mu);
        EXPECT_NEAR(at.cold, edge.cold + edge.cold_slope * (mu - limit), 1e-12 * at.cold);
        EXPECT_GT(at.cold, before);
        before = at.cold;
    }
    const Gruneisen without =
        Gruneisen::from_record(record_of("EOS_GRUNEISEN", 1, {{"C", 1500}, {"S1", 0.8}, {"V0", 1}}), 1000);
    EXPECT_EQ(without.largest, 1e300); // 1 - 0.8 z stays above 0.2
}

} // namespace plash

#include "materials/geologic_cap.h"
#include "materials/johnson_cook.h"
#include "materials/soil_foam.h"
#include "materials/viscoelastic.h"
#include "model/model.h"
#include "sph/particle_bodies.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

namespace {

/// One particle of a material, and what it must be told of it.
struct OneParticle {
    Model model;
    PartConstants constants;
    ParticleLawOfPart law;
    ParticleArrays arrays;

    explicit OneParticle(const Record& material)
    {
        model.materials.push_back(material);
        model.parts.emplace_back();
        model.parts[0].id = 1;
        model.parts[0].material = 0;
        law = particle_law_of(model, model.parts[0]);
        constants.density = law.density;
        constants.smoothing = 1;
        constants.smallest_smoothing = 0.2;
        constants.largest_smoothing = 2;
        arrays.motion = {{{}, 1, {}, law.density}};
        arrays.push.resize(1);
        arrays.node = {0};
        arrays.part = {0};
        arrays.set_density(0, law.density);
        arrays.energy = arrays.kept_pressure = arrays.rate = {0};
        arrays.tension.resize(1);
        arrays.gradient.resize(1);
        arrays.correction = {{1, 1, 1, 0, 0, 0}};
        arrays.stress.resize(1);
        arrays.history_size = law.law->history_size();
        arrays.history.resize(arrays.history_size + 1);
        law.law->start_history(arrays.history.data());
    }
    void advance(double step)
    {
        const Index place = 0;
        law.law->advance(constants, std::span(&place, 1), step, arrays);
    }
};

double difference(const SymmetricTensor<double>& a, const SymmetricTensor<double>& b)
{
    return std::sqrt(contract(a + -1.0 * b, a + -1.0 * b));
}

/// A particle that is squeezed and sheared has the stress that its material gives for the same strains.
template <class Material>
void expect_stress_of(const Record& record, double strain)
{
    OneParticle particle(record);
    const Material material = Material::from_record(record, particle.model);
    auto history = material.initial_history();
    SymmetricTensor<double> stress{};
    const double step = 1e-3;
    const int steps = 40;
    for (int i = 0; i < steps; ++i) {
        const double way = (i < steps / 2 ? 1 : -0.5) * strain / steps; // there, and some of the way back
        const SymmetricTensor<double> increment{-way, 0.3 * way, -0.2 * way, 0.4 * way, 0, -0.1 * way};
        const SymmetricTensor<double> rate = (1 / step) * increment;
        particle.arrays.gradient[0] = {rate.xx, rate.xy, rate.zx, rate.xy, rate.yy,
                                       rate.yz, rate.zx, rate.yz, rate.zz};
        particle.advance(step);
        if constexpr (Material::history_size > 0) {
            material.update(stress, increment, HistoryView<double>{history.data()}, step);
        }
        const double size = std::sqrt(contract(stress, stress));
        ASSERT_GT(size, 0) << record.keyword;
        ASSERT_LT(difference(particle.arrays.stress[0], stress), 1e-9 * size)
            << record.keyword << ", step " << i;
    }
}

} // namespace

TEST(ParticleLaws, SolidsHaveTheStressOfTheirMaterial)
{
    expect_stress_of<SoilFoam>(make_record("MAT_SOIL_AND_FOAM", {{"RO", 1.6e-6},
                                                                 {"G", 0.01},
                                                                 {"BULK", 0.5},
                                                                 {"A0", 4e-8},
                                                                 {"A1", 2e-5},
                                                                 {"A2", 0.3},
                                                                 {"PC", -2e-4},
                                                                 {"EPS2", -0.05},
                                                                 {"EPS3", -0.15},
                                                                 {"P2", 1e-3},
                                                                 {"P3", 11e-3}}),
                               0.05);
    expect_stress_of<Viscoelastic>(
        make_record("MAT_VISCOELASTIC", {{"RO", 1}, {"BULK", 10}, {"G0", 3}, {"GI", 1}, {"BETA", 20}}), 0.02);
    expect_stress_of<JohnsonCook>(make_record("MAT_JOHNSON_COOK", {{"RO", 8.96},
                                                                   {"G", 0.46},
                                                                   {"E", 1.24},
                                                                   {"PR", 0.34},
                                                                   {"A", 9e-4},
                                                                   {"B", 2.92e-3},
                                                                   {"N", 0.31},
                                                                   {"C", 0.025},
                                                                   {"M", 1.09},
                                                                   {"TM", 1356},
                                                                   {"TR", 293},
                                                                   {"EPSO", 1e-6},
                                                                   {"CP", 3.83e-6},
                                                                   {"PC", -1}}),
                                  0.03);
    expect_stress_of<GeologicCap>(make_record("MAT_GEOLOGIC_CAP_MODEL", {{"RO", 2e-6},
                                                                         {"BULK", 0.46},
                                                                         {"G", 0.28},
                                                                         {"ALPHA", 1.7e-3},
                                                                         {"THETA", 0.11},
                                                                         {"GAMMA", 1.2e-3},
                                                                         {"BETA", 0.94},
                                                                         {"R", 2.5},
                                                                         {"D", 0.15},
                                                                         {"W", 0.066},
                                                                         {"X0", 0.002},
                                                                         {"TOFF", -2e-4}}),
                                  0.01);
}

/// A particle drawn beyond its failure strain goes on with its stress (IEROD = 0) or without any (1).
TEST(ParticleLaws, FailedParticlesKeepOrLoseTheirStress)
{
    for (const bool carries_nothing : {false, true}) {
        OneParticle particle(make_record(
            "MAT_PLASTIC_KINEMATIC",
            {{"RO", 1}, {"E", 100}, {"PR", 0.3}, {"SIGY", 1}, {"ETAN", 5}, {"BETA", 1}, {"FS", 0.05}}));
        particle.constants.failed_carry_nothing = carries_nothing;
        const auto stress_after = [&](int steps) {
            for (int i = 0; i < steps; ++i) {
                particle.arrays.gradient[0] = {1, 0, 0, 0, -0.5, 0, 0, 0, -0.5};
                particle.advance(0.01);
            }
            return std::sqrt(contract(particle.arrays.stress[0], particle.arrays.stress[0]));
        };
        EXPECT_GT(stress_after(4), 0.5); // a plastic strain of 0.03
        if (carries_nothing) {
            EXPECT_EQ(stress_after(4), 0);
        } else {
            EXPECT_GT(stress_after(4), 0.5);
        }
    }
}

/// p = -K ln V, never below -CP.
TEST(ParticleLaws, ElasticFluidHasItsLogarithm)
{
    OneParticle particle(make_record("MAT_ELASTIC_FLUID", {{"RO", 1}, {"K", 2}, {"CP", 0.03}}));
    for (int i = 0; i < 100; ++i) {
        particle.arrays.rate[0] = i < 50 ? 1e-3 : -2e-3;
        particle.advance(1);
        const double pressure = 2 * std::log(particle.arrays.density(0));
        EXPECT_NEAR(particle.arrays.pressure(0), std::max(pressure, -0.03), 1e-7);
    }
    EXPECT_LT(particle.arrays.density(0), 0.96) << "the cut-off must have been met";
}

/// s = VC L a rho e' is twice the viscosity times e'; L comes with the particles.
TEST(ParticleLaws, ElasticFluidHasATensorViscosity)
{
    Model model;
    model.materials.push_back(make_record("MAT_ELASTIC_FLUID", {{"RO", 2}, {"K", 8}, {"VC", 0.1}}));
    Part part;
    part.material = 0;
    EXPECT_DOUBLE_EQ(particle_law_of(model, part).viscosity_by_size, 0.5 * 0.1 * 2 * 2); // a = 2
}

TEST(ParticleLaws, SayWhatTheyCannotDo)
{
    const auto complaint = [](const Record& material, bool with_pressure) {
        Model model;
        model.materials.push_back(material);
        model.equations_of_state.push_back(make_record("EOS_GRUNEISEN", {{"C", 1}}));
        Part part;
        part.material = 0;
        if (with_pressure) part.equation_of_state = 0;
        try {
            particle_law_of(model, part);
        } catch (const DeckError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(complaint(make_record("MAT_ELASTIC", {{"RO", 1}, {"E", 2}}), true).find("EOSID"),
              std::string::npos);
}

} // namespace plash

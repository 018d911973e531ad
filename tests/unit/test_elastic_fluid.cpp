#include "materials/elastic_fluid.h"
#include "tests/support/solid_column.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plash {

using testing::record_of;

namespace {

// mm, ms, kg, GPa: water
constexpr double water_density = 1e-6, water_bulk = 2.2, tensor_viscosity = 0.2, cavitation = 1e-3;

Record water(std::initializer_list<std::pair<const char*, double>> more = {})
{
    Record record = record_of("MAT_ELASTIC_FLUID", 1, {});
    for (const auto& [name, value] : more) record.fields.push_back({name, value, "", true, false, {}});
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"RO", water_density}, {"K", water_bulk}, {"VC", tensor_viscosity}, {"CP", cavitation}})
        record.fields.push_back({name, value, "", true, false, {}});
    return record;
}

/// One cell of 2 x 1 x 1 under a velocity field, for one step.
struct FluidCell {
    testing::SolidBlock block{{1, 1, 1}, {2, 1, 1}, water()};
    State state;
    std::vector<std::unique_ptr<SolidGroup>> groups;
    Clock clock;

    FluidCell()
    {
        block.set_viscosity(1e-30, 1e-30);
        state = block.state();
        groups = make_solid_groups(block.model, state);
    }
    SymmetricTensor<double> move(const Tensor3<double>& gradient, double step)
    {
        clock.last_step = step;
        for (std::size_t n = 0; n < state.size(); ++n) {
            state.velocity[n] = gradient * state.position[n];
            state.position[n] += step * state.velocity[n];
        }
        state.clear_forces();
        groups[0]->add_forces(clock, state);
        return testing::solid_results(block.model, state, groups).solid_stress[0];
    }
};

} // namespace

/// Volume cycle: pressure -K ln V on the way in, out to the cut-off, and back; nothing is left.
TEST(ElasticFluid, HasItsBulkModulusAndCavitates)
{
    FluidCell cell;
    const auto squeeze = [&](double logarithm) { // slowly: no viscous part
        const double rate = std::expm1(logarithm / 3);
        const Tensor3<double> gradient{rate * 1e-9, 0, 0, 0, rate * 1e-9, 0, 0, 0, rate * 1e-9};
        return -trace(cell.move(gradient, 1e9)) / 3;
    };
    EXPECT_NEAR(squeeze(-0.03), 0.03 * water_bulk, 1e-12);
    EXPECT_NEAR(squeeze(0.03), 0, 1e-12);
    EXPECT_NEAR(squeeze(4e-4), -8.8e-4, 1e-12);
    EXPECT_NEAR(squeeze(0.01), -cavitation, 1e-15);
    EXPECT_NEAR(squeeze(-0.01), -8.8e-4, 1e-12); // the bubble closes before there is pressure
}

/// Shear and uniaxial rates: VC L a rho times the deviator of the rate, L the cube root of the volume.
TEST(ElasticFluid, HasItsTensorViscosity)
{
    const double factor =
        tensor_viscosity * std::cbrt(2.0) * std::sqrt(water_bulk / water_density) * water_density;
    const double rate = 1e-3, step = 1e-6;
    FluidCell sheared;
    const auto shear = sheared.move({0, rate, 0, 0, 0, 0, 0, 0, 0}, step);
    EXPECT_NEAR(shear.xy, factor * 0.5 * rate, 1e-8 * factor * rate);
    FluidCell pulled;
    const auto axial = pulled.move({rate, 0, 0, 0, 0, 0, 0, 0, 0}, step);
    const double mean = trace(axial) / 3;
    EXPECT_NEAR(axial.xx - mean, factor * 2 / 3 * rate, 1e-8 * factor * rate);
    EXPECT_NEAR(axial.yy - mean, -factor / 3 * rate, 1e-8 * factor * rate);
}

/// A pressure wave from a piston: rho c v, with c = sqrt(K / rho).
TEST(ElasticFluid, CarriesAnAcousticWave)
{
    testing::Column column(200, 200, water({{"VC", 0.1}, {"CP", 1e20}}), {});
    column.model.equations_of_state.clear();
    column.model.parts[0].equation_of_state = none;
    const double speed = std::sqrt(water_bulk / water_density), piston = 1e-4 * speed;
    column.drive(0, piston);
    column.model.controls.time.end_time = 100 / speed;
    Scene scene = make_scene(column.model);
    Recorders none_recorded;
    run(scene, none_recorded);
    const auto profile = testing::profile_of(column, scene, water_density);
    for (int i = 10; i < 80; i += 10) // 1 + v / 2c from the strain of 1e-4
        EXPECT_NEAR(profile.pressure[i], water_density * speed * piston,
                    2e-3 * water_density * speed * piston);
    for (int i = 120; i < 200; i += 10) EXPECT_NEAR(profile.pressure[i], 0, 1e-3 * water_bulk * 1e-4);
    EXPECT_LT(profile.balance, 1e-3);
}

TEST(ElasticFluid, TakesItsBulkModulusFromEAndPr)
{
    const auto law =
        ElasticFluid::from_record(record_of("MAT_ELASTIC_FLUID", 1, {{"RO", 1}, {"E", 3}, {"PR", 0.4}}));
    EXPECT_NEAR(law.bulk_modulus, 5, 1e-14);
    EXPECT_THROW(ElasticFluid::from_record(record_of("MAT_ELASTIC_FLUID", 1, {{"RO", 1}})), DeckError);
}

} // namespace plash

#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

#include <cmath>

/// Laws of the deformation gradient in fully integrated solids, whose points follow their gradients.
namespace plash {

using testing::record_of;
using testing::SolidBlock;

namespace {

Record orthotropic()
{
    return record_of("MAT_ORTHOTROPIC_ELASTIC", 1,
                     {{"RO", 1},
                      {"EA", 10},
                      {"EB", 2},
                      {"EC", 1},
                      {"PRBA", 0.06},
                      {"PRCA", 0.03},
                      {"PRCB", 0.25},
                      {"GAB", 0.8},
                      {"GBC", 0.3},
                      {"GCA", 0.5}});
}

Record mooney_rivlin()
{
    return record_of("MAT_MOONEY-RIVLIN_RUBBER", 1, {{"RO", 1}, {"PR", 0.495}, {"A", 0.6}, {"B", 0.15}});
}

/// A deformation of a unit cube that grows with s from 0 to 1: stretch and shear, while it turns by 80
/// degrees.
Vec3 deformed(const Vec3& x, double s)
{
    const Vec3 y{(1 + 0.3 * s) * x.x + 0.2 * s * x.y, (1 - 0.1 * s) * x.y + 0.1 * s * x.z,
                 (1 - 0.12 * s) * x.z};
    const double angle = 1.4 * s;
    return {std::cos(angle) * y.x - std::sin(angle) * y.y, std::sin(angle) * y.x + std::cos(angle) * y.y,
            y.z};
}

/// Stress at the end of that path, and the internal energy.
std::pair<SymmetricTensor<double>, double> driven(const Record& material, int formulation, int steps,
                                                  bool and_back = false)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, material);
    block.model.sections[0] = record_of("SECTION_SOLID", 1, {{"ELFORM", static_cast<double>(formulation)}});
    block.set_viscosity(1e-30, 1e-30);
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1.0 / steps;
    clock.cycle = 2;
    for (int step = 1; step <= (and_back ? 2 : 1) * steps; ++step) {
        const double s = 1.0 * (step <= steps ? step : 2 * steps - step) / steps;
        for (std::size_t node = 0; node < state.size(); ++node) {
            const Vec3 next = deformed(block.model.nodes.position[node], s);
            state.velocity[node] = (1 / clock.last_step) * (next - state.position[node]);
            state.position[node] = next;
        }
        state.clear_forces();
        for (auto& group : groups) group->add_forces(clock, state);
    }
    EnergyLedger ledger;
    ledger.open_cycle(1);
    for (auto& group : groups) group->report(ledger);
    return {testing::solid_results(block.model, state, groups).solid_stress[0], ledger.internal};
}

double distance(const SymmetricTensor<double>& a, const SymmetricTensor<double>& b)
{
    const SymmetricTensor<double> d = a - b;
    return std::sqrt(contract(d, d) / contract(b, b));
}

} // namespace

/// Under a uniform deformation the stress is that of the one-point element, whose gradient is exact: the
/// error falls with the square of the step.
TEST(FollowedPoint, GivesTheStressOfTheGradientToSecondOrder)
{
    for (const Record& material : {orthotropic(), mooney_rivlin()}) {
        SCOPED_TRACE(material.keyword);
        const auto exact = driven(material, 1, 50).first;
        for (const int formulation : {2, -1, -2}) {
            SCOPED_TRACE(formulation);
            const double coarse = distance(driven(material, formulation, 50).first, exact);
            const double fine = distance(driven(material, formulation, 200).first, exact);
            EXPECT_LT(coarse, 2e-3);
            EXPECT_LT(fine, coarse / 14); // 16 of second order
        }
    }
}

/// Out and back the same way: no stress and no energy is left. The path back takes the same increments with
/// the other sign, and exp(e) exp(-e) is off by e^4 / 4 alone.
TEST(FollowedPoint, ComesBackToNothing)
{
    for (const Record& material : {orthotropic(), mooney_rivlin()}) {
        SCOPED_TRACE(material.keyword);
        const auto there = driven(material, 2, 100), back = driven(material, 2, 100, true);
        const double size = std::sqrt(contract(there.first, there.first));
        EXPECT_LT(std::sqrt(contract(back.first, back.first)), 1e-5 * size);
        EXPECT_NEAR(back.second, 0, 1e-5 * there.second);
    }
}

} // namespace plash

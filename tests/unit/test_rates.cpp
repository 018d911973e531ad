#include "materials/compression_tension.h"
#include "materials/damaged_plasticity.h"
#include "materials/johnson_cook.h"
#include "materials/piecewise_linear_plasticity.h"
#include "materials/plastic_kinematic.h"
#include "tests/support/law_driver.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

namespace plash {

namespace {

// GPa, ms. Sheared by 0.2 at 0.5 / ms beside a volume rate of 0.4 / ms, which shells do not feel. The numbers
// below come from tests/reference/rates.py, which integrates each law as the manual writes it.
constexpr double sheared_by = 0.2, shear_rate = 0.5, volume_rate = 0.4;
constexpr int steps = 4000;

using Fields = std::vector<std::pair<const char*, double>>;

Fields with(Fields fields, const Fields& more)
{
    fields.insert(fields.end(), more.begin(), more.end());
    return fields;
}

const Fields elastic_card{{"RO", 7.85e-6}, {"E", 210}, {"PR", 0.3}};
const Fields bilinear = with(elastic_card, {{"SIGY", 0.3}, {"ETAN", 1}, {"C", 0.04}, {"P", 5}});
const Fields power_law = with(elastic_card, {{"K", 0.5}, {"N", 0.2}, {"SRC", 0.04}, {"SRP", 5}});
const Fields johnson = with(elastic_card, {{"A", 0.3}, {"B", 0.4}, {"N", 0.3}, {"C", 0.02}, {"EPSO", 1e-3}});

/// One curve for both senses of *MAT_124.
Model with_line()
{
    Model model;
    const double slope = 210.0 / 209;
    model.curves.push_back({1, "", {}, {{0, 1}, {0.3, 0.3 + slope}}});
    return model;
}

/// Von Mises stress and plastic strain of a solid point. Its error falls with the step; 4,000 steps leave
/// 1e-5.
template <class Law>
void check_solid(const char* keyword, const Fields& card, double stress, double strain)
{
    const Law law = Law::from_record(make_record(keyword, card), with_line());
    testing::DrivenPoint<Law> point(law);
    const double time = sheared_by / shear_rate, third = volume_rate * time / 3;
    point.strain({third, third, third, 0.5 * sheared_by, 0, 0}, steps, time);
    EXPECT_NEAR(von_mises_stress(point.stress), stress, 2e-5) << keyword;
    EXPECT_NEAR(point.history[Law::plastic_strain], strain, 1e-6) << keyword;
}

/// The same of a shell point without the volume.
template <class Law>
void check_shell(const char* keyword, const Fields& card, double stress, double strain)
{
    const Law law = Law::from_record(make_record(keyword, card), with_line());
    testing::DrivenPoint<Law> point(law);
    const double time = sheared_by / shear_rate;
    for (int i = 0; i < steps; ++i) {
        SymmetricTensor<double> increment{0, 0, 0, 0.5 * sheared_by / steps, 0, 0};
        law.update_plane_stress(point.stress, increment, HistoryView<double>{point.history.data()},
                                time / steps);
        EXPECT_NEAR(increment.zz, 0, 1e-15);
    }
    EXPECT_NEAR(von_mises_stress(point.stress), stress, 2e-5) << keyword;
    EXPECT_NEAR(point.history[Law::plastic_strain], strain, 1e-6) << keyword;
}

} // namespace

TEST(Rates, PlasticKinematic003)
{
    const Fields card =
        with(elastic_card, {{"SIGY", 0.3}, {"ETAN", 1}, {"BETA", 1}, {"SRC", 0.04}, {"SRP", 5}});
    check_solid<PlasticKinematic<false>>("MAT_PLASTIC_KINEMATIC", card, 1.071009, 0.111050);
    check_shell<PlasticKinematic<false>>("MAT_PLASTIC_KINEMATIC", card, 1.048229, 0.111144);
    const Fields viscous = with(card, {{"VP", 1}});
    check_solid<PlasticKinematic<false>>("MAT_PLASTIC_KINEMATIC", viscous, 1.021955, 0.111252);
    check_shell<PlasticKinematic<false>>("MAT_PLASTIC_KINEMATIC", viscous, 1.021955, 0.111252);
}

TEST(Rates, PiecewiseLinear024And123)
{
    for (const char* keyword :
         {"MAT_PIECEWISE_LINEAR_PLASTICITY", "MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY"}) {
        using Law = PiecewiseLinearPlasticity;
        check_solid<Law>(keyword, bilinear, 1.045079, 0.111157);
        check_shell<Law>(keyword, bilinear, 1.023193, 0.111247);
        check_solid<Law>(keyword, with(bilinear, {{"VP", -1}}), 1.023193, 0.111247);
        check_shell<Law>(keyword, with(bilinear, {{"VP", -1}}), 1.023193, 0.111247);
        check_solid<Law>(keyword, with(bilinear, {{"VP", 1}}), 0.857540, 0.111931);
        check_shell<Law>(keyword, with(bilinear, {{"VP", 1}}), 0.857540, 0.111931);
    }
}

TEST(Rates, PlasticityWithDamage081)
{
    const char* keyword = "MAT_PLASTICITY_WITH_DAMAGE";
    const Fields card = with(bilinear, {{"EPPF", 1e12}, {"EPPFR", 1e14}});
    check_solid<DamagedPlasticity>(keyword, card, 1.045079, 0.111157);
    check_shell<DamagedPlasticity>(keyword, card, 1.023193, 0.111247);
    check_solid<DamagedPlasticity>(keyword, with(card, {{"VP", -1}}), 1.023193, 0.111247);
    check_solid<DamagedPlasticity>(keyword, with(card, {{"VP", 1}}), 0.857540, 0.111931);
    check_shell<DamagedPlasticity>(keyword, with(card, {{"VP", 1}}), 0.857540, 0.111931);
}

/// The curves of the flow laws are sampled, to 2e-4 of the flow stress (materials/flow_laws.h).
TEST(Rates, PowerLaw018)
{
    const auto check = [](const Fields& card, bool shell, double stress) {
        const auto law =
            PiecewiseLinearPlasticity::from_record(make_record("MAT_POWER_LAW_PLASTICITY", card), Model{});
        testing::DrivenPoint point(law);
        const double time = sheared_by / shear_rate, third = shell ? 0 : volume_rate * time / 3;
        point.strain({third, third, third, 0.5 * sheared_by, 0, 0}, steps, time);
        EXPECT_NEAR(von_mises_stress(point.stress), stress, 2e-4 * stress);
    };
    check(power_law, false, 0.820099);
    check(power_law, true, 0.802849);
    check(with(power_law, {{"VP", 1}}), false, 0.802289);
}

TEST(Rates, SimplifiedJohnsonCook098)
{
    const auto check = [](const Fields& card, bool shell, double stress) {
        const auto law =
            PiecewiseLinearPlasticity::from_record(make_record("MAT_SIMPLIFIED_JOHNSON_COOK", card), Model{});
        testing::DrivenPoint point(law);
        const double time = sheared_by / shear_rate, third = shell ? 0 : volume_rate * time / 3;
        point.strain({third, third, third, 0.5 * sheared_by, 0, 0}, steps, time);
        EXPECT_NEAR(von_mises_stress(point.stress), stress, 2e-4 * stress);
    };
    check(johnson, false, 0.567401);
    check(johnson, true, 0.565600);
    check(with(johnson, {{"VP", 1}}), false, 0.565575);
}

/// Adiabatic: the plastic work heats and softens. The temperature of a step is that of its start.
TEST(Rates, JohnsonCook015)
{
    const Fields card = with(johnson, {{"G", 210 / 2.6}, {"M", 1}, {"TM", 1800}, {"TR", 300}, {"CP", 460}});
    check_solid<JohnsonCook>("MAT_JOHNSON_COOK", card, 0.559596, 0.113161);
    check_shell<JohnsonCook>("MAT_JOHNSON_COOK", card, 0.559596, 0.113161);
    const Fields viscous = with(card, {{"VP", 1}});
    check_solid<JohnsonCook>("MAT_JOHNSON_COOK", viscous, 0.559574, 0.113161);
    check_shell<JohnsonCook>("MAT_JOHNSON_COOK", viscous, 0.559574, 0.113161);
}

TEST(Rates, CompressionTension124)
{
    const Fields card = with(elastic_card, {{"LCIDC", 1}, {"LCIDT", 1}, {"C", 0.04}, {"P", 5}});
    const char* keyword = "MAT_PLASTICITY_COMPRESSION_TENSION";
    check_solid<CompressionTension>(keyword, card, 1.045079, 0.111157);
    check_shell<CompressionTension>(keyword, card, 1.023193, 0.111247);
}

} // namespace plash

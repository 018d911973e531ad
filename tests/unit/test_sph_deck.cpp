#include "parser/read_model.h"
#include "solver/scene.h"
#include "sph/particle_bodies.h"
#include "tests/support/particle_setup.h"
#include "tests/support/read_text.h"
#include "tests/support/records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// A plate of 4 x 3 particles of water 10 apart, from x = left; `extra` are more keywords.
std::string plate_deck(const std::string& section, const std::string& extra, int left = 0)
{
    std::string deck = "*KEYWORD\n*CONTROL_TERMINATION\n1e-6\n*PART\nwater\n1,7,3,4\n*SECTION_SPH\n" +
                       section + "\n*MAT_NULL\n3,1e-9,-1,1e-9\n*EOS_GRUNEISEN\n4,1.48e6,1.92,,,0.1\n\n" +
                       extra;
    std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
    for (int i = 0; i < 12; ++i) {
        nodes += fmt::format("{},{},{},0\n", 101 + i, left + 10 * (i % 4), 10 * (i / 4));
        elements += fmt::format("{},1,{}\n", 101 + i, i == 0 ? "-1000" : "1e-6"); // the first one by volume
    }
    return deck + nodes + elements + "*END\n";
}

const ParticleBody& body_of(const Scene& scene)
{
    return dynamic_cast<const ParticleBody&>(*scene.terms.at(0));
}

} // namespace

TEST(SphDeck, TakesSpacingMassesAndDefaults)
{
    const Model model = testing::model_of_text(plate_deck("7", ""));
    const Scene scene = make_scene(model);
    const ParticleBody& body = body_of(scene);
    EXPECT_EQ(body.items(), 12u);
    EXPECT_DOUBLE_EQ(body.arrays().motion[0].smoothing, 12);           // CSLH 1.2 times the spacing
    for (double mass : scene.state.mass) EXPECT_DOUBLE_EQ(mass, 1e-6); // 1000 volume units of 1e-9 as well
    EXPECT_DOUBLE_EQ(body.arrays().density(0), 1e-9);
    // h / (Q + sqrt(Q^2 + c^2)) with Q = Q2 c at rest, Q2 = 0.06
    EXPECT_NEAR(body.stable_step().step, 12 / (1.48e6 * (0.06 + std::sqrt(1 + 0.06 * 0.06))), 1e-15);
}

TEST(SphDeck, HonoursSmoothingLengthsAndKernels)
{
    const Model model = testing::model_of_text(plate_deck("7,1.5,0.5,1,,,,1", ""));
    const ParticleOptions options = particle_options_of(model);
    EXPECT_FALSE(options.renormalised);
    const Scene scene = make_scene(model);
    EXPECT_DOUBLE_EQ(body_of(scene).arrays().motion[0].smoothing, 15);
    const Model given = testing::model_of_text(plate_deck("7,,,,8.5", ""));
    EXPECT_DOUBLE_EQ(body_of(make_scene(given)).arrays().motion[0].smoothing, 8.5);
}

TEST(SphDeck, GradedParticlesHaveSmoothingLengthsByTheirMasses)
{
    std::string deck = plate_deck("7", "*PLASH_SPH_FORMULATION\n0\n1\n");
    const std::size_t mass = deck.find("103,1,1e-6");
    ASSERT_NE(mass, std::string::npos);
    deck.replace(mass, 10, "103,1,8e-6"); // twice as wide as the others
    const Scene scene = make_scene(testing::model_of_text(deck));
    const ParticleArrays& a = body_of(scene).arrays();
    for (Index p = 0; p < a.real_count(); ++p) {
        EXPECT_NEAR(a.motion[p].smoothing, a.mass(p) > 2e-6 ? 24 : 12, 1e-12); // CSLH 1.2
    }
    EXPECT_NE(testing::complaint_about(plate_deck("7", "*PLASH_SPH_FORMULATION\n0\n2\n")).find("GRADED"),
              std::string::npos);
}

TEST(SphDeck, MassesOfRingsAreThoseOfTheirAreasTimesTheirRadii)
{
    const Scene scene = make_scene(testing::model_of_text(plate_deck("7", "*CONTROL_SPH\n1,,,-2\n", 5)));
    for (int i = 0; i < 12; ++i) EXPECT_DOUBLE_EQ(scene.state.mass[i], 1e-6 * (5 + 10 * (i % 4))) << i;
    const ParticleArrays& a = body_of(scene).arrays();
    for (Index p = 0; p < a.real_count(); ++p) EXPECT_NEAR(a.motion[p].weight, 1000, 1e-9); // their areas
}

TEST(SphDeck, ViscosityOfAnElasticFluidGoesWithTheParticles)
{
    std::string deck = plate_deck("7", "");
    const std::size_t fluid = deck.find("*MAT_NULL\n3,1e-9,-1,1e-9\n");
    ASSERT_NE(fluid, std::string::npos);
    deck.replace(fluid, 25, "*MAT_ELASTIC_FLUID\n3,1e-9,,,,,2000\n0.1,1\n");
    deck.replace(deck.find("1,7,3,4"), 7, "1,7,3");
    const Scene scene = make_scene(testing::model_of_text(deck));
    const ParticleArrays& a = body_of(scene).arrays();
    // (dimension + 2) mu / rho^2, mu = VC L sqrt(K rho) / 2; particles of 1000 volume units
    const double viscosity = 0.5 * 0.1 * 10 * std::sqrt(2000 * 1e-9);
    EXPECT_NEAR(a.push[0].viscosity, 5 * viscosity * 1e18, 1e-6 * a.push[0].viscosity);
}

TEST(SphDeck, MapsFormsAndBoundaries)
{
    const auto options = [](const std::string& extra) {
        return particle_options_of(testing::model_of_text(plate_deck("7", extra)));
    };
    EXPECT_FALSE(options("").volume_weighted);
    EXPECT_TRUE(options("*CONTROL_SPH\n1,,,2,,1\n").renormalised);
    EXPECT_EQ(options("*CONTROL_SPH\n1,,,2,,1\n").dimension, 2);
    EXPECT_TRUE(options("*CONTROL_SPH\n1,,,,,5\n").volume_weighted);
    const ParticleOptions fluid = options("*CONTROL_SPH\n1,,,,,6\n1\n");
    EXPECT_TRUE(fluid.volume_weighted && fluid.renormalised && !fluid.parts_interact);
    EXPECT_TRUE(options("*CONTROL_SPH\n1\n,,,,,,1\n").bulk_viscosity);
    EXPECT_EQ(options("").shifting, 0);
    EXPECT_EQ(options("*CONTROL_SPH\n1\n\n,,,,,1\n").shifting, 1);
    EXPECT_EQ(options("*CONTROL_SPH\n1\n\n,,,,,1\n*PLASH_SPH_FORMULATION\n,,,3\n").shifting, 3);
    EXPECT_THROW(options("*CONTROL_SPH\n1\n\n,,,,,2\n"), DeckError);
    EXPECT_FALSE(options("").failed_carry_nothing);
    EXPECT_TRUE(options("*CONTROL_SPH\n1\n,,,,1\n").failed_carry_nothing);
    EXPECT_FALSE(options("").smoothing_by_cube_root);
    EXPECT_TRUE(options("*CONTROL_SPH\n1\n0,1\n").smoothing_by_cube_root);
    const auto mirrors = options("*BOUNDARY_SPH_SYMMETRY_PLANE\n0,-5,0,0,3,0\n").mirrors;
    ASSERT_EQ(mirrors.size(), 1u);
    EXPECT_EQ(norm(mirrors[0].normal - Vec3{0, 1, 0}), 0);
    const auto lid = options("*PLASH_SPH_WALL\n0,5,0,0,3,0\n2,0,0\n").mirrors;
    ASSERT_EQ(lid.size(), 1u);
    EXPECT_TRUE(lid[0].no_slip && !mirrors[0].no_slip);
    EXPECT_EQ(norm(lid[0].velocity - Vec3{2, 0, 0}), 0);
    EXPECT_THROW(options("*PLASH_SPH_WALL\n0,5,0,0,3,0\n2,1,0\n"), DeckError);
    const auto periods = options("*DEFINE_VECTOR\n1,-5,0,0,1,0,0\n2,35,9,0,40,0,0\n"
                                 "*BOUNDARY_SPH_PERIODIC\n1,2\n")
                             .periods;
    ASSERT_EQ(periods.size(), 1u);
    EXPECT_EQ(norm(periods[0].period - Vec3{40, 0, 0}), 0);
}

TEST(SphDeck, TakesOpenBoundaries)
{
    const auto options = [](const std::string& extra) {
        return particle_options_of(testing::model_of_text(plate_deck("7", extra)));
    };
    const auto planes = options("*BOUNDARY_SPH_NON_REFLECTING\n0,-5,0,0,3,0\n35,0,0,0,0,0\n").mirrors;
    ASSERT_EQ(planes.size(), 2u);
    EXPECT_TRUE(planes[0].absorbing && planes[1].absorbing);
    EXPECT_EQ(norm(planes[1].normal - Vec3{-1, 0, 0}), 0);

    const std::string around = "*SET_NODE_LIST\n8\n101,102\n*DEFINE_VECTOR\n6,0,0,0,0,2,0\n"
                               "*DEFINE_CURVE\n9\n0,3\n1,3\n*BOUNDARY_SPH_FLOW\n";
    const auto flows = options(around + "8,3,4,0,9,2,0.5,0.1\n105,6\n1,2,1,2,9\n105,6\n").inflows;
    ASSERT_EQ(flows.size(), 2u);
    EXPECT_EQ(flows[0].motion.nodes.size(), 2u);
    EXPECT_EQ(norm(flows[0].motion.direction - Vec3{0, 1, 0}), 0);
    EXPECT_EQ(norm(flows[0].point - Vec3{0, 10, 0}), 0);
    EXPECT_EQ(flows[0].motion.scale, 2);
    EXPECT_EQ(flows[0].motion.birth, 0.1);
    EXPECT_EQ(flows[0].motion.death, 0.5);
    EXPECT_EQ(flows[1].motion.nodes.size(), 12u);
    EXPECT_TRUE(flows[1].motion.kind == PrescribedMotion::Kind::displacement);
    EXPECT_EQ(norm(flows[1].motion.direction - Vec3{1, 0, 0}), 0);
    const auto wrong = [&](const std::string& cards) {
        return testing::complaint_about(plate_deck("7", around + cards));
    };
    EXPECT_NE(wrong("8,3,5,0,9\n105,6\n").find("DOF"), std::string::npos);
    EXPECT_NE(wrong("8,4,1,0,9\n105,6\n").find("STYP"), std::string::npos);
    EXPECT_NE(wrong("8,3,1,3,9\n105,6\n").find("VAD"), std::string::npos);
    EXPECT_NE(wrong("7,3,1,0,9\n105,6\n").find("ID"), std::string::npos);
}

TEST(SphDeck, TakesPlashsOwnFormulation)
{
    const auto options = [](const std::string& extra) {
        return particle_options_of(testing::model_of_text(plate_deck("7", extra)));
    };
    const ParticleOptions plain = options("");
    EXPECT_EQ(plain.density_diffusion, 0);
    EXPECT_FALSE(plain.own_kernel);
    const ParticleOptions own = options("*PLASH_SPH_FORMULATION\n4,0.1,0.5,1,0.2,30,0.15,1\n");
    EXPECT_TRUE(own.own_kernel && own.kernel == Kernel::wendland_c2);
    EXPECT_EQ(own.density_diffusion, 0.1);
    EXPECT_EQ(own.velocity_blend, 0.5);
    EXPECT_EQ(own.shifting, 1);
    EXPECT_EQ(own.tensile_repulsion, 0.2);
    EXPECT_EQ(own.filter_interval, 30);
    EXPECT_EQ(own.skin, 0.15);
    EXPECT_TRUE(own.laminar_by_velocity);
    EXPECT_FALSE(plain.laminar_by_velocity);
    EXPECT_EQ(testing::complaint_about(plate_deck("7", "*PLASH_SPH_FORMULATION\n0,,,,,,,2\n")),
              "*PLASH_SPH_FORMULATION, field VISC: there is no form 2 of laminar viscosity; there are 0 "
              "(Monaghan & Cleary) and 1 (Morris et al.)");
    EXPECT_EQ(testing::complaint_about(plate_deck("7", "*PLASH_SPH_FORMULATION\n3\n")),
              "*PLASH_SPH_FORMULATION, field KERNEL: there is no kernel 3; there are 0 (that of the "
              "sections), 4 (Wendland C2) and 5 (Wendland C4)");
    EXPECT_EQ(testing::complaint_about(plate_deck("7", "*PLASH_SPH_FORMULATION\n0,-1\n")),
              "*PLASH_SPH_FORMULATION, field DELTA: -1 is not between 0 and 1");
}

TEST(SphDeck, KnowsWhenParticlesLeave)
{
    const ParticleOptions options = particle_options_of(testing::model_of_text(
        plate_deck("7", "*DEFINE_BOX\n5,-1,31,-1,21,-1,1\n*CONTROL_SPH\n1,5,,,,,,2e6\n")));
    ASSERT_TRUE(options.box.has_value());
    EXPECT_EQ(options.box->high.x, 31);
    EXPECT_EQ(options.largest_speed, 2e6);
    EXPECT_EQ(particle_options_of(testing::model_of_text(plate_deck("7", ""))).largest_speed, forever);
}

TEST(SphDeck, PartsComeAndGoWithTheirSection)
{
    const auto neighbours = [](const std::string& section) {
        const Model model = testing::model_of_text(plate_deck(section, ""));
        return body_of(make_scene(model)).mean_neighbours();
    };
    EXPECT_GT(neighbours("7,,,,,1e20"), 1) << "the default, written out";
    EXPECT_EQ(neighbours("7,,,,,,1e-3"), 0) << "not born yet";
    EXPECT_EQ(testing::complaint_about(plate_deck("7,,,,,1e-3,2e-3", "")),
              "*SECTION_SPH, field DEATH: 0.001 is before START, 0.002");
}

TEST(SphDeck, SaysWhatIsWrong)
{
    EXPECT_EQ(
        testing::complaint_about(plate_deck("7", "*CONTROL_SPH\n1,,,2,,7\n")),
        "*CONTROL_SPH, field FORM: form 7 (total Lagrangian: kernels on the places of the start) is not "
        "supported; there are 0 to 6, 12, 15 and 16");
    EXPECT_EQ(
        testing::complaint_about(plate_deck("7", "*CONTROL_SPH\n1,,,2,,9\n")),
        "*CONTROL_SPH, field FORM: form 9 (adaptive SPH: ellipsoids for kernels, as *SECTION_SPH_ELLIPSE and "
        "_TENSOR give them, which turn and stretch with the flow; here they are spheres) is not supported; "
        "there are 0 to 6, 12, 15 and 16");
    EXPECT_EQ(testing::complaint_about(plate_deck("7", "*CONTROL_SPH\n1,,,2,,11\n")),
              "*CONTROL_SPH, field FORM: form 11 is not supported; there are 0 to 6, 12, 15 and 16");
    EXPECT_EQ(
        testing::complaint_about(plate_deck("7", "*CONTROL_SPH\n1,,,1\n")),
        "*CONTROL_SPH, field IDIM: 1 is not supported; there are 2 (plane strain), 3 and -2 (axisymmetric)");
    EXPECT_EQ(testing::complaint_about(plate_deck("7", "*CONTROL_SPH\n1,,,-2\n")),
              "*CONTROL_SPH, field IDIM: -2 asks for particles at x > 0, for they are rings around the y "
              "axis, but particle 101 has x = 0");
    EXPECT_EQ(
        testing::complaint_about(plate_deck("7", "*CONTROL_SPH\n1,,,-2\n*PLASH_SPH_FORMULATION\n,,0.5\n", 5)),
        "XSPH, SHIFT, TENSILE, GRADED and VISC of *PLASH_SPH_FORMULATION do not work with axisymmetric "
        "particles (*CONTROL_SPH IDIM = -2)");
    EXPECT_EQ(testing::complaint_about(plate_deck("7,1.2,3,2", "")),
              "*SECTION_SPH, field HMIN: the smallest smoothing length is above the largest one, HMAX");
    EXPECT_EQ(testing::complaint_about(plate_deck("7,,,,,,,5", "")),
              "*SECTION_SPH, field SPHKERN: there is no kernel 5; there are 0 to 3");
}

TEST(SphDeck, SpacingIsTheLargestOfTheSmallestDistances)
{
    // LS-DYNA's rule: each particle's nearest neighbour, and of these the farthest.
    EXPECT_DOUBLE_EQ(particle_spacing({{0, 0, 0}, {1, 0, 0}, {1.5, 0, 0}, {9, 0, 0}}), 7.5);
    EXPECT_DOUBLE_EQ(particle_spacing({{0, 0, 0}, {0, 2, 0}}), 2);
    EXPECT_EQ(particle_spacing({{1, 1, 1}}), 0);
    EXPECT_EQ(particle_spacing({{1, 1, 1}, {1, 1, 1}}), 0);
}

TEST(SphDeck, NoticesDensitiesThatMassesCannotWeigh)
{
    const auto notices = [](double other_density, bool volume_weighted) {
        ParticleWorld world;
        world.options.volume_weighted = volume_weighted;
        world.add_part(TestLinear(1000, 1500), lattice({0, 0, 0}, 3, 3, 3, 1), 1000, 1.2);
        world.add_part(TestLinear(other_density, 1500), lattice({3, 0, 0}, 3, 3, 3, 1), other_density, 1.2);
        world.open_state();
        return world.make_body()->notices(world.state);
    };
    EXPECT_TRUE(notices(950, false).empty());
    EXPECT_TRUE(notices(100, true).empty());
    const std::vector<std::string> said = notices(100, false);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0],
              "particles of parts 2 and 1 have the densities 100 and 1000: where they meet, FORM 0 to 4 "
              "and 12 of *CONTROL_SPH are wrong by that ratio; FORM 5 and 6 are not");
}

/// LS-DYNA's particles of a wing's bird with PC = 0 end with no pressure below 0 at 7 to 84 % of their
/// density.
TEST(SphDeck, NullFluidsCannotPullUnlessPcSaysSo)
{
    EXPECT_EQ(NullFluid::from_record(make_record("MAT_NULL", {{"RO", 1}})).lowest_pressure, 0);
    EXPECT_EQ(NullFluid::from_record(make_record("MAT_NULL", {{"RO", 1}, {"PC", -5}})).lowest_pressure, -5);
}

} // namespace plash

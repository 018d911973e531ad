#include "contact/surface_contact.h"
#include "sph/particle_body.h"
#include "tests/support/deck_run.h"
#include "tests/support/read_text.h"

namespace plash {

namespace {

using testing::DeckRun;
using testing::DeckText;

/// 27 particles of water, 2 apart, that fall at 10 m/s onto a plate of steel shells (t, mm, s); `control`
/// holds *CONTROL_SPH, `contact` the contact of the particles with the plate.
std::string rain(const std::string& control, const std::string& contact, const std::string& plate)
{
    DeckText deck;
    deck.text += "*CONTROL_TERMINATION\n4.0e-4\n" + control +
                 "*SECTION_SPH\n1\n*MAT_NULL\n1,1.0e-9,-1.0e9,1e-9\n*EOS_GRUNEISEN\n1,1.48e6,1.92,,,0.1\n\n"
                 "*PART\nwater\n1,1,1,1\n" +
                 plate;
    deck.sheet(2, {-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, 5, 5);
    std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
    for (int i = 0; i < 27; ++i) {
        const int id = ++deck.nodes;
        nodes += fmt::format("{},{},{},{}\n", id, 2 * (i % 3) - 2, 2 * (i / 3 % 3) - 2, 3 + 2 * (i / 9));
        elements += fmt::format("{},1,8.0e-9\n", id);
    }
    deck.text += nodes + elements + contact +
                 "*SET_NODE_LIST_GENERATE\n1\n37,63\n*INITIAL_VELOCITY\n1\n0.0,0.0,-1.0e4\n";
    return deck.text;
}

constexpr const char* shell_plate =
    "*SECTION_SHELL\n2,2,0.833,3\n1.0,1.0,1.0,1.0\n*MAT_ELASTIC\n2,7.85e-9,2.1e5,0.3\n"
    "*PART\nplate\n2,2,2\n";
constexpr const char* rigid_plate =
    "*SECTION_SHELL\n2,2,0.833,3\n1.0,1.0,1.0,1.0\n*MAT_RIGID\n2,7.85e-9,2.1e5,0.3\n\n\n"
    "*PART\nplate\n2,2,2\n";

struct Rain {
    const char* name;
    const char* control;
    const char* contact;
    const char* plate;
    double gap; ///< half of the shell, and half of what the particle brings [mm]
};

} // namespace

class ContactParticles : public ::testing::TestWithParam<Rain> {};

/// Particles named by a node set or by their part bounce from a deformable or rigid plate, at the distance
/// that SST, or ITHK with the particle's volume of 8 mm^3, says, and momentum is kept.
TEST_P(ContactParticles, BounceAtTheirThickness)
{
    const Rain& rain_case = GetParam();
    DeckRun run(rain(rain_case.control, rain_case.contact, rain_case.plate));
    ASSERT_TRUE(run.scene);
    const auto* contact = run.find<SurfaceContact>();
    ASSERT_NE(contact, nullptr);
    double first_height = 0, lowest = 1e9, pushed = 0;
    const Index first = run.node(37);
    run.watch([&](const Clock& clock, const State& state) {
        for (Index node = first; node < first + 27; ++node) lowest = std::min(lowest, state.position[node].z);
        ElementResults results;
        contact->collect(state, results);
        pushed += results.contacts.at(0).slave_force.z * clock.velocity_step();
        if (contact->touches().size() > 0 && first_height == 0) first_height = state.position[first].z;
    });
    run.go();
    // One step moves a particle by less than 0.02.
    EXPECT_NEAR(first_height, rain_case.gap, 0.03);
    EXPECT_GT(lowest, 0) << "none has passed the middle of the plate";
    double momentum = 0;
    for (Index node = first; node < first + 27; ++node) momentum += 8e-9 * run.scene->state.velocity[node].z;
    EXPECT_GT(momentum, -0.5 * 27 * 8e-9 * 1e4) << "most of them turn back";
    EXPECT_NEAR(momentum + 27 * 8e-9 * 1e4, pushed, 1e-3 * 27 * 8e-9 * 1e4) << "all of it is the contact's";
    EXPECT_LT(run.scene->ledger.balance_error(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    Plates, ContactParticles,
    ::testing::Values(
        Rain{"by_set_without_thickness", "",
             "*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID\n1,rain\n1,2,4,3\n\n\n1\n", shell_plate, 0.5},
        Rain{"by_part_with_ithk", "*CONTROL_SPH\n1\n\n1\n",
             "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n\n\n1\n", shell_plate, 1.5},
        Rain{"by_set_with_sst", "*CONTROL_SPH\n1\n\n1\n",
             "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,4,3\n\n0.0,0.0,0.8\n1\n", shell_plate, 0.9},
        Rain{"soft_0", "", "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n\n\n", shell_plate, 0.5},
        Rain{"soft_2", "", "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n\n\n2\n", shell_plate, 0.5},
        Rain{"on_a_rigid_plate", "", "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,4,3\n\n\n1\n", rigid_plate,
             0.5},
        Rain{"eroding", "", "*CONTACT_ERODING_NODES_TO_SURFACE\n1,2,4,3\n\n\n0,1\n1\n", shell_plate, 0.5}),
    [](const auto& info) { return std::string(info.param.name); });

/// A plate comes up to where particles have left the run (BOXID, below z = 2) and goes through their nodes.
TEST(ParticlesInContact, ThoseThatHaveLeftTouchNothing)
{
    std::string deck = rain("*CONTROL_SPH\n1,5\n*DEFINE_BOX\n5,-50,50,-50,50,2,50\n",
                            "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n\n\n", shell_plate);
    deck += "*SET_NODE_LIST_GENERATE\n2\n1,36\n*INITIAL_VELOCITY\n2\n0,0,5.0e3\n";
    DeckRun run(deck);
    ASSERT_TRUE(run.scene);
    run.go();
    const State& state = run.scene->state;
    EXPECT_EQ(run.find<ParticleBody>()->departed().at(0).count, 18);
    const double plate = state.position[run.node(15)].z, dead = state.position[run.node(37)].z;
    EXPECT_GT(plate + 0.5, dead) << "the surface has come to them";
    for (int id = 1; id <= 36; ++id) EXPECT_EQ(state.velocity[run.node(id)].z, 5.0e3);
    EXPECT_EQ(run.scene->ledger.sliding, 0);
}

TEST(ParticlesInContact, HaveNoSegments)
{
    const Model model = testing::model_of_text(
        "*KEYWORD\n*CONTROL_TERMINATION\n1\n*PART\nplate\n1,1,1\n*PART\nbird\n2,2,2\n*SECTION_SHELL\n1,2\n"
        ".1,.1,.1,.1\n*SECTION_SPH\n2\n*MAT_ELASTIC\n1,1,1,0.3\n*MAT_ELASTIC\n2,1,1,0.3\n"
        "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0\n0\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n"
        "5,0,0,1\n6,1,0,1\n*ELEMENT_SHELL\n1,1,1,2,3,4\n*ELEMENT_SPH\n5,2,1\n6,2,1\n*END\n");
    try {
        make_scene(model);
        FAIL() << "a contact without segments was taken";
    } catch (const DeckError& error) {
        EXPECT_NE(std::string(error.what()).find("particles have none"), std::string::npos) << error.what();
    }
}

} // namespace plash

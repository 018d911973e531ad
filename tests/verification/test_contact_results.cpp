#include "output/contact_files.h"
#include "tests/support/deck_run.h"

#include <map>

namespace plash {

namespace {

using testing::DeckRun;

/// A long block (part 1, held below), on which two cubes of different speed fall (parts 2, 3): contacts 11
/// and 12. Transducer 21 listens to all that the block feels, 22 to what stands between it and the first
/// cube.
std::string two_cubes_on_a_block(int soft)
{
    testing::DeckText deck;
    deck.block(1, {0, 0, 0}, {4, 2, 1}, 1, 1, 1);
    deck.block(2, {0.3, 0.4, 1.002}, {1.3, 1.4, 2.002}, 1, 1, 1);
    deck.block(3, {2.4, 0.4, 1.002}, {3.4, 1.4, 2.002}, 1, 1, 1);
    deck.text += R"(*CONTROL_TERMINATION
0.09
*PART
block
1,1,1
*PART
slow cube
2,1,1
*PART
fast cube
3,1,1
*SECTION_SOLID
1,1
*MAT_ELASTIC
1,1.0,100.0,0.3
*SET_NODE_LIST
1
1,2,3,4
*BOUNDARY_SPC_SET
1,0,1,1,1
*INITIAL_VELOCITY_GENERATION
2,2,0,0.1,0.0,-0.2
*INITIAL_VELOCITY_GENERATION
3,2,0,0.0,0.1,-0.5
)";
    for (const int part : {2, 3}) {
        deck.text +=
            fmt::format("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n{},cube\n{},1,3,3\n0.2,0.2\n,\n{}\n",
                        9 + part, part, soft);
    }
    return deck.text + "*CONTACT_FORCE_TRANSDUCER_PENALTY_ID\n21,all\n1,0,3,0\n,\n,\n"
                       "*CONTACT_FORCE_TRANSDUCER_PENALTY_ID\n22,between\n1,2,3,3\n,\n,\n*END\n";
}

} // namespace

class ContactResults : public ::testing::TestWithParam<int> {};

/// Transducers, forces by contact and forces by node are sums of the same forces: to round-off.
TEST_P(ContactResults, TransducersAndNodesShowTheForcesOfContacts)
{
    DeckRun run(two_cubes_on_a_block(GetParam()));
    run.go();
    ElementResults results;
    results.contact_force.resize(run.scene->model.nodes.size());
    for (const auto& term : run.scene->terms) term->collect(run.scene->state, results);
    std::map<Id, Vec3> force;
    for (const auto& contact : results.contacts) force[contact.contact] = contact.slave_force;
    ASSERT_EQ(force.size(), 4u);
    ASSERT_GT(force[11].z, 0.01) << "the cube must be pushed up";
    ASSERT_GT(force[12].z, 0.01);
    ASSERT_GT(norm(Vec3{force[11].x, force[11].y, 0}), 1e-4) << "friction";
    const double round_off = 1e-12 * norm(force[12]);
    EXPECT_LT(norm(force[21] + force[11] + force[12]), round_off);
    EXPECT_LT(norm(force[22] + force[11]), round_off);
    Vec3 on_block{}, on_first{};
    for (Id id = 1; id <= 8; ++id) on_block += results.contact_force[run.node(id)];
    for (Id id = 9; id <= 16; ++id) on_first += results.contact_force[run.node(id)];
    EXPECT_LT(norm(on_block - force[21]), round_off);
    EXPECT_LT(norm(on_first - force[11]), round_off);
    EXPECT_LT(run.scene->ledger.balance_error(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Soft, ContactResults, ::testing::Values(0, 1, 2));

/// The columns of ncforc: node, force, place.
TEST(ContactFiles, NcforcListsPushedNodes)
{
    const NodeContactForce pushed[] = {{17, {1.5, -2.5e-3, 0}, {10, 20, -30}}};
    EXPECT_EQ(format_ncforc(0.25, pushed),
              "\n\n forces (t= 2.50000E-01 ) on the nodes in contact\n\n"
              "      node        x-force     y-force     z-force           x           y           z\n"
              "        17     1.5000E+00 -2.5000E-03  0.0000E+00  1.0000E+01  2.0000E+01 -3.0000E+01\n");
}

} // namespace plash

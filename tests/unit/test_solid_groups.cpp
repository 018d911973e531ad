#include "core/run_error.h"
#include "tests/support/bare_state.h"
#include "tests/support/solid_block.h"

#include <gtest/gtest.h>

namespace plash {

using testing::record_of;
using testing::solid_results;
using testing::SolidBlock;

namespace {

Record steel(double density = 7850)
{
    return record_of("MAT_ELASTIC", 1, {{"RO", density}, {"E", 210e9}, {"PR", 0.3}});
}

std::string refusal(const Model& model)
{
    State state = bare_state(model);
    try {
        make_solid_groups(model, state);
    } catch (const DeckError& error) {
        return error.what();
    }
    return "";
}

/// The tetrahedron (0 0 0), (1 0 0), (0 1 0), (0 0 1) as an element whose corners repeat nodes so.
SolidBlock tetrahedron(std::array<Index, 8> nodes)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, steel());
    block.model.nodes = {};
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        block.model.nodes.id.push_back(static_cast<Id>(block.model.nodes.id.size()) + 1);
        block.model.nodes.position.push_back(p);
    }
    block.model.solids.nodes[0] = nodes;
    return block;
}

} // namespace

TEST(SolidGroups, LumpMassToTheCorners)
{
    SolidBlock block({2, 1, 1}, {2, 1, 1}, steel());
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_NEAR(groups[0]->mass(), 15700, 1e-9);
    EXPECT_NEAR(state.mass[block.node(0, 0, 0)], 7850.0 / 8, 1e-10);
    EXPECT_NEAR(state.mass[block.node(1, 1, 0)], 7850.0 / 4, 1e-10);
    const SolidMasses masses = solid_masses(block.model, 0);
    EXPECT_NEAR(masses.total, 15700, 1e-9);
    for (std::size_t i = 0; i < masses.nodes.size(); ++i) {
        EXPECT_NEAR(masses.mass[i], state.mass[masses.nodes[i]], 1e-10);
    }
}

TEST(SolidGroups, TetrahedraHaveTheirOwnVolumeStepAndGradientHoweverTheyAreWritten)
{
    for (const std::array<Index, 8>& nodes :
         {std::array<Index, 8>{0, 1, 2, 3, 3, 3, 3, 3}, std::array<Index, 8>{0, 1, 2, 2, 3, 3, 3, 3}}) {
        SolidBlock block = tetrahedron(nodes);
        block.model.controls.time.step_scale = 0.5; // loose elements then need no shorter step
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        EXPECT_NEAR(groups[0]->mass(), 7850.0 / 6, 1e-9);
        for (double mass : state.mass) EXPECT_NEAR(mass, 7850.0 / 24, 1e-9);

        // Stable step: smallest altitude 1 / sqrt(3) over the wave speed, with the linear viscosity of 0.06
        // at rest too since no other solid shares its nodes.
        Clock clock;
        groups[0]->add_forces(clock, state);
        const double wave = std::sqrt(210e9 * 0.7 / (1.3 * 0.4) / 7850);
        EXPECT_NEAR(groups[0]->stable_step().step,
                    1 / std::sqrt(3.0) / wave / (0.06 + std::sqrt(1 + 0.06 * 0.06)), 1e-12 / wave);

        // A stretch along z: nodal forces are those of the linear tetrahedron, stress x area / 3.
        const double e = 1e-6;
        clock.last_step = 1;
        state.velocity[3] = {0, 0, e};
        state.position[3] += state.velocity[3];
        state.clear_forces();
        groups[0]->add_forces(clock, state);
        const double stress = 210e9 * 0.7 / (1.3 * 0.4) * e;
        EXPECT_NEAR(state.force[3].z, -stress / 6, 1e-5 * stress);
        EXPECT_NEAR(state.force[0].z, stress / 6, 1e-5 * stress);
        EXPECT_NEAR(state.force[1].z, 0, 1e-9 * stress);
        EXPECT_NEAR(state.force[1].x, -stress * 3 / 7 / 6, 1e-5 * stress); // nu / (1 - nu) across
    }
}

TEST(SolidGroups, WedgesKeepStressAndBalanceInALinearField)
{
    // A cube cut into two wedges, moved linearly: both have Hooke's stress, and no hourglass energy.
    SolidBlock block({1, 1, 1}, {1, 1, 1}, steel());
    const auto cube = block.model.solids.nodes[0];
    block.model.solids.nodes = {{cube[1], cube[0], cube[4], cube[5], cube[3], cube[3], cube[7], cube[7]},
                                {cube[2], cube[1], cube[5], cube[6], cube[3], cube[3], cube[7], cube[7]}};
    block.model.solids.id = {1, 2};
    block.model.solids.part = {0, 0};
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    double mass = 0;
    for (double m : state.mass) mass += m;
    EXPECT_NEAR(mass, 7850, 1e-9);
    Clock clock;
    clock.last_step = 1;
    for (std::size_t n = 0; n < state.size(); ++n) {
        state.velocity[n] = {1e-7 * state.position[n].x + 2e-7 * state.position[n].z, 0, 0};
        state.position[n] += state.velocity[n];
    }
    state.clear_forces();
    groups[0]->add_forces(clock, state);
    EnergyLedger ledger;
    ledger.open_cycle(1);
    groups[0]->report(ledger);
    EXPECT_NEAR(ledger.hourglass, 0, 1e-12 * ledger.internal);
    const double wave_modulus = 210e9 * 0.7 / (1.3 * 0.4);
    for (const auto& stress : solid_results(block.model, state, groups).solid_stress) {
        EXPECT_NEAR(stress.xx, wave_modulus * 1e-7, 1e-6 * wave_modulus * 1e-7);
        EXPECT_NEAR(stress.zx, 210e9 / 2.6 * 2e-7, 1e-6 * wave_modulus * 1e-7);
    }
}

TEST(SolidGroups, MassScalingReachesTheStepAndTellsWhatItAdded)
{
    for (bool only_small : {true, false}) {
        SolidBlock block({2, 1, 1}, {3, 1, 1}, steel());
        for (Vec3& p : block.model.nodes.position) {
            if (p.x > 1 && p.x < 2) p.x = 1; // cells of 1 and 2, both 1 high
        }
        for (Vec3& p : block.model.nodes.position) p.x *= 0.5; // lengths 0.5 and 1: steps differ by two
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        double before = 0;
        for (double m : state.mass) before += m;
        Clock clock;
        groups[0]->add_forces(clock, state);
        const double first = groups[0]->stable_step().step;
        const double target = 1.5 * first;
        const double added = groups[0]->scale_mass(target, only_small, state);
        double after = 0;
        for (double m : state.mass) after += m;
        EXPECT_NEAR(after - before, added, 1e-9 * before);
        // First cell: 3925 * (1.5^2 - 1); the other has a step of 2 and would lose 7850 * (1 - 0.75^2).
        const double gain = 3925 * 1.25, loss = 7850 * (1 - 0.5625);
        EXPECT_NEAR(added, only_small ? gain : gain - loss, 1e-6);
        groups[0]->add_forces(clock, state);
        EXPECT_NEAR(groups[0]->stable_step().step, target, 1e-12 * target);
    }
}

TEST(SolidGroups, NegativeVolumeStopsTheRunWithElementPartAndPlace)
{
    SolidBlock block({2, 1, 1}, {2, 1, 1}, steel());
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    for (Vec3& p : state.position) {
        if (p.x > 1.5) p.x = 0.9;
    }
    Clock clock;
    clock.last_step = 1e-9;
    try {
        groups[0]->add_forces(clock, state);
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_STREQ(error.what(),
                     "solid 2 of part 1 'block' near (0.95, 0.5, 0.5) has no positive volume any more");
    }
}

TEST(SolidGroups, ErodeWhatHasNoVolumeIfTheDeckAsksForIt)
{
    SolidBlock block({2, 1, 1}, {2, 1, 1}, steel());
    block.model.controls.time.erode_small_step = true;
    block.model.controls.time.smallest_step_factor = 0.01;
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    groups[0]->add_forces(clock, state);
    clock.cycle = 1;
    clock.last_step = 1e-6;
    const Vec3 push{-1.1e6, 0, 0};
    for (std::size_t n = 0; n < state.size(); ++n) {
        if (state.position[n].x < 1.5) continue;
        state.velocity[n] = push;
        state.position[n].x = 0.9;
    }
    state.clear_forces();
    groups[0]->add_forces(clock, state);
    EXPECT_EQ(state.deletions, 1);
    EXPECT_EQ(state.deleted_solids[1], 1);
    for (const Vec3& force : state.force) EXPECT_EQ(norm(force), 0);
    EXPECT_EQ(groups[0]->stable_step().element, 1);
}

TEST(SolidGroups, ErodeElementsBelowTheSmallestStep)
{
    SolidBlock block({2, 1, 1}, {2, 1, 1}, steel());
    block.model.controls.time.erode_small_step = true;
    block.model.controls.time.smallest_step_factor = 0.5;
    block.model.controls.time.step_scale = 0.5; // loose elements then need no shorter step
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    groups[0]->add_forces(clock, state);
    const double first = groups[0]->stable_step().step;
    clock.cycle = 1;
    clock.last_step = 0.5 * first;
    const auto squeeze = [&](double place) {
        for (Vec3& p : state.position) {
            if (p.x > 1.2) p.x = place;
        }
        state.clear_forces();
        groups[0]->add_forces(clock, state);
    };
    squeeze(1.6);
    EXPECT_EQ(state.deletions, 0);
    EXPECT_NEAR(groups[0]->stable_step().step, first * std::sqrt(0.6), 1e-9 * first); // 0.6 / sqrt(0.6)
    squeeze(1.2);
    EXPECT_EQ(state.deletions, 1);
    EXPECT_EQ(groups[0]->stable_step().element, 1);
    EnergyLedger ledger;
    ledger.open_cycle(1);
    groups[0]->report(ledger);
    EXPECT_EQ(ledger.eroded_internal, 0); // nothing strained it: the nodes were moved, not driven
}

TEST(SolidGroups, FailedElementsLeaveTheirEnergyBehind)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1},
                     record_of("MAT_PLASTIC_KINEMATIC", 1,
                               {{"RO", 7850}, {"E", 210e9}, {"PR", 0.3}, {"SIGY", 3e8}, {"FS", 0.05}}));
    State state = block.state();
    auto groups = make_solid_groups(block.model, state);
    Clock clock;
    clock.last_step = 1;
    double internal = 0;
    EnergyLedger ledger;
    for (int step = 0; step < 100 && state.deletions == 0; ++step) {
        for (std::size_t n = 0; n < state.size(); ++n) {
            state.velocity[n] = {0.002 * (state.position[n].z > 0.5), 0, 0};
            state.position[n] += state.velocity[n];
        }
        state.clear_forces();
        groups[0]->add_forces(clock, state);
        ledger.open_cycle(1);
        groups[0]->report(ledger);
        if (state.deletions == 0) internal = ledger.internal;
    }
    EXPECT_EQ(state.deletions, 1);
    EXPECT_EQ(ledger.internal, 0);
    // Shear strain 0.05 sqrt(3): plastic work of the yield stress, 0.05 * 3e8, and the elastic part.
    EXPECT_NEAR(ledger.eroded_internal, 0.05 * 3e8, 0.03 * 0.05 * 3e8);
    EXPECT_GT(ledger.eroded_internal, internal);
}

TEST(SolidGroups, RefuseWhatIsNotThereByName)
{
    {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, record_of("MAT_CONCRETE_DAMAGE_REL3", 5, {{"RO", 1}}));
        EXPECT_NE(refusal(block.model)
                      .find("*MAT_CONCRETE_DAMAGE_REL3 5 is not supported for the solids of part 1"),
                  std::string::npos);
    }
    {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, steel());
        block.model.sections[0] = record_of("SECTION_SOLID", 4, {{"ELFORM", 18}});
        EXPECT_NE(
            refusal(block.model).find("*SECTION_SOLID 4, field ELFORM: formulation 18 is not supported"),
            std::string::npos);
    }
    {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, steel());
        block.set_hourglass(9);
        EXPECT_NE(refusal(block.model).find("*CONTROL_HOURGLASS, field IHQ: type 9 is not supported"),
                  std::string::npos);
    }
    {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, steel());
        std::swap(block.model.solids.nodes[0][0], block.model.solids.nodes[0][4]);
        std::swap(block.model.solids.nodes[0][1], block.model.solids.nodes[0][5]);
        std::swap(block.model.solids.nodes[0][2], block.model.solids.nodes[0][6]);
        std::swap(block.model.solids.nodes[0][3], block.model.solids.nodes[0][7]);
        EXPECT_EQ(
            refusal(block.model),
            "solid 1 of part 1 'block' near (0.5, 0.5, 0.5) has the volume -1: check its node numbering "
            "(nodes 1-4 counter-clockwise as seen from nodes 5-8) and its nodes' positions");
    }
    {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, record_of("MAT_NULL", 3, {{"RO", 1000}}));
        EXPECT_EQ(refusal(block.model),
                  "*PART 1, field EOSID: the solids of *MAT_NULL 3 need an equation of state");
        block.model.equations_of_state.push_back(record_of("EOS_PROPELLANT_DEFLAGRATION", 8, {}));
        block.model.parts[0].equation_of_state = 0;
        EXPECT_NE(refusal(block.model).find("*EOS_PROPELLANT_DEFLAGRATION 8 is not supported"),
                  std::string::npos);
    }
    {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, steel());
        block.model.equations_of_state.push_back(record_of("EOS_GRUNEISEN", 8, {{"C", 1}}));
        block.model.parts[0].equation_of_state = 0;
        EXPECT_EQ(refusal(block.model), "*PART 1, field EOSID: *MAT_ELASTIC takes no equation of state, but "
                                        "8 is given; leave the field empty");
    }
}

TEST(SolidGroups, LeaveRigidPartsAlone)
{
    SolidBlock block({1, 1, 1}, {1, 1, 1}, record_of("MAT_RIGID", 1, {{"RO", 7850}}));
    State state = block.state();
    EXPECT_TRUE(make_solid_groups(block.model, state).empty());
    for (double mass : state.mass) EXPECT_EQ(mass, 0);
    EXPECT_NEAR(solid_masses(block.model, 0).total, 7850, 1e-9);
}

TEST(SolidGroups, HourglassRecordOfAPartOverridesTheControlCard)
{
    // An hourglass velocity pattern: the damping force goes with QM.
    const auto force = [](double coefficient) {
        SolidBlock block({1, 1, 1}, {1, 1, 1}, steel());
        block.set_hourglass(6, 0.3);
        block.model.hourglass.push_back(
            record_of("HOURGLASS", 1, {{"IHQ", 0}, {"QM", coefficient}, {"Q1", 1.5}, {"Q2", 0.06}}));
        block.model.parts[0].hourglass = 0;
        State state = block.state();
        auto groups = make_solid_groups(block.model, state);
        for (std::size_t n = 0; n < state.size(); ++n) {
            const Vec3& p = state.position[n];
            state.velocity[n] = {(p.y - 0.5) * (p.z - 0.5), 0, 0};
        }
        Clock clock;
        groups[0]->add_forces(clock, state);
        return norm(state.force[0]);
    };
    // a_h = QM / 4 rho V^(2/3) c; rate = 8 * 0.25; type 1 for IHQ = 0 (viscous).
    const double wave = std::sqrt(210e9 * 0.7 / (1.3 * 0.4) / 7850);
    EXPECT_NEAR(force(0.05), 0.05 / 4 * 7850 * wave * 2, 1e-9 * 7850 * wave);
    EXPECT_NEAR(force(0.1), 2 * force(0.05), 1e-9 * force(0.1));
}

} // namespace plash

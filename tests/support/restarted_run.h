#pragma once

#include "ale/hex/hex_fluid.h"
#include "tests/support/ale_deck.h"

namespace plash::testing {

/// A deck that writes restart files every third cycle (*DATABASE_BINARY_D3DUMP 3), run as a whole, and once
/// more from the first of these files on.
class RestartedRun {
public:
    explicit RestartedRun(const std::string& deck) : whole(deck), rest(deck)
    {
        const TemporaryFolder folder;
        RunOptions writing, going_on;
        writing.restart.directory = folder.path().string();
        going_on.restart_from = folder / "d3dump01";
        Recorders recorders;
        const Outcome first = plash::run(whole.scene(), recorders, writing);
        EXPECT_EQ(first.termination, Outcome::Termination::normal) << first.message;
        const Outcome second = plash::run(rest.scene(), recorders, going_on);
        EXPECT_EQ(second.termination, Outcome::Termination::normal) << second.message;
        EXPECT_GT(second.clock.cycle, 5); // from 3 on
    }

    EulerianRun whole, rest;

    /// Fluids on hexahedra have the same bits.
    void expect_same_fluid()
    {
        const HexFluid &one = whole.term<EulerianFluid>().hexahedra(),
                       &two = rest.term<EulerianFluid>().hexahedra();
        EXPECT_EQ(one.fields.velocity[0], two.fields.velocity[0]);
        EXPECT_EQ(one.fields.groups[0].mass, two.fields.groups[0].mass);
        for (std::size_t node = 0; node < one.node_count(); ++node)
            ASSERT_EQ(norm(one.mesh.position[node] - two.mesh.position[node]), 0);
    }
};

} // namespace plash::testing

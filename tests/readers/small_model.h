#pragma once

#include "tests/support/snapshot_fixture.h"

namespace plash::testing {

/// Two hexahedra, a tetrahedron, two quadrilaterals and a triangle in three parts; numbers out of order. With
/// beams: two more elements in a fourth part, one with a node that turns its section.
inline SnapshotFixture small_model(bool with_beams = false)
{
    SnapshotFixture fixture;
    Model& model = fixture.model;
    model.title = "small model";
    for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) model.nodes.position.push_back({1.0 * i, 1.0 * j, 1.0 * k});
        }
    }
    for (std::size_t i = 0; i < model.nodes.position.size(); ++i) model.nodes.id.push_back(1000 - 7 * i);
    const auto part = [&](Id id, const char* title) {
        Part part;
        part.id = id;
        part.title = title;
        model.parts.push_back(part);
    };
    part(30, "blocks");
    part(20, "sheets");
    part(10, "tetrahedron");
    model.solids.id = {502, 501, 77};
    model.solids.part = {0, 0, 2};
    model.solids.nodes = {{0, 1, 3, 2, 4, 5, 7, 6}, {4, 5, 7, 6, 8, 9, 11, 10}, {0, 1, 2, 4, 4, 4, 4, 4}};
    model.shells.id = {9, 8, 7};
    model.shells.part = {1, 1, 1};
    model.shells.nodes = {{0, 1, 5, 4}, {4, 5, 9, 8}, {2, 3, 7, 7}};
    if (with_beams) {
        part(15, "rods");
        model.beams.id = {61, 60};
        model.beams.part = {3, 3};
        model.beams.nodes = {{0, 8, 3}, {1, 9, none}};
    }
    fixture.start();
    return fixture;
}

} // namespace plash::testing

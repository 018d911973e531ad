#pragma once

#include "tests/support/snapshot_fixture.h"

namespace plash::testing {

/// Two hexahedra, a tetrahedron, two quadrilaterals and a triangle in three parts; numbers out of order.
inline SnapshotFixture small_model()
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
    fixture.start();
    return fixture;
}

} // namespace plash::testing

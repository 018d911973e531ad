#pragma once

#include "tests/support/deck_text.h"

namespace plash::testing {

inline constexpr double steel_density = 7.85e-6; // of steel, in kg, mm, ms and kN

/// Steel for solids (material 1), the same for solids that go at a time (material 2) and for particles
/// (material 3), and the sections of both.
inline std::string adaptive_steel(double loss_time)
{
    std::string text = "*SECTION_SOLID\n1,1\n*SECTION_SPH\n2\n*CONTROL_ENERGY\n2,2,1,2\n";
    for (int material = 1; material <= 3; ++material)
        text += fmt::format("*MAT_PLASTIC_KINEMATIC\n{},{},200,0.3,0.3,1,1\n\n", material, steel_density);
    return text + fmt::format("*MAT_ADD_EROSION\n2,-1e9\n,,,,,,,{}\n", loss_time);
}

/// A bar of 12 x 3 x 3 mm whose middle becomes particles at a time (without `coupling` just goes), while the
/// end at large x flies off; the velocity rises over four solids. `more` are further keywords.
inline std::string pulled_bar(const std::string& coupling, double loss_time, double end_time,
                              const std::string& more = "")
{
    DeckText deck;
    deck.text += adaptive_steel(loss_time) + more +
                 fmt::format("*CONTROL_TERMINATION\n{}\n*CONTROL_SPH\n,,,,,12\n", end_time);
    deck.text += "*PART\nheld\n1,1,1\n*PART\nslab\n2,1,2\n*PART\nparticles\n3,2,3\n";
    if (!coupling.empty())
        deck.text += "*SET_PART\n4\n1,2\n*DEFINE_ADAPTIVE_SOLID_TO_SPH\n4,1,1,3,2," + coupling + "\n";
    // One mesh: the slab are its middle columns.
    const int first = deck.block(1, {0, 0, 0}, {12, 3, 3}, 12, 3, 3);
    const auto elements = deck.text.find("*ELEMENT_SOLID");
    for (int row = 0; row < 9; ++row)
        for (int i = 5; i < 7; ++i) {
            const std::string before = fmt::format("\n{},1,", row * 12 + i + 1);
            deck.text.replace(deck.text.find(before, elements), before.size(),
                              fmt::format("\n{},2,", row * 12 + i + 1));
        }
    deck.text += "*INITIAL_VELOCITY_NODE\n";
    for (int node = 0; node < 13 * 16; ++node)
        deck.text += fmt::format("{},{}\n", first + node, 0.1 * std::clamp(0.25 * (node % 13 - 4), 0.0, 1.0));
    return deck.text + "*END\n";
}

} // namespace plash::testing

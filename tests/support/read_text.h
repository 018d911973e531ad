#pragma once

#include "parser/read_model.h"
#include "solver/scene.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace plash::testing {

/// The Model of a deck given as text.
inline Model model_of_text(const std::string& deck)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "deck.k") << deck;
    ReadResult result = read_model(folder / "deck.k");
    EXPECT_TRUE(result.ok);
    return std::move(result.model);
}

/// The message of the DeckError with which a scene of the deck is refused.
inline std::string complaint_about(const std::string& deck)
{
    const Model model = model_of_text(deck);
    try {
        make_scene(model);
    } catch (const DeckError& error) {
        return error.what();
    }
    return "no complaint";
}

} // namespace plash::testing

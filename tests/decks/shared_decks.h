#pragma once

#include "tests/paths.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace plash {

/// Folder of decks that other people wrote; they are not part of this project. Empty when there is none.
inline std::string shared_decks()
{
    const char* chosen = std::getenv("PLASH_SHARED");
    const std::filesystem::path folder =
        (chosen ? std::filesystem::path(chosen) : std::filesystem::path(PLASH_SOURCE_DIR) / ".." / "shared") /
        "decks";
    return std::filesystem::exists(folder) ? folder.string() : std::string();
}

} // namespace plash

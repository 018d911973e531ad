#pragma once

#include "tests/paths.h"
#include "tests/support/text_of.h"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

/// Files that tests read but that are not part of the tree: real decks with LS-DYNA's own results.
namespace plash::testing {

/// `name` below the folder `shared` beside the tree, or below PLASH_SHARED.
inline std::filesystem::path shared_file(const std::string& name)
{
    const char* folder = std::getenv("PLASH_SHARED");
    return std::filesystem::path(folder ? folder : PLASH_SOURCE_DIR "/../shared") / name;
}

} // namespace plash::testing

/// Leaves the test with a message when the file is not there.
#define PLASH_NEED_SHARED(path)                                                                              \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "not on this machine: " << (path).string()

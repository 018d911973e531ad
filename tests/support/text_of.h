#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace plash::testing {

/// The bytes of a file without carriage returns.
inline std::string text_of(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    std::string text = bytes.str();
    std::erase(text, '\r');
    return text;
}

} // namespace plash::testing

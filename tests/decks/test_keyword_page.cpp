#include "tests/paths.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace plash {

TEST(KeywordPage, IsUpToDate)
{
    std::FILE* program = ::popen(PLASH_PROGRAM " keywords --markdown", "r");
    ASSERT_NE(program, nullptr);
    std::string printed;
    std::array<char, 1 << 16> buffer;
    for (std::size_t count; (count = std::fread(buffer.data(), 1, buffer.size(), program)) > 0;)
        printed.append(buffer.data(), count);
    ASSERT_EQ(::pclose(program), 0);
    std::ifstream file(PLASH_SOURCE_DIR "/docs/keywords.md");
    std::stringstream page;
    page << file.rdbuf();
    EXPECT_TRUE(page.str() == printed) << "write it anew: ./plash keywords --markdown > docs/keywords.md";
}

} // namespace plash

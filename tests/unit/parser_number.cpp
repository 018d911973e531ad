#include "parser/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plash {
namespace {

double real(std::string_view text)
{
    double value = std::numeric_limits<double>::quiet_NaN();
    return parse_real(text, value) ? value : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

// Rule 10 of the format: numbers as people write them. Decimal literals round to the nearest double, so the
// values must be equal to the last bit.
TEST(Number, ReadsEveryWayOfWritingReals)
{
    EXPECT_EQ(real("1"), 1);
    EXPECT_EQ(real("1.0"), 1);
    EXPECT_EQ(real("1."), 1);
    EXPECT_EQ(real(".5"), .5);
    EXPECT_EQ(real("-.5"), -.5);
    EXPECT_EQ(real("+2"), 2);
    EXPECT_EQ(real("1e3"), 1e3);
    EXPECT_EQ(real("1.E+03"), 1e3);
    EXPECT_EQ(real("1d3"), 1e3);
    EXPECT_EQ(real("1.0D-3"), 1e-3);
    EXPECT_EQ(real("1.0+5"), 1e5);
    EXPECT_EQ(real("8.90000-3"), 8.9e-3);
    EXPECT_EQ(real("  7.8E-6 "), 7.8e-6);
}

TEST(Number, RoundsToTheNearestDouble)
{
    EXPECT_EQ(real("0.1"), 0.1);
    EXPECT_EQ(real("123456789012345678901234567890"), 123456789012345678901234567890.0);
    EXPECT_EQ(real("2.2250738585072014e-308"), 2.2250738585072014e-308);
    EXPECT_EQ(real("3.14159265358979323846264338327950288"), 3.14159265358979323846);
    EXPECT_EQ(real("1e400"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(real("1e-400"), 0);
}

TEST(Number, RefusesWhatIsNoNumber)
{
    for (const char* text :
         {"", "  ", "abc", "1.0.0", "1e", "1e+", "-", ".", "1 2", "0x10", "nan", "inf", "1.0x"})
        EXPECT_TRUE(std::isnan(real(text))) << text;
}

TEST(Number, ReadsWholeNumbersAlsoWrittenAsReals)
{
    std::int64_t value = 0;
    EXPECT_TRUE(parse_whole(" 12 ", value));
    EXPECT_EQ(value, 12);
    EXPECT_TRUE(parse_whole("3.", value));
    EXPECT_EQ(value, 3);
    EXPECT_TRUE(parse_whole("1e3", value));
    EXPECT_EQ(value, 1000);
    EXPECT_TRUE(parse_whole("-4", value));
    EXPECT_EQ(value, -4);
    EXPECT_FALSE(parse_whole("3.5", value));
    EXPECT_FALSE(parse_whole("", value));
    EXPECT_FALSE(parse_whole("1 2", value));
}

TEST(Number, EightColumnsAtOnceReadAsOneByOne)
{
    // Every mixture of blanks, digits, signs and what stands beside them in the character table.
    const std::string characters = " 0189-+./:*\t!";
    std::uint32_t random = 1;
    for (int i = 0; i < 200'000; ++i) {
        std::string text(8, ' ');
        for (char& character : text) {
            random = random * 1664525u + 1013904223u;
            const std::uint32_t choice = random >> 16;
            // Mostly blanks and digits: arbitrary text is hardly ever a number.
            character = choice % 16 < 6    ? ' '
                        : choice % 16 < 15 ? static_cast<char>('0' + choice / 16 % 10)
                                           : characters[choice / 16 % characters.size()];
        }
        std::int64_t eight = -1, wanted = -1;
        if (!parse_eight_digits(text.data(), eight)) {
            const auto first = text.find_first_not_of(' ');
            EXPECT_FALSE(first == std::string::npos ||
                         text.find_first_not_of("0123456789", first) == std::string::npos)
                << "'" << text << "'";
            continue;
        }
        ASSERT_TRUE(parse_digits(text.data(), text.data() + 8, wanted)) << "'" << text << "'";
        EXPECT_EQ(eight, wanted) << "'" << text << "'";
    }
}

} // namespace plash

#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace plash {

/// Whole numbers of a deck stay below: every one is exact as a double, and sums with offsets fit 64 bits.
inline constexpr double largest_whole = 9e15;

/// Text without blanks (and tabs) at both ends.
std::string_view trimmed(std::string_view text);

/// Reads one number as people write it in decks: `1`, `-.5`, `1.`, `1e3`, `1.E+03`, `1d3`, `1.0+5`, `8.9-3`.
/// Blanks around it are allowed; false when `token` is empty or anything else.
bool parse_real(std::string_view token, double& value);

/// Reads a whole number, also when written as a real (`3.`, `1e3`); false when it is none.
bool parse_whole(std::string_view token, std::int64_t& value);

/// A fixed column of digits, the fast path of element lines: false for anything but blanks, one sign and
/// digits. An empty column reads as zero.
inline bool parse_digits(const char* begin, const char* end, std::int64_t& value)
{
    while (begin < end && *begin == ' ') ++begin;
    bool negative = false;
    if (begin < end && (*begin == '-' || *begin == '+')) negative = *begin++ == '-';
    std::int64_t number = 0;
    while (begin < end && static_cast<unsigned>(*begin - '0') < 10 && number < 1'000'000'000'000'000)
        number = 10 * number + (*begin++ - '0');
    while (begin < end && *begin == ' ') ++begin;
    value = negative ? -number : number;
    return begin == end;
}

/// Eight columns at once, blanks in front and digits behind, the usual form of element lines; false for
/// anything else. All blank reads as zero.
inline bool parse_eight_digits(const char* begin, std::int64_t& value)
{
    static_assert(std::endian::native == std::endian::little, "the first column is the lowest byte");
    constexpr std::uint64_t ones = 0x0101010101010101u;
    std::uint64_t text;
    std::memcpy(&text, begin, 8);
    // 0x80 in each byte that is a blank.
    const std::uint64_t other = text ^ 0x20 * ones;
    const std::uint64_t blank = ~(((other & 0x7f * ones) + 0x7f * ones) | other) & 0x80 * ones;
    // One bit makes a blank a zero digit and leaves digits alone; nothing else may change by it.
    const std::uint64_t digits = text | 0x10 * ones;
    if ((digits ^ text) != blank >> 3) return false;
    if ((digits & 0xf0 * ones) != 0x30 * ones || ((digits + 0x06 * ones) & 0xf0 * ones) != 0x30 * ones)
        return false;
    if (blank & (~blank & 0x80 * ones) << 8) return false; // a blank behind a digit
    // Two, four, eight digits to a number.
    std::uint64_t number = digits - 0x30 * ones;
    number = 10 * number + (number >> 8);
    constexpr std::uint64_t pairs = 0x000000ff000000ffu;
    number = ((number & pairs) * 0x000f424000000064u + ((number >> 16) & pairs) * 0x0000271000000001u) >> 32;
    value = static_cast<std::int64_t>(number);
    return true;
}

/// Whatever the locale.
inline bool is_digit(char character)
{
    return character >= '0' && character <= '9';
}

} // namespace plash

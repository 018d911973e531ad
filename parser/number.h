#pragma once

#include <cstdint>
#include <string_view>

namespace plash {

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

} // namespace plash

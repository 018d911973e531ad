#include "parser/number.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace plash {
namespace {

constexpr double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Exact for any number of digits; only reached by long mantissas and large exponents.
double slow_value(const char* begin, const char* mantissa_end, int exponent)
{
    const std::string text = std::string(begin, mantissa_end) + "e" + std::to_string(exponent);
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec == std::errc::result_out_of_range)
        value = exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
    return value;
}

} // namespace

std::string_view trimmed(std::string_view text)
{
    const auto blank = [](char character) {
        return character == ' ' || character == '\t' || character == '\r';
    };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

bool parse_real(std::string_view token, double& value)
{
    const char* at = token.data();
    const char* end = at + token.size();
    while (at < end && (*at == ' ' || *at == '\t')) ++at;
    while (end > at && (end[-1] == ' ' || end[-1] == '\t')) --end;
    if (at == end) return false;

    bool negative = false;
    if (*at == '-' || *at == '+') negative = *at++ == '-';
    const char* const digits = at;
    std::uint64_t mantissa = 0;
    int scale = 0;
    for (; at < end && is_digit(*at); ++at) mantissa = 10 * mantissa + (*at - '0');
    int count = static_cast<int>(at - digits);
    if (at < end && *at == '.') {
        const char* const point = at++;
        for (; at < end && is_digit(*at); ++at) mantissa = 10 * mantissa + (*at - '0');
        scale = -static_cast<int>(at - point - 1);
        count -= scale;
    }
    if (count == 0) return false;
    const char* const mantissa_end = at;

    int exponent = 0;
    if (at < end) {
        if (*at == 'e' || *at == 'E' || *at == 'd' || *at == 'D')
            ++at;
        else if (*at != '-' && *at != '+')
            return false;
        bool negative_exponent = false;
        if (at < end && (*at == '-' || *at == '+')) negative_exponent = *at++ == '-';
        if (at == end) return false;
        for (; at < end && is_digit(*at); ++at)
            if (exponent < 100000) exponent = 10 * exponent + (*at - '0');
        if (at != end) return false;
        if (negative_exponent) exponent = -exponent;
    }

    // Both factors are exact in double, so that one rounding gives the nearest number (Clinger 1990).
    const int power = exponent + scale;
    double magnitude;
    if (count <= 19 && mantissa <= (std::uint64_t{1} << 53) && power >= -22 && power <= 22)
        magnitude = power < 0 ? static_cast<double>(mantissa) / power_of_ten[-power]
                              : static_cast<double>(mantissa) * power_of_ten[power];
    else
        magnitude = slow_value(digits, mantissa_end, exponent);
    value = negative ? -magnitude : magnitude;
    return true;
}

bool parse_whole(std::string_view token, std::int64_t& value)
{
    const std::string_view text = trimmed(token);
    if (text.empty()) return false;
    if (text.size() < 18 && parse_digits(text.data(), text.data() + text.size(), value))
        return is_digit(text.back());
    double real = 0;
    if (!parse_real(text, real) || real != std::floor(real) || std::abs(real) > largest_whole) return false;
    value = static_cast<std::int64_t>(real);
    return true;
}

} // namespace plash

#include "parser/report.h"

#include <fmt/format.h>

namespace plash {
namespace {

/// Messages of one kind that are listed in full; more would bury the others.
constexpr long listed_of_a_kind = 10;

/// Longest text of a message: what a deck holds in one field may be a megabyte.
constexpr std::size_t longest_text = 400;

/// Control characters of the deck as `\\xNN`, and no more than a person will read.
std::string printable(std::string text)
{
    std::size_t length = text.size();
    if (length > longest_text) {
        length = longest_text;
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80)
            --length; // inside UTF-8
    }
    std::string result;
    for (const char character : std::string_view(text).substr(0, length)) {
        const auto code = static_cast<unsigned char>(character);
        if (code < 0x20 || code == 0x7f)
            result += fmt::format("\\x{:02x}", code);
        else
            result += character;
    }
    return length < text.size() ? result + "..." : result;
}

} // namespace

std::string_view to_string(KeywordStatus status)
{
    switch (status) {
    case KeywordStatus::run:
        return "run";
    case KeywordStatus::read:
        return "read";
    case KeywordStatus::ignored:
        return "ignored";
    case KeywordStatus::unsupported:
        return "unsupported";
    case KeywordStatus::unknown:
        break;
    }
    return "unknown";
}

void Report::add(std::vector<Message>& list, std::map<std::string, Count>& counts, Message message)
{
    Count& count = counts[message.keyword + '/' + message.field];
    ++count.number;
    count.last = message.where;
    if (count.number > listed_of_a_kind) return;
    message.keyword = printable(std::move(message.keyword));
    message.text = printable(std::move(message.text));
    list.push_back(std::move(message));
}

void Report::error(Location where, std::string_view keyword, std::string_view field, std::string text)
{
    add(errors, error_counts_, {where, std::string(keyword), std::string(field), std::move(text)});
}

void Report::warning(Location where, std::string_view keyword, std::string_view field, std::string text)
{
    add(warnings, warning_counts_, {where, std::string(keyword), std::string(field), std::move(text)});
}

void Report::close()
{
    const auto summarise = [](std::vector<Message>& list, std::map<std::string, Count>& counts) {
        for (const auto& [kind, count] : counts) {
            if (count.number <= listed_of_a_kind) continue;
            const auto slash = kind.find('/');
            list.push_back({count.last, kind.substr(0, slash), kind.substr(slash + 1),
                            fmt::format("... and {} more of this kind, the last one here",
                                        count.number - listed_of_a_kind)});
        }
        counts.clear();
    };
    summarise(errors, error_counts_);
    summarise(warnings, warning_counts_);
}

} // namespace plash

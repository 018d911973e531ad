#include "parser/card.h"

#include "parser/number.h"

#include <algorithm>

namespace plash {
namespace {

bool all_text(const std::vector<FieldLayout>& fields)
{
    return std::all_of(fields.begin(), fields.end(),
                       [](const FieldLayout& field) { return field.type == FieldType::text; });
}

/// A number followed by a heading: the heading may hold commas of its own.
bool ends_in_heading(const std::vector<FieldLayout>& fields)
{
    return fields.size() > 1 && fields.back().type == FieldType::text && fields.back().width >= 40;
}

/// Commas inside parentheses or `< >` belong to an expression. Returns what stands behind the last field.
std::string_view cut_at_commas(std::string_view line, std::size_t count, bool heading,
                               std::vector<std::string_view>& tokens)
{
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < line.size() && tokens.size() + 1 < count + (heading ? 0 : 1); ++i) {
        const char character = line[i];
        if (character == '(' || character == '<') ++depth;
        if ((character == ')' || character == '>') && depth > 0) --depth;
        if (character != ',' || depth > 0) continue;
        tokens.push_back(line.substr(begin, i - begin));
        begin = i + 1;
    }
    if (tokens.size() == count) return line.substr(begin);
    tokens.push_back(line.substr(begin));
    return {};
}

/// `shift`: columns by which the whole line stands too far to the right.
void cut_at_columns(std::string_view line, const std::vector<FieldLayout>& fields, int minimum_width,
                    std::vector<std::string_view>& tokens, std::size_t shift = 0)
{
    std::size_t begin = 0;
    for (const FieldLayout& field : fields) {
        if (begin >= line.size()) return;
        const std::size_t width = field_width(field, minimum_width) + (begin == 0 ? shift : 0);
        tokens.push_back(line.substr(begin, width));
        begin += width;
    }
}

bool all_numbers(const std::vector<std::string_view>& tokens)
{
    double value = 0;
    return std::all_of(tokens.begin(), tokens.end(), [&](std::string_view token) {
        return parse_real(token, value) || trimmed(token).empty() || token.find_first_of("&<") != token.npos;
    });
}

void cut_at_blanks(std::string_view line, std::size_t count, std::vector<std::string_view>& tokens)
{
    while (tokens.size() < count) {
        const auto begin = line.find_first_not_of(' ');
        if (begin == std::string_view::npos) return;
        line.remove_prefix(begin);
        const auto end = std::min(line.find(' '), line.size());
        tokens.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

/// Numbers that do not stand in their columns: by blanks, or all columns moved to the right by hand. A line
/// that makes no sense either way stays cut by columns.
Cut cut_astray(std::string_view line, const std::vector<FieldLayout>& fields, int minimum_width,
               std::vector<std::string_view>& tokens)
{
    const std::vector<std::string_view> by_columns = tokens;
    tokens.clear();
    cut_at_blanks(line, fields.size(), tokens);
    if (all_numbers(tokens)) return Cut::by_blanks;
    for (std::size_t shift = 1; shift < 5; ++shift) {
        tokens.clear();
        cut_at_columns(line, fields, minimum_width, tokens, shift);
        if (all_numbers(tokens)) return Cut::shifted;
    }
    tokens = by_columns;
    return Cut::fixed;
}

} // namespace

std::string_view to_warning(Cut cut)
{
    if (cut == Cut::by_blanks)
        return "the numbers do not stand in their columns: read as separated by blanks";
    if (cut == Cut::shifted)
        return "all columns stand a little to the right of their place: read as if they did not";
    if (cut == Cut::surplus)
        return "there are more values than the card has fields: those behind the last field are not read";
    return {};
}

int field_width(const FieldLayout& field, int minimum_width)
{
    if (minimum_width == 20 && field.type == FieldType::text && field.width >= 70) return 2 * field.width;
    return std::max(field.width, minimum_width);
}

Cut CardCutter::cut(std::string_view line, const std::vector<FieldLayout>& fields, int minimum_width,
                    std::vector<std::string_view>& tokens)
{
    tokens.clear();
    if (line.find('\t') != std::string_view::npos) {
        expanded_.clear();
        for (char character : line) {
            if (character == '\t')
                expanded_.append(8 - expanded_.size() % 8, ' ');
            else
                expanded_ += character;
        }
        line = expanded_;
    }

    const bool heading = ends_in_heading(fields);
    const auto first_comma = line.find(',');
    // A comma behind the last column belongs to text that nobody reads; one in a heading to the heading.
    int columns = 0;
    for (const FieldLayout& field : fields) columns += field_width(field, minimum_width);
    if (heading) columns = field_width(fields.front(), minimum_width);
    const bool free = first_comma < static_cast<std::size_t>(columns) && !all_text(fields);
    Cut way = Cut::fixed;
    if (free) {
        const std::string_view rest = cut_at_commas(line, fields.size(), heading, tokens);
        way = rest.find_first_not_of(", ") == rest.npos ? Cut::free : Cut::surplus;
    } else {
        cut_at_columns(line, fields, minimum_width, tokens);
        bool astray = false, text = false;
        double value = 0;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            if (fields[i].type == FieldType::text)
                text = text || !fields[i].name.empty();
            else if (tokens[i].find_first_of("<&") == std::string_view::npos)
                astray = astray || (!parse_real(tokens[i], value) && !trimmed(tokens[i]).empty());
        }
        if (astray && !text) way = cut_astray(line, fields, minimum_width, tokens);
    }
    tokens.resize(fields.size());
    return way;
}

} // namespace plash

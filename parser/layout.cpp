#include "parser/layout.h"

#include "parser/layout_text.h"
#include "parser/layout_texts.h"
#include "parser/number.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <stdexcept>

namespace plash {
namespace {

/// Of a keyword with all its options: the longest ones of the manual stay below 100.
constexpr std::size_t longest_keyword = 200;

/// Spelling that does not depend on case or on `-` against `_`.
std::string index_form(std::string_view name)
{
    std::string form(name);
    for (char& character : form) {
        if (character >= 'a' && character <= 'z') character -= 'a' - 'A';
        if (character == '-') character = '_';
    }
    return form;
}

std::vector<std::string> split_at_underscores(std::string_view name)
{
    std::vector<std::string> tokens;
    for (;;) {
        const auto end = name.find('_');
        tokens.emplace_back(name.substr(0, end));
        if (end == std::string_view::npos) return tokens;
        name.remove_prefix(end + 1);
    }
}

std::string join(const std::vector<std::string>& tokens, std::size_t begin, std::size_t end)
{
    std::string text;
    for (std::size_t i = begin; i < end; ++i) {
        if (i > begin) text += '_';
        text += tokens[i];
    }
    return text;
}

/// MAT_24 and MAT_024 are one keyword, as are EOS_1 and EOS_001.
void pad_law_number(std::vector<std::string>& tokens)
{
    if (tokens.size() < 2 || (tokens[0] != "MAT" && tokens[0] != "EOS")) return;
    std::string& number = tokens[1];
    if (!number.empty() && number.size() < 3 && std::all_of(number.begin(), number.end(), [](char character) {
            return character >= '0' && character <= '9';
        }))
        number.insert(0, 3 - number.size(), '0');
}

/// Options may hold underscores themselves: splits `tokens` from `begin` on into options of the layout.
bool split_options(const KeywordLayout& layout, const std::vector<std::string>& tokens, std::size_t begin,
                   std::vector<std::string>& options)
{
    while (begin < tokens.size()) {
        std::size_t end = tokens.size();
        while (end > begin && !layout.option(join(tokens, begin, end))) --end;
        if (end == begin) return false;
        options.push_back(join(tokens, begin, end));
        begin = end;
    }
    return true;
}

} // namespace

bool KeywordLayout::honours(std::string_view field) const
{
    return all_honoured || std::find(honoured.begin(), honoured.end(), field) != honoured.end();
}

const OptionLayout* KeywordLayout::option(std::string_view option_name) const
{
    for (const OptionLayout& option : options)
        if (option.name == option_name) return &option;
    return nullptr;
}

Kind KeywordLayout::defines() const
{
    for (const CardLayout& card : cards)
        for (const FieldLayout& field : card.fields)
            if (field.defines) return field.kind;
    return Kind::none;
}

LayoutTable::LayoutTable(const std::vector<std::string_view>& texts)
{
    for (std::string_view text : texts) {
        for (const LayoutBlock& block : layout_blocks(text)) {
            const auto family = static_cast<std::uint32_t>(families_.size());
            for (std::uint32_t member = 0; member < block.heads.size(); ++member) {
                for (std::string_view name : block.heads[member])
                    by_name_.emplace(index_form(name), Place{family, member});
            }
            Family& added = families_.emplace_back();
            added.text = block.text;
            added.line = block.line;
        }
    }
}

const std::vector<std::unique_ptr<KeywordLayout>>& LayoutTable::members_of(Family& family) const
{
    if (!family.members.empty()) return family.members;
    if (family.reading)
        throw std::runtime_error(fmt::format("layout line {}: `like` goes in a circle", family.line));
    family.reading = true;
    family.members =
        parse_layouts(family.text, family.line, [&](std::string_view name) { return find_locked(name); });
    family.reading = false;
    return family.members;
}

const KeywordLayout* LayoutTable::find_locked(std::string_view name) const
{
    const auto found = by_name_.find(index_form(name));
    if (found == by_name_.end()) return nullptr;
    return members_of(families_[found->second.family])[found->second.member].get();
}

const KeywordLayout* LayoutTable::find(std::string_view name) const
{
    const std::lock_guard guard(mutex_);
    return find_locked(name);
}

std::vector<const KeywordLayout*> LayoutTable::all() const
{
    const std::lock_guard guard(mutex_);
    std::vector<const KeywordLayout*> layouts;
    for (Family& family : families_)
        for (const auto& member : members_of(family)) layouts.push_back(member.get());
    return layouts;
}

KeywordName LayoutTable::resolve(std::string_view written) const
{
    KeywordName result;
    written = trimmed(written);
    if (written.size() > longest_keyword) { // every split into name and options is tried below
        result.name = std::string(written.substr(0, longest_keyword)) + "...";
        return result;
    }
    std::vector<std::string> tokens = split_at_underscores(index_form(written));
    pad_law_number(tokens);
    // The longest known name in front, the rest must be its options.
    const auto try_tokens = [&](const std::vector<std::string>& parts, std::vector<std::string> options) {
        for (std::size_t length = parts.size(); length > 0; --length) {
            const KeywordLayout* layout = find(join(parts, 0, length));
            if (!layout) continue;
            std::vector<std::string> all = options;
            if (!split_options(*layout, parts, length, all)) continue;
            if (!std::all_of(options.begin(), options.end(),
                             [&](const std::string& o) { return layout->option(o); }))
                continue;
            result = {layout, layout->name, std::move(all)};
            return true;
        }
        return false;
    };
    if (try_tokens(tokens, {})) return result;
    // Options in the middle of the name: ..._ID_BEAM_OFFSET_MPP.
    std::vector<std::string> rest, options;
    for (const std::string& token : tokens)
        (token == "ID" || token == "TITLE" || token == "MPP" ? options : rest).push_back(token);
    if (!options.empty() && try_tokens(rest, options)) return result;
    result.name = join(tokens, 0, tokens.size());
    return result;
}

const LayoutTable& layout_table()
{
    static const LayoutTable table(layout_texts());
    return table;
}

namespace {

/// Letters to change, to add and to leave out (Levenshtein 1966), or `limit` if there are that many.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit)
{
    if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= limit) return limit;
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
        }
    }
    return std::min(row[b.size()], limit);
}

} // namespace

std::string_view LayoutTable::closest(std::string_view name) const
{
    const std::string wanted = index_form(name);
    std::string_view best;
    std::size_t least = std::max<std::size_t>(2, name.size() / 10) + 1;
    for (const auto& entry : by_name_) {
        const std::string_view known = entry.first;
        const std::size_t distance = edit_distance(wanted, known, least + 1);
        if (distance < least || (distance == least && !best.empty() && known < best)) {
            least = distance;
            best = known;
        }
    }
    return best;
}

} // namespace plash

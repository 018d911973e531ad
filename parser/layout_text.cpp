#include "parser/layout_text.h"

#include "parser/number.h"
#include "parser/text_file.h"

#include <fmt/format.h>

#include <stdexcept>

namespace plash {
namespace {

struct KindName {
    std::string_view name;
    Kind kind;
};

/// Types of id fields as layouts write them.
constexpr KindName kind_names[] = {
    {"node", Kind::node},
    {"shell", Kind::shell},
    {"solid", Kind::solid},
    {"beam", Kind::beam},
    {"tshell", Kind::tshell},
    {"discrete", Kind::discrete},
    {"mass", Kind::mass},
    {"inertia", Kind::inertia},
    {"seatbelt", Kind::seatbelt},
    {"part", Kind::part},
    {"rigid_body", Kind::rigid_body},
    {"section", Kind::section},
    {"material", Kind::material},
    {"thermal", Kind::thermal_material},
    {"eos", Kind::eos},
    {"hourglass", Kind::hourglass},
    {"curve", Kind::curve},
    {"table", Kind::table},
    {"function", Kind::function},
    {"node_set", Kind::node_set},
    {"segment_set", Kind::segment_set},
    {"part_set", Kind::part_set},
    {"shell_set", Kind::shell_set},
    {"solid_set", Kind::solid_set},
    {"beam_set", Kind::beam_set},
    {"tshell_set", Kind::tshell_set},
    {"discrete_set", Kind::discrete_set},
    {"group_set", Kind::group_set},
    {"box_set", Kind::box_set},
    {"mode_set", Kind::mode_set},
    {"coordinate", Kind::coordinate},
    {"vector", Kind::vector},
    {"orientation", Kind::orientation},
    {"box", Kind::box},
    {"transformation", Kind::transformation},
    {"friction", Kind::friction},
};

[[noreturn]] void fail(std::string_view what, std::string_view token)
{
    throw std::runtime_error(fmt::format("{}: '{}'", what, token));
}

/// Takes the next blank-separated word off `text`.
std::string_view take_word(std::string_view& text)
{
    text = trimmed(text);
    const auto end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text = trimmed(text.substr(end));
    return word;
}

bool take_prefix(std::string_view& text, std::string_view prefix)
{
    if (!text.starts_with(prefix)) return false;
    text = trimmed(text.substr(prefix.size()));
    return true;
}

/// `type` and width after the colon of a field: "i", "curve", "t80", "node8", "16".
void parse_type(std::string_view type, FieldLayout& field)
{
    auto letters = type.size();
    while (letters > 0 && is_digit(type[letters - 1])) --letters;
    if (letters < type.size()) {
        field.width = 0;
        for (char digit : type.substr(letters)) field.width = 10 * field.width + (digit - '0');
    }
    type = type.substr(0, letters);
    if (type.empty()) return;
    if (type == "i") {
        field.type = FieldType::integer;
    } else if (type == "t") {
        field.type = FieldType::text;
    } else {
        field.type = FieldType::integer;
        if (type.front() == '#') {
            field.defines = true;
            type.remove_prefix(1);
        }
        for (const KindName& known : kind_names)
            if (known.name == type) field.kind = known.kind;
        if (field.kind == Kind::none) fail("no such field type", type);
    }
}

/// One word of a card: NAME, NAME:type, NAME=default, NAME1..8:type=default, or `-` for an unused column.
void parse_field(std::string_view word, std::vector<FieldLayout>& fields)
{
    FieldLayout field;
    const std::string_view whole = word;
    if (const auto equal = word.find('='); equal != std::string_view::npos) {
        const std::string_view value = word.substr(equal + 1);
        field.has_default = true;
        field.default_text = value;
        parse_real(value, field.default_value);
        word = word.substr(0, equal);
    }
    if (const auto colon = word.find(':'); colon != std::string_view::npos) {
        parse_type(word.substr(colon + 1), field);
        word = word.substr(0, colon);
    }
    if (field.type != FieldType::text) field.default_text.clear();
    if (word.empty()) fail("a field needs a name", whole);
    if (word == "-") {
        field.type = FieldType::text;
        fields.push_back(field);
        return;
    }
    const auto dots = word.find("..");
    if (dots == std::string_view::npos) {
        field.name = word;
        fields.push_back(field);
        return;
    }
    auto start = dots;
    while (start > 0 && is_digit(word[start - 1])) --start;
    std::int64_t first = 0, last = -1;
    if (!parse_whole(word.substr(start, dots - start), first) || !parse_whole(word.substr(dots + 2), last) ||
        last < first)
        fail("a range reads NAME1..8", whole);
    for (std::int64_t number = first; number <= last; ++number) {
        field.name = fmt::format("{}{}", word.substr(0, start), number);
        fields.push_back(field);
    }
}

/// What stands before the fields: `?`, `if CONDITION:`, `rows`, `rows[COUNT]`, `list[COUNT] N x`.
void parse_card_head(std::string_view& text, CardLayout& card)
{
    if (take_prefix(text, "? ")) card.optional = true;
    if (take_prefix(text, "if ")) {
        const auto colon = text.find(':');
        if (colon == std::string_view::npos) fail("`if` needs `:` behind its condition", text);
        card.condition = trimmed(text.substr(0, colon));
        text = trimmed(text.substr(colon + 1));
    }
    const bool rows = text.starts_with("rows ") || text.starts_with("rows[");
    const bool list = text.starts_with("list ") || text.starts_with("list[");
    if (!rows && !list) return;
    card.repeat = rows ? CardLayout::Repeat::rows : CardLayout::Repeat::list;
    text.remove_prefix(4);
    if (text.front() == '[') {
        const auto end = text.find(']');
        if (end == std::string_view::npos) fail("`[` without `]`", text);
        card.count = text.substr(1, end - 1);
        text = text.substr(end + 1);
    }
    text = trimmed(text);
    if (list) {
        std::int64_t number = 0;
        if (!parse_whole(take_word(text), number) || take_word(text) != "x")
            fail("`list` reads `list 8 x FIELD`", text);
        card.per_line = static_cast<int>(number);
    }
}

/// Name and aliases of a line that begins with `*`.
std::vector<std::string_view> names_of_head(std::string_view line)
{
    std::vector<std::string_view> names;
    std::string_view text = line.substr(1, line.find('[') - 1);
    while (!(text = trimmed(text)).empty()) {
        const std::string_view word = take_word(text);
        if (word != "=") names.push_back(word);
    }
    if (names.empty()) fail("a keyword needs a name", line);
    return names;
}

/// A line without meaning.
bool is_comment(std::string_view content)
{
    return content.empty() || content.front() == '#';
}

/// Reads layout text line by line; the stack of open `{` says where a card belongs.
class LayoutParser {
public:
    explicit LayoutParser(const std::function<const KeywordLayout*(std::string_view)>& find) : find_(find) {}

    void line(std::string_view text)
    {
        if (text.front() == '*') {
            if (open_.size() > 1) fail("`{` without `}` before", text);
            if (has_body_) finish();
            header(text);
            return;
        }
        if (names_.empty()) fail("a card before the first keyword", text);
        has_body_ = true;
        text = trimmed(text);
        if (text == "}") {
            if (open_.size() < 2) fail("`}` without `{`", text);
            open_.pop_back();
        } else if (take_prefix(text, "run:")) {
            body_.treatment = Treatment::run;
            while (!text.empty()) body_.honoured.emplace_back(take_word(text));
            body_.all_honoured = body_.honoured.size() == 1 && body_.honoured.front() == "all";
        } else if (take_prefix(text, "ignored:")) {
            body_.treatment = Treatment::ignored;
            body_.reason = text;
        } else if (take_prefix(text, "refused:")) {
            body_.treatment = Treatment::read;
            body_.reason = text;
        } else if (take_prefix(text, "unused ")) {
            unused(text);
        } else if (text == "none") {
            return; // the keyword has no lines
        } else if (take_prefix(text, "like ")) {
            like(text);
        } else if (take_prefix(text, "option ")) {
            option(text);
        } else {
            card(text);
        }
    }

    void finish()
    {
        if (open_.size() > 1) fail("`{` without `}`", names_.front().front());
        for (const std::vector<std::string>& names : names_) {
            auto layout = std::make_unique<KeywordLayout>(body_);
            layout->name = names.front();
            layout->aliases.assign(names.begin() + 1, names.end());
            layouts_.push_back(std::move(layout));
        }
        names_.clear();
        body_ = {};
        has_body_ = false;
    }

    std::vector<std::unique_ptr<KeywordLayout>> take() { return std::move(layouts_); }

private:
    void header(std::string_view text)
    {
        if (const auto bracket = text.find('['); bracket != std::string_view::npos) {
            std::string_view options = text.substr(bracket + 1);
            options = options.substr(0, options.find(']'));
            while (!options.empty()) standard_option(take_word(options));
        }
        const std::vector<std::string_view> names = names_of_head(text);
        names_.emplace_back(names.begin(), names.end());
        open_ = {&body_.cards};
    }

    /// TITLE: a line of text; ID: number and heading; TITLE:ID: the suffix _TITLE means the line of _ID;
    /// any other name: a suffix without lines.
    void standard_option(std::string_view word)
    {
        OptionLayout option;
        CardLayout line;
        if (word == "TITLE") {
            parse_field("TITLE:t80", line.fields);
        } else if (word == "ID" || word == "TITLE:ID") {
            parse_field("ID:i", line.fields);
            parse_field("HEADING:t70", line.fields);
            word = word.substr(0, word.find(':'));
        }
        option.name = word;
        if (!line.fields.empty()) option.cards.push_back(std::move(line));
        body_.options.push_back(std::move(option));
    }

    /// `option NAME before {`, `option NAME after {` or `option NAME after 2 {`
    void option(std::string_view text)
    {
        OptionLayout option;
        option.name = take_word(text);
        if (text == "after {") {
            option.after = OptionLayout::behind_all;
            take_prefix(text, "after");
        } else if (take_prefix(text, "after ")) {
            std::int64_t after = 0;
            if (!parse_whole(take_word(text), after)) fail("`after` needs the number of a card", text);
            option.after = static_cast<int>(after);
        } else if (!take_prefix(text, "before")) {
            fail("`option NAME before {` or `option NAME after 2 {`", text);
        }
        if (text != "{") fail("an option's lines stand between `{` and `}`", text);
        body_.options.push_back(std::move(option));
        open_.push_back(&body_.options.back().cards);
    }

    /// `unused FIELD ...: why`
    void unused(std::string_view text)
    {
        const auto colon = text.find(':');
        if (colon == std::string_view::npos) fail("`unused FIELD: why`", text);
        std::string_view names = text.substr(0, colon);
        const std::string reason(trimmed(text.substr(colon + 1)));
        while (!names.empty()) body_.ignored_fields.emplace_back(take_word(names), reason);
    }

    void like(std::string_view name)
    {
        const KeywordLayout* other = find_(name);
        if (!other) fail("`like` names an unknown keyword", name);
        body_.cards = other->cards;
        for (const OptionLayout& option : other->options) body_.options.push_back(option);
    }

    void card(std::string_view text)
    {
        CardLayout card;
        parse_card_head(text, card);
        const bool opens = text == "{";
        while (!opens && !text.empty()) parse_field(take_word(text), card.fields);
        std::vector<CardLayout>& cards = *open_.back();
        cards.push_back(std::move(card));
        if (opens) open_.push_back(&cards.back().group);
    }

    const std::function<const KeywordLayout*(std::string_view)>& find_;
    std::vector<std::unique_ptr<KeywordLayout>> layouts_;
    std::vector<std::vector<std::string>> names_; ///< keywords that share the body being read
    KeywordLayout body_;
    bool has_body_ = false;
    std::vector<std::vector<CardLayout>*> open_;
};

} // namespace

std::string_view to_string(Kind kind)
{
    switch (kind) {
    case Kind::curve:
        return "curve, table or function";
    case Kind::shell:
        return "shell element";
    case Kind::solid:
        return "solid element";
    case Kind::beam:
        return "beam element";
    case Kind::tshell:
        return "thick shell element";
    case Kind::discrete:
        return "discrete element";
    case Kind::rigid_body:
        return "nodal rigid body";
    case Kind::thermal_material:
        return "thermal material";
    case Kind::eos:
        return "equation of state";
    case Kind::node_set:
        return "node set";
    case Kind::segment_set:
        return "segment set";
    case Kind::part_set:
        return "part set";
    case Kind::shell_set:
        return "shell set";
    case Kind::solid_set:
        return "solid set";
    case Kind::beam_set:
        return "beam set";
    case Kind::tshell_set:
        return "thick shell set";
    case Kind::discrete_set:
        return "discrete set";
    case Kind::group_set:
        return "multi-material group set";
    case Kind::box_set:
        return "box set";
    case Kind::mode_set:
        return "mode set";
    case Kind::coordinate:
        return "coordinate system";
    default:
        break;
    }
    for (const KindName& known : kind_names)
        if (known.kind == kind) return known.name;
    return "thing";
}

std::vector<LayoutBlock> layout_blocks(std::string_view text)
{
    std::vector<LayoutBlock> blocks;
    LineCursor cursor(text, 1);
    bool in_body = true;
    std::string_view line;
    const char* line_begin = cursor.position();
    for (; cursor.next(line); line_begin = cursor.position()) {
        const std::string_view content = trimmed(line);
        if (is_comment(content)) continue;
        const bool head = line.front() == '*';
        if (head && in_body) {
            blocks.emplace_back();
            blocks.back().text = {line_begin, 0};
            blocks.back().line = cursor.line();
        }
        if (blocks.empty()) fail("a card before the first keyword", line);
        if (head) blocks.back().heads.push_back(names_of_head(content));
        in_body = !head;
        LayoutBlock& block = blocks.back();
        block.text = {block.text.data(), static_cast<std::size_t>(cursor.position() - block.text.data())};
    }
    return blocks;
}

std::vector<std::unique_ptr<KeywordLayout>>
parse_layouts(std::string_view text, int line_number,
              const std::function<const KeywordLayout*(std::string_view)>& find)
{
    LineCursor cursor(text, line_number);
    LayoutParser parser(find);
    std::string_view line;
    try {
        while (cursor.next(line)) {
            const std::string_view content = trimmed(line);
            if (is_comment(content)) continue;
            parser.line(line.front() == '*' ? trimmed(line) : line);
        }
        parser.finish();
        return parser.take();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("layout line {}: {}", cursor.line(), error.what()));
    }
}

} // namespace plash

#include "parser/definition_reader.h"

#include "parser/number.h"

#include <fmt/format.h>

#include <cmath>

namespace plash {
namespace {

/// Largest table that a count in the deck may ask for; beyond it the count is wrong.
constexpr double largest_count = 1e8;

std::string field_names(const CardLayout& card)
{
    std::string names;
    for (const FieldLayout& field : card.fields)
        if (!field.name.empty()) names += (names.empty() ? "" : " ") + field.name;
    return names;
}

bool has_field_starting_a_new_definition(const KeywordLayout& layout)
{
    return !layout.name.starts_with("CONTROL_") && !layout.name.starts_with("DATABASE_BINARY_") &&
           !layout.name.starts_with("DATABASE_EXTENT_");
}

} // namespace

DefinitionReader::DefinitionReader(const Block& block, const Parameters& parameters, Report& report)
    : block_(block),
      layout_(*block.keyword.layout),
      parameters_(parameters),
      report_(report),
      cursor_(block.text, block.where.line + 1),
      last_data_(end_of_data(block.text))
{}

bool DefinitionReader::peek(std::string_view& line) const
{
    LineCursor ahead = cursor_;
    return ahead.next_data(line);
}

bool DefinitionReader::only_blank_lines_left() const
{
    return cursor_.position() >= last_data_;
}

bool DefinitionReader::next(Record& record)
{
    std::string_view line;
    const bool more = peek(line);
    if (definitions_ > 0) {
        if (!more || layout_.cards.empty() || (trimmed(line).empty() && only_blank_lines_left()))
            return false;
        if (!has_field_starting_a_new_definition(layout_)) {
            cursor_.next_data(line);
            report_.warning(here(), layout_.name, "", "lines after its last card are not read");
            return false;
        }
    } else if (!more && !layout_.cards.empty() && !layout_.cards.front().optional) {
        // Some keywords switch something on by their mere presence; the others lost their cards.
        if (layout_.cards.front().repeat == CardLayout::Repeat::once)
            report_.warning(block_.where, layout_.name, "", "the keyword has no data line");
        return false;
    }

    ++definitions_;
    record.keyword = layout_.name;
    record.id = 0;
    record.title.clear();
    record.where = {block_.where.file, block_.where.line};
    record.fields.clear();
    record.tables.clear();
    if (more) {
        LineCursor ahead = cursor_;
        ahead.next_data(line);
        record.where.line = ahead.line();
    }
    read_options(OptionLayout::before_all, record);
    read_cards(layout_.cards, record, true);
    read_options(OptionLayout::behind_all, record);
    return true;
}

void DefinitionReader::read_options(int after, Record& record)
{
    for (const OptionLayout& option : layout_.options) {
        if (option.after != after || option.cards.empty() || !block_.has(option.name)) continue;
        if (option.name == "TITLE" && option.cards.front().fields.size() == 1) {
            std::string_view line;
            if (cursor_.next_data(line)) record.title = trimmed(line);
        } else {
            read_cards(option.cards, record, false);
        }
    }
}

void DefinitionReader::read_cards(const std::vector<CardLayout>& cards, Record& record, bool with_options)
{
    for (std::size_t number = 0; number < cards.size(); ++number) {
        const CardLayout& card = cards[number];
        std::string_view line;
        const bool more = peek(line);
        if (!holds(card, record, line) || (!more && card.optional)) {
            add_absent(card, record);
        } else if (!card.group.empty() && card.repeat == CardLayout::Repeat::once) {
            read_cards(card.group, record, false);
        } else if (card.repeat == CardLayout::Repeat::rows) {
            read_rows(card, record);
        } else if (card.repeat == CardLayout::Repeat::list) {
            read_list(card, record);
        } else if (!more) {
            report_.warning(
                block_.where, layout_.name, "",
                fmt::format("the line with {} is missing: its defaults are used", field_names(card)));
            add_absent(card, record);
        } else {
            read_card(card, record);
        }
        if (with_options) read_options(static_cast<int>(number), record);
    }
}

void DefinitionReader::cut_next_line(const std::vector<FieldLayout>& fields)
{
    std::string_view line;
    cursor_.next_data(line);
    const Cut cut = cutter_.cut(line, fields, block_.minimum_width, tokens_);
    if (const std::string_view warning = to_warning(cut); !warning.empty())
        report_.warning(here(), layout_.name, "", std::string(warning));
}

void DefinitionReader::read_card(const CardLayout& card, Record& record)
{
    cut_next_line(card.fields);
    for (std::size_t i = 0; i < card.fields.size(); ++i) {
        const FieldLayout& layout = card.fields[i];
        if (layout.name.empty()) continue;
        Value value = value_of(layout, tokens_[i], here());
        const bool names_it = layout.defines || layout.name == "ID";
        if (layout.defines || (names_it && record.id == 0)) record.id = std::llround(value.number);
        if (layout.name == "HEADING") {
            record.title = value.text;
            continue;
        }
        record.fields.push_back(
            {layout.name, value.number, std::move(value.text), value.given && !names_it, false, here()});
    }
}

DefinitionReader::Value DefinitionReader::value_of(const FieldLayout& field, std::string_view token,
                                                   Location where)
{
    Value value;
    std::string_view text = trimmed(token);
    std::string substituted;
    const bool reference = text.size() > 1 && text.find_first_of("&<") < 2 && field.width < 70;
    if (reference) {
        Substitution substitution = parameters_.substitute(text, block_.where.file);
        if (!substitution.error.empty()) {
            report_.error(where, layout_.name, field.name, substitution.error);
            text = {};
        } else {
            substituted = std::move(substitution.text);
            text = substituted;
        }
    }
    if (field.type == FieldType::text) {
        value.text = text.empty() ? field.default_text : text;
        value.given = !text.empty() && text != field.default_text;
        return value;
    }
    value.number = field.default_value;
    if (text.empty()) return value;

    double number = 0;
    if (!parse_real(text, number)) {
        report_.error(where, layout_.name, field.name,
                      fmt::format("'{}' is not a {}", text,
                                  field.type == FieldType::integer ? "whole number" : "number"));
        return value;
    }
    if (!std::isfinite(number)) {
        report_.error(where, layout_.name, field.name, fmt::format("'{}' is too large for a number", text));
        return value;
    }
    if (field.type == FieldType::integer && number != std::floor(number)) {
        report_.error(where, layout_.name, field.name, fmt::format("'{}' is not a whole number", text));
        return value;
    }
    if (field.type == FieldType::integer && std::abs(number) > largest_whole) {
        report_.error(where, layout_.name, field.name,
                      fmt::format("'{}' is too large for a whole number", text));
        return value;
    }
    // A zero says "default" in this format, so it is never a wish of its own.
    if (number == 0 && field.default_value != 0 && field.type == FieldType::integer)
        number = field.default_value;
    value.given = number != field.default_value;
    if (field.type == FieldType::real && number != 0 && block_.transform && block_.transform->units.change())
        number = in_units_of_the_deck(field, number, where);
    value.number = field.kind == Kind::none
                       ? number
                       : static_cast<double>(block_.number(field.kind, std::llround(number)));
    return value;
}

double DefinitionReader::in_units_of_the_deck(const FieldLayout& field, double number, Location where)
{
    // What the points of a curve are is told by who uses it.
    const bool later =
        (layout_.name.starts_with("DEFINE_CURVE") || layout_.name.starts_with("DEFINE_TABLE")) &&
        (field.name == "A1" || field.name == "O1" || field.name == "VALUE" || field.name == "OFFA" ||
         field.name == "OFFO");
    if (later) return number;
    const std::optional<Dimension> dimension = dimension_of(layout_.name, field.name);
    const std::optional<double> factor = dimension ? block_.transform->units.of(*dimension) : std::nullopt;
    if (factor) return number * *factor;
    report_.error(where, layout_.name, field.name,
                  dimension ? "temperatures cannot be converted (FCTTEM of *INCLUDE_TRANSFORM)"
                            : "Plash does not know the unit of this field and cannot convert it as "
                              "*INCLUDE_TRANSFORM asks: convert the file beforehand");
    return number;
}

void DefinitionReader::add_absent(const CardLayout& card, Record& record)
{
    if (card.repeat != CardLayout::Repeat::once) return;
    for (const FieldLayout& field : card.fields) {
        if (field.name.empty() || record.peek(field.name)) continue;
        record.fields.push_back(
            {field.name, field.default_value, field.default_text, false, false, record.where});
    }
}

long DefinitionReader::count_of(const CardLayout& card, const Record& record) const
{
    const double count = evaluate(card.count, record);
    if (count > largest_count) {
        report_.error(here(), layout_.name, card.count,
                      fmt::format("{:g} lines are more than can be", count));
        return 0;
    }
    return std::max(0L, std::lround(count));
}

void DefinitionReader::read_rows(const CardLayout& card, Record& record)
{
    const std::vector<CardLayout> single{
        CardLayout{.condition = {}, .count = {}, .fields = card.fields, .group = {}}};
    const std::vector<CardLayout>& cards = card.group.empty() ? single : card.group;
    const long wanted = card.count.empty() ? -1 : count_of(card, record);
    Table table;
    std::string_view line;
    for (long row = 0; wanted < 0 || row < wanted; ++row) {
        if (!peek(line)) {
            if (wanted >= 0)
                report_.error(here(), layout_.name, card.count,
                              fmt::format("{} rows are asked for, the block ends after {}", wanted, row));
            break;
        }
        if (wanted < 0 && trimmed(line).empty() && only_blank_lines_left()) break;
        read_row(cards, record, table, row == 0);
    }
    row_.clear();
    if (!table.columns.empty()) record.tables.push_back(std::move(table));
}

void DefinitionReader::read_row(const std::vector<CardLayout>& cards, const Record& record, Table& table,
                                bool first)
{
    row_.clear();
    int row_line = 0;
    for (const CardLayout& card : cards) {
        std::string_view line;
        const bool more = peek(line);
        const bool present = holds(card, record, line) && (more || !card.optional);
        long entries = 1;
        if (card.repeat != CardLayout::Repeat::once) entries = present ? count_of(card, record) : 0;
        const bool list = card.repeat == CardLayout::Repeat::list;
        for (long entry = 0; entry < entries; ++entry) {
            std::vector<FieldLayout> fields = card.fields;
            if (list) {
                const long on_line = std::min<long>(card.per_line, entries - entry);
                fields.assign(on_line, card.fields.front());
                entry += on_line - 1;
            }
            if (entry > 0 && !peek(line)) {
                report_.error(here(), layout_.name, card.count,
                              fmt::format("{} entries are asked for, the block ends before", entries));
                break;
            }
            if (present && peek(line)) {
                cut_next_line(fields);
                if (!row_line) row_line = cursor_.line();
            } else {
                tokens_.assign(fields.size(), {});
            }
            for (std::size_t i = 0; i < fields.size(); ++i) {
                if (fields[i].name.empty()) continue;
                std::string name = fields[i].name;
                if (list || card.repeat == CardLayout::Repeat::rows) name += fmt::format("{}", entry + 1);
                row_.emplace_back(std::move(name), value_of(fields[i], tokens_[i], here()));
            }
        }
    }
    if (first)
        for (const auto& [name, value] : row_) table.columns.push_back(name);
    row_.resize(table.columns.size());
    bool text = !table.text.empty();
    for (const auto& [name, value] : row_) text = text || !value.text.empty();
    if (text) table.text.resize(table.values.size());
    for (auto& [name, value] : row_) {
        table.values.push_back(value.number);
        if (text) table.text.push_back(std::move(value.text));
    }
    table.lines.push_back(row_line);
}

void DefinitionReader::read_list(const CardLayout& card, Record& record)
{
    const long wanted = card.count.empty() ? -1 : count_of(card, record);
    std::vector<FieldLayout> fields;
    for (int i = 0; i < card.per_line; ++i)
        fields.insert(fields.end(), card.fields.begin(), card.fields.end());
    Table table;
    for (const FieldLayout& field : card.fields) table.columns.push_back(field.name);
    const std::size_t width = card.fields.size();
    std::string_view line;
    long entries = 0;
    while (wanted < 0 || entries < wanted) {
        if (!peek(line)) {
            if (wanted >= 0)
                report_.error(
                    here(), layout_.name, card.count,
                    fmt::format("{} values are asked for, the block ends after {}", wanted, entries));
            break;
        }
        cut_next_line(fields);
        for (int i = 0; i < card.per_line && (wanted < 0 || entries < wanted); ++i, ++entries) {
            bool empty = true;
            Value values[8];
            for (std::size_t j = 0; j < width && j < 8; ++j) {
                values[j] = value_of(fields[j], tokens_[i * width + j], here());
                empty = empty && values[j].number == 0 && values[j].text.empty();
            }
            if (empty && wanted < 0) continue; // lists are padded with zeros and blanks
            for (std::size_t j = 0; j < width && j < 8; ++j) {
                if (!values[j].text.empty()) table.text.resize(table.values.size());
                table.values.push_back(values[j].number);
                if (!values[j].text.empty()) table.text.push_back(std::move(values[j].text));
            }
            table.lines.push_back(cursor_.line());
        }
    }
    if (!table.text.empty()) table.text.resize(table.values.size());
    record.tables.push_back(std::move(table));
}

bool DefinitionReader::holds(const CardLayout& card, const Record& record, std::string_view line) const
{
    if (card.condition.empty()) return true;
    if (card.condition == "&") return !line.empty() && line.front() == '&';
    return evaluate(card.condition, record) != 0;
}

double DefinitionReader::evaluate(std::string_view expression, const Record& record) const
{
    return evaluate_condition(expression, [&](std::string_view name) -> ConditionValue {
        for (const auto& [known, value] : row_)
            if (known == name) return {value.number, value.text, !value.text.empty()};
        if (const Record::Field* field = record.peek(name))
            return {field->value, field->text, !field->text.empty()};
        return {0, name, true};
    });
}

} // namespace plash

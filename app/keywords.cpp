#include "app/commands.h"

#include "parser/layout.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace plash {
namespace {

std::string_view status_of(const KeywordLayout& layout)
{
    switch (layout.treatment) {
    case Treatment::run:
        return "run";
    case Treatment::ignored:
        return "ignored";
    case Treatment::read:
        break;
    }
    return "read";
}

std::string type_of(const FieldLayout& field)
{
    if (field.kind != Kind::none)
        return fmt::format("{}{}", field.defines ? "new " : "", to_string(field.kind));
    return field.type == FieldType::real ? "real" : field.type == FieldType::integer ? "integer" : "text";
}

/// Calls visit(card, field) for every named field.
template <class Visit>
void for_each_field(const std::vector<CardLayout>& cards, Visit&& visit)
{
    for (const CardLayout& card : cards) {
        for (const FieldLayout& field : card.fields)
            if (!field.name.empty()) visit(card, field);
        for_each_field(card.group, visit);
    }
}

std::string default_of(const FieldLayout& field)
{
    if (!field.has_default) return field.type == FieldType::text || field.kind != Kind::none ? "" : "0";
    return field.type == FieldType::text ? field.default_text : fmt::format("{}", field.default_value);
}

nlohmann::ordered_json to_json(const KeywordLayout& layout)
{
    nlohmann::ordered_json json{{"name", layout.name}, {"status", status_of(layout)}};
    if (!layout.aliases.empty()) json["aliases"] = layout.aliases;
    if (!layout.reason.empty()) json["reason"] = layout.reason;
    json["options"] = nlohmann::ordered_json::array();
    for (const OptionLayout& option : layout.options) json["options"].push_back(option.name);
    json["fields"] = nlohmann::ordered_json::array();
    for_each_field(layout.cards, [&](const CardLayout&, const FieldLayout& field) {
        nlohmann::ordered_json entry{
            {"name", field.name}, {"type", type_of(field)}, {"default", default_of(field)}};
        entry["honoured"] = layout.treatment == Treatment::run && layout.honours(field.name);
        for (const auto& [name, why] : layout.ignored_fields)
            if (name == field.name) entry["reason"] = why;
        json["fields"].push_back(std::move(entry));
    });
    return json;
}

void print_fields(const KeywordLayout& layout)
{
    fmt::print("*{}: {}{}\n", layout.name, status_of(layout),
               layout.reason.empty() ? "" : " (" + layout.reason + ")");
    for (const std::string& alias : layout.aliases) fmt::print("  also written *{}\n", alias);
    for (const OptionLayout& option : layout.options) fmt::print("  option _{}\n", option.name);
    for_each_field(layout.cards, [&](const CardLayout& card, const FieldLayout& field) {
        const bool honoured = layout.treatment == Treatment::run && layout.honours(field.name);
        fmt::print("  {:10} {:28} {:10} {}{}\n", field.name, type_of(field), default_of(field),
                   honoured ? "honoured" : "",
                   card.condition.empty() ? "" : fmt::format("  (if {})", card.condition));
    });
    for (const auto& [name, why] : layout.ignored_fields) fmt::print("  {} is ignored: {}\n", name, why);
}

/// Names of the fields that are honoured, or of the others, each once.
std::string field_names(const KeywordLayout& layout, bool honoured)
{
    std::string text;
    std::vector<std::string_view> seen;
    for_each_field(layout.cards, [&](const CardLayout&, const FieldLayout& field) {
        if (layout.honours(field.name) != honoured) return;
        if (std::find(seen.begin(), seen.end(), field.name) != seen.end()) return;
        seen.push_back(field.name);
        text += (text.empty() ? "" : " ") + field.name;
    });
    return text;
}

/// A cell of a table: `|` would end it.
std::string cell(std::string text)
{
    for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
        text.insert(at, 1, '\\');
    return text;
}

/// The page docs/keywords.md.
void print_page(const std::vector<const KeywordLayout*>& layouts)
{
    const auto of = [&](Treatment treatment) {
        std::vector<const KeywordLayout*> chosen;
        std::copy_if(layouts.begin(), layouts.end(), std::back_inserter(chosen),
                     [&](const KeywordLayout* layout) { return layout->treatment == treatment; });
        return chosen;
    };
    const auto run = of(Treatment::run), ignored = of(Treatment::ignored), read = of(Treatment::read);
    fmt::print("# Keywords\n\n"
               "Written by `./plash keywords --markdown > docs/keywords.md` from the card layouts "
               "(layouts.md); a test "
               "says when it is not up to date.\n`plash keywords NAME` shows every field of a keyword with "
               "its type and "
               "default.\n\n{} keywords run, {} are ignored without harm, {} are read only: checked and in "
               "the Model, "
               "but a deck that holds one is refused.\n",
               run.size(), ignored.size(), read.size());
    fmt::print("\n## Run\n\nA field that is not honoured is listed by `plash check` where a deck sets it.\n\n"
               "| keyword | honoured | not honoured |\n|---|---|---|\n");
    for (const KeywordLayout* layout : run)
        fmt::print("| {} | {} | {} |\n", layout->name, cell(field_names(*layout, true)),
                   cell(field_names(*layout, false)));
    fmt::print("\n## Ignored without harm\n\n| keyword | why |\n|---|---|\n");
    for (const KeywordLayout* layout : ignored)
        fmt::print("| {} | {} |\n", layout->name, cell(layout->reason));
    fmt::print("\n## Read only\n\n");
    for (const KeywordLayout* layout : read) fmt::print("- {}\n", layout->name);
}

int list_keywords(const std::string& name, bool json, bool page)
{
    const LayoutTable& table = layout_table();
    std::vector<const KeywordLayout*> chosen;
    if (const KeywordLayout* one = table.resolve(name).layout; one && !name.empty()) {
        chosen.push_back(one);
    } else {
        const std::string part = table.resolve(name).name;
        for (const KeywordLayout* layout : table.all())
            if (layout->name.find(part) != std::string::npos) chosen.push_back(layout);
    }
    if (chosen.empty()) {
        fmt::print(stderr, "plash: no keyword like '{}'\n", name);
        return 2;
    }
    std::sort(chosen.begin(), chosen.end(),
              [](const KeywordLayout* a, const KeywordLayout* b) { return a->name < b->name; });
    if (page) {
        print_page(chosen);
    } else if (json) {
        auto list = nlohmann::ordered_json::array();
        for (const KeywordLayout* layout : chosen) list.push_back(to_json(*layout));
        fmt::print("{}\n", list.dump(1));
    } else if (chosen.size() == 1) {
        print_fields(*chosen.front());
    } else {
        for (const KeywordLayout* layout : chosen)
            fmt::print("{:8} *{}{}\n", status_of(*layout), layout->name,
                       layout->reason.empty() ? "" : " (" + layout->reason + ")");
    }
    return 0;
}

} // namespace

void add_keywords(CLI::App& program, int& exit_code)
{
    struct Options {
        std::string name;
        bool json = false, page = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("keywords", "list what Plash makes of each keyword and field");
    command->add_option("name", options->name, "one keyword in full, or a part of the names to list");
    command->add_flag("--json", options->json, "print as JSON");
    command->add_flag("--markdown", options->page, "print the page docs/keywords.md");
    command->callback(
        [options, &exit_code] { exit_code = list_keywords(options->name, options->json, options->page); });
}

} // namespace plash

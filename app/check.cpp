#include "app/commands.h"
#include "contact/move_penetrating.h"

#include "parser/read_model.h"
#include "solver/scene.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>

namespace plash {
namespace {

struct CheckOptions {
    std::string deck;
    bool json = false;
    std::vector<std::string> parameters;
};

/// What will become of the deck, as far as its keywords and fields tell.
enum class Verdict { faithful, simplified, refused };

Verdict verdict_of(const ReadResult& result, const std::vector<Message>& unsupported)
{
    if (!result.ok || !unsupported.empty()) return Verdict::refused;
    return result.report.ignored.empty() ? Verdict::faithful : Verdict::simplified;
}

nlohmann::ordered_json to_json(const Message& message, const Model& model)
{
    const int file = message.where.file;
    return {{"file", file == none ? "" : model.files[file]},
            {"line", message.where.line},
            {"keyword", message.keyword},
            {"field", message.field},
            {"message", message.text}};
}

nlohmann::ordered_json to_json(const ReadResult& result, const CheckOptions& options, double seconds,
                               const std::vector<Message>& unsupported)
{
    const Model& model = result.model;
    const Report& report = result.report;
    nlohmann::ordered_json json;
    json["deck"] = options.deck;
    json["seconds"] = seconds;
    json["bytes"] = result.bytes;
    json["nodes"] = model.nodes.size();
    json["elements"] = {{"shell", report.elements.shell},
                        {"tshell", report.elements.tshell},
                        {"solid", report.elements.solid},
                        {"beam", report.elements.beam},
                        {"discrete", report.elements.discrete},
                        {"mass", report.elements.mass},
                        {"sph", report.elements.sph}};
    json["parts"] = model.parts.size();
    json["keywords"] = nlohmann::ordered_json::array();
    for (const auto& [name, use] : report.keywords)
        json["keywords"].push_back(
            {{"name", name}, {"blocks", use.blocks}, {"status", to_string(use.status)}});
    json["fields"] = {{"honoured", report.fields.honoured},
                      {"ignored", report.fields.ignored},
                      {"unsupported", report.fields.unsupported}};
    json["unused"] = nlohmann::ordered_json::array();
    for (const Unused& unused : report.unused)
        json["unused"].push_back({{"what", unused.what}, {"count", unused.count}, {"first", unused.first}});
    json["ignored"] = nlohmann::ordered_json::array();
    for (const IgnoredField& field : report.ignored)
        json["ignored"].push_back({{"file", model.files[field.where.file]},
                                   {"line", field.where.line},
                                   {"keyword", field.keyword},
                                   {"field", field.field},
                                   {"value", field.value},
                                   {"reason", field.reason}});
    json["errors"] = nlohmann::ordered_json::array();
    for (const Message& message : report.errors) json["errors"].push_back(to_json(message, model));
    for (const Message& message : unsupported) json["errors"].push_back(to_json(message, model));
    json["warnings"] = nlohmann::ordered_json::array();
    for (const Message& message : report.warnings) json["warnings"].push_back(to_json(message, model));
    return json;
}

/// "90 shells, 4 beams, ": the kinds of elements that the deck has.
std::string elements_of(const Report& report)
{
    std::string text;
    const auto add = [&](long count, std::string_view what) {
        if (count > 0) text += fmt::format("{} {}, ", count, what);
    };
    add(report.elements.shell, "shells");
    add(report.elements.tshell, "thick shells");
    add(report.elements.solid, "solids");
    add(report.elements.beam, "beams");
    add(report.elements.discrete, "discrete elements");
    add(report.elements.mass, "masses");
    add(report.elements.sph, "particles");
    return text;
}

/// What stands in the way of a run, in words.
std::string obstacles(const Report& report, const std::vector<Message>& unsupported)
{
    const auto counted = [](std::size_t count, std::string_view what) {
        return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    std::string text;
    if (!report.errors.empty()) text = counted(report.errors.size(), "error") + " listed above";
    if (!unsupported.empty())
        text += (text.empty() ? "" : ", and ") + counted(unsupported.size(), "keyword") +
                " that Plash does not run yet";
    return text;
}

void print_text(const ReadResult& result, const CheckOptions& options,
                const std::vector<Message>& unsupported)
{
    const Model& model = result.model;
    const Report& report = result.report;
    fmt::print("{}: {} nodes, {}{} parts\n", options.deck, model.nodes.size(), elements_of(report),
               model.parts.size());
    if (!model.title.empty()) fmt::print("  {}\n", model.title);

    fmt::print("\nkeywords\n");
    for (const auto& [name, use] : report.keywords)
        fmt::print("  {:11} {:5}  *{}{}\n", to_string(use.status), use.blocks, name,
                   use.reason.empty() ? "" : " (" + use.reason + ")");
    if (!report.unused.empty()) fmt::print("\ndefined, but used by nothing\n");
    for (const Unused& unused : report.unused)
        fmt::print("  {:11}  {}, the first is {}\n", unused.count, unused.what, unused.first);
    if (!report.ignored.empty()) fmt::print("\nignored fields\n");
    for (const IgnoredField& field : report.ignored)
        fmt::print("  {}: *{}, field {} = {}: {}\n", model.place(field.where), field.keyword, field.field,
                   field.value, field.reason);
    if (!report.warnings.empty()) fmt::print("\nwarnings\n");
    for (const Message& message : report.warnings) fmt::print("  {}\n", to_text(message, model));
    if (!report.errors.empty() || !unsupported.empty()) fmt::print("\nerrors\n");
    for (const Message& message : report.errors) fmt::print("  {}\n", to_text(message, model));
    for (const Message& message : unsupported) fmt::print("  {}\n", to_text(message, model));

    switch (verdict_of(result, unsupported)) {
    case Verdict::faithful:
        fmt::print("\nThe deck will run faithfully.\n");
        break;
    case Verdict::simplified:
        fmt::print("\nThe deck will run with {} listed simplification{}.\n", report.ignored.size(),
                   report.ignored.size() == 1 ? "" : "s");
        break;
    case Verdict::refused:
        fmt::print("\nThe deck will not run: {}.\n", obstacles(report, unsupported));
        break;
    }
}

/// Builds the scene as a run would: physics says what it cannot do, and marks the fields that it uses.
void set_up_physics(ReadResult& result)
{
    try {
        const std::vector<MovedNode> moved = move_penetrating_nodes(result.model);
        for (const std::string& line : describe(moved, result.model))
            if (!line.starts_with(' ')) result.report.warning({}, "", "", line);
        const Scene scene = make_scene(result.model);
        for (const auto& term : scene.terms) {
            // The first line says what, lines behind it where.
            for (const std::string& line : term->notices(scene.state))
                if (!line.starts_with(' ')) result.report.warning({}, "", "", line);
        }
    } catch (const DeckError& error) {
        result.report.error(error.where, "", "", error.what());
        result.ok = false;
    }
}

int check(const CheckOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    ReadOptions read_options;
    for (const std::string& assignment : options.parameters) {
        const auto sign = assignment.find('=');
        read_options.parameters.emplace_back(assignment.substr(0, sign),
                                             sign == std::string::npos ? "" : assignment.substr(sign + 1));
    }
    ReadResult result = read_model(options.deck, read_options);
    const std::vector<Message> unsupported = unsupported_keywords(result.report);
    if (result.ok && unsupported.empty()) set_up_physics(result);
    list_unread_fields(result.model, result.report);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (options.json)
        fmt::print("{}\n", to_json(result, options, seconds, unsupported)
                               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else
        print_text(result, options, unsupported);
    return verdict_of(result, unsupported) == Verdict::refused ? 1 : 0;
}

} // namespace

void add_check(CLI::App& program, int& exit_code)
{
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = program.add_subcommand("check", "say what a deck holds and what Plash makes of it");
    command->add_option("deck", options->deck, "keyword deck")->required();
    command->add_flag("--json", options->json, "print the report as JSON (docs/check_json.md)");
    command->add_option("--set", options->parameters, "NAME=VALUE: replace a *PARAMETER of the deck");
    command->callback([options, &exit_code] { exit_code = check(*options); });
}

} // namespace plash

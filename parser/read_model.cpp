#include "parser/read_model.h"

#include "parser/mesh_checks.h"
#include "parser/number.h"
#include "parser/reading.h"
#include "parser/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace plash {
namespace {

/// Two definitions with the same number are compared by their values, not kept.
std::size_t fingerprint(const Record& record)
{
    std::size_t hash = std::hash<std::string>{}(record.keyword);
    const auto mix = [&](std::size_t value) { hash = hash * 1099511628211u + value; };
    for (const Record::Field& field : record.fields) {
        mix(std::hash<double>{}(field.value));
        mix(std::hash<std::string>{}(field.text));
    }
    for (const Table& table : record.tables) {
        for (double value : table.values) mix(std::hash<double>{}(value));
        for (const std::string& text : table.text) mix(std::hash<std::string>{}(text));
    }
    return hash;
}

std::string unknown_keyword(std::string_view name)
{
    const std::string_view closest = layout_table().closest(name);
    return closest.empty() ? "unknown keyword" : fmt::format("unknown keyword, perhaps *{}", closest);
}

class ModelReader {
public:
    ModelReader(const Deck& deck, Model& model, Report& report) : reading_(deck, model, report) {}

    void run()
    {
        for (int phase = 0; phase <= static_cast<int>(last_phase); ++phase) {
            for (const Block& block : reading_.deck.blocks)
                if (phase_of(block) == static_cast<Phase>(phase)) read(block);
            finish(static_cast<Phase>(phase));
        }
        convert_foreign_curves(reading_);
        references_.check(reading_);
        check_parts();
        check_mesh(reading_.model, reading_.report);
        check_units(reading_.model, reading_.report);
        count_unused(reading_);
        count_keywords();
    }

private:
    /// Decks have many blocks and few keywords.
    const Translator* translator_of(const Block& block)
    {
        const auto [known, added] = translators_.try_emplace(block.keyword.layout, nullptr);
        if (added) known->second = find_translator(block.keyword.name);
        return known->second;
    }

    Phase phase_of(const Block& block)
    {
        if (!block.keyword.layout) return last_phase;
        if (const Translator* translator = translator_of(block)) return translator->phase;
        if (block.keyword.name.starts_with("ELEMENT_")) return Phase::elements;
        if (block.keyword.name.starts_with("PART_")) return Phase::parts;
        return block.keyword.layout->defines() == Kind::none ? Phase::conditions : Phase::properties;
    }

    void read(const Block& block)
    {
        if (!block.keyword.layout) {
            reading_.report.warning(block.where, block.keyword.name, "",
                                    unknown_keyword(block.keyword.name) + ": not read");
            return;
        }
        const Translator* translator = translator_of(block);
        if (translator && translator->block) {
            translator->block(block, reading_);
            reading_.deck.files[block.where.file]->release(block.text);
            return;
        }
        const Kind kind = block.keyword.layout->defines();
        DefinitionReader definitions(block, reading_.deck.parameters, reading_.report);
        Record record;
        while (definitions.next(record)) {
            if (kind != Kind::none && !is_new(kind, record, block)) continue;
            if (translator && translator->definition)
                translator->definition(record, block, reading_);
            else
                reading_.model.others.push_back(record);
            if (kind != Kind::none)
                reading_.table(kind).add(record.id, translator ? last_index(kind) : other_index(kind));
            references_.collect(record, *block.keyword.layout, reading_);
            if (!is_kept_record(kind)) list_fields(record, *block.keyword.layout, reading_.report);
        }
    }

    /// False for the second definition of a number.
    bool is_new(Kind kind, const Record& record, const Block& block)
    {
        if (record.id == 0 && kind != Kind::hourglass && kind != Kind::rigid_body) {
            reading_.report.error(record.where, record.keyword, "",
                                  fmt::format("the {} needs a number", to_string(kind)));
            return false;
        }
        if (block.has("COLLECT")) return true;
        const std::size_t print = fingerprint(record);
        const auto [known, added] = seen_.try_emplace({kind, record.id}, Seen{print, record.where});
        if (added) return true;
        const std::string text = fmt::format("{} {} is defined a second time, first at {}", to_string(kind),
                                             record.id, reading_.model.place(known->second.where));
        if (known->second.print == print)
            reading_.report.warning(record.where, record.keyword, "", text + ", with the same values");
        else
            reading_.report.error(record.where, record.keyword, "", text + ", with other values");
        return false;
    }

    /// Records of these kinds stay in the Model: physics marks what it reads of them.
    static bool is_kept_record(Kind kind)
    {
        return kind == Kind::section || kind == Kind::material || kind == Kind::eos ||
               kind == Kind::hourglass;
    }

    /// Position in the Model of what was defined last.
    Index last_index(Kind kind) const
    {
        const Model& model = reading_.model;
        const auto last = [](const auto& list) { return static_cast<Index>(list.size()) - 1; };
        switch (kind) {
        case Kind::section:
            return last(model.sections);
        case Kind::material:
            return last(model.materials);
        case Kind::eos:
            return last(model.equations_of_state);
        case Kind::hourglass:
            return last(model.hourglass);
        case Kind::part:
            return last(model.parts);
        case Kind::rigid_body:
            return last(model.nodal_rigid_bodies);
        case Kind::curve:
            return last(model.curves);
        case Kind::table:
            return last(model.tables);
        case Kind::coordinate:
            return last(model.coordinate_systems);
        case Kind::vector:
            return last(model.vectors);
        case Kind::box:
            return last(model.boxes);
        case Kind::node_set:
            return last(model.node_sets);
        case Kind::segment_set:
            return last(model.segment_sets);
        case Kind::part_set:
            return last(model.part_sets);
        case Kind::shell_set:
            return last(model.shell_sets);
        case Kind::solid_set:
            return last(model.solid_sets);
        case Kind::beam_set:
            return last(model.beam_sets);
        case Kind::tshell_set:
            return last(model.thick_shell_sets);
        case Kind::discrete_set:
            return last(model.discrete_sets);
        case Kind::beam:
            return last(model.beams.id);
        case Kind::discrete:
            return last(model.discretes.id);
        case Kind::mass:
            return last(model.masses.id);
        default:
            return last(model.others);
        }
    }

    /// Position of a definition that went into `others`; `none` when things of its kind are looked for in a
    /// list of their own (a *DEFINE_BOX_LOCAL is a box, but none of Model::boxes).
    Index other_index(Kind kind) const
    {
        const Model& model = reading_.model;
        const Index last = static_cast<Index>(model.others.size()) - 1;
        const bool own_list =
            kind == Kind::curve || kind == Kind::table || kind == Kind::coordinate || kind == Kind::vector ||
            kind == Kind::box || kind == Kind::part || kind == Kind::node_set || kind == Kind::segment_set ||
            kind == Kind::part_set || kind == Kind::shell_set || kind == Kind::solid_set ||
            kind == Kind::beam_set || kind == Kind::tshell_set || kind == Kind::discrete_set ||
            is_kept_record(kind) || kind == Kind::beam || kind == Kind::discrete || kind == Kind::mass ||
            kind == Kind::shell || kind == Kind::solid || kind == Kind::tshell;
        return own_list ? none : last;
    }

    void finish(Phase phase)
    {
        Model& model = reading_.model;
        if (phase == Phase::nodes) finish_nodes();
        if (phase == Phase::properties) finish_tables(reading_);
        if (phase == Phase::elements) {
            finish_elements(model.shells, Kind::shell, "ELEMENT_SHELL");
            finish_elements(model.solids, Kind::solid, "ELEMENT_SOLID");
            finish_elements(model.thick_shells, Kind::tshell, "ELEMENT_TSHELL");
        }
        if (phase == Phase::sets) {
            finish_sets(reading_);
            move_node_sets(reading_);
            finish_nodal_rigid_bodies(reading_);
        }
        if (phase == Phase::conditions) {
            finish_loads(reading_);
            finish_contacts(reading_);
            finish_switched_parts(reading_);
        }
    }

    /// Nodes with the same number: decks repeat them, so identical ones are dropped with a warning.
    void finish_nodes()
    {
        Nodes& nodes = reading_.model.nodes;
        std::vector<Index> repeated = reading_.table(Kind::node).build(nodes.id);
        move_included_nodes(reading_);
        if (repeated.empty()) return;
        std::sort(repeated.begin(), repeated.end());
        for (Index index : repeated) {
            const Index first = reading_.table(Kind::node).find(nodes.id[index]);
            const bool same = norm(nodes.position[first] - nodes.position[index]) == 0;
            const std::string text = fmt::format("node {} is defined a second time", nodes.id[index]);
            const Location where = repeated_line("NODE", nodes.id[index]);
            if (same)
                reading_.report.warning(where, "NODE", "NID", text + " at the same place");
            else
                reading_.report.error(where, "NODE", "NID", text + " at another place");
        }
        const std::vector<Index> moved_to =
            remove(repeated, nodes.size(), [&](std::size_t from, std::size_t to) {
                nodes.id[to] = nodes.id[from];
                nodes.position[to] = nodes.position[from];
            });
        nodes.id.resize(nodes.size() - repeated.size());
        nodes.position.resize(nodes.id.size());
        for (FixedNodes& fixed : reading_.model.fixed_nodes)
            for (Index& node : fixed.nodes) node = moved_to[node];
        reading_.table(Kind::node).build(nodes.id);
    }

    /// Closes the gaps that `gone` (sorted) leaves; returns where each entry went (gone ones: to their
    /// neighbour).
    template <class Move>
    static std::vector<Index> remove(const std::vector<Index>& gone, std::size_t count, Move&& move)
    {
        std::vector<Index> moved_to(count);
        std::size_t to = 0, next = 0;
        for (std::size_t from = 0; from < count; ++from) {
            moved_to[from] = static_cast<Index>(
                to > 0 && next < gone.size() && gone[next] == static_cast<Index>(from) ? to - 1 : to);
            if (next < gone.size() && gone[next] == static_cast<Index>(from)) {
                ++next;
                continue;
            }
            if (to != from) move(from, to);
            ++to;
        }
        return moved_to;
    }

    template <class ElementList>
    void finish_elements(ElementList& elements, Kind kind, std::string_view keyword)
    {
        for (Index index : reading_.table(kind).build(elements.id))
            reading_.report.error(
                repeated_line(keyword, elements.id[index]), keyword, "EID",
                fmt::format("{} {} is defined a second time", to_string(kind), elements.id[index]));
    }

    /// Where a number stands for the second time as the first field of a line in the blocks of a keyword.
    Location repeated_line(std::string_view keyword, Id wanted)
    {
        if (++located_ > most_located) return {}; // each costs a walk through the deck
        int found = 0;
        for (const Block& block : reading_.deck.blocks) {
            if (!block.keyword.name.starts_with(keyword)) continue;
            LineCursor cursor(block.text, block.where.line + 1);
            const std::size_t width = std::max(8, block.minimum_width);
            std::string_view line;
            while (cursor.next_data(line)) {
                std::int64_t id = 0;
                const auto end = std::min({line.find(','), width, line.size()});
                if (parse_whole(line.substr(0, end), id) && id == wanted && ++found == 2)
                    return {block.where.file, cursor.line()};
            }
        }
        return {};
    }

    void check_parts()
    {
        const Model& model = reading_.model;
        std::vector<bool> used(model.parts.size());
        for_each_topology(model, [&](const auto& elements) {
            for (Index part : elements.part) used[part] = true;
        });
        for (Index part : model.particles.part) used[part] = true;
        const auto report = [&](const std::vector<Index>& parts, std::string_view field,
                                std::string_view what) {
            for (Index index : parts) {
                const Part& part = model.parts[index];
                if (used[index])
                    reading_.report.error(part.where, "PART", field,
                                          fmt::format("part {} has no {}", part.id, what));
            }
        };
        report(reading_.parts_without_section, "SECID", "section");
        if (!reading_.heat_only) report(reading_.parts_without_material, "MID", "material");
    }

    void count_keywords()
    {
        for (const auto& [keyword, blocks] : reading_.deck.obeyed)
            reading_.report.keywords[keyword] = {keyword, KeywordStatus::run, blocks.number, "",
                                                 blocks.first};
        for (const Block& block : reading_.deck.blocks) {
            KeywordUse& use = reading_.report.keywords[block.keyword.name];
            if (use.blocks++ > 0) continue;
            use.name = block.keyword.name;
            use.first = block.where;
            const KeywordLayout* layout = block.keyword.layout;
            if (!layout) continue;
            use.reason = layout->reason;
            use.status = layout->treatment == Treatment::run       ? KeywordStatus::run
                         : layout->treatment == Treatment::ignored ? KeywordStatus::ignored
                                                                   : KeywordStatus::read;
        }
    }

public:
    /// Enters the non-default fields of a record into the report.
    static void list_fields(const Record& record, const KeywordLayout& layout, Report& report)
    {
        const bool claimed = std::any_of(record.fields.begin(), record.fields.end(),
                                         [](const Record::Field& field) { return field.read; });
        for (const Record::Field& field : record.fields) {
            if (!field.given) continue;
            if (layout.treatment == Treatment::read) {
                ++report.fields.unsupported;
                continue;
            }
            const bool honoured =
                layout.treatment == Treatment::run && layout.honours(field.name) && (field.read || !claimed);
            ++(honoured ? report.fields.honoured : report.fields.ignored);
            // A zero means "as by default" to LS-DYNA, whatever the default is.
            const bool zero = field.value == 0 && field.text.empty();
            if (honoured || zero || layout.treatment == Treatment::ignored) continue;
            std::string reason = "Plash does not use it";
            for (const auto& [name, why] : layout.ignored_fields)
                if (name == field.name) reason = why;
            report.ignored.push_back({field.where, record.keyword, field.name,
                                      field.text.empty() ? fmt::format("{}", field.value) : field.text,
                                      reason});
        }
    }

private:
    struct Seen {
        std::size_t print;
        Location where;
    };
    static constexpr int most_located = 20;
    Reading reading_;
    std::unordered_map<const KeywordLayout*, const Translator*> translators_;
    int located_ = 0;
    std::map<std::pair<Kind, Id>, Seen> seen_;
    References references_;
};

} // namespace

namespace {

/// `scan` cuts the deck into blocks; what it reports comes before all else.
template <class Scan>
ReadResult read_scanned(Scan&& scan)
{
    ReadResult result;
    const Deck deck = scan(result.report);
    result.bytes = deck.bytes;
    result.model.files = deck.names;
    result.model.title = deck.title;
    ModelReader(deck, result.model, result.report).run();
    result.report.close();
    result.ok = result.report.ok();
    return result;
}

} // namespace

ReadResult read_model(const std::string& path, const ReadOptions& options)
{
    return read_scanned([&](Report& report) { return scan_deck(path, options.parameters, report); });
}

ReadResult read_model_text(const std::string& path, std::string_view text, const ReadOptions& options)
{
    return read_scanned(
        [&](Report& report) { return scan_deck_text(path, text, options.parameters, report); });
}

void list_unread_fields(const Model& model, Report& report)
{
    for (const auto* records :
         {&model.sections, &model.materials, &model.equations_of_state, &model.hourglass})
        for (const Record& record : *records)
            if (const KeywordLayout* layout = layout_table().find(record.keyword))
                ModelReader::list_fields(record, *layout, report);
}

std::vector<Message> unsupported_keywords(const Report& report)
{
    std::vector<Message> messages;
    for (const auto& [name, use] : report.keywords) {
        if (use.status == KeywordStatus::run || use.status == KeywordStatus::ignored) continue;
        std::string why = use.status == KeywordStatus::unknown ? unknown_keyword(name)
                          : use.reason.empty()                 ? "read, but this physics is not run yet"
                                                               : "not supported: " + use.reason;
        messages.push_back({use.first, name, "", std::move(why)});
    }
    std::sort(messages.begin(), messages.end(), [](const Message& a, const Message& b) {
        return std::pair(a.where.file, a.where.line) < std::pair(b.where.file, b.where.line);
    });
    return messages;
}

std::string to_text(const Message& message, const Model& model)
{
    std::string text = model.place(message.where);
    if (!text.empty()) text += ": ";
    if (!message.keyword.empty()) text += "*" + message.keyword;
    if (!message.field.empty()) text += (message.keyword.empty() ? "" : ", ") + ("field " + message.field);
    if (!message.keyword.empty() || !message.field.empty()) text += ": ";
    return text + message.text;
}

} // namespace plash

// *DATABASE family: which results, how often, for which nodes and elements.

#include "parser/reading.h"

#include <fmt/format.h>

namespace plash {
namespace {

std::string lower(std::string_view text)
{
    std::string result(text);
    for (char& character : result)
        if (character >= 'A' && character <= 'Z') character += 'a' - 'A';
    return result;
}

OutputRequest request_of(const Record& record, std::string_view curve, Reading& reading)
{
    OutputRequest request;
    request.where = record.where;
    request.interval = record.real("DT");
    if (request.interval < 0) reading.error(record, "DT", "the interval is negative");
    if (record.peek("BINARY")) request.binary = static_cast<int>(record.integer("BINARY"));
    if (!curve.empty()) request.interval_curve = reading.find(record, curve, Kind::curve);
    return request;
}

void read_ascii(const Record& record, const Block&, Reading& reading)
{
    const std::string name =
        lower(std::string_view(record.keyword).substr(std::string_view("DATABASE_").size()));
    reading.model.controls.output.ascii[name] = request_of(record, "LCUR", reading);
}

/// NPLTC asks for a number of states instead of an interval.
void read_d3plot(const Record& record, const Block&, Reading& reading)
{
    OutputRequest& request = reading.model.controls.output.d3plot;
    request = request_of(record, "LCDT", reading);
    request.states = static_cast<int>(record.integer("NPLTC"));
}

void read_extent(const Record& record, const Block&, Reading& reading)
{
    // What output/d3plot_layout.cpp takes into account; other fields stay unread and are reported.
    for (const char* field : {"MAXINT", "SIGFLG", "EPSFLG", "RLTFLG", "ENGFLG", "IEVERP"})
        reading.model.controls.output.extent[field] = record.real(field);
}

/// Positions of the nodes or elements that a history names, directly or by sets.
void read_history(const Record& record, Kind kind, Kind set_kind, std::vector<Index>& chosen,
                  Reading& reading)
{
    const Table* table = record.table("ID");
    if (!table) return;
    const bool sets = record.keyword.ends_with("_SET");
    for (std::size_t row = 0; row < table->rows(); ++row) {
        const Id id = static_cast<Id>(table->at(row, 0));
        if (id == 0) continue;
        const Index found = reading.table(sets ? set_kind : kind).find(id);
        if (found == none) continue; // reported with all references
        if (!sets) {
            chosen.push_back(found);
            continue;
        }
        const Model& model = reading.model;
        const std::vector<Index>& members = set_kind == Kind::node_set    ? model.node_sets[found].nodes
                                            : set_kind == Kind::shell_set ? model.shell_sets[found].elements
                                            : set_kind == Kind::beam_set  ? model.beam_sets[found].elements
                                                                          : model.solid_sets[found].elements;
        chosen.insert(chosen.end(), members.begin(), members.end());
    }
}

void read_node_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::node, Kind::node_set, reading.model.controls.output.history_nodes, reading);
}

void read_shell_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::shell, Kind::shell_set, reading.model.controls.output.history_shells, reading);
}

void read_beam_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::beam, Kind::beam_set, reading.model.controls.output.history_beams, reading);
}

void read_solid_history(const Record& record, const Block&, Reading& reading)
{
    read_history(record, Kind::solid, Kind::solid_set, reading.model.controls.output.history_solids, reading);
}

constexpr Translator keywords[] = {
    {"DATABASE_GLSTAT", Phase::conditions, read_ascii},
    {"DATABASE_MATSUM", Phase::conditions, read_ascii},
    {"DATABASE_NODOUT", Phase::conditions, read_ascii},
    {"DATABASE_ELOUT", Phase::conditions, read_ascii},
    {"DATABASE_RWFORC", Phase::conditions, read_ascii},
    {"DATABASE_SPCFORC", Phase::conditions, read_ascii},
    {"DATABASE_BNDOUT", Phase::conditions, read_ascii},
    {"DATABASE_BINARY_D3PLOT", Phase::conditions, read_d3plot},
    {"DATABASE_EXTENT_BINARY", Phase::conditions, read_extent},
    {"DATABASE_HISTORY_NODE", Phase::conditions, read_node_history},
    {"DATABASE_HISTORY_NODE_ID", Phase::conditions, read_node_history},
    {"DATABASE_HISTORY_NODE_SET", Phase::conditions, read_node_history},
    {"DATABASE_HISTORY_SHELL", Phase::conditions, read_shell_history},
    {"DATABASE_HISTORY_SHELL_ID", Phase::conditions, read_shell_history},
    {"DATABASE_HISTORY_SHELL_SET", Phase::conditions, read_shell_history},
    {"DATABASE_HISTORY_BEAM", Phase::conditions, read_beam_history},
    {"DATABASE_HISTORY_BEAM_ID", Phase::conditions, read_beam_history},
    {"DATABASE_HISTORY_BEAM_SET", Phase::conditions, read_beam_history},
    {"DATABASE_SWFORC", Phase::conditions, read_ascii},
    {"DATABASE_HISTORY_SOLID", Phase::conditions, read_solid_history},
    {"DATABASE_HISTORY_SOLID_ID", Phase::conditions, read_solid_history},
    {"DATABASE_HISTORY_SOLID_SET", Phase::conditions, read_solid_history},
};

} // namespace

std::span<const Translator> database_keywords()
{
    return keywords;
}

} // namespace plash

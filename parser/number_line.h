#pragma once

#include "parser/number.h"
#include "parser/reading.h"

namespace plash {

/// The numbers of a data line in the fixed columns of one card: the fast path of long lists. A line that is
/// not plain fixed columns (commas, parameters, tabs, faults) is cut and read like any other card.
class NumberLine {
public:
    /// The columns that hold numbers are those of `fields`; all three must outlive the line.
    NumberLine(const Block& block, Reading& reading, std::vector<FieldLayout> fields);

    /// False when a fault was reported. Missing columns are zero.
    bool read(std::string_view line, int number)
    {
        const char* at = line.data();
        const char* const end = at + line.size();
        bool plain = true;
        for (std::size_t i = 0; i < columns_.size() && plain; ++i) {
            const char* stop = end - at > columns_[i].width ? at + columns_[i].width : end;
            if (columns_[i].whole) {
                std::int64_t whole = 0;
                plain = (columns_[i].width == 8 && stop - at == 8 && parse_eight_digits(at, whole)) ||
                        parse_digits(at, stop, whole);
                values_[i] = static_cast<double>(whole != 0 ? whole + columns_[i].offset : 0);
            } else {
                values_[i] = 0;
                plain =
                    parse_real({at, static_cast<std::size_t>(stop - at)}, values_[i]) || is_blank(at, stop);
                values_[i] *= columns_[i].factor;
            }
            at = stop;
        }
        return plain || read_slowly(line, number);
    }

    double real(std::size_t column) const { return values_[column]; }
    Id id(std::size_t column) const { return static_cast<Id>(values_[column]); }

private:
    struct Column {
        int width;
        bool whole;
        Id offset;     ///< of the include, for numbers of things
        double factor; ///< of the include, from its units to those of the deck
    };

    static bool is_blank(const char* at, const char* stop)
    {
        while (at < stop && *at == ' ') ++at;
        return at == stop;
    }
    bool read_slowly(std::string_view line, int number);
    double factor_of(const FieldLayout& field) const;

    const Block& block_;
    Reading& reading_;
    std::vector<FieldLayout> fields_;
    std::vector<Column> columns_;
    std::vector<double> values_;
    std::vector<std::string_view> tokens_;
    CardCutter cutter_;
};

/// Turns the node and part numbers of element lines into positions; reports the missing ones.
class ElementIds {
public:
    ElementIds(const Block& block, Reading& reading) : block_(block), reading_(reading) {}

    /// Positions of the nodes from a column on; an empty column repeats the node before it (shapes with fewer
    /// corners). False when a node is missing.
    template <std::size_t Count>
    bool find_nodes(const NumberLine& numbers, std::size_t first_column, Id element, int line,
                    std::array<Index, Count>& nodes)
    {
        const IdTable& table = reading_.table(Kind::node);
        for (std::size_t i = 0; i < Count; ++i) {
            const Id id = numbers.id(first_column + i);
            nodes[i] = id == 0 && i > 0 ? nodes[i - 1] : table.find(id);
            if (nodes[i] == none) {
                report_node(element, i, id, line);
                return false;
            }
        }
        return true;
    }

    /// Position of the part; `none` after a report.
    Index find_part(Id id, Id element, int line);

    /// False, after a report, for element numbers that cannot be.
    bool is_number(Id element, int line);

private:
    void report_node(Id element, std::size_t corner, Id id, int line);

    const Block& block_;
    Reading& reading_;
    Id last_id_ = 0;
    Index last_part_ = none;
};

} // namespace plash

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plash {

using Id = std::int64_t;    ///< number as the deck gives it
using Index = std::int32_t; ///< position in one of the Model's arrays; `none` = no such thing
inline constexpr Index none = -1;

/// Where something stands in the deck.
struct Location {
    int file = none; ///< index into Model::files
    int line = 0;    ///< counted from 1
};

/// Lines that repeat below a definition's header (points of a curve, members of a set, layers of a shell):
/// values row by row.
struct Table {
    std::vector<std::string> columns; ///< manual names
    std::vector<double> values;       ///< rows x columns, row-major; 0 for text
    std::vector<std::string> text;    ///< as `values`, when a column holds text; else empty
    std::vector<int> lines;           ///< deck line of each row
    mutable bool read = false;        ///< some feature asked for it

    std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
    double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
};

/// One definition (section, material, equation of state, hourglass ...) as named values: the parameters that
/// the deck gave, with the layout's defaults filled in. Physics reads a value by its manual name; a value
/// that differs from its default and that nobody reads shows up in the report of ignored fields.
class Record {
public:
    struct Field {
        std::string name;          ///< manual name, e.g. "SIGY"; repeated fields are numbered: "EPS1"
        double value = 0;          ///< number, or 0 for text
        std::string text;          ///< text fields only
        bool given = false;        ///< written in the deck and different from the default
        mutable bool read = false; ///< some feature asked for it
        Location where;
    };

    std::string keyword; ///< canonical name without options, e.g. "MAT_PIECEWISE_LINEAR_PLASTICITY"
    Id id = 0;
    std::string title;
    Location where;
    std::vector<Field> fields;
    std::vector<Table> tables;

    /// Value of a field; `fallback` when the layout has no such field or the deck left it empty and the
    /// layout has no default.
    double real(std::string_view name, double fallback = 0) const;
    Id integer(std::string_view name, Id fallback = 0) const;
    std::string_view text(std::string_view name) const;
    /// Written in the deck with a value that is not the default. Counts as reading.
    bool given(std::string_view name) const;
    const Field* find(std::string_view name) const;
    /// The field without counting it as read: for checks that honour nothing.
    const Field* peek(std::string_view name) const;
    /// The table whose first column has this name; nullptr when the deck has no such lines.
    const Table* table(std::string_view first_column) const;
};

/// A number from a card where 0 asks for the default.
inline double value_or(double value, double fallback)
{
    return value != 0 ? value : fallback;
}

} // namespace plash

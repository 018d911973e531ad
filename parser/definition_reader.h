#pragma once

#include "parser/card.h"
#include "parser/condition.h"
#include "parser/deck.h"

namespace plash {

/// Reads the definitions of one block after another, each as a Record: titles, fields, tables.
class DefinitionReader {
public:
    /// All three must outlive the reader; the block's keyword must have a layout.
    DefinitionReader(const Block& block, const Parameters& parameters, Report& report);

    /// The next definition; false after the last one. Faults go to the report, the field then has its
    /// default.
    bool next(Record& record);

private:
    struct Value {
        double number = 0;
        std::string text;
        bool given = false;
    };

    bool peek(std::string_view& line) const;
    bool only_blank_lines_left() const;
    void read_options(int after, Record& record);
    void read_cards(const std::vector<CardLayout>& cards, Record& record, bool with_options);
    void read_card(const CardLayout& card, Record& record);
    void read_rows(const CardLayout& card, Record& record);
    void read_list(const CardLayout& card, Record& record);
    void read_row(const std::vector<CardLayout>& cards, const Record& record, Table& table, bool first);
    void add_absent(const CardLayout& card, Record& record);
    void cut_next_line(const std::vector<FieldLayout>& fields);
    Value value_of(const FieldLayout& field, std::string_view token, Location where);
    double in_units_of_the_deck(const FieldLayout& field, double number, Location where);
    bool holds(const CardLayout& card, const Record& record, std::string_view line) const;
    double evaluate(std::string_view expression, const Record& record) const;
    long count_of(const CardLayout& card, const Record& record) const;
    Location here() const { return {block_.where.file, cursor_.line()}; }

    const Block& block_;
    const KeywordLayout& layout_;
    const Parameters& parameters_;
    Report& report_;
    LineCursor cursor_;
    const char* last_data_; ///< behind it the block holds blank lines and comments only
    CardCutter cutter_;
    std::vector<std::string_view> tokens_;
    std::vector<std::pair<std::string, Value>> row_; ///< named values of the row being read, for conditions
    long definitions_ = 0;
};

} // namespace plash

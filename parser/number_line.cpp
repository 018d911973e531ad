#include "parser/number_line.h"

#include "parser/number.h"

#include <fmt/format.h>

#include <cmath>

namespace plash {

NumberLine::NumberLine(const Block& block, Reading& reading, std::vector<FieldLayout> fields)
    : block_(block), reading_(reading), fields_(std::move(fields)), values_(fields_.size())
{
    for (const FieldLayout& field : fields_)
        columns_.push_back({field_width(field, block.minimum_width), field.type == FieldType::integer,
                            block.transform ? block.transform->offset(field.kind) : 0, factor_of(field)});
}

double NumberLine::factor_of(const FieldLayout& field) const
{
    if (!block_.transform || field.name.empty() || field.type != FieldType::real) return 1;
    const std::optional<Dimension> dimension = dimension_of(block_.keyword.name, field.name);
    return dimension ? block_.transform->units.of(*dimension).value_or(1) : 1;
}

bool NumberLine::read_slowly(std::string_view line, int number)
{
    const Location where{block_.where.file, number};
    const std::string& keyword = block_.keyword.name;
    const Cut cut = cutter_.cut(line, fields_, block_.minimum_width, tokens_);
    if (const std::string_view warning = to_warning(cut); !warning.empty())
        reading_.report.warning(where, keyword, "", std::string(warning));
    bool fine = true;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        std::string_view text = trimmed(tokens_[i]);
        Substitution substitution;
        values_[i] = 0;
        if (text.empty()) continue;
        if (text.find_first_of("&<") < 2) {
            substitution = reading_.deck.parameters.substitute(text, block_.where.file);
            text = substitution.text;
        }
        std::string fault = substitution.error;
        if (fault.empty() && (!parse_real(text, values_[i]) || !std::isfinite(values_[i])))
            fault = fmt::format("'{}' is not a number", text);
        else if (fault.empty() && fields_[i].type == FieldType::integer &&
                 values_[i] != std::floor(values_[i]))
            fault = fmt::format("'{}' is not a whole number", text);
        else if (fault.empty() && fields_[i].type == FieldType::integer &&
                 std::abs(values_[i]) > largest_whole)
            fault = fmt::format("'{}' is too large for a whole number", text);
        if (fault.empty()) {
            if (values_[i] != 0) values_[i] += static_cast<double>(columns_[i].offset);
            values_[i] *= columns_[i].factor;
            continue;
        }
        reading_.report.error(where, keyword, fields_[i].name, fault);
        values_[i] = 0; // whoever goes on with the line gets no number that an id cannot hold
        fine = false;
    }
    return fine;
}

void ElementIds::report_node(Id element, std::size_t corner, Id id, int line)
{
    reading_.report.error({block_.where.file, line}, block_.keyword.name, fmt::format("N{}", corner + 1),
                          fmt::format("element {} has node {}, which is not defined", element, id));
}

Index ElementIds::find_part(Id id, Id element, int line)
{
    if (id == last_id_ && last_part_ != none) return last_part_;
    last_id_ = id;
    last_part_ = reading_.table(Kind::part).find(id);
    if (last_part_ == none)
        reading_.report.error({block_.where.file, line}, block_.keyword.name, "PID",
                              fmt::format("element {} is of part {}, which is not defined", element, id));
    return last_part_;
}

bool ElementIds::is_number(Id element, int line)
{
    if (element > 0) return true;
    reading_.report.error({block_.where.file, line}, block_.keyword.name, "EID",
                          "an element needs a positive number");
    return false;
}

} // namespace plash

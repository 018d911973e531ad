// Sections, materials, equations of state and hourglass controls stay Records: physics reads their fields by
// name.

#include "parser/reading.h"

namespace plash {
namespace {

void keep_section(const Record& record, const Block&, Reading& reading)
{
    reading.model.sections.push_back(record);
}

void keep_material(const Record& record, const Block&, Reading& reading)
{
    reading.model.materials.push_back(record);
}

void keep_equation_of_state(const Record& record, const Block&, Reading& reading)
{
    reading.model.equations_of_state.push_back(record);
}

void keep_hourglass(const Record& record, const Block&, Reading& reading)
{
    for (std::string_view field : {"QM", "QB/VDC", "QW"}) {
        if (const Record::Field* given = record.peek(field); given && given->given)
            reading.check_hourglass(record, field);
    }
    reading.model.hourglass.push_back(record);
}

constexpr Translator properties_table[] = {
    {"SECTION_*", Phase::properties, keep_section},
    {"MAT_ADD_*", Phase::conditions},
    {"MAT_NONLOCAL", Phase::conditions},
    {"MAT_THERMAL_*", Phase::conditions},
    {"MAT_*", Phase::properties, keep_material},
    {"EOS_*", Phase::properties, keep_equation_of_state},
    {"HOURGLASS", Phase::properties, keep_hourglass},
};

} // namespace

std::span<const Translator> property_keywords()
{
    return properties_table;
}

} // namespace plash

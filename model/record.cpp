#include "model/record.h"

#include <cmath>

namespace plash {

const Record::Field* Record::peek(std::string_view name) const
{
    // Cards that depend on a choice (ELFORM, say) may name the same field: the one that the deck gave counts.
    const Field* first = nullptr;
    for (const Field& field : fields) {
        if (field.name != name) continue;
        if (field.given) return &field;
        if (!first) first = &field;
    }
    return first;
}

const Record::Field* Record::find(std::string_view name) const
{
    const Field* field = peek(name);
    if (field) field->read = true;
    return field;
}

double Record::real(std::string_view name, double fallback) const
{
    const Field* field = find(name);
    return field ? field->value : fallback;
}

Id Record::integer(std::string_view name, Id fallback) const
{
    const Field* field = find(name);
    return field ? static_cast<Id>(std::llround(field->value)) : fallback;
}

std::string_view Record::text(std::string_view name) const
{
    const Field* field = find(name);
    return field ? std::string_view(field->text) : std::string_view();
}

bool Record::given(std::string_view name) const
{
    const Field* field = find(name);
    return field && field->given;
}

const Table* Record::table(std::string_view first_column) const
{
    for (const Table& table : tables) {
        if (!table.columns.empty() && table.columns.front() == first_column) {
            table.read = true;
            return &table;
        }
    }
    return nullptr;
}

} // namespace plash

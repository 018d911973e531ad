#pragma once

#include "model/record.h"

#include <string>
#include <utility>
#include <vector>

namespace plash {

/// A Record as the reader would give it, for models that tests build themselves.
inline Record make_record(std::string keyword, std::vector<std::pair<const char*, double>> values)
{
    Record record;
    record.keyword = std::move(keyword);
    record.id = 1;
    for (const auto& [name, value] : values) {
        Record::Field field;
        field.name = name;
        field.value = value;
        field.given = true;
        record.fields.push_back(std::move(field));
    }
    return record;
}

} // namespace plash

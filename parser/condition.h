#pragma once

#include <functional>
#include <string_view>

namespace plash {

/// A field's value for conditions: a number, or text.
struct ConditionValue {
    double number = 0;
    std::string_view text;
    bool is_text = false;
};

/// Looks a field up by name; an unknown name must come back as text of that name.
using FieldLookup = std::function<ConditionValue(std::string_view name)>;

/// Value of a layout's condition or count: numbers, field names, `+ - *`, `abs(x)`, `max(a,b)`, `== != < > <=
/// >=`, `x in 1,5,101..105`, `and`, `or`, parentheses. True is 1. Throws std::runtime_error on a mistake in
/// it.
double evaluate_condition(std::string_view condition, const FieldLookup& lookup);

} // namespace plash

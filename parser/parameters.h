#pragma once

#include "parser/report.h"

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

namespace plash {

/// What `&name`, `-&name` or `<expression>` in a field stands for.
struct Substitution {
    bool is_text = false; ///< a character parameter
    double number = 0;
    std::string text;  ///< the value as text, also of a number
    std::string error; ///< why there is no value; empty when all is well
};

/// The *PARAMETER values of a deck. Names are matched exactly first, then without regard to case. Each file
/// has its own scope for _LOCAL parameters, which hide global ones.
class Parameters {
public:
    /// --set NAME=VALUE: wins over every definition in the deck. False when VALUE is empty.
    bool set_override(std::string_view name, std::string_view value);

    /// *PARAMETER_DUPLICATION DFLAG: 1 warn and keep the first (default), 2 warn and take the new one, 3
    /// error, 4 take the new one silently, 5 keep the first silently.
    void set_duplication(int flag) { duplication_ = flag; }

    /// One definition; `name` still carries its type letter (R, I or C). `local_scope`: a file, or `none`.
    void define(std::string_view name, std::string_view value, bool expression, int local_scope,
                int file_scope, Location where, Report& report);

    /// The value of a field's text that holds `&` or `<`, as seen from a file.
    Substitution substitute(std::string_view token, int file_scope) const;

    /// Values of an expression, `&` before names optional.
    bool evaluate(std::string_view expression, int file_scope, double& value, std::string& error) const;

    /// Names given by --set that no definition and no use in the deck has asked for.
    std::vector<std::string> unused_overrides() const;

private:
    struct Value {
        char type = 'R';
        double number = 0;
        std::string text;
        Location where;
    };
    using Scope = std::map<std::string, Value, std::less<>>;

    const Value* find(std::string_view name, int file_scope) const;
    static const Value* find_in(const Scope& scope, std::string_view name);
    const std::string* override_of(std::string_view name) const;

    Scope global_;
    std::unordered_map<int, Scope> local_;
    struct Override {
        std::string text;
        mutable bool used = false;
    };
    std::map<std::string, Override, std::less<>> overrides_;
    int duplication_ = 1;
};

} // namespace plash

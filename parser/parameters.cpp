#include "parser/parameters.h"

#include "parser/number.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <strings.h>

namespace plash {
namespace {

bool same_ignoring_case(std::string_view a, std::string_view b)
{
    return a.size() == b.size() && strncasecmp(a.data(), b.data(), a.size()) == 0;
}

double sign_of(double magnitude, double sign)
{
    return std::copysign(magnitude, sign);
}
double truncated(double value)
{
    return std::trunc(value);
}
double rounded(double value)
{
    return std::round(value);
}
double remainder_of(double value, double divisor)
{
    return std::fmod(value, divisor);
}

/// Fortran's power operator, names with `&` and blanks as muparser wants them.
std::string to_muparser(std::string_view expression)
{
    std::string text;
    for (std::size_t i = 0; i < expression.size(); ++i) {
        if (expression[i] == '*' && i + 1 < expression.size() && expression[i + 1] == '*') {
            text += '^';
            ++i;
        } else if (expression[i] != '&') {
            text += expression[i];
        }
    }
    return text;
}

} // namespace

bool Parameters::set_override(std::string_view name, std::string_view value)
{
    if (name.empty() || value.empty()) return false;
    overrides_[std::string(name)].text = value;
    return true;
}

const std::string* Parameters::override_of(std::string_view name) const
{
    for (const auto& [known, value] : overrides_) {
        if (!same_ignoring_case(known, name)) continue;
        value.used = true;
        return &value.text;
    }
    return nullptr;
}

std::vector<std::string> Parameters::unused_overrides() const
{
    std::vector<std::string> names;
    for (const auto& [name, value] : overrides_)
        if (!value.used) names.push_back(name);
    return names;
}

const Parameters::Value* Parameters::find_in(const Scope& scope, std::string_view name)
{
    if (const auto exact = scope.find(name); exact != scope.end()) return &exact->second;
    for (const auto& [known, value] : scope)
        if (same_ignoring_case(known, name)) return &value;
    return nullptr;
}

const Parameters::Value* Parameters::find(std::string_view name, int file_scope) const
{
    if (const auto local = local_.find(file_scope); local != local_.end())
        if (const Value* value = find_in(local->second, name)) return value;
    return find_in(global_, name);
}

void Parameters::define(std::string_view name, std::string_view value, bool expression, int local_scope,
                        int file_scope, Location where, Report& report)
{
    const std::string_view keyword = expression ? "PARAMETER_EXPRESSION" : "PARAMETER";
    name = trimmed(name);
    value = trimmed(value);
    const std::string_view written = name;
    Value definition;
    definition.type = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    definition.where = where;
    name = trimmed(name.substr(1));
    if (definition.type != 'R' && definition.type != 'I' && definition.type != 'C') {
        report.error(where, keyword, "PRMR",
                     fmt::format("'{}' must start with R (real), I (integer) or C (text)", written));
        return;
    }
    if (name.empty()) {
        report.error(where, keyword, "PRMR", "a parameter needs a name behind its type letter");
        return;
    }
    if (const std::string* forced = override_of(name)) {
        value = *forced;
        expression = false;
    }

    Scope& scope = local_scope == none ? global_ : local_[local_scope];
    if (const auto earlier = scope.find(name); earlier != scope.end()) {
        const std::string what = fmt::format("parameter '{}' is defined again", name);
        if (duplication_ == 3) {
            report.error(where, keyword, "PRMR", what + " (*PARAMETER_DUPLICATION asks for an error)");
            return;
        }
        if (duplication_ == 1) report.warning(where, keyword, "PRMR", what + ": the first value is kept");
        if (duplication_ == 2) report.warning(where, keyword, "PRMR", what + ": the new value is taken");
        if (duplication_ == 1 || duplication_ == 5) return;
    }

    if (definition.type == 'C') {
        definition.text = value;
    } else {
        std::string error;
        if (!expression && value.find_first_of("&<") != std::string_view::npos) {
            Substitution substitution = substitute(value, file_scope);
            definition.number = substitution.number;
            error = substitution.error;
        } else if (expression) {
            evaluate(value, file_scope, definition.number, error);
        } else if (!parse_real(value, definition.number)) {
            error = fmt::format("'{}' is not a number", value);
        }
        if (!error.empty()) {
            report.error(where, keyword, std::string(name), error);
            return;
        }
        if (definition.type == 'I') definition.number = std::trunc(definition.number);
    }
    scope.insert_or_assign(std::string(name), std::move(definition));
}

bool Parameters::evaluate(std::string_view expression, int file_scope, double& value,
                          std::string& error) const
{
    if (trimmed(expression).empty()) {
        error = "the expression is empty";
        return false;
    }
    try {
        mu::Parser parser;
        parser.DefineFun("mod", remainder_of);
        parser.DefineFun("int", truncated);
        parser.DefineFun("aint", truncated);
        parser.DefineFun("nint", rounded);
        parser.DefineFun("anint", rounded);
        parser.DefineFun(
            "float", +[](double x) { return x; });
        parser.DefineFun(
            "dble", +[](double x) { return x; });
        parser.DefineFun(
            "ceiling", +[](double x) { return std::ceil(x); });
        parser.DefineFun(
            "floor", +[](double x) { return std::floor(x); });
        parser.DefineFun(
            "log", +[](double x) { return std::log(x); });
        parser.DefineFun("sign", sign_of);
        parser.DefineConst("pi", 3.14159265358979323846);
        parser.DefineConst("PI", 3.14159265358979323846);
        // Parameters are looked up as the expression names them.
        struct Lookup {
            const Parameters* parameters;
            int scope;
            std::deque<double> values;
            std::string missing;
        } lookup{this, file_scope, {}, {}};
        parser.SetVarFactory(
            [](const char* name, void* data) -> double* {
                auto& found = *static_cast<Lookup*>(data);
                const Value* parameter = found.parameters->find(name, found.scope);
                if (!parameter && found.missing.empty()) found.missing = name;
                return &found.values.emplace_back(parameter ? parameter->number : 0);
            },
            &lookup);
        parser.SetExpr(to_muparser(trimmed(expression)));
        value = parser.Eval();
        if (!lookup.missing.empty()) {
            error = fmt::format("there is no parameter '{}'", lookup.missing);
            return false;
        }
    } catch (const mu::Parser::exception_type& failure) {
        error = fmt::format("'{}' is not an expression: {}", trimmed(expression), failure.GetMsg());
        return false;
    }
    if (!std::isfinite(value)) {
        error = fmt::format("'{}' has no finite value", trimmed(expression));
        return false;
    }
    return true;
}

Substitution Parameters::substitute(std::string_view token, int file_scope) const
{
    Substitution result;
    std::string_view rest = trimmed(token);
    bool negative = false;
    if (rest.size() > 1 && (rest.front() == '-' || rest.front() == '+')) {
        negative = rest.front() == '-';
        rest = trimmed(rest.substr(1));
    }
    if (!rest.empty() && rest.front() == '<') {
        const auto end = rest.find('>');
        if (end == std::string_view::npos) {
            result.error = fmt::format("'{}' lacks a closing '>'", rest);
            return result;
        }
        evaluate(rest.substr(1, end - 1), file_scope, result.number, result.error);
    } else {
        if (!rest.empty() && rest.front() == '&') rest.remove_prefix(1);
        if (rest.find_first_of("*/+(") != std::string_view::npos) {
            evaluate(rest, file_scope, result.number, result.error); // &length*0.5
            if (negative) result.number = -result.number;
            result.text = fmt::format("{}", result.number);
            return result;
        }
        const Value* value = find(rest, file_scope);
        if (!value) {
            result.error = fmt::format("there is no parameter '{}'", rest);
            return result;
        }
        result.is_text = value->type == 'C';
        result.number = value->number;
        result.text = value->text;
    }
    if (negative) result.number = -result.number;
    if (!result.is_text) result.text = fmt::format("{}", result.number);
    return result;
}

} // namespace plash

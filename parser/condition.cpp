#include "parser/condition.h"

#include "parser/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plash {
namespace {

bool is_letter(char character)
{
    return (character >= 'A' && character <= 'Z') || (character >= 'a' && character <= 'z') ||
           character == '_';
}

/// Recursive descent, one function per level of precedence.
class Evaluator {
public:
    Evaluator(std::string_view text, const FieldLookup& lookup) : rest_(text), lookup_(lookup) {}

    double whole()
    {
        const double value = any();
        skip();
        if (!rest_.empty()) fail();
        return value;
    }

private:
    [[noreturn]] void fail() const
    {
        throw std::runtime_error(fmt::format("bad condition near '{}'", rest_));
    }

    void skip()
    {
        while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    }

    bool take(std::string_view token)
    {
        skip();
        if (!rest_.starts_with(token)) return false;
        if (is_letter(token.front()) && rest_.size() > token.size() && is_letter(rest_[token.size()]))
            return false;
        rest_.remove_prefix(token.size());
        return true;
    }

    double any()
    {
        double value = all();
        while (take("or")) {
            const double right = all();
            value = value != 0 || right != 0;
        }
        return value;
    }

    double all()
    {
        double value = comparison();
        while (take("and")) {
            const double right = comparison();
            value = value != 0 && right != 0;
        }
        return value;
    }

    static bool equal(const ConditionValue& a, const ConditionValue& b)
    {
        if (a.is_text || b.is_text) return a.is_text && b.is_text && a.text == b.text;
        return a.number == b.number;
    }

    double comparison()
    {
        const ConditionValue left = sum();
        if (take("in")) {
            bool found = false;
            do {
                const ConditionValue first = sum();
                if (take("..")) {
                    const double last = sum().number;
                    found = found || (left.number >= first.number && left.number <= last);
                } else {
                    found = found || equal(left, first);
                }
            } while (take(","));
            return found;
        }
        if (take("==")) return equal(left, sum());
        if (take("!=")) return !equal(left, sum());
        if (take("<=")) return left.number <= sum().number;
        if (take(">=")) return left.number >= sum().number;
        if (take("<")) return left.number < sum().number;
        if (take(">")) return left.number > sum().number;
        return left.is_text ? !left.text.empty() : left.number;
    }

    ConditionValue sum()
    {
        ConditionValue value = product();
        for (;;) {
            if (take("+"))
                value.number += product().number;
            else if (take("-"))
                value.number -= product().number;
            else
                return value;
        }
    }

    ConditionValue product()
    {
        ConditionValue value = factor();
        while (take("*")) value.number *= factor().number;
        return value;
    }

    ConditionValue factor()
    {
        skip();
        if (take("-")) return {-factor().number, {}, false};
        if (take("(")) {
            const double value = any();
            if (!take(")")) fail();
            return {value, {}, false};
        }
        if (rest_.empty()) fail();
        if (is_digit(rest_.front())) {
            std::size_t length = 1;
            while (length < rest_.size() &&
                   (is_digit(rest_[length]) || (rest_[length] == '.' && rest_.substr(length, 2) != "..")))
                ++length;
            double value = 0;
            parse_real(rest_.substr(0, length), value);
            rest_.remove_prefix(length);
            return {value, {}, false};
        }
        std::size_t length = 0;
        while (length < rest_.size() && (is_letter(rest_[length]) || is_digit(rest_[length]))) ++length;
        if (length == 0) fail();
        const std::string_view name = rest_.substr(0, length);
        rest_.remove_prefix(length);
        if (name == "abs" || name == "max") return function(name);
        return lookup_(name);
    }

    ConditionValue function(std::string_view name)
    {
        if (!take("(")) fail();
        double value = sum().number;
        if (name == "abs") {
            value = std::abs(value);
        } else {
            if (!take(",")) fail();
            value = std::max(value, sum().number);
        }
        if (!take(")")) fail();
        return {value, {}, false};
    }

    std::string_view rest_;
    const FieldLookup& lookup_;
};

} // namespace

double evaluate_condition(std::string_view condition, const FieldLookup& lookup)
{
    return Evaluator(condition, lookup).whole();
}

} // namespace plash

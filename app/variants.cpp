#include "app/variants.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>

namespace plash {

std::string Variant::name() const
{
    return name_without("");
}

std::string Variant::name_without(const std::string& parameter) const
{
    std::string text;
    for (const auto& [name, value] : settings) {
        if (name == parameter) continue;
        text += fmt::format("{}{}={}", text.empty() ? "" : "_", name, value);
    }
    std::replace(text.begin(), text.end(), '/', '-');
    return text.empty() ? "deck" : text;
}

std::string Variant::value(const std::string& parameter) const
{
    for (const auto& [name, value] : settings) {
        if (name == parameter) return value;
    }
    return "";
}

std::vector<Variant> variants_of(const std::vector<std::string>& vary)
{
    std::vector<Variant> variants = {Variant{}};
    for (const std::string& text : vary) {
        const auto sign = text.find('=');
        const std::string name = text.substr(0, sign);
        std::vector<std::string> values;
        std::istringstream rest(sign == std::string::npos ? "" : text.substr(sign + 1));
        for (std::string value; std::getline(rest, value, ',');) {
            if (!value.empty()) values.push_back(value);
        }
        if (name.empty() || values.empty())
            throw std::invalid_argument("'" + text + "' must be NAME=VALUE,VALUE,...");
        if (!variants.front().value(name).empty())
            throw std::invalid_argument("'" + name + "' is varied twice");
        std::vector<Variant> grown;
        for (const Variant& variant : variants) {
            for (const std::string& value : values) {
                grown.push_back(variant);
                grown.back().settings.emplace_back(name, value);
            }
        }
        variants = std::move(grown);
    }
    return variants;
}

} // namespace plash

#include "picture/diagram_file.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace plash {

namespace {

constexpr std::array<std::array<double, 3>, 8> palette = {{{0.12, 0.44, 0.71},
                                                           {0.82, 0.33, 0.17},
                                                           {0.23, 0.60, 0.36},
                                                           {0.54, 0.36, 0.71},
                                                           {0.72, 0.53, 0.04},
                                                           {0.16, 0.64, 0.64},
                                                           {0.76, 0.28, 0.50},
                                                           {0.33, 0.38, 0.43}}};

std::vector<std::string> groups_of(const std::string& line)
{
    std::vector<std::string> groups;
    std::istringstream rest(line);
    for (std::string group; std::getline(rest, group, '\t');) groups.push_back(group);
    return groups;
}

/// The place of a name among those that have come up; a new one is added.
std::size_t number_of(const std::string& name, std::vector<std::string>& names)
{
    const auto known = std::find(names.begin(), names.end(), name);
    const std::size_t number = known - names.begin();
    if (known == names.end()) names.push_back(name);
    return number;
}

bool read_number(const std::string& text, double& value)
{
    char* end = nullptr;
    value = std::strtod(text.c_str(), &end);
    return end != text.c_str() && *end == '\0';
}

} // namespace

std::vector<Plot> read_diagrams(const std::string& path)
{
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + " cannot be read");
    std::vector<Plot> plots;
    std::vector<std::string> names;
    std::size_t number = 0;
    for (std::string text; std::getline(file, text);) {
        ++number;
        const auto groups = groups_of(text);
        if (groups.empty()) continue;
        double x = 0, y = 0;
        if (groups[0] == "plot" && groups.size() == 4) {
            plots.push_back({groups[1], groups[2], groups[3], {}});
        } else if (groups[0] == "line" && groups.size() >= 2 && !plots.empty()) {
            auto& lines = plots.back().lines;
            const bool markers = groups.size() > 2 && groups[2] == "markers";
            const auto& colour = palette[number_of(groups[1], names) % palette.size()];
            lines.push_back({groups[1], {}, {}, colour, markers});
        } else if (groups.size() == 2 && read_number(groups[0], x) && read_number(groups[1], y) &&
                   !plots.empty() && !plots.back().lines.empty()) {
            plots.back().lines.back().x.push_back(x);
            plots.back().lines.back().y.push_back(y);
        } else {
            throw std::runtime_error(path + ":" + std::to_string(number) + ": '" + text +
                                     "' is no line of a diagram file");
        }
    }
    if (plots.empty()) throw std::runtime_error(path + " holds no diagram");
    return plots;
}

} // namespace plash

#include "picture/diagram_file.h"
#include "picture/run_results.h"
#include "picture/strip.h"
#include "picture/virtual_display.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

namespace {

using namespace plash;

/// Numbers separated by commas.
std::vector<double> numbers(const std::string& text, const std::string& option)
{
    std::vector<double> values;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');) {
        std::size_t used = 0;
        try {
            values.push_back(std::stod(word, &used));
        } catch (const std::exception&) {
            used = 0;
        }
        if (used == 0 || used != word.size()) {
            throw std::runtime_error(option + " wants numbers separated by commas, not '" + text + "'");
        }
    }
    return values;
}

std::vector<double> numbers(const std::string& text, const std::string& option, std::size_t count)
{
    std::vector<double> values = numbers(text, option);
    if (values.size() != count) {
        throw std::runtime_error(option + " wants " + std::to_string(count) + " numbers, not '" + text + "'");
    }
    return values;
}

std::array<double, 3> direction(const std::string& view)
{
    static const std::map<std::string, std::array<double, 3>> named = {
        {"iso", {1, -1.6, 0.9}}, {"x", {1, 0, 0}}, {"-x", {-1, 0, 0}}, {"y", {0, 1, 0}},
        {"-y", {0, -1, 0}},      {"z", {0, 0, 1}}, {"-z", {0, 0, -1}},
    };
    if (const auto found = named.find(view); found != named.end()) return found->second;
    const std::vector<double> v = numbers(view, "--view", 3);
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) throw std::runtime_error("--view 0,0,0 is no direction");
    return {v[0], v[1], v[2]};
}

/// Where the eye is when nobody says: a plane model is seen from in front of its plane.
std::array<double, 3> own_direction(const std::vector<Surface>& surfaces)
{
    std::array<double, 3> size;
    for (int i = 0; i < 3; ++i) {
        float low = surfaces.front().bounds[0][i], high = surfaces.front().bounds[1][i];
        for (const Surface& surface : surfaces) {
            low = std::min(low, surface.bounds[0][i]);
            high = std::max(high, surface.bounds[1][i]);
        }
        size[i] = high - low;
    }
    const double largest = *std::max_element(size.begin(), size.end());
    const auto thin = [&](int axis) { return size[axis] <= 0.02 * largest; };
    if (thin(2) && !thin(0) && !thin(1)) return direction("z");
    if (thin(1) && !thin(0) && !thin(2)) return direction("-y");
    if (thin(0) && !thin(1) && !thin(2)) return direction("x");
    return direction("iso");
}

/// What to colour by when nobody says: von Mises stress, or the pressure where that is all there is, as in
/// water.
Quantity own_quantity(RunResults& results, const std::vector<std::size_t>& states)
{
    const auto largest = [&](Quantity quantity) {
        float most = 0;
        for (std::size_t state : states) {
            const Surface surface = results.surface(state, quantity);
            for (float value : surface.values()) most = std::max(most, value);
        }
        return most;
    };
    const bool fluid = largest(Quantity::von_mises) < 1e-3f * largest(Quantity::pressure);
    return fluid ? Quantity::pressure : Quantity::von_mises;
}

std::string folder_name(const std::string& directory)
{
    return std::filesystem::weakly_canonical(directory).filename().string();
}

std::size_t nearest(const std::vector<double>& times, double time)
{
    const auto closer = [&](double a, double b) { return std::abs(a - time) < std::abs(b - time); };
    return std::min_element(times.begin(), times.end(), closer) - times.begin();
}

/// States to show: those nearest to the wanted times, or `count` spread evenly over the run; each once.
std::vector<std::size_t> chosen_states(const std::vector<double>& times, const std::string& wanted, int count)
{
    std::vector<double> targets;
    if (!wanted.empty()) {
        targets = numbers(wanted, "--times");
    } else {
        for (int i = 0; i < count; ++i) {
            const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 1;
            targets.push_back(times.front() + share * (times.back() - times.front()));
        }
    }
    std::vector<std::size_t> states;
    for (double target : targets) {
        const std::size_t state = nearest(times, target);
        if (std::find(states.begin(), states.end(), state) == states.end()) states.push_back(state);
    }
    return states;
}

} // namespace

int main(int argument_count, char** arguments)
{
    CLI::App program{"Draws a run's model at several times into one PNG file", "plash picture"};
    std::string directory, field, times, view, output, range, title;
    int frames = 4, width = 1800;
    bool without_edges = false, diagrams = false;
    program.add_option("DIR", directory, "result folder of a run")->required();
    program.add_flag("--diagrams", diagrams,
                     "DIR is a file of diagrams (picture/diagram_file.h) to draw into -o");
    program.add_option(
        "-f,--field", field,
        "von_mises, plastic_strain, pressure, velocity or displacement; without it the von Mises "
        "stress, or the pressure where there is none");
    program.add_option("-t,--times", times, "times to show, separated by commas");
    program.add_option("-n,--frames", frames, "number of times, evenly spread, without --times")
        ->capture_default_str()
        ->check(CLI::Range(1, 24));
    program.add_option(
        "-v,--view", view,
        "where the eye is: iso, x, -x, y, -y, z, -z or a direction x,y,z; without it in front of "
        "a plane model, else iso");
    program.add_option("-r,--range", range, "ends of the colour scale: low,high");
    program.add_option("-o,--output", output, "PNG file; without it picture.png in DIR");
    program.add_option("--title", title, "instead of the deck's title");
    program.add_option("--width", width, "of the picture in pixels")
        ->capture_default_str()
        ->check(CLI::Range(300, 8000));
    program.add_flag("--no-edges", without_edges, "draw no edges of elements");
    try {
        program.parse(argument_count, arguments);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : 2;
    }

    try {
        if (diagrams) {
            if (output.empty()) throw std::runtime_error("--diagrams needs -o FILE.png");
            const std::vector<Plot> plots = read_diagrams(directory);
            const VirtualDisplay display;
            draw_plots(plots, plots.size() == 1 ? 1 : 2, width, output);
            return 0;
        }
        StripStyle style;
        if (!view.empty()) style.from = direction(view);
        if (!range.empty()) {
            const std::vector<double> ends = numbers(range, "--range", 2);
            style.range = {ends[0], ends[1]};
        }
        RunResults results(directory);
        std::vector<Surface> surfaces;
        const std::vector<std::size_t> states = chosen_states(results.times(), times, frames);
        const Quantity quantity = field.empty() ? own_quantity(results, states) : quantity_named(field);
        for (std::size_t state : states) surfaces.push_back(results.surface(state, quantity));
        if (view.empty()) style.from = own_direction(surfaces);
        style.title = !title.empty()             ? title
                      : !results.title().empty() ? results.title()
                                                 : folder_name(directory);
        style.legend = title_of(quantity);
        if (quantity == Quantity::pressure) style.beyond = 0.005; // single particles in spray
        style.width = width;
        style.edges = !without_edges && surfaces.front().polygons.size() < 60000;
        if (output.empty()) output = (std::filesystem::path(directory) / "picture.png").string();
        const VirtualDisplay display;
        draw_strip(surfaces, results.walls(), style, output);
        std::printf("%s\n", output.c_str());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "plash picture: %s\n", error.what());
        return 1;
    }
}

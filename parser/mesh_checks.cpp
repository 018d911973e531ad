#include "parser/mesh_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plash {
namespace {

/// Elements of one fault that are named; the others are counted.
constexpr int most_named = 5;

/// Names the first elements with a fault and counts the rest, part by part.
class FaultyElements {
public:
    FaultyElements(const Model& model, std::string_view kind, std::string_view fault)
        : model_(model), kind_(kind), fault_(fault)
    {}

    void add(Id element, Index part)
    {
        if (++count_ <= most_named) names_ += fmt::format("{}{}", names_.empty() ? "" : ", ", element);
        if (part_ == none) part_ = part;
    }

    void report(std::string_view keyword, Report& report) const
    {
        if (count_ == 0) return;
        const Part& part = model_.parts[part_];
        std::string others;
        if (count_ > most_named) others = fmt::format(" and {} more", count_ - most_named);
        report.error(part.where, keyword, "",
                     fmt::format("{} {}{} (part {} '{}' first): {}", kind_, names_, others, part.id,
                                 part.title, fault_));
    }

private:
    const Model& model_;
    std::string_view kind_, fault_;
    std::string names_;
    long count_ = 0;
    Index part_ = none;
};

/// Volume inside the six faces of a hexahedron, each taken as the mean of its two triangulations; degenerate
/// shapes included [length^3]. Three triple products in place of 24 (Grandy 1997, the tetrakis form).
double volume_of(const std::array<Index, 8>& nodes, const std::vector<Vec3>& position)
{
    const auto side = [&](int to, int from) { return position[nodes[to]] - position[nodes[from]]; };
    const auto triple = [](const Vec3& u, const Vec3& v, const Vec3& w) { return dot(u, cross(v, w)); };
    return (triple(side(3, 1) + side(7, 2), side(6, 3), side(2, 0)) +
            triple(side(4, 3) + side(5, 7), side(6, 4), side(7, 0)) +
            triple(side(1, 4) + side(2, 5), side(6, 1), side(5, 0))) /
           12;
}

/// Cohesive layers may have no thickness at the start.
bool may_be_flat(const Model& model, Index part)
{
    const Index section = model.parts[part].section;
    if (section == none) return false;
    const Record::Field* formulation = model.sections[section].peek("ELFORM");
    const double number = formulation ? std::abs(formulation->value) : 0;
    return number >= 19 && number <= 22;
}

/// `elements`: anything with a volume; `kind` and `keyword` name it in messages.
template <class ElementList>
void check_volumes(const ElementList& elements, std::string_view kind, std::string_view keyword,
                   const Model& model, Report& report)
{
    FaultyElements flat(model, kind, "no volume: corners coincide or lie in one plane");
    FaultyElements inverted(model, kind, "negative volume: the corners are numbered inside out");
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& nodes = elements.nodes[i];
        const double volume = volume_of(nodes, model.nodes.position);
        double size = 0;
        for (Index node : nodes)
            size = std::max(size, norm(model.nodes.position[node] - model.nodes.position[nodes[0]]));
        // Round-off of the sum of triangles is some 1e-15 of the cube around the element.
        const double smallest = 1e-12 * size * size * size;
        if (volume > smallest || may_be_flat(model, elements.part[i])) continue;
        (volume < -smallest ? inverted : flat).add(elements.id[i], elements.part[i]);
    }
    flat.report(keyword, report);
    inverted.report(keyword, report);
}

void check_shells(const Model& model, Report& report)
{
    FaultyElements flat(model, "shell", "no area: corners coincide or lie on one line");
    FaultyElements crossed(model, "shell", "opposite corners are one node");
    for (std::size_t i = 0; i < model.shells.size(); ++i) {
        const auto& nodes = model.shells.nodes[i];
        const auto at = [&](int corner) { return model.nodes.position[nodes[corner]]; };
        const Vec3 first = at(2) - at(0), second = at(3) - at(1);
        const double area = norm(cross(first, second)) / 2;
        if (nodes[0] == nodes[2] || nodes[1] == nodes[3])
            crossed.add(model.shells.id[i], model.shells.part[i]);
        else if (area <= 1e-12 * std::max(dot(first, first), dot(second, second)))
            flat.add(model.shells.id[i], model.shells.part[i]);
    }
    flat.report("ELEMENT_SHELL", report);
    crossed.report("ELEMENT_SHELL", report);
}

/// Beams may have no length where their section is that of a discrete element (ELFORM 6), a scalar or a spot
/// weld.
void check_beams(const Model& model, Report& report)
{
    FaultyElements repeated(model, "beam", "both ends are one node");
    for (std::size_t i = 0; i < model.beams.size(); ++i)
        if (model.beams.nodes[i][0] == model.beams.nodes[i][1])
            repeated.add(model.beams.id[i], model.beams.part[i]);
    repeated.report("ELEMENT_BEAM", report);
}

/// Densities and sound speeds that solids and liquids have in a set of units, from cork to diamond.
struct Units {
    std::string_view names;
    double lowest_density, highest_density; // [mass/length^3]
    double lowest_speed, highest_speed;     // [velocity]
};

/// kg/m^3 between 10 and 30,000 and m/s between 1 and 20,000, converted.
constexpr Units known_units[] = {
    {"kg, m, s", 1e1, 3e4, 1, 2e4},
    {"t, mm, s", 1e-11, 3e-8, 1e3, 2e7},
    {"kg, mm, ms", 1e-8, 3e-5, 1e-3, 2e1},
    {"g, mm, ms", 1e-5, 3e-2, 1e-3, 2e1},
    {"g, cm, us", 1e-2, 3e1, 1e-4, 2},
    {"g, mm, s", 1e-5, 3e-2, 1e3, 2e7},
    {"kg, mm, s", 1e-8, 3e-5, 1e3, 2e7},
    {"g, cm, s", 1e-2, 3e1, 1e2, 2e6},
    {"lbf s2/in, in, s", 9e-7, 3e-3, 4e1, 8e5},
    {"slug, ft, s", 2e-2, 6e1, 3, 7e4},
};

} // namespace

void check_mesh(const Model& model, Report& report)
{
    check_volumes(model.solids, "solid", "ELEMENT_SOLID", model, report);
    check_volumes(model.thick_shells, "thick shell", "ELEMENT_TSHELL", model, report);
    check_shells(model, report);
    check_beams(model, report);
}

void check_units(const Model& model, Report& report)
{
    for (const Record& material : model.materials) {
        const Record::Field* density = material.peek("RO");
        const Record::Field* modulus = material.peek("E");
        if (!density || !modulus || density->value <= 0 || modulus->value <= 0) continue;
        if (material.keyword == "MAT_RIGID")
            continue; // its modulus only serves contacts, its density the mass
        const double speed = std::sqrt(modulus->value / density->value);
        const bool possible =
            std::any_of(std::begin(known_units), std::end(known_units), [&](const Units& units) {
                return density->value >= units.lowest_density && density->value <= units.highest_density &&
                       speed >= units.lowest_speed && speed <= units.highest_speed;
            });
        if (!possible)
            report.warning(
                modulus->where, material.keyword, "E",
                fmt::format(
                    "density {:g} and modulus {:g} of material {} give a sound speed of {:g}: no usual "
                    "set of units (kg m s, t mm s, kg mm ms, g mm ms, g cm us ...) has both",
                    density->value, modulus->value, material.id, speed));
    }
}

} // namespace plash

#include "elements/shell_mass.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

std::array<Index, 4> shell_corners(const Model& model, Index element)
{
    std::array<Index, 4> nodes = model.shells.nodes[element];
    for (int turn = 0; turn < 4 && nodes[2] != nodes[3]; ++turn) {
        const bool repeats = nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[3] == nodes[0];
        if (!repeats) break;
        std::rotate(nodes.begin(), nodes.begin() + 1, nodes.end());
    }
    return nodes;
}

std::span<const Layer> shell_layers(const Model& model, Index element)
{
    const ShellElements& shells = model.shells;
    if (!shells.layers.empty() && !shells.layers[element].empty()) return shells.layers[element];
    return model.parts[shells.part[element]].layers;
}

const Record& shell_section(const Model& model, const Part& part)
{
    if (part.section != none) return model.sections[part.section];
    if (part.composite != none) return model.others[part.composite];
    throw DeckError(part.where, fmt::format("*PART {} has shells but no *SECTION_SHELL", part.id));
}

ShellPlate shell_plate(const Model& model, const Part& part)
{
    const Record& section = shell_section(model, part);
    ShellPlate plate;
    plate.more_mass = section.real("MAREA");
    const Id formulation = section.integer("ELFORM", 2);
    if (formulation != 5 && formulation != 9) plate.reference = section.real("NLOC");
    if (part.material != none) plate.density = model.materials[part.material].real("RO");
    const double first = section.real("T1");
    for (const char* name : {"T1", "T2", "T3", "T4"}) {
        const double value = section.real(name);
        plate.thickness += 0.25 * (value > 0 ? value : first);
    }
    return plate;
}

namespace {

double thickness_of(const Model& model, Index element, const ShellPlate& plate)
{
    if (const auto layers = shell_layers(model, element); !layers.empty()) {
        double sum = 0;
        for (const Layer& layer : layers) sum += layer.thickness;
        return sum;
    }
    if (model.shells.thickness.empty() || !(model.shells.thickness[element][0] > 0)) return plate.thickness;
    const std::array<double, 4>& corner = model.shells.thickness[element];
    // Corners that the deck leaves empty have the thickness of the first.
    double sum = 0;
    for (double value : corner) sum += value > 0 ? value : corner[0];
    return 0.25 * sum;
}

ShellPlate plate_under(const Model& model, Index element)
{
    return shell_plate(model, model.parts[model.shells.part[element]]);
}

} // namespace

double shell_thickness(const Model& model, Index element)
{
    return thickness_of(model, element, plate_under(model, element));
}

ShellMass shell_mass(const Model& model, Index element)
{
    return shell_mass(model, element, plate_under(model, element));
}

ShellMass shell_mass(const Model& model, Index element, const ShellPlate& plate)
{
    const std::array<Index, 4> nodes = shell_corners(model, element);
    const auto at = [&](int corner) { return model.nodes.position[nodes[corner]]; };
    ShellMass result;
    result.area = 0.5 * norm(cross(at(2) - at(0), at(3) - at(1)));
    result.thickness = thickness_of(model, element, plate);
    double per_area = plate.more_mass;
    const auto layers = shell_layers(model, element);
    for (const Layer& layer : layers)
        per_area += model.materials[layer.material].real("RO") * layer.thickness;
    if (layers.empty()) per_area += plate.density * result.thickness;
    const bool triangle = nodes[2] == nodes[3];
    for (int corner = 0; corner < (triangle ? 3 : 4); ++corner) {
        result.corner_mass[corner] = per_area * result.area / (triangle ? 3 : 4);
    }
    result.offset = 0.5 * result.thickness * plate.reference;
    if (!model.shells.offset.empty()) result.offset -= model.shells.offset[element];
    const double own = result.thickness * result.thickness / 12 + result.offset * result.offset;
    result.squared_gyration = std::max(own, result.area / 8);
    return result;
}

} // namespace plash

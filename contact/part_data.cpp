#include "contact/part_data.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

double first_given(const Record& record, std::initializer_list<const char*> names)
{
    for (const char* name : names) {
        const Record::Field* field = record.find(name);
        if (field && field->value > 0) return field->value;
    }
    return 0;
}

double bulk_of_state_equation(const Record& state_equation, double density)
{
    const std::string& name = state_equation.keyword;
    if (name.find("LINEAR_POLYNOMIAL") != std::string::npos) return first_given(state_equation, {"C1"});
    if (name.find("GRUNEISEN") != std::string::npos) {
        const double speed = first_given(state_equation, {"C"});
        return density * speed * speed;
    }
    if (name.find("TABULATED") != std::string::npos) {
        // Slope of pressure over ln(volume) at the first compressive interval.
        for (int i = 1; i < 10; ++i) {
            const auto value = [&](const char* stem, int number) {
                return state_equation.real(stem + std::to_string(number));
            };
            const double strain = value("EV", i + 1) - value("EV", i);
            if (value("EV", i + 1) >= 0 || strain >= 0) continue;
            return -(value("C", i + 1) - value("C", i)) / strain;
        }
    }
    return first_given(state_equation, {"K0", "A", "C1"});
}

/// Shear modulus at small strains [stress].
double shear_modulus_of(const Record& material)
{
    const auto sum = [&](const char* a, const char* b) {
        return 2 * (first_given(material, {a}) + first_given(material, {b}));
    };
    if (material.keyword == "MAT_MOONEY-RIVLIN_RUBBER") return sum("A", "B");
    if (material.keyword == "MAT_HYPERELASTIC_RUBBER") return sum("C10", "C01"); // its G is one of damping
    if (material.keyword != "MAT_OGDEN_RUBBER") return first_given(material, {"G", "GI", "G0"});
    double half = 0;
    for (int i = 1; i <= 8; ++i) {
        half += 0.5 * material.real("MU" + std::to_string(i)) * material.real("ALPHA" + std::to_string(i));
    }
    return half;
}

} // namespace

std::string name_of(std::string_view kind, const Contact& contact)
{
    return contact.id == 0 ? std::string(kind) : fmt::format("{} {}", kind, contact.id);
}

double bulk_modulus_of(const Model& model, const Part& part)
{
    if (part.material == none) return 0;
    const Record& material = model.materials[part.material];
    const double young = first_given(material, {"E", "YM", "EA", "EX"});
    const bool blatz_ko = material.keyword == "MAT_BLATZ-KO_RUBBER"; // its Poisson's ratio is part of the law
    const double poisson = blatz_ko ? 0.463 : first_given(material, {"PR", "NU", "PRBA"});
    if (young > 0) return young / (3 * (1 - 2 * std::min(poisson, 0.499)));
    const double bulk = first_given(material, {"K", "BULK", "KUN", "BULKM"});
    if (bulk > 0) return bulk;
    const double shear = shear_modulus_of(material);
    if (shear > 0 && poisson > 0) {
        return 2 * shear * (1 + poisson) / (3 * (1 - 2 * std::min(poisson, 0.499)));
    }
    if (part.equation_of_state == none) return 0;
    return bulk_of_state_equation(model.equations_of_state[part.equation_of_state],
                                  first_given(material, {"RO"}));
}

std::vector<PartData> part_data(const Model& model)
{
    std::vector<PartData> parts(model.parts.size());
    for (std::size_t number = 0; number < parts.size(); ++number) {
        const Part& part = model.parts[number];
        PartData& data = parts[number];
        if (part.material != none) {
            const Record& material = model.materials[part.material];
            data.density = first_given(material, {"RO"});
            data.rigid = model.is_rigid(static_cast<Index>(number));
        }
        data.bulk_modulus = bulk_modulus_of(model, part);
        if (part.section == none) continue;
        const Record& section = model.sections[part.section];
        if (section.keyword.starts_with("SECTION_SHELL")) data.thickness = section.real("T1");
        if (section.keyword.starts_with("SECTION_BEAM")) {
            data.spot_weld = section.integer("ELFORM") == 9;
            const double outer = first_given(section, {"TS1"}), inner = first_given(section, {"TT1"});
            const bool tube = section.integer("CST") == 1;
            const double own_area = first_given(section, {"A"});
            data.beam_radius = 0.5 * std::max(outer, tube ? 0 : inner);
            const double hole = tube && inner < outer ? inner : 0;
            data.beam_area = tube ? 0.25 * std::numbers::pi * (outer * outer - hole * hole) : outer * inner;
            if (own_area > 0) data.beam_area = own_area;
            // LS-DYNA: the square root of the area is the diameter where the section has no other sizes.
            if (data.beam_radius == 0) data.beam_radius = 0.5 * std::sqrt(data.beam_area);
        }
    }
    return parts;
}

std::vector<double> lumped_masses(const Model& model, const std::vector<PartData>& parts)
{
    const std::vector<Vec3>& position = model.nodes.position;
    std::vector<double> mass(position.size());
    for (Index i = 0; i < static_cast<Index>(brick_count(model)); ++i) {
        const auto& nodes = brick_nodes(model, i);
        const double whole = parts[brick_part(model, i)].density * solid_volume(nodes, position);
        if (const auto* ten = ten_nodes(model, i)) { // as elements/ten_node_tetrahedron.h lumps them
            for (int node = 0; node < 10; ++node)
                mass[(*ten)[node]] += whole * (node < 4 ? 1. / 36 : 4. / 27);
            continue;
        }
        const int corners = nodes[4] == nodes[3] && nodes[5] == nodes[3] ? 4 : 8;
        for (int corner = 0; corner < corners; ++corner) mass[nodes[corner]] += whole / corners;
    }
    for (std::size_t i = 0; i < model.shells.size(); ++i) {
        const auto& nodes = model.shells.nodes[i];
        const PartData& part = parts[model.shells.part[i]];
        double thickness = part.thickness;
        if (!model.shells.thickness.empty() && model.shells.thickness[i][0] > 0) {
            const auto& t = model.shells.thickness[i];
            thickness = 0.25 * (t[0] + t[1] + t[2] + t[3]);
        }
        const bool triangle = nodes[3] == nodes[2];
        const double share = part.density * thickness * segment_area(nodes, position) / (triangle ? 3 : 4);
        for (int corner = 0; corner < (triangle ? 3 : 4); ++corner) mass[nodes[corner]] += share;
    }
    for (std::size_t i = 0; i < model.beams.size(); ++i) {
        const auto& nodes = model.beams.nodes[i];
        const PartData& part = parts[model.beams.part[i]];
        const double length = norm(position[nodes[1]] - position[nodes[0]]);
        for (int end = 0; end < 2; ++end) mass[nodes[end]] += 0.5 * part.density * part.beam_area * length;
    }
    return mass;
}

} // namespace plash

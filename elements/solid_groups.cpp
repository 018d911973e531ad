#include "elements/solid_groups.h"

#include "elements/cohesive_solids.h"
#include "elements/solid_laws.h"
#include "model/eulerian.h"

#include <algorithm>
#include <fmt/format.h>

namespace plash {

namespace {

using Corners = std::array<Index, 8>;

/// Material laws that solids can have.
constexpr struct {
    std::string_view keyword;
    SolidGroupMaker make;
} laws[] = {
    {"MAT_ELASTIC", make_elastic_solids},
    {"MAT_PLASTIC_KINEMATIC", make_plastic_kinematic_solids},
    {"MAT_NULL", make_null_solids},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_solids},
    {"MAT_ISOTROPIC_ELASTIC_PLASTIC", make_piecewise_linear_solids},
    {"MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY", make_piecewise_linear_solids},
    {"MAT_POWER_LAW_PLASTICITY", make_piecewise_linear_solids},
    {"MAT_SIMPLIFIED_JOHNSON_COOK", make_piecewise_linear_solids},
    {"MAT_MOONEY-RIVLIN_RUBBER", make_rubber_solids},
    {"MAT_CRUSHABLE_FOAM", make_crushable_foam_solids},
    {"MAT_JOHNSON_COOK", make_johnson_cook_solids},
    {"MAT_SOIL_AND_FOAM", make_soil_foam_solids},
    {"MAT_SOIL_AND_FOAM_FAILURE", make_soil_foam_solids},
    {"MAT_ELASTIC_PLASTIC_HYDRO", make_elastic_plastic_hydro_solids},
    {"MAT_ELASTIC_PLASTIC_HYDRO_SPALL", make_elastic_plastic_hydro_solids},
    {"MAT_VISCOELASTIC", make_viscoelastic_solids},
    {"MAT_KELVIN-MAXWELL_VISCOELASTIC", make_viscoelastic_solids},
    {"MAT_BLATZ-KO_RUBBER", make_rubber_solids},
    {"MAT_OGDEN_RUBBER", make_ogden_solids},
    {"MAT_HYPERELASTIC_RUBBER", make_hyperelastic_solids},
    {"MAT_LOW_DENSITY_FOAM", make_low_density_foam_solids},
    {"MAT_FU_CHANG_FOAM", make_fu_chang_foam_solids},
    {"MAT_PLASTICITY_WITH_DAMAGE", make_damaged_plasticity_solids},
    {"MAT_PLASTICITY_COMPRESSION_TENSION", make_compression_tension_solids},
    {"MAT_ELASTIC_FLUID", make_elastic_fluid_solids},
    {"MAT_HIGH_EXPLOSIVE_BURN", make_high_explosive_solids},
    {"MAT_GEOLOGIC_CAP_MODEL", make_geologic_cap_solids},
    {"MAT_HONEYCOMB", make_honeycomb_solids},
    {"MAT_ORTHOTROPIC_ELASTIC", make_orthotropic_solids},
    {"MAT_LOW_DENSITY_VISCOUS_FOAM", make_low_density_viscous_foam_solids},
};

/// Shapes that need a group of their own.
enum class Shape { hexahedron, wedge, pyramid, tetrahedron, ten_node_tetrahedron };
constexpr int shape_count = 5;

int distinct_count(Corners nodes)
{
    std::sort(nodes.begin(), nodes.end());
    return static_cast<int>(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
}

/// Tetrahedra, however they repeat nodes, as the collapsed hexahedron a b c c d d d d, whose quadrilaterals
/// are the triangles of the tetrahedron.
Corners tetrahedron_of(const Corners& nodes)
{
    Corners corner{};
    int count = 0;
    for (Index node : nodes) {
        if (std::find(corner.begin(), corner.begin() + count, node) == corner.begin() + count)
            corner[count++] = node;
    }
    return {corner[0], corner[1], corner[2], corner[2], corner[3], corner[3], corner[3], corner[3]};
}

Shape shape_of(const Model& model, Index element)
{
    if (ten_nodes(model, element)) return Shape::ten_node_tetrahedron;
    const int distinct = distinct_count(model.solids.nodes[element]);
    if (distinct == 8) return Shape::hexahedron;
    if (distinct == 6) return Shape::wedge;
    if (distinct == 5) return Shape::pyramid;
    if (distinct == 4) return Shape::tetrahedron;
    throw DeckError(model.parts[model.solids.part[element]].where,
                    fmt::format("*ELEMENT_SOLID {} has {} different nodes; a solid has at least 4",
                                model.solids.id[element], distinct));
}

/// Hourglass type, its coefficient and the bulk viscosity of a part: from its *HOURGLASS, or from the control
/// cards.
void set_viscosities(const Model& model, const Part& part, SolidSetup& setup)
{
    const ElementControls& control = model.controls.elements;
    const Record* record = part.hourglass == none ? nullptr : &model.hourglass[part.hourglass];
    SolidHourglass& hourglass = setup.parameters.hourglass;
    BulkViscosity& viscosity = setup.parameters.viscosity;
    Id type = control.hourglass_type;
    if (record) {
        type = record->integer("IHQ");
        hourglass.coefficient = value_or(record->real("QM"), 0.1);
        viscosity.quadratic = value_or(record->real("Q1"), 1.5);
        viscosity.linear = value_or(record->real("Q2"), 0.06);
        record->integer("IBQ"); // LS-DYNA's solids have the standard bulk viscosity for every value
    } else {
        hourglass.coefficient = value_or(control.hourglass_coefficient, 0.1);
        viscosity.quadratic = value_or(control.quadratic_viscosity, 1.5);
        viscosity.linear = value_or(control.linear_viscosity, 0.06);
    }
    // Type 8 speaks of fully integrated shells, and fully integrated solids have no hourglass modes.
    if (setup.eight_points || (type == 8 && !record)) type = 1;
    if (type < 0 || type > 7) {
        const std::string name = record ? fmt::format("*HOURGLASS {}", record->id) : "*CONTROL_HOURGLASS";
        throw DeckError(
            record ? record->where : part.where,
            fmt::format("{}, field IHQ: type {} is not supported for the solids of part {}; there "
                        "are 1 to 7 (0: 1)",
                        name, type, part.id));
    }
    using Form = SolidHourglass::Form;
    constexpr Form forms[] = {Form::viscous,   Form::viscous,   Form::viscous,        Form::viscous,
                              Form::stiffness, Form::stiffness, Form::assumed_strain, Form::total_strain};
    hourglass.form = forms[type];
    hourglass.orthogonal = type >= 2;
    // LS-DYNA: types 3 and 5 are types 2 and 4 with exact volume integration; 6 and 7 are derived for it.
    setup.rule = type == 3 || type >= 5 ? SolidGradientRule::mean : SolidGradientRule::centre;
}

/// Degenerate shapes need the exact volume and base vectors orthogonal to linear motion; a tetrahedron has
/// no hourglass modes, and a wave crosses it along its smallest altitude.
void adapt_to_shape(Shape shape, SolidSetup& setup)
{
    if (shape == Shape::hexahedron) return;
    setup.rule = SolidGradientRule::mean;
    setup.parameters.hourglass.orthogonal = true;
    if (shape != Shape::tetrahedron && shape != Shape::ten_node_tetrahedron) return;
    setup.parameters.hourglass.form = SolidHourglass::Form::none;
    setup.parameters.length_factor = 3;
}

/// ELFORM of a part; DeckError for one that is not supported.
/// tetrahedra, wedges, ten_nodes  whether the part has nothing else
Id formulation_of(const Model& model, const Part& part, bool tetrahedra, bool wedges, bool ten_nodes)
{
    if (part.section == none) {
        throw DeckError(part.where, fmt::format("*PART {} has solids but no section", part.id));
    }
    const Record& section = model.sections[part.section];
    if (section.keyword != "SECTION_SOLID") {
        throw DeckError(part.where, fmt::format("*PART {} has solids, but its section {} is *{} instead of "
                                                "*SECTION_SOLID",
                                                part.id, section.id, section.keyword));
    }
    const Id formulation = section.integer("ELFORM", 1);
    if (ten_nodes && formulation != 16 && formulation != 17) {
        throw DeckError(
            section.where,
            fmt::format("*SECTION_SOLID {}, field ELFORM: formulation {} does not use the ten nodes "
                        "of the tetrahedra of part {}; 16 (quadratic) and 17 (composite) do",
                        section.id, formulation, part.id));
    }
    if (formulation == 0) return 1;
    if (formulation >= -2 && formulation <= 3) return formulation;
    if ((formulation == 10 || formulation == 13) && tetrahedra) return formulation;
    if (formulation == 15 && wedges) return formulation;
    if ((formulation == 16 || formulation == 17) && ten_nodes) return formulation;
    throw DeckError(
        section.where,
        fmt::format("*SECTION_SOLID {}, field ELFORM: formulation {} is not supported for part {}; "
                    "there are 1 (one-point hexahedron, wedge, tetrahedron), 2, -1, -2 (fully integrated "
                    "hexahedron), 3 (run as -1), for parts of tetrahedra only 10 (one point) and 13 "
                    "(volumes of nodes), of ten-node tetrahedra only 16 (quadratic) and 17 (composite), and "
                    "for parts of wedges only 15",
                    section.id, formulation, part.id));
}

const Record& material_of(const Model& model, const Part& part)
{
    if (part.material != none) return model.materials[part.material];
    throw DeckError(part.where, fmt::format("*PART {} has solids but no material", part.id));
}

void add_part(const Model& model, Index part_index, const std::vector<Index>& elements,
              const InitialStresses& initial_stresses, const InitialStresses& initial_strains, State& state,
              std::vector<std::unique_ptr<SolidGroup>>& groups)
{
    const Part& part = model.parts[part_index];
    const Record& material = material_of(model, part);
    if (model.is_rigid(part_index)) return;
    const auto* law = std::find_if(std::begin(laws), std::end(laws),
                                   [&](const auto& entry) { return entry.keyword == material.keyword; });
    if (law == std::end(laws)) {
        throw DeckError(material.where,
                        fmt::format("*{} {} is not supported for the solids of part {}; solids "
                                    "have {}",
                                    material.keyword, material.id, part.id,
                                    fmt::join(solid_material_keywords(), ", ")));
    }
    std::vector<Index> by_shape[shape_count];
    for (Index element : elements) by_shape[static_cast<int>(shape_of(model, element))].push_back(element);
    const auto all_are = [&](Shape shape) {
        return by_shape[static_cast<int>(shape)].size() == elements.size();
    };
    const auto ten = by_shape[static_cast<int>(Shape::ten_node_tetrahedron)].size();
    if (ten > 0 && ten < elements.size()) {
        throw DeckError(
            part.where,
            fmt::format("*PART {} has {} ten-node tetrahedra among {} solids; give them a part of "
                        "their own",
                        part.id, ten, elements.size()));
    }
    const Id formulation =
        formulation_of(model, part, all_are(Shape::tetrahedron), all_are(Shape::wedge), ten > 0);
    const bool sorted = model.controls.elements.sort_solids > 0;

    const Record* equation_of_state =
        part.equation_of_state == none ? nullptr : &model.equations_of_state[part.equation_of_state];
    for (Shape shape :
         {Shape::hexahedron, Shape::wedge, Shape::pyramid, Shape::tetrahedron, Shape::ten_node_tetrahedron}) {
        std::vector<Index>& members = by_shape[static_cast<int>(shape)];
        if (members.empty()) continue;
        SolidSetup setup{model, part_index, std::move(members)};
        setup.initial_stresses = &initial_stresses;
        setup.initial_strains = &initial_strains;
        if (ten > 0) setup.ten_nodes = formulation == 16 ? &quadratic_tetrahedron : &composite_tetrahedron;
        setup.connectivity.reserve(setup.elements.size() * (ten > 0 ? 10 : 8));
        for (Index element : setup.elements) {
            if (const auto* all = ten_nodes(model, element)) {
                setup.connectivity.insert(setup.connectivity.end(), all->begin(), all->end());
                continue;
            }
            const Corners& nodes = model.solids.nodes[element];
            const Corners corners = shape == Shape::tetrahedron ? tetrahedron_of(nodes) : nodes;
            setup.connectivity.insert(setup.connectivity.end(), corners.begin(), corners.end());
        }
        // Collapsed shapes have one point in every formulation, as with LS-DYNA's ESORT; wedges that are
        // sorted out, or of formulation 15, have all points.
        setup.eight_points = (shape == Shape::hexahedron && formulation != 1) ||
                             (shape == Shape::wedge && (formulation == 15 || sorted));
        setup.nodal_volume = shape == Shape::tetrahedron && formulation == 13;
        setup.shear = formulation == -1 || formulation == 3 ? SolidShear::cancelled
                      : formulation == -2                   ? SolidShear::scaled
                                                            : SolidShear::full;
        set_viscosities(model, part, setup);
        adapt_to_shape(shape, setup);
        if (formulation == 3 && shape == Shape::hexahedron) {
            setup.notice =
                fmt::format("part {}: solids of ELFORM 3 (quadratic with nodal rotations) run as ELFORM "
                            "-1 (fully integrated, without shear locking)",
                            part.id);
        }
        // LS-DYNA deletes elements without volume only if both ERODE and DTMIN are set.
        setup.erode_inverted =
            model.controls.time.erode_small_step && model.controls.time.smallest_step_factor != 0;
        groups.push_back(law->make(material, equation_of_state, std::move(setup), state));
    }
}

} // namespace

std::vector<std::unique_ptr<SolidGroup>> make_solid_groups(const Model& model, State& state)
{
    std::vector<std::vector<Index>> elements(model.parts.size());
    for (std::size_t element = 0; element < model.solids.size(); ++element) {
        elements[model.solids.part[element]].push_back(static_cast<Index>(element));
    }
    const InitialStresses initial_stresses = initial_solid_stresses(model);
    const InitialStresses initial_strains = initial_solid_strains(model);
    std::vector<std::unique_ptr<SolidGroup>> groups;
    for (std::size_t part = 0; part < elements.size(); ++part) {
        const auto number = static_cast<Index>(part);
        if (elements[part].empty() || is_eulerian(model, number) || is_cohesive(model, number)) continue;
        add_part(model, static_cast<Index>(part), elements[part], initial_stresses, initial_strains, state,
                 groups);
    }
    return groups;
}

std::vector<std::string_view> solid_material_keywords()
{
    std::vector<std::string_view> keywords;
    for (const auto& law : laws) keywords.push_back(law.keyword);
    keywords.push_back("MAT_RIGID");
    return keywords;
}

SolidMasses solid_masses(const Model& model, Index part)
{
    const Record& material = material_of(model, model.parts[part]);
    const double density = material.real("RO");
    SolidMasses masses;
    std::vector<double> by_node(model.nodes.size(), 0.0);
    for (Index element = 0; element < static_cast<Index>(brick_count(model)); ++element) {
        if (brick_part(model, element) != part) continue;
        const bool solid = element < static_cast<Index>(model.solids.size());
        Corners nodes = brick_nodes(model, element);
        if (solid && distinct_count(nodes) == 4) nodes = tetrahedron_of(nodes);
        Vec3 corner[8];
        for (int i = 0; i < 8; ++i) corner[i] = model.nodes.position[nodes[i]];
        const double mass = density * gradient_of<SolidGradientRule::mean>(modes_of(corner)).volume;
        if (!(mass > 0)) {
            throw DeckError(
                model.parts[part].where,
                fmt::format("{} {} of rigid part {} has the mass {:.6g}: check RO of its material "
                            "and its node numbering",
                            solid ? "solid" : "thick shell",
                            solid ? model.solids.id[element]
                                  : model.thick_shells.id[element - model.solids.size()],
                            model.parts[part].id, mass));
        }
        if (const auto* all = ten_nodes(model, element)) {
            for (int i = 0; i < 10; ++i)
                by_node[(*all)[i]] +=
                    mass * (i < 4 ? quadratic_tetrahedron.corner_mass : quadratic_tetrahedron.edge_mass());
            masses.total += mass;
            continue;
        }
        std::sort(nodes.begin(), nodes.end());
        const auto end = std::unique(nodes.begin(), nodes.end());
        for (auto node = nodes.begin(); node != end; ++node) by_node[*node] += mass / (end - nodes.begin());
        masses.total += mass;
    }
    for (std::size_t node = 0; node < by_node.size(); ++node) {
        if (by_node[node] == 0) continue;
        masses.nodes.push_back(static_cast<Index>(node));
        masses.mass.push_back(by_node[node]);
    }
    return masses;
}

} // namespace plash

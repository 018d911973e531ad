#include "elements/thick_shell_settings.h"

#include "elements/shell_settings.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

constexpr int most_thick_points = 64;

Id thick_formulation(const Record& section)
{
    const Id formulation = section.integer("ELFORM", 1);
    return formulation == 0 ? 1 : formulation;
}

void read_thick_hourglass(const Model& model, const Part& part, ThickShellSettings& settings,
                          SolidParameters& parameters)
{
    const ElementControls& control = model.controls.elements;
    const Record* record = part.hourglass == none ? nullptr : &model.hourglass[part.hourglass];
    Id type = control.hourglass_type;
    settings.hourglass_coefficient = value_or(control.hourglass_coefficient, 0.1);
    parameters.viscosity.quadratic = value_or(control.quadratic_viscosity, 1.5);
    parameters.viscosity.linear = value_or(control.linear_viscosity, 0.06);
    if (record) {
        if (record->integer("IHQ") != 0) type = record->integer("IHQ");
        settings.hourglass_coefficient = value_or(record->real("QM"), 0.1);
        parameters.viscosity.quadratic = value_or(record->real("Q1"), 1.5);
        parameters.viscosity.linear = value_or(record->real("Q2"), 0.06);
        record->integer("IBQ");
        if (type < 0 || type > 6) {
            reject_field(*record, "IHQ",
                         fmt::format("hourglass control {} is not supported for the thick shells of part {} "
                                     "(1 to 3: viscous, 4 to 6: stiffness)",
                                     type, part.id));
        }
    }
    using Kind = ThickShellSettings::Hourglass;
    settings.hourglass = settings.columns > 1    ? Kind::none
                         : type <= 3 || type > 6 ? Kind::viscous
                                                 : Kind::stiffness;
    parameters.hourglass.form = SolidHourglass::Form::none; // that of solids
}

/// Shear of each layer over its mean: constant, or a parabola that vanishes at both faces and stores the same
/// energy in layers of one stiffness.
std::vector<double> shear_shares(const ThicknessRule& rule, bool parabolic)
{
    std::vector<double> share(rule.size(), 1.0);
    if (!parabolic) return share;
    double square = 0;
    for (int layer = 0; layer < rule.size(); ++layer) {
        share[layer] = 1 - rule.place[layer] * rule.place[layer];
        square += rule.weight[layer] * share[layer] * share[layer];
    }
    if (!(square > 0)) return std::vector<double>(rule.size(), 1.0);
    for (double& value : share) value /= std::sqrt(square);
    return share;
}

} // namespace

const Record& thick_shell_section(const Model& model, const Part& part)
{
    const Record* section = part.section != none     ? &model.sections[part.section]
                            : part.composite != none ? &model.others[part.composite]
                                                     : nullptr;
    if (section && (section->keyword == "SECTION_TSHELL" || section->keyword == "PART_COMPOSITE_TSHELL"))
        return *section;
    throw DeckError(part.where, fmt::format("*PART {} has thick shells but no *SECTION_TSHELL", part.id));
}

ThickShellStress thick_shell_stress(const Model& model, const Part& part)
{
    const Record& section = thick_shell_section(model, part);
    switch (thick_formulation(section)) {
    case 1:
    case 2:
    case 6:
        return ThickShellStress::plane;
    case 3:
    case 5:
    case 7:
        return ThickShellStress::solid;
    }
    reject_field(
        section, "ELFORM",
        fmt::format("thick shell formulation {} is not supported (1 and 6: one column of points, 2: 2 "
                    "x 2 columns, stresses of shells; 5: one column, 3 and 7: 2 x 2, stresses of "
                    "solids)",
                    section.integer("ELFORM", 1)));
}

ThickShellSettings thick_shell_settings(const Model& model, const Part& part,
                                        const ThickShellElasticity& elastic, int plies,
                                        SolidParameters& parameters)
{
    const Record& section = thick_shell_section(model, part);
    const ThickShellStress stress = thick_shell_stress(model, part);
    const Id formulation = thick_formulation(section);
    ThickShellSettings settings;
    settings.strains = model.controls.output.strains();
    settings.columns = formulation == 2 || formulation == 3 || formulation == 7 ? 4 : 1;
    if (plies > 0) {
        if (plies > most_thick_points) {
            throw DeckError(part.where,
                            fmt::format("*PART {} has {} plies through its thick shells; at most {} "
                                        "are supported",
                                        part.id, plies, most_thick_points));
        }
        for (int ply = 0; ply < plies; ++ply) {
            settings.rule.place.push_back((2.0 * ply + 1) / plies - 1);
            settings.rule.weight.push_back(1.0 / plies);
        }
    } else {
        const Id points = section.integer("NIP") == 0 ? 2 : section.integer("NIP");
        if (points < 1 || points > most_thick_points) {
            reject_field(section, "NIP",
                         fmt::format("{} is not a number of points from 1 to {}", points, most_thick_points));
        }
        settings.rule = thickness_rule(model, section, points, "QR");
    }
    settings.shear_factor = value_or(section.real("SHRF", 1.0), 1.0);
    const bool constant = section.integer("TSHEAR") == 1;
    settings.shear_share = shear_shares(settings.rule, stress == ThickShellStress::solid && !constant);
    settings.young_modulus = elastic.young_modulus;
    settings.poisson_ratio = elastic.poisson_ratio;
    settings.shear_modulus = elastic.young_modulus / (2 * (1 + elastic.poisson_ratio));
    const double nu = elastic.poisson_ratio;
    const double modulus = stress == ThickShellStress::plane
                               ? elastic.young_modulus / (1 - nu * nu)
                               : elastic.young_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    settings.wave_speed = std::sqrt(modulus / elastic.density);
    settings.bulk_viscosity = stress == ThickShellStress::solid;
    parameters.density = elastic.density;
    read_thick_hourglass(model, part, settings, parameters);
    return settings;
}

} // namespace plash

#include "elements/beam_section.h"

#include "elements/beam_integration.h"
#include "elements/shell_settings.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Places on [-1, 1] and weights that sum to one.
ThicknessRule rule_of(const Record& section)
{
    switch (section.integer("QR/IRID", 2)) {
    case 1:
        return gauss_rule(1);
    case 0:
    case 2:
        return gauss_rule(2);
    case 3:
        return gauss_rule(3);
    case 4:
        return {{-1, 0, 1}, {1.0 / 6, 2.0 / 3, 1.0 / 6}}; // Lobatto
    case 5:
        return gauss_rule(4);
    }
    reject_field(section, "QR/IRID",
                 fmt::format("integration rule {} is not supported (1: one point, 2: 2 x 2 Gauss, 3: 3 x 3 "
                             "Gauss, 4: 3 x 3 Lobatto, 5: 4 x 4 Gauss, below 0: *INTEGRATION_BEAM)",
                             section.integer("QR/IRID", 2)));
}

/// Mean of a dimension at both ends; an empty field of the second end means the first.
double mean_size(const Record& section, const char* first, const char* second)
{
    const double one = section.real(first), two = section.real(second);
    return two > 0 ? 0.5 * (one + two) : one;
}

void add_rectangle(const Record& section, double width_s, double width_t, BeamSection& result)
{
    if (!(width_s > 0)) reject_field(section, "TS1", fmt::format("{} is no thickness", width_s));
    if (!(width_t > 0)) reject_field(section, "TT1", fmt::format("{} is no thickness", width_t));
    // NSLOC, NTLOC = 1: the nodes lie on the side of positive s, t.
    const double shift_s = -0.5 * width_s * section.real("NSLOC");
    const double shift_t = -0.5 * width_t * section.real("NTLOC");
    const ThicknessRule rule = rule_of(section);
    for (int i = 0; i < rule.size(); ++i)
        for (int j = 0; j < rule.size(); ++j) {
            result.points.push_back({0.5 * width_s * rule.place[i] + shift_s,
                                     0.5 * width_t * rule.place[j] + shift_t,
                                     rule.weight[i] * rule.weight[j]});
        }
    result.area = width_s * width_t;
    result.inertia_s = result.area * width_t * width_t / 12;
    result.inertia_t = result.area * width_s * width_s / 12;
    result.torsion = result.inertia_s + result.inertia_t;
}

void add_tube(const Record& section, double outer, double inner, BeamSection& result)
{
    if (!(outer > 0)) reject_field(section, "TS1", fmt::format("{} is no outer diameter", outer));
    if (!(inner >= 0 && inner < outer)) {
        reject_field(section, "TT1", fmt::format("{} is no inner diameter of a tube of {}", inner, outer));
    }
    add_tube_points(0.5 * outer, 0.5 * inner, rule_of(section).size(), result);
}

void read_integrated(const Model& model, const Record& section, BeamSection& result)
{
    const double ts = mean_size(section, "TS1", "TS2"), tt = mean_size(section, "TT1", "TT2");
    if (const double rule = section.real("QR/IRID"); rule < 0) {
        for (const char* field : {"NSLOC", "NTLOC"}) {
            if (section.real(field) != 0)
                reject_field(section, field, "an offset of the axis is not supported with *INTEGRATION_BEAM");
        }
        return read_beam_integration(model, section, -static_cast<Id>(rule), ts, tt > 0 ? tt : ts, result);
    }
    const Id shape = section.integer("CST");
    if (result.formulation == 9 || shape == 1) {
        if (shape == 0) return add_rectangle(section, ts, tt > 0 ? tt : ts, result);
        if (section.real("NSLOC") != 0 || section.real("NTLOC") != 0) {
            reject_field(section, "NSLOC", "an offset of the axis is not supported for tubes (CST = 1)");
        }
        return add_tube(section, ts, tt, result);
    }
    if (shape == 0) return add_rectangle(section, ts, tt, result);
    reject_field(section, "CST",
                 fmt::format("cross section {} is not supported (0: rectangle, 1: tube)", shape));
}

void read_resultants(const Record& section, BeamSection& result)
{
    result.area = positive(section, "A", "cross-sectional area");
    result.inertia_s = section.real("ISS");
    result.inertia_t = section.real("ITT");
    result.torsion = section.real("J");
    for (const char* field : {"ISS", "ITT", "J"}) {
        if (section.real(field) < 0) {
            reject_field(section, field, fmt::format("{} is negative", section.real(field)));
        }
    }
    if (result.inertia_t == 0) result.inertia_t = result.inertia_s;
    if (result.torsion == 0) result.torsion = result.inertia_s + result.inertia_t;
    result.shear_area = section.real("SA");
    if (section.real("IST") != 0) {
        reject_field(section, "IST",
                     "a product of inertia is not supported; turn the s axis into a "
                     "principal one with the third node");
    }
}

} // namespace

bool BeamSection::isotropic() const
{
    return std::abs(inertia_s - inertia_t) <= 1e-9 * (inertia_s + inertia_t);
}

BeamSection beam_section(const Model& model, const Part& part)
{
    if (part.section == none) {
        throw DeckError(part.where, fmt::format("*PART {} has beams but no *SECTION_BEAM", part.id));
    }
    const Record& section = model.sections[part.section];
    if (section.keyword != "SECTION_BEAM") {
        throw DeckError(part.where, fmt::format("*PART {} has beams, but its section {} is *{} instead of "
                                                "*SECTION_BEAM",
                                                part.id, section.id, section.keyword));
    }
    BeamSection result;
    result.formulation = static_cast<int>(section.integer("ELFORM", 1));
    if (result.formulation == 0) result.formulation = 1;
    result.shear_factor = section.real("SHRF", 1);
    if (result.shear_factor == 0) result.shear_factor = 1; // empty field
    result.added_mass = section.real("NSM");
    switch (result.formulation) {
    case 1:
    case 9:
        read_integrated(model, section, result);
        break;
    case 2:
        read_resultants(section, result);
        break;
    case 3:
        result.area = positive(section, "A", "cross-sectional area");
        if (section.real("RAMPT") != 0) {
            reject_field(section, "RAMPT",
                         "a ramp of the initial stress is not supported; with 0 the truss "
                         "starts with STRESS");
        }
        result.initial_stress = section.real("STRESS");
        break;
    default:
        reject_field(section, "ELFORM",
                     fmt::format("beam formulation {} is not supported (1: Hughes-Liu, 2: Belytschko-Schwer "
                                 "resultant, 3: truss, 6: discrete, 9: spot weld)",
                                 result.formulation));
    }
    return result;
}

BeamMass beam_mass(const BeamSection& section, double density, double length, double shear_modulus_ratio,
                   double step_scale)
{
    const double structural = 0.5 * density * section.area * length;
    const double square = length * length;
    double gyration = section.larger_inertia() / section.area + square / 12;
    if (shear_modulus_ratio > 0) {
        // Transverse waves: omega^2 = k G A L (4 / (L^2 2 m) + 1 / (2 J)) must stay below (2 c / (s L))^2.
        const double margin = 1 / (step_scale * step_scale * shear_modulus_ratio) - 1;
        if (margin > 0) gyration = std::max(gyration, 0.25 * square / margin);
    }
    return {structural + 0.5 * section.added_mass * length, structural * gyration};
}

} // namespace plash

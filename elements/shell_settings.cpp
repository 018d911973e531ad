#include "elements/shell_settings.h"

#include "elements/shell_mass.h"
#include "materials/parameters.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

/// *INTEGRATION_SHELL: places and weights of the deck, or layers of equal thickness (ESOP = 1).
ThicknessRule user_rule(const Model& model, const Record& section, Id number, const char* field)
{
    for (const Record& record : model.others) {
        if (record.keyword != "INTEGRATION_SHELL" || record.integer("IRID") != number) continue;
        ThicknessRule rule;
        const Id points = record.integer("NIP");
        if (points < 1) reject_field(record, "NIP", fmt::format("{} is no number of points", points));
        if (record.integer("ESOP") == 1) {
            for (Id point = 0; point < points; ++point) {
                rule.place.push_back(-1 + (2.0 * point + 1) / points);
                rule.weight.push_back(1.0 / points);
            }
            return rule;
        }
        const Table* rows = record.table("S");
        if (!rows || rows->rows() == 0) reject_field(record, "NIP", "the rule has no points");
        std::vector<std::pair<double, double>> given;
        double sum = 0;
        for (std::size_t row = 0; row < rows->rows(); ++row) {
            const double place = rows->at(row, 0), weight = rows->at(row, 1);
            if (!(place >= -1 && place <= 1 && weight > 0) || rows->at(row, 2) != 0) {
                throw DeckError(
                    {record.where.file, rows->lines[row]},
                    fmt::format("*INTEGRATION_SHELL {}: the point S = {}, WF = {}, PID = {} is not one from "
                                "-1 to 1 with a positive weight and the part's own material (PID = 0)",
                                number, place, weight, rows->at(row, 2)));
            }
            given.emplace_back(place, weight);
            sum += weight;
        }
        std::sort(given.begin(), given.end()); // from the bottom
        for (const auto& [place, weight] : given) {
            rule.place.push_back(place);
            rule.weight.push_back(weight / sum);
        }
        return rule;
    }
    reject_field(section, field, fmt::format("there is no *INTEGRATION_SHELL {}", number));
}

void read_section(const Model& model, const Record& section, bool laminate, ShellSettings& settings)
{
    const Id points = section.integer("NIP") == 0 ? 2 : section.integer("NIP");
    if (points < 1 || points > 10) {
        reject_field(section, "NIP", fmt::format("{} is not a number of points from 1 to 10", points));
    }
    if (section.integer("ICOMP") != 0 && !laminate) {
        reject_field(section, "ICOMP", "angles of layers say nothing to an isotropic material");
    }
    settings.rule = thickness_rule(model, section, points, "QR/IRID");
    settings.shear_factor = section.real("SHRF", 1.0);
    if (settings.shear_factor == 0) settings.shear_factor = 1; // empty field
    settings.reference_offset = section.real("NLOC");
    const Id formulation = section.integer("ELFORM", 2);
    if (formulation == 1 || formulation == 10 || formulation == 11) settings.warping = true;
    if (formulation == 5 || formulation == 9) {
        settings.membrane = true;
        settings.rule = gauss_rule(1);
        settings.shear_factor = 0;
        settings.reference_offset = 0;
    }
}

/// What runs in place of formulations that Plash does not have.
std::string stand_in(const Part& part, Id formulation)
{
    if (formulation == 1 || formulation == 11) {
        return fmt::format(
            "part {}: shells of ELFORM {} (Hughes-Liu) run as ELFORM 10 (Belytschko-Wong-Chiang)", part.id,
            formulation);
    }
    if (formulation == 6 || formulation == 7) {
        return fmt::format("part {}: shells of ELFORM {} (selectively reduced Hughes-Liu) run as ELFORM 16",
                           part.id, formulation);
    }
    return {};
}

ShellHourglass read_hourglass(const Model& model, const Part& part)
{
    const ElementControls& controls = model.controls.elements;
    ShellHourglass result;
    Id type = controls.hourglass_type;
    result.membrane = result.bending = result.warping = controls.hourglass_coefficient;
    if (part.hourglass != none) {
        const Record& record = model.hourglass[part.hourglass];
        if (record.integer("IHQ") != 0) type = record.integer("IHQ");
        result.membrane = record.real("QM");
        if (result.membrane == 0) result.membrane = 0.1;
        result.bending = record.given("QB/VDC") ? record.real("QB/VDC") : result.membrane;
        result.warping = record.given("QW") ? record.real("QW") : result.membrane;
        const bool full_warping = type == 8; // of fully integrated shells, which always have it
        if ((type < 0 || type > 5) && !full_warping) {
            reject_field(
                record, "IHQ",
                fmt::format("hourglass control {} is not supported for shells (1 to 5, and 8 for ELFORM 16)",
                            type));
        }
    }
    // Types 6 and above in *CONTROL_HOURGLASS speak of solids; shells then keep the stiffness form.
    result.kind = type <= 3 ? ShellHourglass::Kind::viscous : ShellHourglass::Kind::stiffness;
    return result;
}

} // namespace

ThicknessRule gauss_rule(int points)
{
    ThicknessRule rule;
    for (int point = 0; point < points; ++point) {
        // Newton's method on the Legendre polynomial from Chebyshev's estimate of its zeros.
        double x = -std::cos(std::numbers::pi * (point + 0.75) / (points + 0.5));
        double slope = 0;
        for (int iteration = 0; iteration < 50; ++iteration) {
            double value = 1, before = 0;
            for (int degree = 1; degree <= points; ++degree) {
                const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
                before = value;
                value = next;
            }
            slope = points * (x * value - before) / (x * x - 1);
            const double change = value / slope;
            x -= change;
            if (std::abs(change) < 1e-16) break;
        }
        if (2 * point + 1 == points) x = 0;
        rule.place.push_back(x);
        rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

ThicknessRule lobatto_rule(int points)
{
    // Abramowitz & Stegun (1972), 25.4.32: the ends and the zeros of P'(n-1), weights 2 / (n (n - 1)
    // P(n-1)^2).
    const int last = points - 1;
    ThicknessRule rule;
    for (int point = 0; point < points; ++point) {
        double x = -std::cos(std::numbers::pi * point / last), value = 0;
        for (int iteration = 0; iteration < 50; ++iteration) {
            double before = 1;
            value = x;
            for (int degree = 2; degree <= last; ++degree) {
                const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
                before = value;
                value = next;
            }
            // Newton's method on (x^2 - 1) P'(n-1) = (n - 1) (x P(n-1) - P(n-2)), whose slope is n (n - 1)
            // P(n-1).
            const double change = (x * value - before) / (points * value);
            x -= change;
            if (std::abs(change) < 1e-16) break;
        }
        if (2 * point == last) x = 0;
        rule.place.push_back(x);
        rule.weight.push_back(1 / (points * last * value * value));
    }
    return rule;
}

ThicknessRule trapezoidal_rule(int points)
{
    ThicknessRule rule;
    const double spacing = 2.0 / (points - 1);
    for (int point = 0; point < points; ++point) {
        const bool end = point == 0 || point == points - 1;
        rule.place.push_back(-1 + point * spacing);
        rule.weight.push_back((end ? 0.25 : 0.5) * spacing);
    }
    return rule;
}

ThicknessRule thickness_rule(const Model& model, const Record& section, Id points, const char* field)
{
    const double rule = section.real(field);
    if (rule > 1 || (rule > 0 && rule < 1)) {
        reject_field(section, field,
                     fmt::format("integration rule {} is not supported (0: Gauss, 1: trapezoidal, below 0: "
                                 "*INTEGRATION_SHELL)",
                                 rule));
    }
    if (rule < 0) return user_rule(model, section, -static_cast<Id>(rule), field);
    if (rule == 1 && points > 1) return trapezoidal_rule(static_cast<int>(points));
    // With two points Lobatto's rule is that of the surfaces alone; LS-DYNA takes Gauss's.
    return model.controls.elements.thickness_integration == 1 && points > 2
               ? lobatto_rule(static_cast<int>(points))
               : gauss_rule(static_cast<int>(points));
}

ShellSettings shell_settings(const Model& model, Index part_index, double density, double young_modulus,
                             double poisson_ratio, bool laminate)
{
    const Part& part = model.parts[part_index];
    const ElementControls& controls = model.controls.elements;
    ShellSettings settings;
    const Record& section = shell_section(model, part);
    read_section(model, section, laminate, settings);
    settings.notice = stand_in(part, section.integer("ELFORM", 2));
    settings.hourglass = read_hourglass(model, part);
    if (settings.membrane) settings.hourglass.bending = settings.hourglass.warping = 0;
    settings.thickness_change = controls.thickness_change == 1;
    settings.warping = settings.warping || controls.warping == 1;
    settings.length_rule = model.controls.time.shell_length_rule;
    settings.density = density;
    settings.poisson_ratio = poisson_ratio;
    settings.wave_speed = std::sqrt(young_modulus / (density * (1 - poisson_ratio * poisson_ratio)));
    settings.stiffness = {young_modulus, young_modulus / (2 * (1 + poisson_ratio)), settings.shear_factor,
                          density * settings.wave_speed};
    settings.bulk_viscosity = controls.bulk_viscosity_type == -1 || controls.bulk_viscosity_type == -2;
    settings.quadratic_viscosity = controls.quadratic_viscosity;
    settings.linear_viscosity = controls.linear_viscosity;
    return settings;
}

} // namespace plash

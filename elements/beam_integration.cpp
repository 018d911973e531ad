#include "elements/beam_integration.h"

#include "elements/shell_settings.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

void add_user_points(const Record& rule, double ts, double tt, BeamSection& result)
{
    if (!(ts > 0 && tt > 0)) {
        reject_field(
            rule, "RA",
            "points of a user's rule lie over the thicknesses TS1 and TT1 of the section, which must "
            "be above zero");
    }
    const Table* rows = rule.table("S");
    if (!rows || rows->rows() == 0) reject_field(rule, "NIP", "the rule has no points");
    double sum = 0;
    for (std::size_t row = 0; row < rows->rows(); ++row) {
        const double s = rows->at(row, 0), t = rows->at(row, 1), weight = rows->at(row, 2);
        if (!(std::abs(s) <= 1 && std::abs(t) <= 1 && weight > 0) || rows->at(row, 3) != 0) {
            throw DeckError(
                {rule.where.file, rows->lines[row]},
                fmt::format("*INTEGRATION_BEAM {}: the point S = {}, T = {}, WF = {}, PID = {} is not "
                            "one from -1 to 1 with a positive weight and the part's own material "
                            "(PID = 0)",
                            rule.integer("IRID"), s, t, weight, rows->at(row, 3)));
        }
        result.points.push_back({0.5 * ts * s, 0.5 * tt * t, weight});
        sum += weight;
    }
    for (BeamPoint& point : result.points) point.share /= sum;
    result.area = value_or(rule.real("RA"), 1) * ts * tt;
}

/// A wall: a rectangle with 2 Gauss points across and `along` along its longer side. Shares are areas for
/// now.
void add_wall(double s, double t, double width_s, double width_t, int along, BeamSection& result)
{
    const ThicknessRule rule_s = gauss_rule(width_s >= width_t ? along : 2);
    const ThicknessRule rule_t = gauss_rule(width_s >= width_t ? 2 : along);
    for (int i = 0; i < rule_s.size(); ++i) {
        for (int j = 0; j < rule_t.size(); ++j) {
            result.points.push_back({s + 0.5 * width_s * rule_s.place[i], t + 0.5 * width_t * rule_t.place[j],
                                     rule_s.weight[i] * rule_t.weight[j] * width_s * width_t});
        }
    }
}

void add_walls(const Record& rule, bool tube, BeamSection& result)
{
    const double width = positive(rule, "D1", "width W");
    const double flange = positive(rule, "D2", "thickness TF of the flanges");
    const double depth = positive(rule, "D3", "depth D");
    const double web = positive(rule, "D4", "thickness TW of the web");
    if (depth <= 2 * flange || width <= (tube ? 2 : 1) * web)
        reject_field(rule, "D1", "the walls are thicker than the section");
    const Id refinement = std::max<Id>(1, rule.integer("K", 1));
    const int along = static_cast<int>(std::min<Id>(10, 4 * refinement));
    for (const double side : {-1.0, 1.0})
        add_wall(0, side * 0.5 * (depth - flange), width, flange, along, result);
    if (tube) {
        for (const double side : {-1.0, 1.0})
            add_wall(side * 0.5 * (width - web), 0, web, depth - 2 * flange, along, result);
    } else {
        add_wall(0, 0, web, depth - 2 * flange, along, result);
    }
    for (const BeamPoint& point : result.points) result.area += point.share;
    for (BeamPoint& point : result.points) point.share /= result.area;
}

} // namespace

void add_tube_points(double outer_radius, double inner_radius, int rule_points, BeamSection& result)
{
    const double outer_square = outer_radius * outer_radius, inner_square = inner_radius * inner_radius;
    const auto add_circle = [&](double squared_radius, int count, double share) {
        for (int i = 0; i < count; ++i) {
            const double angle = std::numbers::pi * (2 * i + 1) / count;
            const double radius = std::sqrt(squared_radius);
            result.points.push_back({radius * std::cos(angle), radius * std::sin(angle), share / count});
        }
    };
    const double mean = 0.5 * (outer_square + inner_square), half = 0.5 * (outer_square - inner_square);
    if (rule_points == 1) {
        result.points.push_back({0, 0, 1});
    } else if (rule_points == 2) {
        add_circle(mean, 4, 1);
    } else {
        const ThicknessRule radial = gauss_rule(2);
        for (int i = 0; i < 2; ++i) add_circle(mean + half * radial.place[i], 8, radial.weight[i]);
    }
    result.area = std::numbers::pi * (outer_square - inner_square);
    result.inertia_s = result.inertia_t = 0.5 * result.area * mean;
    result.torsion = result.area * mean;
}

void take_inertia_of_points(BeamSection& result)
{
    result.inertia_s = result.inertia_t = 0;
    for (const BeamPoint& point : result.points) {
        result.inertia_s += result.area * point.share * point.t * point.t;
        result.inertia_t += result.area * point.share * point.s * point.s;
    }
    result.torsion = result.inertia_s + result.inertia_t;
}

void read_beam_integration(const Model& model, const Record& section, Id number, double ts, double tt,
                           BeamSection& result)
{
    for (const Record& rule : model.others) {
        if (rule.keyword != "INTEGRATION_BEAM" || rule.integer("IRID") != number) continue;
        const Id shape = rule.integer("ICST");
        for (const char* field : {"SREF", "TREF"}) {
            if (rule.peek(field) && rule.real(field) != 0)
                reject_field(rule, field, "an offset of the axis is not supported");
        }
        switch (shape) {
        case 0:
            add_user_points(rule, ts, tt, result);
            take_inertia_of_points(result);
            return;
        case 1:
        case 5:
            add_walls(rule, shape == 5, result);
            take_inertia_of_points(result);
            return;
        case 8:
            add_tube_points(positive(rule, "D1", "radius"), 0, 3, result);
            return;
        case 9: {
            const double outer = positive(rule, "D1", "outer radius"), inner = rule.real("D2");
            if (!(inner >= 0 && inner < outer))
                reject_field(rule, "D2", fmt::format("{} is no inner radius of a tube of {}", inner, outer));
            add_tube_points(outer, inner, 3, result);
            return;
        }
        default:
            reject_field(
                rule, "ICST",
                fmt::format("standard section {} is not supported (1: W, 5: rectangular tube, 8: circle, "
                            "9: tube); give its points with ICST = 0",
                            shape));
        }
    }
    reject_field(section, "QR/IRID", fmt::format("there is no *INTEGRATION_BEAM {}", number));
}

} // namespace plash

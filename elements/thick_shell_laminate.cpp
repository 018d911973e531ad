#include "elements/thick_shell_laminate.h"

#include "elements/erosion_criteria.h"
#include "elements/shell_settings.h"
#include "elements/thick_shell_group.h"
#include "elements/thick_shell_groups.h"
#include "elements/thick_shell_settings.h"
#include "materials/flow_laws.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

constexpr double radians = std::numbers::pi / 180;

/// A ply of one element: material, middle from -1 (bottom) to 1, share of the thickness, angle of its axis a.
struct ThickPly {
    Index material = none;
    double middle = 0, share = 0, angle = 0;
};

ShellFrame<double> mid_surface(const Model& model, Index element)
{
    Vec3 corner[8];
    for (int i = 0; i < 8; ++i) corner[i] = model.nodes.position[model.thick_shells.nodes[element][i]];
    return thick_shell_frame(modes_of(corner)).surface;
}

/// Plies of an element from the bottom: its layers, whose thicknesses are scaled to that of the element, or
/// the points of the section's rule for a part of one orthotropic material.
std::vector<ThickPly> thick_plies(const Model& model, Index element)
{
    const Part& part = model.parts[model.thick_shells.part[element]];
    const Record& section = thick_shell_section(model, part);
    const ShellFrame<double> frame = mid_surface(model, element);
    const auto& angles = model.thick_shells.material_angle;
    const double own = angles.empty() ? 0 : radians * angles[element];
    const auto angle_of = [&](Index material) {
        return ply_angle(model, model.materials[material], frame, own);
    };

    std::vector<ThickPly> plies;
    const auto layers = thick_shell_layers(model, element);
    double whole = 0, below = 0;
    for (const Layer& layer : layers) whole += layer.thickness;
    for (const Layer& layer : layers) {
        const double share = layer.thickness / whole;
        plies.push_back(
            {layer.material, 2 * below + share - 1, share, angle_of(layer.material) + radians * layer.angle});
        below += share;
    }
    if (!layers.empty()) return plies;

    const Id points = section.integer("NIP") == 0 ? 2 : section.integer("NIP");
    const ThicknessRule rule = thickness_rule(model, section, points, "QR");
    const Table* given = section.integer("ICOMP") == 1 ? section.table("BI") : nullptr;
    for (int point = 0; point < rule.size(); ++point) {
        const bool has = given && point < static_cast<int>(given->rows());
        plies.push_back({part.material, rule.place[point], rule.weight[point],
                         angle_of(part.material) + (has ? radians * given->at(point, 0) : 0)});
    }
    return plies;
}

SolidPlyLaw solid_ply_law(const Model& model, const Part& part, const Record& material)
{
    if (material.keyword == "MAT_ORTHOTROPIC_ELASTIC") return OrthotropicSolid::from_record(material, model);
    if (material.keyword == "MAT_ELASTIC") return Elastic::from_record(material, model);
    if (material.keyword == "MAT_PIECEWISE_LINEAR_PLASTICITY" || is_flow_law(material.keyword))
        return PiecewiseLinearPlasticity::from_record(material, model);
    throw DeckError(material.where,
                    fmt::format("*{} {} is not supported for plies with stresses of a solid (thick shells of "
                                "part {}, formulation 3 or 5); use formulation 1 or 2",
                                material.keyword, material.id, part.id));
}

/// Sets places, weights, angles and histories of all plies of an element.
template <class Law>
auto start_plies(const Model& model, const Law& law)
{
    return [&model, &law](Index element, int lane, int points, const auto& values_of) {
        const std::vector<ThickPly> plies = thick_plies(model, element);
        for (int point = 0; point < points; ++point) {
            const std::size_t number = point % plies.size();
            const ThickPly& ply = plies[number];
            Lanes* values = values_of(point) + 6;
            values[Laminate::ply_place][lane] = ply.middle;
            values[Laminate::ply_weight][lane] = ply.share;
            values[Laminate::ply_cosine][lane] = std::cos(ply.angle);
            values[Laminate::ply_sine][lane] = std::sin(ply.angle);
            const auto start_values = [&](const auto& own) {
                const auto initial = own.initial_history();
                for (std::size_t i = 0; i < initial.size(); ++i) values[Laminate::own + i][lane] = initial[i];
            };
            std::visit(start_values, law.plies[number]);
        }
    };
}

} // namespace

std::span<const Layer> thick_shell_layers(const Model& model, Index element)
{
    const ThickShellElements& shells = model.thick_shells;
    if (!shells.layers.empty() && !shells.layers[element].empty()) return shells.layers[element];
    return model.parts[shells.part[element]].layers;
}

std::unique_ptr<SolidGroup> make_laminate_thick_shells(SolidSetup setup, State& state)
{
    const Model& model = setup.model;
    const Part& part = model.parts[setup.part];
    const ThickShellStress stress = thick_shell_stress(model, part);
    const std::vector<ThickPly> plies = thick_plies(model, setup.elements.front());
    Laminate shell;
    SolidLaminate solid;
    // The fastest ply sets the step. Of the mean, moduli are those of elastic plies without lateral strain.
    ThickShellElasticity elastic;
    double squared_speed = 0;
    const auto count = [&](const ThickPly& ply, double modulus, double density) {
        squared_speed = std::max(squared_speed, modulus / density);
        elastic.young_modulus += ply.share * modulus;
        elastic.density += ply.share * density;
    };
    for (const ThickPly& ply : plies) {
        const Record& material = model.materials[ply.material];
        if (stress == ThickShellStress::plane) {
            shell.plies.push_back(ply_law(model, part, material));
            count(ply, ply_modulus(shell.plies.back()), ply_density(shell.plies.back()));
            continue;
        }
        if (erosion_criteria(model, material)) {
            throw DeckError(part.where,
                            fmt::format("*PART {}: *MAT_ADD_EROSION is not supported for plies (*{} "
                                        "{})",
                                        part.id, material.keyword, material.id));
        }
        solid.plies.push_back(solid_ply_law(model, part, material));
        const auto largest = [](const auto& law) {
            if constexpr (requires { law.largest_modulus(); }) {
                return law.largest_modulus();
            } else {
                return SolidLaminate::normal_constants(law).second;
            }
        };
        count(ply, std::visit(largest, solid.plies.back()),
              std::visit([](const auto& law) { return law.density; }, solid.plies.back()));
    }
    ThickShellSettings settings =
        thick_shell_settings(model, part, elastic, static_cast<int>(plies.size()), setup.parameters);
    settings.wave_speed = std::sqrt(squared_speed);
    settings.points_fail = true;
    setup.shear_modulus = settings.shear_modulus;
    if (stress == ThickShellStress::plane) {
        const auto start = start_plies(model, shell);
        return std::make_unique<ThickShellGroup<ThickShellStress::plane, Laminate>>(
            shell, std::move(settings), std::move(setup), state, start);
    }
    const auto start = start_plies(model, solid);
    return std::make_unique<ThickShellGroup<ThickShellStress::solid, SolidLaminate>>(
        solid, std::move(settings), std::move(setup), state, start);
}

} // namespace plash

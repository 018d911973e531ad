#include "elements/shell_laminate.h"

#include "elements/erosion_criteria.h"
#include "elements/shell_group_makers.h"
#include "elements/shell_group_of_law.h"
#include "elements/shell_mass.h"
#include "materials/flow_laws.h"
#include "materials/parameters.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace plash {

namespace {

constexpr double degree = std::numbers::pi / 180;

ShellFrame<double> start_frame(const Model& model, Index element)
{
    const std::array<Index, 4> nodes = shell_corners(model, element);
    const auto at = [&](int i) { return model.nodes.position[nodes[i]]; };
    return shell_frame(pattern_of(at(0), at(1), at(2), at(3)));
}

/// Angle from side 1-2 to the reference direction of a material's axis a, before MANGLE and layer angles.
/// system  MCID of the element, or `none`
double reference_angle(const Model& model, const Record& material, const ShellFrame<double>& frame,
                       Index system)
{
    if (!material.peek("AOPT")) return 0; // isotropic: any direction will do
    const double option = material.real("AOPT");
    Vec3 direction{};
    if (system != none) {
        direction = model.coordinate_systems[system].axes[0];
    } else if (option == 0) {
        return 0;
    } else if (option == 2) {
        direction = {material.real("A1"), material.real("A2"), material.real("A3")};
    } else if (option == 3) {
        direction = cross(Vec3{material.real("V1"), material.real("V2"), material.real("V3")}, frame.e3);
    } else if (option < 0) {
        const Id id = static_cast<Id>(-option);
        for (const CoordinateSystem& system : model.coordinate_systems) {
            if (system.id == id) direction = system.axes[0];
        }
    } else {
        reject_field(
            material, "AOPT",
            fmt::format("material axes option {} is not supported for shells (0: side 1-2, 2: vector A, "
                        "3: vector V, below 0: a coordinate system)",
                        option));
    }
    const double x = dot(direction, frame.e1), y = dot(direction, frame.e2);
    if (x * x + y * y <= 1e-12 * dot(direction, direction)) {
        reject_field(material, "AOPT", "the direction that it names is missing or stands normal to a shell");
    }
    return std::atan2(y, x);
}

double own_angle(const Record& material)
{
    if (material.peek("MANGLE")) return degree * material.real("MANGLE");
    // BETA of 054/055 is the weight of shear, of the others the material angle.
    return material.peek("BETA") && material.peek("AOPT") ? degree * material.real("BETA") : 0;
}

} // namespace

PlyLaw ply_law(const Model& model, const Part& part, const Record& material)
{
    if (erosion_criteria(model, material)) {
        throw DeckError(part.where,
                        fmt::format("*PART {}: *MAT_ADD_EROSION is not supported for plies (*{} {})", part.id,
                                    material.keyword, material.id));
    }
    if (material.keyword == "MAT_ORTHOTROPIC_ELASTIC")
        return OrthotropicElastic::from_record(material, model);
    if (material.keyword == "MAT_COMPOSITE_DAMAGE" || material.keyword == "MAT_ENHANCED_COMPOSITE_DAMAGE") {
        return CompositeDamage::from_record(material, model);
    }
    if (material.keyword == "MAT_LAMINATED_COMPOSITE_FABRIC") {
        return LaminatedFabric::from_record(material, model);
    }
    if (material.keyword == "MAT_HILL_3R" ||
        material.keyword == "MAT_TRANSVERSELY_ANISOTROPIC_ELASTIC_PLASTIC") {
        return HillSheet::from_record(material, model);
    }
    if (material.keyword == "MAT_FABRIC") return Fabric::from_record(material, model);
    if (material.keyword == "MAT_ELASTIC") return Elastic::from_record(material, model);
    if (material.keyword == "MAT_PIECEWISE_LINEAR_PLASTICITY" || is_flow_law(material.keyword)) {
        return PiecewiseLinearPlasticity::from_record(material, model);
    }
    throw DeckError(material.where, fmt::format("*{} {} is not supported for the plies of part {}",
                                                material.keyword, material.id, part.id));
}

double ply_density(const PlyLaw& ply)
{
    return std::visit(
        [](const auto& law) {
            if constexpr (requires { law.density(); }) {
                return law.density();
            } else {
                return law.density;
            }
        },
        ply);
}

double ply_modulus(const PlyLaw& ply)
{
    return std::visit(
        [](const auto& law) {
            if constexpr (requires { law.largest_modulus(); }) {
                return law.largest_modulus();
            } else {
                return law.young_modulus / (1 - law.poisson_ratio * law.poisson_ratio);
            }
        },
        ply);
}

double ply_angle(const Model& model, const Record& material, const ShellFrame<double>& frame,
                 double element_angle, Index system)
{
    return reference_angle(model, material, frame, system) +
           (element_angle != 0 ? element_angle : own_angle(material));
}

std::vector<PlyPlace> plies_of(const Model& model, Index element)
{
    const Part& part = model.parts[model.shells.part[element]];
    const Record& section = shell_section(model, part);
    const ShellFrame<double> frame = start_frame(model, element);
    const double thickness = shell_thickness(model, element);
    const double element_angle =
        model.shells.material_angle.empty() ? 0 : degree * model.shells.material_angle[element];
    const Index system = model.shells.material_system.empty() ? none : model.shells.material_system[element];
    double offset = -0.5 * thickness * section.real("NLOC");
    if (!model.shells.offset.empty()) offset += model.shells.offset[element];
    const auto angle_of = [&](Index material) {
        return ply_angle(model, model.materials[material], frame, element_angle, system);
    };

    std::vector<PlyPlace> plies;
    const auto layers = shell_layers(model, element);
    double below = -0.5 * thickness;
    for (const Layer& layer : layers) {
        plies.push_back({layer.material, offset + below + 0.5 * layer.thickness, layer.thickness,
                         angle_of(layer.material) + degree * layer.angle});
        below += layer.thickness;
    }
    if (!layers.empty()) return plies;

    const Id points = section.integer("NIP") == 0 ? 2 : section.integer("NIP");
    const ThicknessRule rule = thickness_rule(model, section, points, "QR/IRID");
    const Table* angles = section.integer("ICOMP") == 1 ? section.table("ANGLE") : nullptr;
    for (int point = 0; point < rule.size(); ++point) {
        const bool given = angles && point < static_cast<int>(angles->rows());
        plies.push_back({part.material, offset + 0.5 * thickness * rule.place[point],
                         thickness * rule.weight[point],
                         angle_of(part.material) + (given ? degree * angles->at(point, 0) : 0)});
    }
    return plies;
}

void Laminate::start(ShellStore& store) const
{
    using namespace shell_record;
    constexpr int point_size = shell_record::history + history_size;
    store.ply_place = ply_place;
    store.ply_weight = ply_weight;
    for (const PlyLaw& ply : plies) {
        auto& shown = store.shown.emplace_back(
            std::visit([](const auto& law) { return shown_variables(law, true); }, ply));
        for (ShownVariable& one : shown)
            if (one.variable >= 0) one.variable += own;
    }
    for (Index batch = 0; batch < store.patches.batch_count(); ++batch) {
        for (int lane = 0; lane < lane_count; ++lane) {
            const Index element = store.patches.elements[batch * lane_count + lane];
            const std::vector<PlyPlace> places = plies_of(store.model, element);
            const double thickness_now = store.record(batch)[shell_record::thickness][lane];
            for (int column = 0; column < store.plane_points(); ++column) {
                for (std::size_t ply = 0; ply < places.size(); ++ply) {
                    Lanes* values = store.record(batch) + points +
                                    (column * places.size() + ply) * point_size + shell_record::history;
                    values[ply_place][lane] = 2 * places[ply].middle / thickness_now;
                    values[ply_weight][lane] = places[ply].thickness / thickness_now;
                    values[ply_cosine][lane] = std::cos(places[ply].angle);
                    values[ply_sine][lane] = std::sin(places[ply].angle);
                    const auto start_values = [&](const auto& law) {
                        const auto initial = law.initial_history();
                        for (std::size_t i = 0; i < initial.size(); ++i) values[own + i][lane] = initial[i];
                    };
                    std::visit(start_values, plies[ply]);
                }
            }
        }
    }
}

std::unique_ptr<Term> make_laminate_shells(const ShellPart& part, ShellFormulation formulation, State& state)
{
    const Model& model = part.model;
    const Part& owner = model.parts[part.part];
    Laminate law;
    double squared_speed = 0, modulus = 0, density = 0;
    const std::vector<PlyPlace> places = plies_of(model, part.elements.front());
    double thickness = 0;
    for (const PlyPlace& place : places) {
        law.plies.push_back(ply_law(model, owner, model.materials[place.material]));
        const PlyLaw& ply = law.plies.back();
        squared_speed = std::max(squared_speed, ply_modulus(ply) / ply_density(ply));
        modulus += place.thickness * ply_modulus(ply);
        density += place.thickness * ply_density(ply);
        thickness += place.thickness;
    }
    ShellSettings settings =
        shell_settings(model, part.part, density / thickness, modulus / thickness, 0, true);
    settings.wave_speed = std::sqrt(squared_speed);
    const auto count = static_cast<double>(places.size());
    settings.rule.place.assign(places.size(), 0);
    settings.rule.weight.assign(places.size(), 1 / count);
    settings.points_fail = true;
    return make_shells_of_settings(part, formulation, std::move(settings), std::move(law), state);
}

} // namespace plash

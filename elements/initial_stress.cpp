#include "elements/initial_stress.h"

#include "materials/depth_stress.h"
#include "materials/parameters.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <unordered_map>

namespace plash {

namespace {

/// Column of a table by its name; -1 when the table has none.
int column_of(const Table& table, std::string_view name)
{
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    return found == table.columns.end() ? -1 : static_cast<int>(found - table.columns.begin());
}

/// Names of the fields of a point: six components, plastic strain, place through the thickness.
using PointFields = std::array<const char*, 8>;
constexpr PointFields stress_fields = {"SIGXX", "SIGYY", "SIGZZ", "SIGXY", "SIGYZ", "SIGZX", "EPS", "T"};
constexpr PointFields strain_fields = {"EPSXX", "EPSYY", "EPSZZ", "EPSXY", "EPSYZ", "EPSZX", "", "T"};

std::vector<InitialStressPoint> points_of(const Record& record, std::string_view first_column,
                                          const PointFields& names)
{
    const Table* table = record.table(first_column);
    if (!table) {
        throw DeckError(record.where, fmt::format("*{}: the card gives no points", record.keyword));
    }
    int column[8];
    for (int i = 0; i < 8; ++i) column[i] = column_of(*table, names[i]);
    std::vector<InitialStressPoint> points;
    for (std::size_t row = 0; row < table->rows(); ++row) {
        const auto at = [&](int i) { return column[i] < 0 ? 0.0 : table->at(row, column[i]); };
        points.push_back({at(7), {at(0), at(1), at(2), at(3), at(4), at(5)}, at(6)});
    }
    return points;
}

/// Strains: of solids a single card, of shells rows, which without places stand at the lower and the upper
/// surface.
std::vector<InitialStressPoint> strains_of_card(const Record& record)
{
    if (record.table("EPSXX")) {
        std::vector<InitialStressPoint> points = points_of(record, "EPSXX", strain_fields);
        if (points.size() == 2 && points[0].place == points[1].place) {
            points[0].place = -1;
            points[1].place = 1;
        }
        return points;
    }
    const auto at = [&](int i) { return record.real(strain_fields[i]); };
    return {{0, {at(0), at(1), at(2), at(3), at(4), at(5)}, 0}};
}

/// What the cards of one family mean.
/// keyword    of single elements; that of sets has _SET behind it
/// points_in  the points of a card
template <class PointsIn>
InitialStresses read_points(const Model& model, std::string_view keyword, const std::vector<Id>& ids,
                            const std::vector<ElementSet>& sets, PointsIn&& points_in)
{
    InitialStresses stresses;
    const std::string set_keyword = std::string(keyword) + "_SET";
    std::unordered_map<Id, Index> place;
    for (const Record& record : model.others) {
        const bool of_set = record.keyword == set_keyword;
        if (record.keyword != keyword && !of_set) continue;
        if (place.empty()) {
            for (std::size_t i = 0; i < ids.size(); ++i) place.emplace(ids[i], static_cast<Index>(i));
        }
        for (const char* field : {"IVEFLG", "IALEGP"}) {
            if (record.peek(field) && record.real(field) != 0) {
                reject_field(record, field,
                             "energies and volumes at the start are not supported; leave it at 0");
            }
        }
        const InitialStress stress{record.where, points_in(record)};
        if (!of_set) {
            const auto found = place.find(record.integer("EID"));
            if (found == place.end()) {
                reject_field(record, "EID",
                             fmt::format("there is no such element {}", record.integer("EID")));
            }
            stresses[found->second] = stress;
            continue;
        }
        const auto set = std::find_if(sets.begin(), sets.end(),
                                      [&](const ElementSet& one) { return one.id == record.integer("SID"); });
        if (set == sets.end()) {
            reject_field(record, "SID", fmt::format("there is no such set {}", record.integer("SID")));
        }
        for (Index element : set->elements) stresses[element] = stress;
    }
    return stresses;
}

InitialStresses read_stresses(const Model& model, std::string_view keyword, std::string_view first_column,
                              const std::vector<Id>& ids, const std::vector<ElementSet>& sets)
{
    return read_points(model, keyword, ids, sets,
                       [&](const Record& record) { return points_of(record, first_column, stress_fields); });
}

/// Nothing where no result file shows strains.
InitialStresses read_strains(const Model& model, std::string_view keyword, const std::vector<Id>& ids,
                             const std::vector<ElementSet>& sets)
{
    if (!model.controls.output.strains()) return {};
    return read_points(model, keyword, ids, sets, [](const Record& record) {
        if (record.peek("ILOCAL") && record.integer("ILOCAL") != 0)
            reject_field(record, "ILOCAL", "strains have to be given in global axes (0)");
        return strains_of_card(record);
    });
}

/// z of the middle of a solid's nodes [length].
double middle_height(const Model& model, std::size_t element)
{
    double sum = 0;
    for (const Index node : model.solids.nodes[element]) sum += model.nodes.position[node].z;
    return sum / static_cast<double>(model.solids.nodes[element].size());
}

} // namespace

/// A single point in the middle of each solid for *INITIAL_STRESS_DEPTH.
InitialStresses initial_solid_stresses(const Model& model)
{
    InitialStresses stresses;
    for (const DepthStress& depth : depth_stresses(model)) {
        for (std::size_t element = 0; element < model.solids.size(); ++element) {
            if (model.solids.part[element] != depth.part) continue;
            stresses[static_cast<Index>(element)] = {depth.where,
                                                     {{0, depth.at(middle_height(model, element)), 0}}};
        }
    }
    for (auto& [element, stress] :
         read_stresses(model, "INITIAL_STRESS_SOLID", "SIGXX", model.solids.id, model.solid_sets)) {
        stresses[element] = std::move(stress);
    }
    return stresses;
}

InitialStresses initial_shell_stresses(const Model& model)
{
    return read_stresses(model, "INITIAL_STRESS_SHELL", "T", model.shells.id, model.shell_sets);
}

InitialStresses initial_thick_shell_stresses(const Model& model)
{
    return read_stresses(model, "INITIAL_STRESS_TSHELL", "T", model.thick_shells.id, model.thick_shell_sets);
}

InitialStresses initial_solid_strains(const Model& model)
{
    return read_strains(model, "INITIAL_STRAIN_SOLID", model.solids.id, model.solid_sets);
}

InitialStresses initial_shell_strains(const Model& model)
{
    return read_strains(model, "INITIAL_STRAIN_SHELL", model.shells.id, model.shell_sets);
}

InitialStresses initial_thick_shell_strains(const Model& model)
{
    return read_strains(model, "INITIAL_STRAIN_TSHELL", model.thick_shells.id, model.thick_shell_sets);
}

InitialStressPoint mean_of(const InitialStress& stress)
{
    InitialStressPoint mean;
    const double share = 1.0 / stress.points.size();
    for (const InitialStressPoint& point : stress.points) {
        mean.stress = mean.stress + share * point.stress;
        mean.plastic_strain += share * point.plastic_strain;
    }
    return mean;
}

InitialStressPoint through_thickness(const InitialStress& stress, double place, int column)
{
    // Points of the same place are those of a plane, in the order of its columns.
    std::map<double, std::vector<const InitialStressPoint*>> layers;
    for (const InitialStressPoint& point : stress.points) layers[point.place].push_back(&point);
    const auto at = [&](const std::vector<const InitialStressPoint*>& layer) -> const InitialStressPoint& {
        return *layer[std::min<std::size_t>(column, layer.size() - 1)];
    };
    if (layers.size() == 1) return at(layers.begin()->second);
    auto high = layers.upper_bound(place);
    if (high == layers.begin()) ++high;
    if (high == layers.end()) --high;
    const auto low = std::prev(high);
    const InitialStressPoint &a = at(low->second), &b = at(high->second);
    const double share = (place - low->first) / (high->first - low->first);
    return {place, a.stress + share * (b.stress - a.stress),
            std::max(0.0, a.plastic_strain + share * (b.plastic_strain - a.plastic_strain))};
}

} // namespace plash

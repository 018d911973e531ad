#include "ale/initial_state.h"

#include "ale/cell_pieces.h"
#include "ale/container.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plash {

namespace {

/// Values of the lines of one container: columns by name, those of the cards by their place, since several
/// cards use the same names.
class ContainerRow {
public:
    ContainerRow(const Record& record, const Table& table, std::size_t row)
        : record_(record), table_(table), row_(row)
    {}

    double at(std::string_view name) const { return table_.at(row_, column(name, 0)); }
    Id whole(std::string_view name) const { return std::llround(at(name)); }
    /// Of the columns that follow the `occurrence`-th one named X0.
    double shape_value(int occurrence, int offset) const
    {
        return table_.at(row_, column("X0", occurrence) + offset);
    }
    Vec3 shape_point(int occurrence, int offset) const
    {
        return {shape_value(occurrence, offset), shape_value(occurrence, offset + 1),
                shape_value(occurrence, offset + 2)};
    }

    [[noreturn]] void reject(std::string_view field, const std::string& why) const
    {
        throw DeckError({record_.where.file, table_.lines[row_]},
                        fmt::format("*{}, field {}: {}", record_.keyword, field, why));
    }

private:
    const Record& record_;
    const Table& table_;
    std::size_t row_;

    std::size_t column(std::string_view name, int occurrence) const
    {
        for (std::size_t i = 0; i < table_.columns.size(); ++i)
            if (table_.columns[i] == name && occurrence-- == 0) return i;
        return 0;
    }
};

const CoordinateSystem* find_system(const Model& model, Id id)
{
    for (const CoordinateSystem& system : model.coordinate_systems)
        if (system.id == id) return &system;
    return nullptr;
}

Container container_of(const ContainerRow& row, const DeckGroups& groups, const Model& model)
{
    Container container;
    const Id fill = row.whole("FILLOPT"), group = row.whole("FAMMG"), type = row.whole("CONTTYP");
    if (fill != 0 && fill != 1)
        row.reject("FILLOPT", fmt::format("{} is not one of 0 inside, 1 outside", fill));
    container.outside = fill == 1;
    if (group < 1 || group > static_cast<Id>(groups.groups.size()))
        row.reject("FAMMG",
                   fmt::format("there is no group {}; the deck has 1 to {}", group, groups.groups.size()));
    container.group = static_cast<int>(group) - 1;
    container.velocity = {row.at("VX"), row.at("VY"), row.at("VZ")};
    if (row.at("RADVEL") != 0) row.reject("RADVEL", "radial velocities are not supported");
    switch (type) {
    case 3:
        container.shape = Container::Shape::half_space;
        container.origin = row.shape_point(0, 0);
        container.normal = row.shape_point(0, 3);
        if (norm(container.normal) == 0) row.reject("XCOS", "the plane has no normal");
        container.normal = unit(container.normal);
        break;
    case 4:
        container.shape = Container::Shape::cone;
        container.origin = row.shape_point(1, 0);
        container.end = row.shape_point(1, 3);
        container.radius = row.shape_value(1, 6);
        container.end_radius = row.shape_value(1, 7);
        if (norm(container.end - container.origin) == 0) row.reject("X1", "the cylinder has no length");
        break;
    case 5:
        container.shape = Container::Shape::box;
        container.origin = row.shape_point(2, 0);
        container.end = row.shape_point(2, 3);
        if (const Id id = std::llround(row.shape_value(2, 6)); id != 0) {
            const CoordinateSystem* system = find_system(model, id);
            if (!system) row.reject("LCSID", fmt::format("there is no coordinate system {}", id));
            container.axis_x = system->axes[0];
            container.axis_y = system->axes[1];
            container.axis_z = system->axes[2];
            const auto global = [&](const Vec3& local) {
                return system->origin + local.x * system->axes[0] + local.y * system->axes[1] +
                       local.z * system->axes[2];
            };
            container.origin = global(container.origin);
            container.end = global(container.end);
        }
        break;
    case 6:
        container.shape = Container::Shape::sphere;
        container.origin = row.shape_point(3, 0);
        container.radius = row.shape_value(3, 3);
        break;
    default:
        row.reject("CONTTYP", fmt::format("container type {} is not supported; there are 3 plane, 4 cylinder "
                                          "or cone, 5 box, 6 sphere",
                                          type));
    }
    return container;
}

/// What a cell holds of each of the deck's groups: share of its volume, and that times velocity.
struct Filling {
    std::vector<double> share;
    std::vector<Vec3> flow;
};

/// One *INITIAL_VOLUME_FRACTION_GEOMETRY.
struct Geometry {
    std::vector<bool> parts; ///< whose cells it fills, by part of the Model
    int background = 0;
    std::vector<Container> containers;
};

std::vector<Geometry> geometries_of(const Model& model, const DeckGroups& groups)
{
    std::vector<Geometry> result;
    for (const Record& record : model.others) {
        if (record.keyword != "INITIAL_VOLUME_FRACTION_GEOMETRY") continue;
        Geometry geometry;
        geometry.parts.resize(model.parts.size());
        for (Index part : parts_of_fields(model, record, "FMSID", "FMIDTYP")) geometry.parts[part] = true;
        const Id background = record.integer("BAMMG");
        if (background < 1 || background > static_cast<Id>(groups.groups.size()))
            throw DeckError(record.where,
                            fmt::format("*{}, field BAMMG: there is no group {}; the deck has 1 "
                                        "to {}",
                                        record.keyword, background, groups.groups.size()));
        geometry.background = static_cast<int>(background) - 1;
        if (const Table* table = record.table("CONTTYP"))
            for (std::size_t row = 0; row < table->rows(); ++row)
                geometry.containers.push_back(container_of(ContainerRow(record, *table, row), groups, model));
        result.push_back(std::move(geometry));
    }
    return result;
}

/// Containers fill a cell one after the other. Cells that a surface passes are cut into `cuts` per axis, each
/// piece by the plane that the surface is there: the error falls with the square of the piece.
void fill_by_containers(Filling& filling, const Geometry& geometry, const FluidCell& cell, bool is_box)
{
    bool cut = false;
    for (const Container& container : geometry.containers) cut = cut || passes_cell(container, cell, is_box);
    const int pieces = cut ? cell_cuts : 1;
    double weights = is_box ? pieces * pieces * pieces : 0;
    Filling sum{std::vector<double>(filling.share.size()), std::vector<Vec3>(filling.share.size())};
    Filling part = sum;
    for (int k = 0; k < pieces; ++k) {
        for (int j = 0; j < pieces; ++j) {
            for (int i = 0; i < pieces; ++i) {
                const CellPiece piece = piece_of_cell(cell, is_box, pieces, {i, j, k});
                if (!is_box) weights += piece.volume;
                const double weight = is_box ? 1 / weights : piece.volume;
                std::fill(part.share.begin(), part.share.end(), 0.0);
                std::fill(part.flow.begin(), part.flow.end(), Vec3{});
                part.share[geometry.background] = 1;
                for (const Container& container : geometry.containers) {
                    const double inside = share_inside(container, piece.centre, piece.half);
                    if (inside == 0) continue;
                    for (double& other : part.share) other *= 1 - inside;
                    for (Vec3& other : part.flow) other *= 1 - inside;
                    part.share[container.group] += inside;
                    part.flow[container.group] += inside * container.velocity;
                }
                for (std::size_t g = 0; g < sum.share.size(); ++g) {
                    sum.share[g] += weight * part.share[g];
                    sum.flow[g] += weight * part.flow[g];
                }
            }
        }
    }
    for (std::size_t g = 0; g < sum.share.size(); ++g) {
        double& share = sum.share[g];
        if (!is_box) {
            share /= weights;
            sum.flow[g] *= 1 / weights;
        }
        if (share < 1e-12) share = 0;
        if (share > 1 - 1e-12) share = 1;
    }
    filling = std::move(sum);
}

/// Shares by element number.
using ElementShares = std::map<Id, std::vector<double>>;

ElementShares element_shares_of(const Model& model, const DeckGroups& groups)
{
    ElementShares result;
    for (const Record& record : model.others) {
        if (record.keyword != "INITIAL_VOLUME_FRACTION") continue;
        std::vector<double> share(groups.groups.size());
        double sum = 0;
        for (int g = 0; g < 7; ++g) {
            const double value = record.real(fmt::format("VF{}", g + 1));
            if (value == 0) continue;
            if (g >= static_cast<int>(share.size()))
                throw DeckError(record.where, fmt::format("*{}, field VF{}: the deck has {} groups",
                                                          record.keyword, g + 1, share.size()));
            sum += share[g] = value;
        }
        if (sum > 1 + 1e-6)
            throw DeckError(record.where, fmt::format("*{}: the fractions of element {} add up to {:g}",
                                                      record.keyword, record.integer("EID"), sum));
        result[record.integer("EID")] = std::move(share);
    }
    return result;
}

std::vector<bool> void_parts_of(const Model& model)
{
    std::vector<bool> result(model.parts.size());
    for (const Record& record : model.others) {
        if (record.keyword == "INITIAL_VOID_PART") {
            if (const Index part = find_part(model, record.integer("PID")); part != none) result[part] = true;
        } else if (record.keyword == "INITIAL_VOID_SET") {
            if (const PartSet* set = find_part_set(model, record.integer("PSID")))
                for (Index part : set->parts) result[part] = true;
        }
    }
    return result;
}

} // namespace

void fill_initial_state(Fluid& fluid, const MeshBlock& block, const DeckGroups& groups, const Model& model)
{
    const std::vector<Geometry> geometries = geometries_of(model, groups);
    const ElementShares by_element = element_shares_of(model, groups);
    const std::vector<bool> empty = void_parts_of(model);
    const std::size_t nodes = fluid.fields.node_mass.size();
    std::vector<double> weight(nodes, 0.0);
    std::array<std::vector<double>, 3> momentum;
    for (auto& component : momentum) component.assign(nodes, 0.0);
    bool moves = false;
    Filling filling;
    for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
        const Index solid = block.solids[number];
        const Index part = model.solids.part[solid];
        filling.share.assign(groups.groups.size(), 0.0);
        filling.flow.assign(groups.groups.size(), Vec3{});
        // A structured mesh belongs to no group: its cells start full of the first one.
        const int own = std::max(groups.group_of_part(part), 0);
        if (!empty[part]) filling.share[own] = 1;
        const FluidCell cell = fluid.cell(number);
        for (const Geometry& geometry : geometries)
            if (geometry.parts[part]) fill_by_containers(filling, geometry, cell, block.is_box());
        if (const auto found = by_element.find(model.solids.id[solid]); found != by_element.end()) {
            for (std::size_t g = 0; g < filling.share.size(); ++g) // velocities stay
                filling.flow[g] *= filling.share[g] > 0 ? found->second[g] / filling.share[g] : 0;
            filling.share = found->second;
        }
        double mass = 0;
        Vec3 own_momentum{};
        for (std::size_t g = 0; g < groups.groups.size(); ++g) {
            const DeckGroup& group = groups.groups[g];
            if (group.fluid == none || filling.share[g] == 0) continue;
            fluid.fill_place(cell.place, cell.volume, group.fluid, filling.share[g], group.density,
                             group.energy_per_mass);
            mass += filling.share[g] * group.density * cell.volume;
            own_momentum += (group.density * cell.volume) * filling.flow[g];
        }
        if (mass == 0) continue;
        moves = moves || norm(own_momentum) > 0;
        for (const std::ptrdiff_t node : cell.corners) {
            weight[node] += mass;
            momentum[0][node] += own_momentum.x;
            momentum[1][node] += own_momentum.y;
            momentum[2][node] += own_momentum.z;
        }
    }
    if (!moves) return;
    for (std::size_t node = 0; node < weight.size(); ++node) {
        if (weight[node] == 0) continue;
        for (int axis = 0; axis < 3; ++axis)
            fluid.fields.velocity[axis][node] += momentum[axis][node] / weight[node];
    }
}

} // namespace plash

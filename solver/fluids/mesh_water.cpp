#include "solver/fluids/new_water.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace plash {

namespace {

constexpr double precision = 1e-4; // shares that a deck's digits cannot tell from 0 and 1
constexpr int most_fluids = 6;     // *INITIAL_VOLUME_FRACTION has seven columns, one of them for the void

/// Fluids by material and equation of state, with the parts that hold them.
struct FluidParts {
    std::vector<std::vector<Index>> groups;
    std::vector<int> group_of_part; ///< by part of the Model; none: no water
};

FluidParts fluid_parts(const Model& model, const Water& water)
{
    FluidParts result;
    result.group_of_part.assign(model.parts.size(), none);
    for (Index part : water.parts) {
        const Part& own = model.parts[part];
        const auto same = [&](const std::vector<Index>& group) {
            const Part& other = model.parts[group.front()];
            return other.material == own.material && other.equation_of_state == own.equation_of_state;
        };
        auto found = std::find_if(result.groups.begin(), result.groups.end(), same);
        if (found == result.groups.end()) found = result.groups.insert(found, std::vector<Index>{});
        found->push_back(part);
        result.group_of_part[part] = static_cast<int>(found - result.groups.begin());
    }
    if (result.groups.size() > most_fluids)
        throw DeckError({},
                        fmt::format("the water of the deck is of {} materials; an Eulerian mesh made from it "
                                    "can hold {}",
                                    result.groups.size(), most_fluids));
    return result;
}

/// Cells of a mesh between planes, i fastest.
struct Cells {
    const MeshPlanes& planes;
    std::array<std::size_t, 3> count;

    explicit Cells(const MeshPlanes& the_planes) : planes(the_planes)
    {
        for (int axis = 0; axis < 3; ++axis) count[axis] = planes[axis].size() - 1;
    }
    std::size_t size() const { return count[0] * count[1] * count[2]; }
    std::size_t at(std::size_t i, std::size_t j, std::size_t k) const
    {
        return i + count[0] * (j + count[1] * k);
    }
};

/// Length of overlap with each cell along an axis, from the first one that is met.
struct Overlap {
    std::size_t first = 0;
    std::vector<double> share; ///< of the cell's own length
};

Overlap overlap_along(const std::vector<double>& planes, double low, double high)
{
    Overlap overlap;
    const auto above = std::upper_bound(planes.begin(), planes.end(), low);
    overlap.first = above == planes.begin() ? 0 : static_cast<std::size_t>(above - planes.begin()) - 1;
    for (std::size_t cell = overlap.first; cell + 1 < planes.size() && planes[cell] < high; ++cell) {
        const double length = std::min(high, planes[cell + 1]) - std::max(low, planes[cell]);
        overlap.share.push_back(std::max(length, 0.0) / (planes[cell + 1] - planes[cell]));
    }
    return overlap;
}

/// Bounds of a piece that is a box along the global axes.
std::array<Vec3, 2> box_of(const WaterPiece& piece, const Part& part)
{
    Vec3 low = piece.corners[0], high = low;
    for (const Vec3& corner : piece.corners)
        for (const auto component : vector_component) {
            low.*component = std::min(low.*component, corner.*component);
            high.*component = std::max(high.*component, corner.*component);
        }
    const Vec3 edges = high - low;
    const double volume = piece.size * piece.size * piece.size;
    if (std::abs(edges.x * edges.y * edges.z / volume - 1) > 1e-3)
        throw DeckError(part.where,
                        fmt::format("*PART {} '{}': its water is not made of boxes along the global "
                                    "axes, of which alone an Eulerian mesh can be made; give it "
                                    "ELFORM = 11 or 12 to use its own mesh",
                                    part.id, part.title));
    return {low, high};
}

/// Share of each fluid in each cell, and the part that has most of it.
struct Filling {
    std::vector<std::vector<double>> share; ///< by group and cell
    std::vector<Index> part;                ///< by cell
};

Filling fill(const Model& model, const Water& water, const FluidParts& fluids, const Cells& cells)
{
    Filling filling;
    filling.share.assign(fluids.groups.size(), std::vector<double>(cells.size()));
    filling.part.assign(cells.size(), none);
    std::vector<double> most(cells.size());
    for (const WaterPiece& piece : water.pieces) {
        const auto [low, high] = box_of(piece, model.parts[piece.part]);
        const Overlap x = overlap_along(cells.planes[0], low.x, high.x);
        const Overlap y = overlap_along(cells.planes[1], low.y, high.y);
        const Overlap z = overlap_along(cells.planes[2], low.z, high.z);
        std::vector<double>& own = filling.share[fluids.group_of_part[piece.part]];
        for (std::size_t k = 0; k < z.share.size(); ++k)
            for (std::size_t j = 0; j < y.share.size(); ++j)
                for (std::size_t i = 0; i < x.share.size(); ++i) {
                    const std::size_t cell = cells.at(x.first + i, y.first + j, z.first + k);
                    const double share = x.share[i] * y.share[j] * z.share[k];
                    own[cell] += share;
                    if (share <= most[cell]) continue;
                    most[cell] = share;
                    filling.part[cell] = piece.part;
                }
    }
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        double sum = 0;
        for (auto& group : filling.share) {
            if (group[cell] < precision) group[cell] = 0;
            sum += group[cell];
        }
        if (sum <= 1 - precision) continue;
        for (auto& group : filling.share) group[cell] /= sum;
    }
    return filling;
}

Index add_eulerian_section(Model& model)
{
    Record section = made_record("SECTION_SOLID", {}, {{"ELFORM", 11}});
    section.id = free_id(model.sections);
    model.sections.push_back(std::move(section));
    return static_cast<Index>(model.sections.size()) - 1;
}

Index add_void_part(Model& model, Index section)
{
    Record vacuum = made_record("MAT_VACUUM", {}, {});
    vacuum.id = free_id(model.materials);
    model.materials.push_back(std::move(vacuum));
    Part part;
    part.id = free_id(model.parts);
    part.title = "void";
    part.section = section;
    part.material = static_cast<Index>(model.materials.size()) - 1;
    model.parts.push_back(std::move(part));
    return static_cast<Index>(model.parts.size()) - 1;
}

void add_groups(Model& model, const FluidParts& fluids, Index void_part)
{
    for (const std::vector<Index>& parts : fluids.groups) {
        if (parts.size() == 1) {
            model.others.push_back(
                made_record("ALE_MULTI-MATERIAL_GROUP", {},
                            {{"SID", static_cast<double>(model.parts[parts.front()].id)}, {"IDTYPE", 1}}));
            continue;
        }
        PartSet set;
        set.id = free_id(model.part_sets);
        set.parts = parts;
        model.others.push_back(made_record("ALE_MULTI-MATERIAL_GROUP", {},
                                           {{"SID", static_cast<double>(set.id)}, {"IDTYPE", 0}}));
        model.part_sets.push_back(std::move(set));
    }
    model.others.push_back(
        made_record("ALE_MULTI-MATERIAL_GROUP", {},
                    {{"SID", static_cast<double>(model.parts[void_part].id)}, {"IDTYPE", 1}}));
}

/// Nodes of the sides that walls are.
void hold_sides(Model& model, const std::vector<WaterWall>& walls, const MeshPlanes& planes, Index first)
{
    const std::array<std::size_t, 3> count{planes[0].size(), planes[1].size(), planes[2].size()};
    for (const WaterWall& wall : walls) {
        const std::vector<double>& own = planes[wall.axis];
        const double side = wall.water_above ? own.front() : own.back();
        if (std::abs(side - wall.at) > 1e-6 * (own.back() - own.front())) continue;
        FixedNodes fixed;
        fixed.freedoms = wall.held;
        Index node = first;
        for (std::size_t k = 0; k < count[2]; ++k)
            for (std::size_t j = 0; j < count[1]; ++j)
                for (std::size_t i = 0; i < count[0]; ++i, ++node) {
                    const std::size_t place[3] = {i, j, k};
                    if (place[wall.axis] == (wall.water_above ? 0 : count[wall.axis] - 1))
                        fixed.nodes.push_back(node);
                }
        model.fixed_nodes.push_back(std::move(fixed));
    }
}

} // namespace

Record made_record(std::string_view keyword, Location where,
                   std::initializer_list<std::pair<const char*, double>> values)
{
    Record record;
    record.keyword = keyword;
    record.where = where;
    for (const auto& [name, value] : values) record.fields.push_back({name, value, {}, true, true, where});
    return record;
}

NewWater make_mesh_water(Model& model, const Water& water, const std::vector<WaterWall>& walls,
                         const MeshPlanes& planes)
{
    const FluidParts fluids = fluid_parts(model, water);
    const Cells cells(planes);
    const Filling filling = fill(model, water, fluids, cells);
    const Index section = add_eulerian_section(model);
    const Index void_part = add_void_part(model, section);
    for (Index part : water.parts) model.parts[part].section = section;
    add_groups(model, fluids, void_part);

    NewWater result;
    result.mesh_parts = water.parts;
    result.mesh_parts.push_back(void_part);
    const Index first = static_cast<Index>(model.nodes.size());
    Id node_id = free_id(model.nodes.id);
    for (double z : planes[2])
        for (double y : planes[1])
            for (double x : planes[0]) {
                model.nodes.id.push_back(node_id++);
                model.nodes.position.push_back({x, y, z});
            }
    const Index row = static_cast<Index>(planes[0].size()),
                sheet = row * static_cast<Index>(planes[1].size());
    Id element_id = free_id(model.solids.id);
    double filled = 0;
    for (std::size_t k = 0; k < cells.count[2]; ++k) {
        for (std::size_t j = 0; j < cells.count[1]; ++j) {
            for (std::size_t i = 0; i < cells.count[0]; ++i, ++element_id) {
                const std::size_t cell = cells.at(i, j, k);
                double sum = 0, largest = 0;
                for (const auto& group : filling.share) {
                    sum += group[cell];
                    largest = std::max(largest, group[cell]);
                }
                const bool full = largest == 1;
                const Index n = first + static_cast<Index>(i) + static_cast<Index>(j) * row +
                                static_cast<Index>(k) * sheet;
                model.solids.id.push_back(element_id);
                model.solids.part.push_back(full ? filling.part[cell] : void_part);
                model.solids.nodes.push_back({n, n + 1, n + 1 + row, n + row, n + sheet, n + 1 + sheet,
                                              n + 1 + row + sheet, n + row + sheet});
                filled += sum * (planes[0][i + 1] - planes[0][i]) * (planes[1][j + 1] - planes[1][j]) *
                          (planes[2][k + 1] - planes[2][k]);
                if (sum > 0)
                    for (Index node : model.solids.nodes.back())
                        result.nodes[filling.part[cell]].push_back(node);
                if (full || sum == 0) continue;
                Record record = made_record("INITIAL_VOLUME_FRACTION", {}, {{"EID", double(element_id)}});
                for (std::size_t g = 0; g < fluids.groups.size(); ++g)
                    record.fields.push_back(
                        {fmt::format("VF{}", g + 1), filling.share[g][cell], {}, true, true, {}});
                record.fields.push_back(
                    {fmt::format("VF{}", fluids.groups.size() + 1), 1 - sum, {}, true, true, {}});
                model.others.push_back(std::move(record));
            }
        }
    }
    if (!model.solids.axes.empty()) model.solids.axes.resize(model.solids.size());
    hold_sides(model, walls, planes, first);
    const double volume = water.volume();
    if (std::abs(filled / volume - 1) > 0.02)
        throw DeckError({},
                        fmt::format("the water's {} do not fill a space without gaps and overlaps: they have "
                                    "a volume of {:g}, the cells that they cover hold {:g}",
                                    water.particles ? "particles" : "elements", volume, filled));
    result.lines.push_back(
        fmt::format("an Eulerian mesh of {} x {} x {} cells, {:.4g} of its volume of {:.4g} "
                    "filled with water",
                    cells.count[0], cells.count[1], cells.count[2], filled,
                    (planes[0].back() - planes[0].front()) * (planes[1].back() - planes[1].front()) *
                        (planes[2].back() - planes[2].front())));
    static constexpr const char* sides[3][2] = {
        {"lower x", "upper x"}, {"lower y", "upper y"}, {"lower z", "upper z"}};
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const auto wall = std::find_if(walls.begin(), walls.end(), [&](const WaterWall& candidate) {
                const double at = side == 0 ? planes[axis].front() : planes[axis].back();
                return candidate.axis == axis && candidate.water_above == (side == 0) &&
                       std::abs(candidate.at - at) <= 1e-6 * (planes[axis].back() - planes[axis].front());
            });
            if (wall != walls.end())
                result.lines.push_back(fmt::format("its {} side at {:g} is closed: {}", sides[axis][side],
                                                   wall->at, wall->origin));
            else
                result.lines.push_back(fmt::format("its {} side at {:g} is open", sides[axis][side],
                                                   side == 0 ? planes[axis].front() : planes[axis].back()));
        }
    return result;
}

} // namespace plash

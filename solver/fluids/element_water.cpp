#include "solver/fluids/new_water.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace plash {

namespace {

Id next_number(const std::vector<Id>& ids)
{
    return ids.empty() ? 1 : *std::max_element(ids.begin(), ids.end()) + 1;
}

Index add_record(std::vector<Record>& list, Record record)
{
    record.id = 1;
    for (const Record& other : list) record.id = std::max(record.id, other.id + 1);
    list.push_back(std::move(record));
    return static_cast<Index>(list.size()) - 1;
}

/// Pieces of the spacing along each of a hexahedron's axes.
std::array<int, 3> pieces_along(const std::array<Vec3, 8>& corners, double spacing)
{
    static constexpr int edges[3][4][2] = {
        {{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
    std::array<int, 3> count{1, 1, 1};
    if (spacing <= 0) return count;
    for (int axis = 0; axis < 3; ++axis) {
        double length = 0;
        for (const auto& edge : edges[axis]) length += 0.25 * norm(corners[edge[1]] - corners[edge[0]]);
        count[axis] = std::max(1, static_cast<int>(std::round(length / spacing)));
    }
    return count;
}

bool has_keyword(const Model& model, std::string_view keyword)
{
    return std::any_of(model.others.begin(), model.others.end(),
                       [&](const Record& record) { return record.keyword == keyword; });
}

} // namespace

NewWater make_particle_water(Model& model, const Water& water, const std::vector<bool>& changed,
                             const std::vector<WaterWall>& walls, double spacing)
{
    NewWater result;
    const bool first_particles = model.particles.size() == 0;
    Id node_id = next_number(model.nodes.id);
    double largest = 0, smallest = std::numeric_limits<double>::infinity(), sum = 0;
    std::size_t made = 0;
    for (const WaterPiece& piece : water.pieces) {
        if (!changed[piece.part]) continue;
        const auto [nr, ns, nt] = pieces_along(piece.corners, spacing);
        for (int k = 0; k < nt; ++k)
            for (int j = 0; j < ns; ++j)
                for (int i = 0; i < nr; ++i) {
                    std::array<Vec3, 8> corners;
                    static constexpr int side[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
                    for (int n = 0; n < 8; ++n)
                        corners[n] = point_in(piece.corners, double(i + side[n % 4][0]) / nr,
                                              double(j + side[n % 4][1]) / ns, double(k + n / 4) / nt);
                    const double volume = volume_of(corners);
                    result.nodes[piece.part].push_back(static_cast<Index>(model.nodes.size()));
                    model.particles.node.push_back(static_cast<Index>(model.nodes.size()));
                    model.particles.part.push_back(piece.part);
                    model.particles.mass.push_back(-volume);
                    model.nodes.id.push_back(node_id++);
                    model.nodes.position.push_back(
                        point_in(piece.corners, (i + 0.5) / nr, (j + 0.5) / ns, (k + 0.5) / nt));
                    const double size = std::cbrt(volume);
                    largest = std::max(largest, size);
                    smallest = std::min(smallest, size);
                    sum += size;
                    ++made;
                }
    }
    result.spacing = sum / static_cast<double>(made);
    result.lines.push_back(fmt::format("{} particles, {:.4g} apart{}", made, result.spacing,
                                       spacing > 0 ? "" : ", one in the middle of each element"));
    if (largest > 1.2 * smallest)
        result.lines.push_back(
            fmt::format("WARNING: particles stand from {:.4g} to {:.4g} apart; pressures will "
                        "be wrong where these meet (SIZE of *PLASH_FLUID evens them out)",
                        smallest, largest));
    Index section = none, hourglass = none;
    for (Index part : water.parts)
        if (!changed[part]) {
            section = model.parts[part].section;
            hourglass = model.parts[part].hourglass;
        }
    const bool own_section = section == none;
    if (own_section)
        section = add_record(model.sections,
                             made_record("SECTION_SPH", {}, {{"CSLH", 1.5}, {"HMIN", 0.2}, {"HMAX", 2}}));
    for (Index part : water.parts) {
        if (!changed[part]) continue;
        model.parts[part].section = section;
        if (!own_section)
            model.parts[part].hourglass = hourglass; // particles of one body share their viscosity
    }
    if (first_particles && !has_keyword(model, "PLASH_SPH_FORMULATION") &&
        !has_keyword(model, "CONTROL_SPH")) {
        model.others.push_back(made_record("PLASH_SPH_FORMULATION", {}, {{"KERNEL", 4}, {"DELTA", 0.1}}));
        result.lines.push_back("kernel Wendland C2 with 1.5 spacings, density diffusion 0.1 (docs/sph.md)");
    }
    for (const WaterWall& wall : walls) {
        Vec3 tail{}, head{};
        tail.*vector_component[wall.axis] = wall.at;
        head.*vector_component[wall.axis] = wall.at + (wall.water_above ? 1 : -1);
        Record mirror = made_record("BOUNDARY_SPH_SYMMETRY_PLANE", {},
                                    {{"VTX", tail.x},
                                     {"VTY", tail.y},
                                     {"VTZ", tail.z},
                                     {"VHX", head.x},
                                     {"VHY", head.y},
                                     {"VHZ", head.z}});
        const bool there = std::any_of(model.others.begin(), model.others.end(), [&](const Record& other) {
            return other.keyword == mirror.keyword && other.real("VTX") == tail.x &&
                   other.real("VTY") == tail.y && other.real("VTZ") == tail.z &&
                   other.real("VHX") == head.x && other.real("VHY") == head.y && other.real("VHZ") == head.z;
        });
        if (there) continue;
        if (wall.origin.find("SYMMETRY_PLANE") == std::string::npos)
            model.others.push_back(std::move(mirror));
        result.lines.push_back(fmt::format("{} at {} = {:g} became a symmetry plane of the particles{}",
                                           wall.origin, "xyz"[wall.axis], wall.at,
                                           wall.held == 7 ? ", along which they slip" : ""));
    }
    return result;
}

NewWater make_solid_water(Model& model, const Water& water, const std::vector<bool>& changed,
                          const std::vector<WaterWall>& walls)
{
    NewWater result;
    if (!water.lattice)
        throw DeckError(
            {}, "the particles do not stand on a lattice along the global axes; no solids can be made "
                "of them");
    const double raster = 1e-3 * water.smallest_size;
    std::map<std::pair<Index, std::array<long, 3>>, Index> known;
    Id node_id = next_number(model.nodes.id), element_id = next_number(model.solids.id);
    std::size_t made = 0;
    const auto node_at = [&](Index part, const Vec3& place) {
        const std::array<long, 3> key{std::lround(place.x / raster), std::lround(place.y / raster),
                                      std::lround(place.z / raster)};
        // Round-off may put a corner into the next interval of the raster.
        for (long dx : {0, -1, 1})
            for (long dy : {0, -1, 1})
                for (long dz : {0, -1, 1}) {
                    const auto found = known.find({part, {key[0] + dx, key[1] + dy, key[2] + dz}});
                    if (found != known.end()) return found->second;
                }
        const Index node = static_cast<Index>(model.nodes.size());
        model.nodes.id.push_back(node_id++);
        model.nodes.position.push_back(place);
        known.emplace(std::pair(part, key), node);
        result.nodes[part].push_back(node);
        return node;
    };
    for (const WaterPiece& piece : water.pieces) {
        if (!changed[piece.part]) continue;
        std::array<Index, 8> nodes;
        for (int n = 0; n < 8; ++n) nodes[n] = node_at(piece.part, piece.corners[n]);
        model.solids.id.push_back(element_id++);
        model.solids.part.push_back(piece.part);
        model.solids.nodes.push_back(nodes);
        ++made;
    }
    if (!model.solids.axes.empty()) model.solids.axes.resize(model.solids.size());
    const Index section = add_record(model.sections, made_record("SECTION_SOLID", {}, {{"ELFORM", 1}}));
    for (Index part : water.parts) {
        if (!changed[part]) continue;
        double quadratic = 0, linear = 0;
        if (model.parts[part].hourglass != none) {
            const Record& old = model.hourglass[model.parts[part].hourglass];
            quadratic = old.real("Q1");
            linear = old.real("Q2");
        }
        model.parts[part].section = section;
        // Weak viscous control: a fluid has no stiffness that an hourglass mode could be measured by.
        model.parts[part].hourglass = add_record(
            model.hourglass,
            made_record("HOURGLASS", {}, {{"IHQ", 1}, {"QM", 1e-3}, {"Q1", quadratic}, {"Q2", linear}}));
    }
    result.lines.push_back(fmt::format("{} solids (ELFORM 1, hourglass control IHQ 1, QM 0.001)", made));
    for (const WaterWall& wall : walls) {
        FixedNodes fixed;
        fixed.freedoms = wall.held;
        for (const auto& [part, nodes] : result.nodes)
            for (Index node : nodes)
                if (std::abs(model.nodes.position[node].*vector_component[wall.axis] - wall.at) < raster)
                    fixed.nodes.push_back(node);
        if (fixed.nodes.empty()) continue;
        result.lines.push_back(fmt::format("{} at {} = {:g} holds {} nodes", wall.origin, "xyz"[wall.axis],
                                           wall.at, fixed.nodes.size()));
        model.fixed_nodes.push_back(std::move(fixed));
    }
    return result;
}

} // namespace plash

#include "solver/fluids/water.h"

#include "ale/fluid_term.h"
#include "contact/part_data.h"
#include "model/eulerian.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace plash {

namespace {

bool is_fluid(const Model& model, const Part& part)
{
    return part.material != none && part.equation_of_state != none &&
           model.materials[part.material].keyword == "MAT_NULL";
}

void add_piece(Water& water, Index part, const std::array<Vec3, 8>& corners)
{
    water.pieces.push_back({part, corners, std::cbrt(volume_of(corners))});
}

void add_solids(const Model& model, const std::vector<bool>& fluid, Water& water)
{
    for (std::size_t i = 0; i < model.solids.size(); ++i) {
        if (!fluid[model.solids.part[i]]) continue;
        std::array<Vec3, 8> corners;
        for (int n = 0; n < 8; ++n) {
            corners[n] = model.nodes.position[model.solids.nodes[i][n]];
            water.has_node[model.solids.nodes[i][n]] = true;
        }
        add_piece(water, model.solids.part[i], corners);
        water.solids = true;
    }
}

/// Distance of neighbours along one axis, if the particles stand in planes across it; 0: in a single one;
/// negative: they do not.
double plane_distance(std::vector<double> at, double spacing)
{
    std::sort(at.begin(), at.end());
    double distance = std::numeric_limits<double>::infinity(), sum = 0;
    for (std::size_t i = 1; i < at.size(); ++i) {
        const double gap = at[i] - at[i - 1];
        if (gap < 1e-3 * spacing) continue;
        distance = std::min(distance, gap);
        sum += gap;
    }
    if (sum == 0) return 0;
    const double planes = sum / distance;
    return distance > 0.5 * spacing && std::abs(planes - std::round(planes)) < 0.05 ? sum / std::round(planes)
                                                                                    : -1;
}

/// Boxes of the particles of one part: as long along each axis as its planes are apart.
void add_particles(const Model& model, Index part, bool plane_strain, Water& water)
{
    std::vector<Index> members;
    for (std::size_t i = 0; i < model.particles.size(); ++i)
        if (model.particles.part[i] == part) members.push_back(static_cast<Index>(i));
    if (members.empty()) return;
    water.particles = true;
    const double density = density_of(model, part);
    double volume = 0;
    for (Index member : members) {
        const double mass = model.particles.mass[member];
        volume += mass < 0 ? -mass : mass / density;
        water.has_node[model.particles.node[member]] = true;
    }
    volume /= static_cast<double>(members.size());
    const double spacing = plane_strain ? std::sqrt(volume) : std::cbrt(volume);
    double edge[3], known = 1;
    int flat = -1;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == 2 && plane_strain) {
            edge[axis] = 1; // masses of plane strain are by depth
            known *= edge[axis];
            continue;
        }
        std::vector<double> at;
        for (Index member : members)
            at.push_back(model.nodes.position[model.particles.node[member]].*vector_component[axis]);
        edge[axis] = plane_distance(std::move(at), spacing);
        if (edge[axis] == 0 && flat < 0)
            flat = axis;
        else if (edge[axis] <= 0)
            water.lattice = false;
        else
            known *= edge[axis];
    }
    if (flat >= 0) edge[flat] = volume / known;
    if (flat < 0 && std::abs(known / volume - 1) > 0.02) water.lattice = false;
    if (!water.lattice)
        for (double& side : edge) side = spacing;
    for (Index member : members) {
        const Vec3& centre = model.nodes.position[model.particles.node[member]];
        const Vec3 half{0.5 * edge[0], 0.5 * edge[1], 0.5 * edge[2]};
        add_piece(water, part, box_corners(centre - half, centre + half));
    }
}

/// The fluid of a mesh that is to become water: its densest one.
int chosen_group(const DeckGroups& groups, Water& water)
{
    int chosen = none;
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        const DeckGroup& group = groups.groups[g];
        if (group.fluid != none && (chosen == none || group.density > groups.groups[chosen].density))
            chosen = static_cast<int>(g);
    }
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        const DeckGroup& group = groups.groups[g];
        if (group.fluid == none || static_cast<int>(g) == chosen) continue;
        if (group.density > 0.1 * groups.groups[chosen].density)
            throw DeckError({}, fmt::format("the Eulerian mesh holds two liquids, '{}' and '{}'; only one "
                                            "liquid with gas or nothing beside it can be translated",
                                            groups.groups[chosen].name, group.name));
        water.remarks.push_back(fmt::format("the gas '{}' of the Eulerian mesh is left away", group.name));
    }
    return chosen;
}

/// Cells that are at least half full.
void add_mesh(const Model& model, Water& water)
{
    static constexpr int by_bits[8] = {0, 1, 3, 2, 4, 5, 7, 6}; // corner of the element to that of the cell
    double held = 0, kept = 0;
    for (const auto& term : make_eulerian_fluids(model)) {
        const DeckGroups& groups = term->groups();
        const DeckGroup& group = groups.groups[chosen_group(groups, water)];
        if (group.parts.empty())
            throw DeckError({}, fmt::format("the fluid '{}' of a structured mesh has no *PART, which its "
                                            "translation needs",
                                            group.name));
        const Fluid& fluid = term->fluid();
        const AlignedDoubles& fraction = fluid.fields.groups[group.fluid].fraction;
        for (std::size_t number = 0; number < fluid.cell_count(); ++number) {
            const FluidCell cell = fluid.cell(number);
            const double share = fraction.empty() ? 1 : fraction[cell.place];
            held += share * cell.volume;
            if (share < 0.5) continue;
            kept += cell.volume;
            std::array<Vec3, 8> corners;
            for (int n = 0; n < 8; ++n) corners[n] = cell.points[by_bits[n]];
            add_piece(water, group.parts.front(), corners);
        }
        for (Index node : term->block().nodes) water.has_node[node] = true;
    }
    water.mesh = true;
    if (std::abs(kept - held) > 1e-6 * held)
        water.remarks.push_back(
            fmt::format("cells that are at least half full count as full: {:+.2f} % of the "
                        "volume",
                        100 * (kept / held - 1)));
}

} // namespace

bool Water::is_already(FluidForm form) const
{
    switch (form) {
    case FluidForm::lagrange:
        return solids && !particles && !mesh;
    case FluidForm::sph:
        return particles && !solids && !mesh;
    case FluidForm::ale:
        break;
    }
    return mesh && !solids && !particles;
}

double Water::volume() const
{
    return std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double sum, const WaterPiece& piece) {
        return sum + piece.size * piece.size * piece.size;
    });
}

Water find_water(const Model& model)
{
    Water water;
    water.is_water.resize(model.parts.size());
    water.has_node.resize(model.nodes.size());
    std::vector<bool> fluid(model.parts.size());
    for (std::size_t part = 0; part < model.parts.size(); ++part) {
        const bool eulerian = is_eulerian(model, static_cast<Index>(part));
        fluid[part] = !eulerian && is_fluid(model, model.parts[part]);
        water.is_water[part] = eulerian;
    }
    bool plane_strain = false;
    for (const Record& record : model.others)
        if (record.keyword == "CONTROL_SPH") plane_strain = plane_strain || record.integer("IDIM") == 2;
    add_solids(model, fluid, water);
    for (std::size_t part = 0; part < model.parts.size(); ++part)
        if (fluid[part]) add_particles(model, static_cast<Index>(part), plane_strain, water);
    if (has_eulerian_mesh(model)) add_mesh(model, water);
    const bool any_particles = water.particles;
    water.smallest_size = std::numeric_limits<double>::infinity();
    std::vector<bool> of_particles(model.parts.size());
    for (Index part : model.particles.part) of_particles[part] = true;
    for (const WaterPiece& piece : water.pieces) {
        water.is_water[piece.part] = true;
        if (!any_particles || of_particles[piece.part])
            water.smallest_size = std::min(water.smallest_size, piece.size);
        for (const Vec3& corner : piece.corners) {
            const bool first = &piece == &water.pieces.front() && &corner == &piece.corners.front();
            for (const auto component : vector_component) {
                const double at = corner.*component;
                water.low.*component = first ? at : std::min(water.low.*component, at);
                water.high.*component = first ? at : std::max(water.high.*component, at);
            }
        }
    }
    std::vector<bool> listed(model.parts.size());
    for (const WaterPiece& piece : water.pieces) listed[piece.part] = true;
    for (std::size_t part = 0; part < listed.size(); ++part)
        if (listed[part]) water.parts.push_back(static_cast<Index>(part));
    return water;
}

std::array<Vec3, 8> box_corners(const Vec3& low, const Vec3& high)
{
    return {Vec3{low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, high.y, low.z},
            {low.x, high.y, low.z},    {low.x, low.y, high.z}, {high.x, low.y, high.z},
            {high.x, high.y, high.z},  {low.x, high.y, high.z}};
}

Vec3 point_in(const std::array<Vec3, 8>& corners, double r, double s, double t)
{
    const double x[2] = {1 - r, r}, y[2] = {1 - s, s}, z[2] = {1 - t, t};
    static constexpr int side[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    Vec3 sum{};
    for (int n = 0; n < 8; ++n) sum += (x[side[n % 4][0]] * y[side[n % 4][1]] * z[n / 4]) * corners[n];
    return sum;
}

double volume_of(const std::array<Vec3, 8>& corners)
{
    const std::vector<Vec3> position(corners.begin(), corners.end());
    return solid_volume({0, 1, 2, 3, 4, 5, 6, 7}, position);
}

double density_of(const Model& model, Index part)
{
    return model.materials[model.parts[part].material].real("RO");
}

} // namespace plash

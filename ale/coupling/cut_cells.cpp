#include "ale/coupling/cut_cells.h"

#include "ale/mixture.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plash {

namespace {

/// Parts that hold less of their cell join a neighbour.
constexpr double least_open = 0.5;

/// Fluid that leaves less than this of its part empty fills it: what passes faces one after the other leaves
/// such gaps.
constexpr double nearly_full = 1 - 1e-3;

/// Nodes bear no more of a face than twice their fluid over that of its fullest node: those with next to
/// nothing, a drop of spray, would be thrown away by it. The others bear the rest.
/// fluid  what each node has [volume, or mass where there is one fluid]
void spare_light_nodes(const std::array<double, 4>& fluid, std::array<double, 4>& weight)
{
    double fullest = 0, sum = 0;
    for (int n = 0; n < 4; ++n) {
        fullest = std::max(fullest, fluid[n]);
        sum += weight[n];
    }
    if (!(fullest > 0)) return;
    double kept = 0, excess = 0;
    std::array<double, 4> free = weight; // of those that can bear more
    for (int n = 0; n < 4; ++n) {
        const double most = 2 * fluid[n] / fullest * sum;
        if (weight[n] > most) {
            excess += weight[n] - most;
            weight[n] = most;
            free[n] = 0;
        }
        kept += free[n];
    }
    if (!(excess > 0 && kept > 0)) return;
    for (int n = 0; n < 4; ++n) weight[n] += excess / kept * free[n];
}

} // namespace

CutCells::CutCells(BoxFluid& fluid) : fluid_(fluid), entry_(fluid.grid.storage(), none)
{
    for (auto& entry : face_entry_) entry.assign(fluid.grid.storage(), none);
}

void CutCells::clear()
{
    for (const Cell& cell : cells_) entry_[cell.place] = none;
    for (const Face& face : faces_) face_entry_[face.axis][face.place] = none;
    cells_.clear();
    faces_.clear();
    groups_.clear();
    contents_.clear();
    by_size_.clear();
}

std::array<std::ptrdiff_t, 8> CutCells::nodes_of(const Cell& cell) const
{
    const BoxGrid& grid = fluid_.grid;
    std::array<std::ptrdiff_t, 8> nodes;
    for (int n = 0; n < 8; ++n)
        nodes[n] = cell.place + (n & 1) * grid.stride(0) + (n >> 1 & 1) * grid.stride(1) +
                   (n >> 2 & 1) * grid.stride(2);
    return nodes;
}

/// What a node has of all fluids: their mass, or where there are several, of which a light one fills as much
/// as a heavy one, their volume at the densities of reference.
double CutCells::fluid_at(std::ptrdiff_t node) const
{
    if (fluid_count() == 1) return fluid_.fields.node_mass[node];
    const BoxGrid& grid = fluid_.grid;
    double sum = 0;
    for (int g = 0; g < fluid_count(); ++g) {
        double mass = 0;
        for (int n = 0; n < 8; ++n)
            mass +=
                fluid_.fields.groups[g].mass[node - (n & 1) * grid.stride(0) - (n >> 1 & 1) * grid.stride(1) -
                                             (n >> 2 & 1) * grid.stride(2)];
        sum += mass / fluid_.groups[g].reference_density;
    }
    return sum;
}

bool CutCells::in_box(const std::array<int, 3>& index) const
{
    for (int axis = 0; axis < 3; ++axis)
        if (index[axis] < 0 || index[axis] >= fluid_.grid.cells(axis)) return false;
    return true;
}

std::array<int, 3> CutCells::beyond(const Cell& cell, int side) const
{
    std::array<int, 3> index = cell.index;
    index[side / 2] += side % 2 == 0 ? -1 : 1;
    return index;
}

Index CutCells::add_face(int axis, const std::array<int, 3>& index)
{
    const BoxGrid& grid = fluid_.grid;
    const std::ptrdiff_t place = grid.at(index[0], index[1], index[2]);
    Index& entry = face_entry_[axis][place];
    if (entry != none) return entry;
    entry = static_cast<Index>(faces_.size());
    const BoxCuts::Face cut = cuts_->face(axis, index[0], index[1], index[2]);
    const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
    Face face{place, axis, cut.open > 1 - 1e-6 ? 1 : cut.open, {}, {}};
    const bool whole = face.open == 1;
    const double area = face.open * grid.width(a, index[a]) * grid.width(b, index[b]);
    const double s = whole ? 0.5 : cut.middle[0], t = whole ? 0.5 : cut.middle[1];
    face.node = {place, place + grid.stride(a), place + grid.stride(b),
                 place + grid.stride(a) + grid.stride(b)};
    face.weight = {area * (1 - s) * (1 - t), area * s * (1 - t), area * (1 - s) * t, area * s * t};
    const auto between = [&](int along, double part) {
        const std::vector<double>& planes = grid.planes(along);
        const double low = planes[index[along]];
        return part == 0 ? low : low + part * (planes[index[along] + 1] - low);
    };
    face.middle.*vector_component[axis] = between(axis, 0);
    face.middle.*vector_component[a] = between(a, s);
    face.middle.*vector_component[b] = between(b, t);
    faces_.push_back(face);
    return entry;
}

/// Whether a cell that is none of these presses on a face, which it does on all four nodes alike.
bool CutCells::is_pressed_alike(const Face& face) const
{
    for (const std::ptrdiff_t side : {face.place - fluid_.grid.stride(face.axis), face.place})
        if (entry_[side] == none &&
            (fluid_.fields.pressure[side] != 0 || fluid_.fields.pressure_rate[side] != 0))
            return true;
    return false;
}

void CutCells::spare_light_nodes_from(std::size_t first_face)
{
    for (std::size_t n = first_face; n < faces_.size(); ++n) {
        Face& face = faces_[n];
        if (is_pressed_alike(face)) continue;
        std::array<double, 4> fluid;
        for (int corner = 0; corner < 4; ++corner) fluid[corner] = fluid_at(face.node[corner]);
        spare_light_nodes(fluid, face.weight);
    }
}

Index CutCells::add_cell(const std::array<int, 3>& index, double open)
{
    const BoxGrid& grid = fluid_.grid;
    const std::ptrdiff_t place = grid.at(index[0], index[1], index[2]);
    if (entry_[place] != none) return entry_[place];
    const Index number = entry_[place] = static_cast<Index>(cells_.size());
    Cell cell{index, place, grid.volume(index[0], index[1], index[2]), open, open, {}};
    for (int side = 0; side < 6; ++side) {
        std::array<int, 3> face = index;
        face[side / 2] += side % 2;
        cell.face[side] = add_face(side / 2, face);
    }
    cells_.push_back(cell);
    return number;
}

void CutCells::begin(const BoxCuts& cuts)
{
    if (!cells_.empty()) find_covered();
    clear();
    cuts_ = &cuts;
    if (held_axes_.empty()) {
        held_axes_.resize(fluid_.grid.storage());
        for (const HeldNode& node : fluid_.held) held_axes_[node.place] |= node.axes;
    }
    for (const BoxCuts::Cell& cut : cuts.cells()) {
        const std::ptrdiff_t place = fluid_.grid.at(cut.index[0], cut.index[1], cut.index[2]);
        if (!BoxContents::nothing(fluid_.contents.near_cells(place))) add_cell(cut.index, cut.open);
    }
    const std::size_t cut_cells = cells_.size();
    for (std::size_t n = 0; n < cut_cells; ++n)
        if (cells_[n].open < least_open) join(static_cast<Index>(n), cuts);
    join_covered();
    spare_light_nodes_from(0);
    for (std::size_t n = 0; n < cells_.size(); ++n) {
        Cell& cell = cells_[n];
        if (cell.parent != none) continue;
        cell.group = static_cast<Index>(groups_.size());
        groups_.emplace_back();
    }
    for (std::size_t n = 0; n < cells_.size(); ++n) {
        Cell& cell = cells_[n];
        if (cell.group == none) cell.group = cells_[root(static_cast<Index>(n))].group;
        const Vec3 middle{fluid_.grid.centre(0, cell.index[0]), fluid_.grid.centre(1, cell.index[1]),
                          fluid_.grid.centre(2, cell.index[2])};
        groups_[cell.group].volume += cell.open * cell.volume;
        groups_[cell.group].middle += cell.open * cell.volume * middle;
    }
    contents_.assign(groups_.size() * fluid_count(), {});
    for (const Cell& cell : cells_) {
        for (int g = 0; g < fluid_count(); ++g) {
            const GroupFields& own = fluid_.fields.groups[g];
            Content& sum = content(cell.group, g);
            sum.mass += own.mass[cell.place];
            sum.energy += own.energy[cell.place];
            sum.volume += own.fraction[cell.place] * cell.volume;
        }
    }
    for (Group& group : groups_) {
        const Index index = static_cast<Index>(&group - groups_.data());
        double sum = 0, mass = 0;
        for (int g = 0; g < fluid_count(); ++g) {
            sum += content(index, g).volume;
            mass += content(index, g).mass;
        }
        if (group.volume > 0) {
            group.middle = (1 / group.volume) * group.middle;
            group.density = mass / group.volume;
        }
        group.filled = group.volume > 0 ? sum / group.volume : 0;
        if (!(group.filled > nearly_full)) continue;
        for (int g = 0; g < fluid_count(); ++g) content(index, g).volume /= group.filled;
        group.filled = 1;
    }
}

double CutCells::out_rate(const Cell& cell, const std::array<AlignedDoubles, 3>& velocity) const
{
    double rate = 0;
    for (int side = 0; side < 6; ++side) {
        const Face& face = faces_[cell.face[side]];
        double passes = 0;
        for (int n = 0; n < 4; ++n) passes += face.weight[n] * velocity[face.axis][face.node[n]];
        rate += side % 2 == 0 ? -passes : passes;
    }
    return rate;
}

/// How far the cell beyond a face is filled, of what is open there; a covered one is as the cell itself.
double CutCells::filled_beyond(const Cell& cell, int side, double own) const
{
    const std::array<int, 3> index = beyond(cell, side);
    if (!in_box(index) || faces_[cell.face[side]].open < 0.02) return own;
    const std::ptrdiff_t place = fluid_.grid.at(index[0], index[1], index[2]);
    return entry_[place] != none ? groups_[cells_[entry_[place]].group].filled : filled_share(place);
}

double CutCells::openness_of(const Cell& cell, double own) const
{
    double below[3], above[3];
    for (int axis = 0; axis < 3; ++axis) {
        below[axis] = filled_beyond(cell, 2 * axis, own);
        above[axis] = filled_beyond(cell, 2 * axis + 1, own);
    }
    return openness(own, below, above);
}

void CutCells::find_pressure(Index index, const Cell& largest, double out, double node_stiffness, double step)
{
    Group& group = groups_[index];
    group.pressure = 0;
    group.step = 1e300;
    if (!(group.filled > 0 && group.volume > 0)) return;
    Mixture<double> mix;
    double mass = 0;
    for (int g = 0; g < fluid_count(); ++g) {
        const Content& own = content(index, g);
        mix.fraction[g] = own.volume / group.volume;
        mix.mass[g] = own.mass;
        mix.energy[g] = own.energy;
        mass += own.mass;
    }
    if (!(mass > 0)) return;
    const double divergence = (out - group.swept) / group.volume;
    const LagrangeSettings& settings = fluid_.lagrange;
    const double open = group.filled < 1 ? openness_of(largest, group.filled) : 0;
    close_mixture<double>(mix, fluid_.groups, group.volume, settings.void_allowed, open,
                          std::max(-divergence * step, 0.0));
    group.filled = 0;
    for (int g = 0; g < fluid_count(); ++g) {
        Content& own = content(index, g);
        own.volume = mix.fraction[g] * group.volume;
        own.energy = mix.energy[g];
        own.share = mix.share[g];
        group.filled += mix.fraction[g];
    }
    double length = 1e300;
    for (int axis = 0; axis < 3; ++axis)
        length = std::min(length, fluid_.grid.width(axis, largest.index[axis]));
    const double jump = std::max(-divergence, 0.0) * length;
    const double viscous =
        settings.quadratic_viscosity * jump + settings.linear_viscosity * std::sqrt(mix.signal_square);
    const double bulk_viscosity = mix.stiffness > 0 ? mass / group.volume * jump * viscous : 0;
    group.pressure = mix.pressure + bulk_viscosity - 0.5 * step * mix.stiffness * divergence;
    // 4 / 1.5: so that a whole cell of water asks for the step of a mesh of such cells.
    const double rate_square =
        4 / 1.5 * mix.stiffness / group.volume * (node_stiffness + group.structure_compliance);
    if (rate_square > 0) group.step = 2 / std::sqrt(rate_square);
}

void CutCells::find_pressures(double step)
{
    std::vector<double> out(groups_.size()), node_stiffness(groups_.size());
    std::vector<Index> largest(groups_.size(), none);
    // Squares of what a group's pressure does to a node, over the node's mass.
    std::vector<std::pair<std::pair<Index, std::ptrdiff_t>, double>> parts;
    for (std::size_t n = 0; n < cells_.size(); ++n) {
        const Cell& cell = cells_[n];
        out[cell.group] += out_rate(cell, fluid_.fields.velocity);
        Index& best = largest[cell.group];
        if (best == none || cells_[best].open < cell.open) best = static_cast<Index>(n);
        for (int side = 0; side < 6; ++side) {
            const Face& face = faces_[cell.face[side]];
            for (int m = 0; m < 4; ++m)
                parts.push_back(
                    {{cell.group, 3 * face.node[m] + face.axis}, (side % 2 == 0 ? -1 : 1) * face.weight[m]});
        }
    }
    std::sort(parts.begin(), parts.end());
    for (std::size_t n = 0; n < parts.size();) {
        const auto key = parts[n].first;
        double sum = 0;
        for (; n < parts.size() && parts[n].first == key; ++n) sum += parts[n].second;
        const double mass = fluid_.fields.node_mass[key.second / 3];
        const bool held = held_axes_[key.second / 3] >> key.second % 3 & 1;
        if (mass > 0 && !held) node_stiffness[key.first] += sum * sum / mass;
    }
    for (std::size_t g = 0; g < groups_.size(); ++g)
        find_pressure(static_cast<Index>(g), cells_[largest[g]], out[g], node_stiffness[g], step);
    for (const Cell& cell : cells_) fluid_.fields.pressure[cell.place] = groups_[cell.group].pressure;
}

double CutCells::stable_step() const
{
    double step = 1e300;
    for (const Group& group : groups_) step = std::min(step, group.step);
    return step;
}

void CutCells::end(const BoxCuts& cuts)
{
    const std::size_t before = cells_.size(), faces_before = faces_.size();
    for (std::size_t n = 0; n < before; ++n) {
        Cell& cell = cells_[n];
        cell.next = cuts.open_share(cell.index[0], cell.index[1], cell.index[2]);
    }
    touched_next_.clear();
    for (const BoxCuts::Cell& cut : cuts.cells()) {
        const std::ptrdiff_t place = fluid_.grid.at(cut.index[0], cut.index[1], cut.index[2]);
        touched_next_.push_back(place);
        if (entry_[place] != none) continue;
        const double open = cuts_->open_share(cut.index[0], cut.index[1], cut.index[2]);
        if (open > 0) continue; // it enters the cell's list in the next step
        if (BoxContents::nothing(fluid_.contents.near_cells(place))) continue;
        const Index number = add_cell(cut.index, 0);
        cells_[number].next = cut.open;
    }
    for (std::size_t n = before; n < cells_.size(); ++n) {
        const std::size_t known = cells_.size();
        join(static_cast<Index>(n), cuts);
        if (cells_.size() > known) { // a parent that was not cut and is not: of its own
            Cell& parent = cells_.back();
            parent.next = cuts.open_share(parent.index[0], parent.index[1], parent.index[2]);
        }
    }
    spare_light_nodes_from(faces_before);
    for (std::size_t n = before; n < cells_.size(); ++n) {
        const Index of = cells_[root(static_cast<Index>(n))].group;
        cells_[n].group = of;
    }
    by_size_.resize(cells_.size());
    std::iota(by_size_.begin(), by_size_.end(), 0);
    std::stable_sort(by_size_.begin(), by_size_.end(),
                     [&](Index a, Index b) { return cells_[a].open < cells_[b].open; });
}

void CutCells::before_forces()
{
    for (const Cell& cell : cells_)
        fluid_.fields.pressure[cell.place] = fluid_.fields.pressure_rate[cell.place] = 0;
}

/// What passes the faces between parts that have joined, so that all of a group have the same density at the
/// end of the step.
void CutCells::pass_to_parents()
{
    for (const Index number : by_size_) {
        Cell& cell = cells_[number];
        if (cell.parent == none || cell.group == none) continue;
        const double filled = std::min(groups_[cell.group].filled, 1.0);
        double has = 0;
        for (int g = 0; g < fluid_count(); ++g) {
            const Content& sum = content(cell.group, g);
            if (sum.mass > 0) has += fluid_.fields.groups[g].mass[cell.place] / sum.mass * sum.volume;
        }
        double leaves = 0;
        for (int side = 0; side < 6; ++side) {
            if (side == cell.to_parent) continue;
            const double out = (side % 2 == 0 ? -1 : 1) * faces_[cell.face[side]].flux;
            leaves += out * (out > 0 ? filled : filled_beyond(cell, side, filled));
        }
        const double excess = has - leaves - cell.next * cell.volume * filled;
        Face& face = faces_[cell.face[cell.to_parent]];
        face.flux = (cell.to_parent % 2 == 0 ? -1 : 1) * excess;
        face.joint = true;
    }
}

/// Returns the work of the fluid's pressure on all that bounds it.
double CutCells::deform(double step)
{
    FluidFields& fields = fluid_.fields;
    for (Face& face : faces_) {
        face.flux = 0;
        for (int n = 0; n < 4; ++n)
            face.flux += step * face.weight[n] * fields.mean_velocity[face.axis][face.node[n]];
    }
    std::vector<double> growth(groups_.size()), volume(groups_.size());
    for (const Cell& cell : cells_) {
        if (cell.group == none) continue;
        double out = 0;
        for (int side = 0; side < 6; ++side) out += (side % 2 == 0 ? -1 : 1) * faces_[cell.face[side]].flux;
        growth[cell.group] += out + (cell.next - cell.open) * cell.volume;
        volume[cell.group] += out + cell.next * cell.volume;
    }
    double work = 0;
    std::vector<double> energy_of(contents_.size());
    for (std::size_t index = 0; index < groups_.size(); ++index) {
        Group& group = groups_[index];
        double shares = 0, mass = 0, sum = 0;
        for (int g = 0; g < fluid_count(); ++g) {
            shares += content(index, g).share;
            mass += content(index, g).mass;
        }
        const double done = group.pressure * growth[index];
        if (mass > 0) work += done;
        for (int g = 0; g < fluid_count(); ++g) {
            Content& own = content(index, g);
            own.energy -= done * (shares > 0 ? own.share / shares : mass > 0 ? own.mass / mass : 0);
            own.volume = std::max(own.volume + own.share * growth[index], 0.0);
            sum += own.volume;
        }
        if (sum > volume[index] && sum > 0)
            for (int g = 0; g < fluid_count(); ++g)
                content(index, g).volume *= std::max(volume[index], 0.0) / sum;
        group.filled = volume[index] > 0 ? std::min(sum / volume[index], 1.0) : 1;
        if (group.filled > nearly_full) group.filled = 1;
    }
    pass_to_parents();
    for (const Face& face : faces_) fields.volume_flux[face.axis][face.place] = face.flux;
    for (const Cell& cell : cells_) {
        double out = 0;
        for (int side = 0; side < 6; ++side) out += (side % 2 == 0 ? -1 : 1) * faces_[cell.face[side]].flux;
        fields.volume[cell.place] = cell.volume + out;
        if (cell.group == none) continue;
        for (int g = 0; g < fluid_count(); ++g) {
            const Content& sum = content(cell.group, g);
            GroupFields& own = fields.groups[g];
            const double part = sum.mass > 0 ? own.mass[cell.place] / sum.mass : 0;
            own.energy[cell.place] = part * sum.energy;
            own.fraction[cell.place] = part * sum.volume / fields.volume[cell.place];
        }
    }
    return work;
}

/// Fluid that fills its part leaves through all open faces, and what passes between parts that have joined is
/// fluid alone; else the interface counts, of which a face sees the open part only.
void CutCells::share_outflow(int axis)
{
    for (const Cell& cell : cells_) {
        if (cell.group == none) continue;
        const Group& group = groups_[cell.group];
        double sum = 0;
        for (const GroupFields& own : fluid_.fields.groups) sum += own.fraction[cell.place];
        if (!(sum > 0)) continue;
        for (int side = 0; side < 2; ++side) {
            const Face& face = faces_[cell.face[2 * axis + side]];
            double shares = 0; // the covered part counts as empty space to the interface
            for (const GroupFields& own : fluid_.fields.groups)
                shares += own.share_of_outflow[side][cell.place];
            for (GroupFields& own : fluid_.fields.groups) {
                double& share = own.share_of_outflow[side][cell.place];
                if (group.filled >= 1 || face.joint)
                    share = shares > 0 ? share / shares : own.fraction[cell.place] / sum;
                else if (face.open > 0)
                    share = std::min(share / face.open, 1.0);
            }
        }
    }
}

void CutCells::keep()
{
    kept_.clear();
    const auto keep_place = [&](std::ptrdiff_t place) {
        for (int g = 0; g < fluid_count(); ++g) {
            const GroupFields& own = fluid_.fields.groups[g];
            kept_.push_back({place, g, own.fraction[place], own.energy[place]});
        }
    };
    for (const Cell& cell : cells_) keep_place(cell.place);
    for (const std::ptrdiff_t place : touched_next_)
        if (entry_[place] == none) keep_place(place);
}

void CutCells::restore()
{
    for (const Kept& kept : kept_) {
        GroupFields& own = fluid_.fields.groups[kept.fluid];
        own.fraction[kept.place] = kept.fraction;
        own.energy[kept.place] = kept.energy;
    }
}

} // namespace plash

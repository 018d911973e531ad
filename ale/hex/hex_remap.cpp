#include "ale/hex/hex_fluid.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace plash {

/// Youngs' normal on a mesh: fractions at nodes are means of the cells around, and differences are those
/// between opposite faces. On a box these are his sums over 27 cells.
Vector3<double> HexFluid::gradient(const FirstGroups& first, std::size_t cell) const
{
    double at[8];
    for (int corner = 0; corner < 8; ++corner) {
        const Index node = mesh.corners[cell][corner];
        const std::size_t begin = mesh.first_corner[node], end = mesh.first_corner[node + 1];
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += first.at<double>(mesh.node_corner[i] / 8);
        at[corner] = sum / static_cast<double>(end - begin);
    }
    double difference[3] = {};
    for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis)
            difference[axis] += (corner >> axis & 1) ? 8 * at[corner] : -8 * at[corner];
    return {difference[0], difference[1], difference[2]};
}

void HexFluid::find_outflow_shares(const HexSweep& sweep)
{
    for_chunks(sweep.members.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t member = begin; member < end; ++member) {
            const auto [cell, axis] = sweep.members[member];
            const Mask mask = contents_[cell];
            if (BoxContents::nothing(mask) || BoxContents::pure(mask)) continue;
            const double per_volume = 1 / fields.volume[cell];
            const double low = volume_flux_[mesh.cell_faces[cell][2 * axis]];
            const double high = volume_flux_[mesh.cell_faces[cell][2 * axis + 1]];
            const double lower_part = std::clamp(-low * per_volume, 0.0, 1.0);
            const double upper_part = std::clamp(high * per_volume, 0.0, 1.0);
            if (lower_part == 0 && upper_part == 0) continue;
            share_outflow<double>(fields, cell, axis, lower_part, upper_part,
                                  [&](const FirstGroups& first) { return gradient(first, cell); });
        }
    });
}

/// Flux of the only group of a mesh that is full of it.
template <bool second_order>
double HexFluid::flux_of_full(const HexSweep& sweep, std::size_t entry)
{
    const HexLine& line = sweep.lines[entry];
    const std::size_t face = sweep.first_face + entry;
    const double flux = volume_flux_[face];
    const bool upward = flux > 0;
    const GroupScratch& own = scratch_[0];
    const auto values = [&](const std::vector<double>& of) {
        return Line<double>{of[line.far_below], of[line.below], of[line.above], of[line.far_above]};
    };
    const Index donor = upward ? line.below : line.above;
    const double part = std::abs(flux) / fields.volume[donor];
    const double mass = flux * carried_value<second_order>(values(own.density), upward, part, line.weights);
    const double donor_mass = fields.groups[0].mass[donor];
    const double mass_part = donor_mass > 0 ? std::abs(mass) / donor_mass : 0;
    const double energy =
        mass * carried_value<second_order>(values(own.energy), upward, mass_part, line.weights);
    scratch_[0].flux[entry] = {flux, mass, energy};
    return mass;
}

template <bool second_order>
double HexFluid::flux_of_parts(const HexSweep& sweep, std::size_t entry)
{
    const HexLine& line = sweep.lines[entry];
    const std::size_t face = sweep.first_face + entry;
    const double flux = volume_flux_[face];
    const bool upward = flux > 0;
    const Index donor = upward ? line.below : line.above;
    // Beyond an end of the chord stands a uniform mixture like that in the last cell.
    const bool from_beyond = (upward ? mesh.faces[face].below : mesh.faces[face].above) == none;
    const Index cells[4] = {line.far_below, line.below, line.above, line.far_above};
    double total = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        GroupScratch& scratch = scratch_[g];
        const GroupFields& own = fields.groups[g];
        if (flux == 0 || !(contents_[donor] & (1u << g))) {
            scratch.flux[entry] = {};
            continue;
        }
        const auto values = [&](const auto& of) {
            return Line<double>{of[cells[0]], of[cells[1]], of[cells[2]], of[cells[3]]};
        };
        GroupLine<double> lines{values(scratch.density), values(scratch.energy), values(own.mass), {}, 0, 0};
        const double donor_mass = own.mass[donor];
        lines.inverse_mass.below = lines.inverse_mass.above = donor_mass > 0 ? 1 / donor_mass : 0;
        lines.volume_below = own.fraction[line.below] * fields.volume[line.below];
        lines.volume_above = own.fraction[line.above] * fields.volume[line.above];
        const double fraction = own.fraction[donor];
        const double cut = from_beyond ? fraction : own.share_of_outflow[upward ? 1 : 0][donor];
        scratch.flux[entry] = partial_flux<second_order>(lines, flux, fraction, cut, line.weights);
        total += scratch.flux[entry].mass;
    }
    return total;
}

template <bool second_order>
void HexFluid::find_fluxes(const HexSweep& sweep)
{
    for_chunks(sweep.members.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t member = begin; member < end; ++member) {
            const Index cell = sweep.members[member].cell;
            for (std::size_t g = 0; g < groups.size(); ++g) {
                const GroupFields& own = fields.groups[g];
                const double mass = own.mass[cell];
                const double volume = (mixed_ && mass > 0 ? own.fraction[cell] : 1) * fields.volume[cell];
                scratch_[g].density[cell] = mass / volume;
                scratch_[g].energy[cell] = mass > 0 ? own.energy[cell] / mass : 0;
            }
        }
    });
    for_chunks(sweep.lines.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry)
            mass_flux_[sweep.first_face + entry] =
                mixed_ ? flux_of_parts<second_order>(sweep, entry) : flux_of_full<second_order>(sweep, entry);
    });
}

void HexFluid::move_cells(const HexSweep& sweep)
{
    for_chunks(sweep.members.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t member = begin; member < end; ++member) {
            const auto [cell, axis] = sweep.members[member];
            const Index low = mesh.cell_faces[cell][2 * axis], high = mesh.cell_faces[cell][2 * axis + 1];
            member_flux_[member] = mass_flux_[low] + mass_flux_[high];
            const double before = fields.volume[cell];
            const double after = before + (volume_flux_[low] - volume_flux_[high]);
            fields.volume[cell] = after;
            double total = 0;
            for (std::size_t g = 0; g < groups.size(); ++g) {
                GroupFields& own = fields.groups[g];
                const GroupFlux<double>&in = scratch_[g].flux[low - sweep.first_face],
                      &out = scratch_[g].flux[high - sweep.first_face];
                const double mass = own.mass[cell] + (in.mass - out.mass);
                const double energy = own.energy[cell] + (in.energy - out.energy);
                if (!mixed_) {
                    own.mass[cell] = mass;
                    own.energy[cell] = energy;
                    continue;
                }
                const double volume = own.fraction[cell] * before + (in.volume - out.volume);
                // Round-off of what should be nothing, or full.
                const bool has = mass > 0 && volume > 1e-14 * after;
                const double fraction = volume / after;
                own.mass[cell] = has ? mass : 0;
                own.energy[cell] = has ? energy : 0;
                own.fraction[cell] = !has ? 0 : fraction > 1 - 1e-13 ? 1 : fraction;
                total += own.mass[cell];
            }
            if (groups.size() > 1) fields.mass_of_groups[cell] = total;
        }
    });
}

/// Benson's half-index shift; see sweep_momentum for boxes.
template <bool second_order>
void HexFluid::move_momentum(const HexSweep& sweep)
{
    const auto& v = fields.velocity;
    for_chunks(sweep.edges.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t edge = begin; edge < end; ++edge) {
            double flux = 0;
            for (const auto* part = sweep.around_edge.begin(edge); part != sweep.around_edge.end(edge);
                 ++part)
                flux += part->sign * member_flux_[part->member];
            flux *= 0.125;
            edge_flux_[edge] = flux;
            if (flux == 0) continue;
            const HexLine& line = sweep.edges[edge];
            const bool upward = flux > 0;
            const Index donor = upward ? line.below : line.above;
            const double donor_mass = fields.node_mass[donor];
            const double part = donor_mass > 0 ? std::min(std::abs(flux) / donor_mass, 1.0) : 0;
            const auto known = [&](Index node, int axis) {
                return v[axis][fields.node_mass[node] > 0 ? node : donor];
            };
            double carried[3];
            for (int axis = 0; axis < 3; ++axis) {
                const Line<double> values{known(line.far_below, axis), known(line.below, axis),
                                          known(line.above, axis), known(line.far_above, axis)};
                carried[axis] = carried_value<second_order>(values, upward, part, line.weights);
            }
            edge_velocity_[edge] = {carried[0], carried[1], carried[2]};
        }
    });
    update_nodes(sweep);
}

/// Momentum of nodes after what came in and left, as a change of velocity: mass_after (v_after - v) is the
/// sum of each flow times (its velocity - v). What passes an end of a chord has the node's own.
void HexFluid::update_nodes(const HexSweep& sweep)
{
    const bool keep_lost = !fields.lost_motion.empty();
    for_chunks(sweep.nodes.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Index node = sweep.nodes[i];
            const Vec3 v{fields.velocity[0][node], fields.velocity[1][node], fields.velocity[2][node]};
            const double before = fields.node_mass[node];
            double change = 0, through = 0, lost = 0;
            Vec3 momentum{};
            for (const auto* flow = sweep.at_node.begin(i); flow != sweep.at_node.end(i); ++flow) {
                const double in =
                    flow->sign * (flow->end ? 0.25 * mass_flux_[flow->edge] : edge_flux_[flow->edge]);
                if (in == 0) continue;
                change += in;
                if (flow->sign > 0) through += std::abs(in);
                if (flow->end) continue;
                const Vec3 faster = edge_velocity_[flow->edge] - v;
                momentum += in * faster;
                lost += in * dot(faster, faster);
            }
            if (through == 0 && change == 0) continue;
            const double after = before + change;
            const bool has = after > 1e-13 * (before + through);
            fields.node_mass[node] = has ? after : 0;
            const Vec3 gain = has ? (1 / after) * momentum : Vec3{};
            fields.velocity[0][node] = v.x + gain.x;
            fields.velocity[1][node] = v.y + gain.y;
            fields.velocity[2][node] = v.z + gain.z;
            // What came in and stayed, minus what it is now, both seen by an observer who moves with v.
            if (keep_lost && has) fields.lost_motion[node] += 0.5 * (lost - after * dot(gain, gain));
        }
    });
}

/// Kinetic energy that leaves at the ends of chords in a sweep, before its nodes are updated.
double HexFluid::motion_through_ends(const HexSweep& sweep) const
{
    double outward = 0;
    for (std::size_t entry = 0; entry < sweep.lines.size(); ++entry) {
        const std::size_t i = sweep.first_face + entry;
        const HexFace& face = mesh.faces[i];
        if ((face.below != none && face.above != none) || mass_flux_[i] == 0) continue;
        double squares = 0;
        for (const Index node : face.nodes)
            for (const AlignedDoubles& component : fields.velocity)
                squares += component[node] * component[node];
        outward += (face.above == none ? 0.125 : -0.125) * mass_flux_[i] * squares;
    }
    return outward;
}

double HexFluid::sweep()
{
    double left = 0;
    const int count = mesh.directions;
    for (int position = 0; position < count; ++position) {
        const HexSweep& sweep = sweeps_[swept_direction(steps_done(), position, count)];
        if (mixed_) find_outflow_shares(sweep);
        if (order == AdvectionOrder::van_leer)
            find_fluxes<true>(sweep);
        else
            find_fluxes<false>(sweep);
        move_cells(sweep);
        if (open_sides) left += motion_through_ends(sweep);
        if (order == AdvectionOrder::van_leer)
            move_momentum<true>(sweep);
        else
            move_momentum<false>(sweep);
        update_contents();
    }
    return left;
}

double HexFluid::return_lost_motion()
{
    const double returned = sum_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t node = begin; node < end; ++node) {
            double& lost = fields.lost_motion[node];
            const double mass = fields.node_mass[node];
            sum += mass > 0 ? lost : 0;
            lost = mass > 0 ? lost / mass : 0;
        }
        return sum;
    });
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; ++cell) {
            double heat = 0;
            for (const Index node : mesh.corners[cell]) heat += 0.125 * fields.lost_motion[node];
            for (GroupFields& group : fields.groups) group.energy[cell] += heat * group.mass[cell];
        }
    });
    std::fill(fields.lost_motion.begin(), fields.lost_motion.end(), 0.0);
    return returned;
}

} // namespace plash

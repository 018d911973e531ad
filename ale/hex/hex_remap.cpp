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

/// Fluxes of the only group of a mesh that is full of it, through a batch of faces; returns the masses.
template <bool second_order>
Lanes HexFluid::flux_of_full(const HexSweep& sweep, std::size_t entry)
{
    GroupScratch& own = scratch_[0];
    const Lanes flux = load<Lanes>(&volume_flux_[sweep.first_face + entry]);
    const auto upward = flux > 0.0;
    const std::array<LaneMask, 4> at = sweep.lines.places_of(entry);
    const LineWeights<Lanes> weights = sweep.lines.weights_of(entry);
    const LaneMask donor = upward ? at[1] : at[2];
    const Lanes part = abs(flux) / gather(fields.volume.data(), donor);
    const Lanes mass =
        flux * carried_value<second_order>(line_of(own.density.data(), at), upward, part, weights);
    const Lanes donor_mass = gather(fields.groups[0].mass.data(), donor);
    const Lanes mass_part = donor_mass > 0.0 ? abs(mass) / donor_mass : Lanes{};
    const Lanes energy =
        mass * carried_value<second_order>(line_of(own.energy.data(), at), upward, mass_part, weights);
    store(&own.volume_flux[entry], flux);
    store(&own.mass_flux[entry], mass);
    store(&own.energy_flux[entry], energy);
    return mass;
}

/// The same where cells may hold several groups, or void.
template <bool second_order>
Lanes HexFluid::flux_of_parts(const HexSweep& sweep, std::size_t entry)
{
    const Lanes flux = load<Lanes>(&volume_flux_[sweep.first_face + entry]);
    const auto upward = flux > 0.0;
    const std::array<LaneMask, 4> at = sweep.lines.places_of(entry);
    const LineWeights<Lanes> weights = sweep.lines.weights_of(entry);
    const LaneMask donor = upward ? at[1] : at[2];
    // Beyond an end of the chord stands a uniform mixture like that in the last cell.
    const auto from_beyond =
        (upward ? load<Lanes>(&sweep.ends_below[entry]) : load<Lanes>(&sweep.ends_above[entry])) > 0.0;
    Lanes total{};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        GroupScratch& scratch = scratch_[g];
        const GroupFields& own = fields.groups[g];
        const Lanes fraction = gather(own.fraction.data(), donor);
        GroupFlux<Lanes> passing{};
        if (any((fraction > 0.0) & (flux != 0.0))) {
            const Lanes donor_mass = gather(own.mass.data(), donor);
            const Lanes inverse = donor_mass > 0.0 ? 1.0 / donor_mass : Lanes{};
            const Lanes volume = fraction * gather(fields.volume.data(), donor);
            const GroupLine<Lanes> lines{line_of(scratch.density.data(), at),
                                         line_of(scratch.energy.data(), at),
                                         line_of(own.mass.data(), at),
                                         {Lanes{}, inverse, inverse, Lanes{}},
                                         volume,
                                         volume};
            const Lanes shared = upward ? gather(own.share_of_outflow[1].data(), donor)
                                        : gather(own.share_of_outflow[0].data(), donor);
            const Lanes cut = from_beyond ? fraction : shared;
            passing = partial_flux<second_order>(lines, flux, fraction, cut, weights);
            total += passing.mass;
        }
        store(&scratch.volume_flux[entry], passing.volume);
        store(&scratch.mass_flux[entry], passing.mass);
        store(&scratch.energy_flux[entry], passing.energy);
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
    for_chunks(sweep.lines.size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; entry += lane_count) {
            const Lanes mass =
                mixed_ ? flux_of_parts<second_order>(sweep, entry) : flux_of_full<second_order>(sweep, entry);
            store_part(&mass_flux_[sweep.first_face + entry], mass, end - entry);
        }
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
                const GroupScratch& scratch = scratch_[g];
                const std::size_t in = low - sweep.first_face, out = high - sweep.first_face;
                const double mass = own.mass[cell] + (scratch.mass_flux[in] - scratch.mass_flux[out]);
                const double energy = own.energy[cell] + (scratch.energy_flux[in] - scratch.energy_flux[out]);
                if (!mixed_) {
                    own.mass[cell] = mass;
                    own.energy[cell] = energy;
                    continue;
                }
                const double volume =
                    own.fraction[cell] * before + (scratch.volume_flux[in] - scratch.volume_flux[out]);
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
    for_chunks(sweep.edges.size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t edge = begin; edge < end; edge += lane_count) {
            Lanes flux{};
            for (const HexSweep::Part& part : sweep.around_edge)
                flux +=
                    load<Lanes>(&part.sign[edge]) * gather(member_flux_.data(), places(&part.member[edge]));
            flux *= 0.125;
            store(&edge_flux_[edge], flux);
            if (!any(flux != 0.0)) continue;
            const auto upward = flux > 0.0;
            std::array<LaneMask, 4> at = sweep.edges.places_of(edge);
            const LaneMask donor = upward ? at[1] : at[2];
            const Lanes donor_mass = gather(fields.node_mass.data(), donor);
            const Lanes part = donor_mass > 0.0 ? min(abs(flux) / donor_mass, broadcast<Lanes>(1)) : Lanes{};
            // Nodes without mass repeat the donor.
            if (mixed_)
                for (LaneMask& node : at) node = gather(fields.node_mass.data(), node) > 0.0 ? node : donor;
            const LineWeights<Lanes> weights = sweep.edges.weights_of(edge);
            for (int axis = 0; axis < 3; ++axis)
                store(&edge_velocity_[axis][edge],
                      carried_value<second_order>(line_of(v[axis].data(), at), upward, part, weights));
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
                const Vec3 faster = Vec3{edge_velocity_[0][flow->edge], edge_velocity_[1][flow->edge],
                                         edge_velocity_[2][flow->edge]} -
                                    v;
                momentum += in * faster;
                lost += in * dot(faster, faster);
            }
            if (through == 0 && change == 0) continue;
            const double after = before + change;
            const bool has = after > std::max(1e-13 * (before + through), smallest_node_mass);
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
    for (std::size_t entry = 0; entry < sweep.lines.size; ++entry) {
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
        const int direction = swept_direction(steps_done(), position, count);
        const HexSweep& sweep = sweeps_[direction];
        if (mixed_) find_outflow_shares(sweep);
        for (const DryFace& face : dry_faces)
            if (mesh.direction[face.cell][face.axis] == direction) close(face);
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

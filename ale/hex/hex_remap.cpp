#include "ale/hex/hex_fluid.h"
#include "core/parallel.h"

#include <algorithm>

namespace plash {

void HexFluid::store_fluxes(int group, std::size_t face, const GroupFlux<Lanes>& passing, std::size_t lanes)
{
    GroupScratch& own = scratch_[group];
    store_part(&own.volume_flux[face], passing.volume, lanes);
    store_part(&own.mass_flux[face], passing.mass, lanes);
    store_part(&own.energy_flux[face], passing.energy, lanes);
}

/// Fluxes through a batch of faces among cells that are full of one group; returns the masses.
template <bool second_order>
Lanes HexFluid::flux_of_full(const HexSweep& sweep, std::size_t entry, int group, std::size_t lanes)
{
    const GroupScratch& own = scratch_[group];
    const std::size_t face = sweep.first_face + entry;
    const Lanes flux = load<Lanes>(&volume_flux_[face]);
    const auto upward = flux > 0.0;
    const std::array<Places, 4> at = sweep.lines.places_of(entry);
    const LineWeights<Lanes> weights = sweep.lines.weights_of(entry);
    const Lanes part = abs(flux) / gather_either(fields.volume.data(), upward, at[1], at[2]);
    const Lanes mass =
        flux * carried_value<second_order>(line_of(own.density.data(), at), upward, part, weights);
    const Lanes donor_mass = gather_either(fields.groups[group].mass.data(), upward, at[1], at[2]);
    const Lanes mass_part = donor_mass > 0.0 ? abs(mass) / donor_mass : Lanes{};
    const Lanes energy =
        mass * carried_value<second_order>(line_of(own.energy.data(), at), upward, mass_part, weights);
    for (int other = 0; other < static_cast<int>(groups.size()); ++other)
        store_fluxes(other, face, other == group ? GroupFlux<Lanes>{flux, mass, energy} : GroupFlux<Lanes>{},
                     lanes);
    return mass;
}

/// The same where cells may hold several groups, or void.
template <bool second_order>
Lanes HexFluid::flux_of_parts(const HexSweep& sweep, std::size_t entry, std::size_t lanes)
{
    const std::size_t face = sweep.first_face + entry;
    const Lanes flux = load<Lanes>(&volume_flux_[face]);
    const auto upward = flux > 0.0;
    const std::array<Places, 4> at = sweep.lines.places_of(entry);
    const LineWeights<Lanes> weights = sweep.lines.weights_of(entry);
    const auto of_donor = [&](const AlignedDoubles& values) {
        return gather_either(values.data(), upward, at[1], at[2]);
    };
    // Beyond an end of the chord stands a uniform mixture like that in the last cell.
    const auto from_beyond =
        (upward ? load<Lanes>(&sweep.ends_below[entry]) : load<Lanes>(&sweep.ends_above[entry])) > 0.0;
    const Lanes donor_volume = of_donor(fields.volume);
    Lanes total{};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const GroupScratch& scratch = scratch_[g];
        const GroupFields& own = fields.groups[g];
        const Lanes fraction = of_donor(own.fraction);
        GroupFlux<Lanes> passing{};
        if (any((fraction > 0.0) & (flux != 0.0))) {
            const Lanes donor_mass = of_donor(own.mass);
            const Lanes inverse = donor_mass > 0.0 ? 1.0 / donor_mass : Lanes{};
            const Lanes volume = fraction * donor_volume;
            const GroupLine<Lanes> lines{line_of(scratch.density.data(), at),
                                         line_of(scratch.energy.data(), at),
                                         line_of(own.mass.data(), at),
                                         {Lanes{}, inverse, inverse, Lanes{}},
                                         volume,
                                         volume};
            const Lanes shared = upward ? gather(own.share_of_outflow[1].data(), at[1])
                                        : gather(own.share_of_outflow[0].data(), at[2]);
            const Lanes cut = from_beyond ? fraction : shared;
            passing = partial_flux<second_order>(lines, flux, fraction, cut, weights);
            total += passing.mass;
        }
        store_fluxes(static_cast<int>(g), face, passing, lanes);
    }
    return total;
}

/// Densities and energies per mass of all cells that hold fluid; others have no mass, and are not asked.
void HexFluid::find_densities()
{
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; cell += lane_count) {
            const Mask mask = activity_.of_cells(cell);
            if (BoxContents::nothing(mask)) continue;
            const Lanes all = load<Lanes>(&fields.volume[cell]);
            for (std::size_t g = 0; g < groups.size(); ++g) {
                if (!(mask >> g & 1)) continue;
                const GroupFields& own = fields.groups[g];
                const Lanes mass = load<Lanes>(&own.mass[cell]);
                const auto has = mass > 0.0;
                const Lanes volume = mixed_ ? (has ? load<Lanes>(&own.fraction[cell]) : 1.0) * all : all;
                store(&scratch_[g].density[cell], mass / volume);
                store(&scratch_[g].energy[cell], has ? load<Lanes>(&own.energy[cell]) / mass : Lanes{});
            }
        }
    });
}

template <bool second_order>
void HexFluid::find_fluxes(const HexSweep& sweep, int direction)
{
    find_densities();
    for_chunks(sweep.lines.size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; entry += lane_count) {
            const Mask mask = activity_.of_lines(direction, entry);
            const std::size_t face = sweep.first_face + entry, lanes = end - entry;
            std::uint8_t& still = of_sweep_[direction].still_faces[entry / lane_count];
            const bool nothing = BoxContents::nothing(mask);
            if (nothing && still) continue;
            Lanes mass{};
            if (nothing)
                for (int group = 0; group < static_cast<int>(groups.size()); ++group)
                    store_fluxes(group, face, GroupFlux<Lanes>{}, lanes);
            else if (BoxContents::pure(mask))
                mass = flux_of_full<second_order>(sweep, entry, BoxContents::only_group(mask), lanes);
            else
                mass = flux_of_parts<second_order>(sweep, entry, lanes);
            store_part(&mass_flux_[face], mass, lanes);
            still = nothing;
        }
    });
}

void HexFluid::move_cells(const HexSweep& sweep, int direction)
{
    for_chunks(sweep.members.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t member = begin; member < end; member += lane_count) {
            if (!activity_.reaches_members(direction, member)) {
                store(&member_flux_[member], Lanes{});
                continue;
            }
            const Places cells = sweep.member_cell.at(member), low = sweep.low_face.at(member),
                         high = sweep.high_face.at(member);
            store(&member_flux_[member], gather(mass_flux_.data(), low) + gather(mass_flux_.data(), high));
            const Lanes before = gather(fields.volume.data(), cells);
            const Lanes after =
                before + (gather(volume_flux_.data(), low) - gather(volume_flux_.data(), high));
            scatter(fields.volume.data(), cells, after);
            Lanes total{};
            for (std::size_t g = 0; g < groups.size(); ++g) {
                GroupFields& own = fields.groups[g];
                const GroupScratch& scratch = scratch_[g];
                const auto gain = [&](const AlignedDoubles& flux) {
                    return gather(flux.data(), low) - gather(flux.data(), high);
                };
                const Lanes mass = gather(own.mass.data(), cells) + gain(scratch.mass_flux);
                const Lanes energy = gather(own.energy.data(), cells) + gain(scratch.energy_flux);
                if (!mixed_) {
                    scatter(own.mass.data(), cells, mass);
                    scatter(own.energy.data(), cells, energy);
                    continue;
                }
                const Lanes old_fraction = gather(own.fraction.data(), cells);
                const Lanes volume = old_fraction * before + gain(scratch.volume_flux);
                // Round-off of what should be nothing, or full.
                const auto has = (mass > 0.0) & (volume > 1e-14 * after);
                const Lanes fraction = volume / after;
                const Lanes kept = has ? mass : Lanes{};
                scatter(own.mass.data(), cells, kept);
                scatter(own.energy.data(), cells, has ? energy : Lanes{});
                scatter(own.fraction.data(), cells, has ? settled_fraction(old_fraction, fraction) : Lanes{});
                total += kept;
            }
            if (groups.size() > 1) scatter(fields.mass_of_groups.data(), cells, total);
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
    const bool second_order = order == AdvectionOrder::van_leer;
    for (int position = 0; position < count; ++position) {
        const int direction = swept_direction(steps_done(), position, count);
        const HexSweep& sweep = sweeps_[direction];
        if (mixed_) find_outflow_shares(sweep);
        for (const DryFace& face : dry_faces)
            if (mesh.direction[face.cell][face.axis] == direction) close(face);
        if (second_order)
            find_fluxes<true>(sweep, direction);
        else
            find_fluxes<false>(sweep, direction);
        move_cells(sweep, direction);
        if (open_sides) left += motion_through_ends(sweep);
        move_momentum(sweep, direction, second_order);
        activity_.look(fields, false);
    }
    if (motion_.prepared()) {
        motion_.move(mesh);
        take_new_measures();
        follows_.reset();
    }
    return left;
}

double HexFluid::return_lost_motion()
{
    const double returned = sum_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        Lanes sum{};
        for (std::size_t node = begin; node < end; node += lane_count) {
            if (!activity_.reaches_nodes(node)) continue;
            const Lanes lost = load<Lanes>(&fields.lost_motion[node]);
            const Lanes mass = load<Lanes>(&fields.node_mass[node]);
            sum += mass > 0.0 ? lost : Lanes{};
            store(&fields.lost_motion[node], mass > 0.0 ? lost / mass : Lanes{});
        }
        return sum_of(sum);
    });
    for_chunks(mesh.cells(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t cell = begin; cell < end; cell += lane_count) {
            if (BoxContents::nothing(activity_.of_cells(cell))) continue;
            Lanes heat{};
            for (const PlaceList& nodes : layout_.cell_nodes)
                heat += 0.125 * gather(fields.lost_motion.data(), nodes.at(cell));
            for (GroupFields& group : fields.groups)
                store(&group.energy[cell],
                      load<Lanes>(&group.energy[cell]) + heat * load<Lanes>(&group.mass[cell]));
        }
    });
    std::fill(fields.lost_motion.begin(), fields.lost_motion.end(), 0.0);
    return returned;
}

} // namespace plash

#include "ale/hex/hex_fluid.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace plash {

/// Benson's half-index shift; see sweep_momentum for boxes.
template <bool second_order>
void HexFluid::find_edge_fluxes(const HexSweep& sweep, int direction)
{
    const auto& v = fields.velocity;
    SweepScratch& scratch = of_sweep_[direction];
    for_chunks(sweep.edges.size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t edge = begin; edge < end; edge += lane_count) {
            const Mask mask = activity_.of_edges(direction, edge);
            std::uint8_t& still = scratch.still_edges[edge / lane_count];
            const bool nothing = BoxContents::nothing(mask);
            if (nothing && still) continue;
            Lanes flux{};
            if (!nothing)
                for (const HexSweep::Part& part : sweep.around_edge)
                    flux += load<Lanes>(&part.sign[edge]) * gather(member_flux_.data(), part.member.at(edge));
            flux *= 0.125;
            store(&scratch.edge_flux[edge], flux);
            still = nothing;
            if (!any(flux != 0.0)) continue;
            const auto upward = flux > 0.0;
            const std::array<Places, 4> at = sweep.edges.places_of(edge);
            const Lanes donor_mass = gather_either(fields.node_mass.data(), upward, at[1], at[2]);
            const Lanes part = donor_mass > 0.0 ? min(abs(flux) / donor_mass, broadcast<Lanes>(1)) : Lanes{};
            const LineWeights<Lanes> weights = sweep.edges.weights_of(edge);
            const bool everywhere = BoxContents::pure(mask);
            Line<Lanes> mass{};
            if (!everywhere) mass = line_of(fields.node_mass.data(), at);
            Line<Lanes> velocity[3];
            for (int axis = 0; axis < 3; ++axis) {
                velocity[axis] = line_of(v[axis].data(), at);
                if (!everywhere) repeat_donor(velocity[axis], mass, upward);
            }
            Lanes carried[3];
            carried_velocities<second_order>(velocity, upward, part, weights, everywhere ? smooth_square : 0,
                                             carried);
            for (int axis = 0; axis < 3; ++axis) store(&edge_velocity_[axis][edge], carried[axis]);
        }
    });
}

/// Momentum of nodes after what came in and left, as a change of velocity: mass_after (v_after - v) is the
/// sum of each flow times (its velocity - v). What passes an end of a chord has the node's own.
void HexFluid::update_nodes(const HexSweep& sweep, int direction)
{
    for (const HexSweep::End& end : sweep.ends) {
        const double in = end.sign * 0.25 * mass_flux_[end.face];
        end_change_[end.position] += in;
        if (end.sign > 0) end_inflow_[end.position] += std::abs(in);
    }
    const bool keep_lost = !fields.lost_motion.empty();
    const AlignedDoubles& edge_flux = of_sweep_[direction].edge_flux;
    for_chunks(sweep.nodes.place.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; i += lane_count) {
            if (!activity_.reaches_swept_nodes(direction, i)) continue;
            const Places nodes = sweep.nodes.at(i);
            Lanes v[3], momentum[3] = {}, lost{};
            for (int axis = 0; axis < 3; ++axis) v[axis] = gather(fields.velocity[axis].data(), nodes);
            const Lanes before = gather(fields.node_mass.data(), nodes);
            Lanes change = load<Lanes>(&end_change_[i]), through = load<Lanes>(&end_inflow_[i]);
            for (const HexSweep::Flow& flow : sweep.at_node) {
                const Places edges = flow.edge.at(i);
                const Lanes sign = load<Lanes>(&flow.sign[i]);
                const Lanes in = sign * gather(edge_flux.data(), edges);
                change += in;
                through += sign > 0.0 ? abs(in) : Lanes{};
                for (int axis = 0; axis < 3; ++axis) {
                    const Lanes faster = gather(edge_velocity_[axis].data(), edges) - v[axis];
                    momentum[axis] += in * faster;
                    if (keep_lost) lost += in * faster * faster;
                }
            }
            const Lanes after = before + change;
            const auto has = after > max(1e-13 * (before + through), broadcast<Lanes>(smallest_node_mass));
            const Lanes per_mass = has ? 1.0 / after : Lanes{};
            scatter(fields.node_mass.data(), nodes, has ? after : Lanes{});
            for (int axis = 0; axis < 3; ++axis) {
                const Lanes gain = per_mass * momentum[axis];
                scatter(fields.velocity[axis].data(), nodes, v[axis] + gain);
                if (keep_lost) lost -= after * gain * gain;
            }
            // What came in and stayed, minus what it is now, both seen by an observer who moves with v.
            if (keep_lost)
                scatter(fields.lost_motion.data(), nodes,
                        gather(fields.lost_motion.data(), nodes) + (has ? 0.5 * lost : Lanes{}));
        }
    });
    for (const HexSweep::End& end : sweep.ends) end_change_[end.position] = end_inflow_[end.position] = 0;
}

void HexFluid::move_momentum(const HexSweep& sweep, int direction, bool second_order)
{
    if (second_order)
        find_edge_fluxes<true>(sweep, direction);
    else
        find_edge_fluxes<false>(sweep, direction);
    update_nodes(sweep, direction);
}

} // namespace plash

#include "ale/cell_flux.h"
#include "ale/remap.h"
#include "ale/sheets.h"

#include <algorithm>

namespace plash {

namespace {

/// Sweep of the nodes of one sheet. An edge joins node `row` to the next one along the axis.
template <bool second_order>
class MomentumSweep {
public:
    MomentumSweep(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents,
                  RemapScratch& scratch, int axis, double smooth_square)
        : grid_(grid),
          fields_(fields),
          contents_(contents),
          scratch_(scratch),
          axis_(axis),
          smooth_square_(smooth_square),
          keep_lost_(!fields.lost_motion.empty()),
          stride_(grid.stride(axis)),
          side_a_(grid.stride((axis + 1) % 3)),
          side_b_(grid.stride((axis + 2) % 3))
    {}

    void along_row(std::ptrdiff_t place)
    {
        const int batches = grid_.node_batches(), cells = grid_.cells(0);
        BoxContents::Mask any = 0;
        for (int batch = 0; batch < batches; ++batch) any |= contents_.near_nodes(place + batch * lane_count);
        if (BoxContents::nothing(any)) return;
        // Ghost nodes repeat the outermost ones, so that slopes end there.
        for (int axis = 0; axis < 3; ++axis) {
            double* v = &fields_.velocity[axis][place];
            v[-1] = v[0];
            v[cells + 1] = v[cells];
        }
        double* mass = &fields_.node_mass[place];
        mass[-1] = mass[0];
        mass[cells + 1] = mass[cells];
        const double* lower = grid_.node_weights(0, false);
        const double* upper = grid_.node_weights(0, true);
        for (int batch = 0; batch < batches; ++batch) {
            const int i = batch * lane_count;
            const LineWeights<Lanes> weights{load<Lanes>(lower + i), load<Lanes>(upper + i),
                                             load<Lanes>(lower + i + 1), load<Lanes>(upper + i + 1)};
            const std::ptrdiff_t here = place + i;
            edge_batch(0, i, {here - 1, here, here + 1, here + 2}, here, here + 1, weights,
                       contents_.near_nodes(here));
        }
        // Edges that leave the box at either end carry what passes its boundary.
        open_end(0, -1, place, place);
        open_end(0, cells, place + cells, place + cells);
        for (int batch = 0; batch < batches; ++batch) {
            const int i = batch * lane_count;
            update_batch(place + i, {0, i - 1}, {0, i});
        }
        for (int axis = 0; axis < 3; ++axis) {
            double* v = &fields_.velocity[axis][place];
            v[-1] = v[cells + 1] = 0;
        }
        mass[-1] = mass[cells + 1] = 0;
    }

    void across_rows(std::ptrdiff_t place, int first, int last)
    {
        const int rows = grid_.cells(axis_) + 1; // of nodes
        const auto at = [&](int row) { return place + std::clamp(row, 0, rows - 1) * stride_; };
        const auto slot = [](int edge) { return (edge + 3) % 3; };
        const double* lower = grid_.node_weights(axis_, false);
        const double* upper = grid_.node_weights(axis_, true);
        // Edge -1 ends in row 0, edge rows - 1 begins in the last row.
        for (int edge = -1; edge <= rows; ++edge) {
            if (edge < rows) {
                const LineWeights<Lanes> weights{broadcast<Lanes>(lower[edge]), broadcast<Lanes>(upper[edge]),
                                                 broadcast<Lanes>(lower[edge + 1]),
                                                 broadcast<Lanes>(upper[edge + 1])};
                const std::ptrdiff_t faces_low = at(edge), faces_high = at(edge + 1);
                for (int batch = first; batch < last; ++batch) {
                    const int i = batch * lane_count;
                    edge_batch(slot(edge), i,
                               {at(edge - 1) + i, at(edge) + i, at(edge + 1) + i, at(edge + 2) + i},
                               faces_low + i, faces_high + i, weights, contents_.near_nodes(at(edge) + i));
                }
            }
            if (edge < 1) continue;
            for (int batch = first; batch < last; ++batch) {
                const int i = batch * lane_count;
                update_batch(at(edge - 1) + i, {slot(edge - 2), i}, {slot(edge - 1), i});
            }
        }
    }

private:
    struct EdgePlace {
        int slot, i;
    };
    enum EdgeValue { velocity_x, velocity_y, velocity_z, mass_flux, edge_values };

    const BoxGrid& grid_;
    FluidFields& fields_;
    const BoxContents& contents_;
    RemapScratch& scratch_;
    int axis_;
    double smooth_square_;
    bool keep_lost_;
    std::ptrdiff_t stride_, side_a_, side_b_;

    double* edge_row(int slot, EdgeValue value) { return scratch_.row(slot * edge_values + value); }

    /// Mass through the four faces around a node in the plane of the node.
    Lanes four_faces(std::ptrdiff_t place) const
    {
        const double* flux = &fields_.mass_flux[axis_][place];
        return (load<Lanes>(flux) + load<Lanes>(flux - side_a_)) +
               (load<Lanes>(flux - side_b_) + load<Lanes>(flux - side_a_ - side_b_));
    }

    /// node           storage places of the four nodes in a line, the edge joins the two in the middle
    /// low_faces, high_faces  planes of faces at both ends of the edge
    void edge_batch(int slot, int i, const std::ptrdiff_t (&node)[4], std::ptrdiff_t low_faces,
                    std::ptrdiff_t high_faces, const LineWeights<Lanes>& weights, BoxContents::Mask mask)
    {
        if (BoxContents::nothing(mask)) {
            for (int value = 0; value < edge_values; ++value) {
                store(edge_row(slot, EdgeValue(value)) + i, Lanes{});
            }
            return;
        }
        const Lanes flux = 0.125 * (four_faces(low_faces) + four_faces(high_faces));
        const auto upward = flux > 0.0;
        const auto line = [&](const AlignedDoubles& values) {
            return Line<Lanes>{load<Lanes>(&values[node[0]]), load<Lanes>(&values[node[1]]),
                               load<Lanes>(&values[node[2]]), load<Lanes>(&values[node[3]])};
        };
        const Line<Lanes> mass = line(fields_.node_mass);
        const Lanes donor_mass = upward ? mass.below : mass.above;
        const Lanes part = donor_mass > 0.0 ? min(abs(flux) / donor_mass, broadcast<Lanes>(1)) : Lanes{};
        const bool everywhere = BoxContents::pure(mask);
        store(edge_row(slot, mass_flux) + i, flux);
        Line<Lanes> velocity[3];
        for (int axis = 0; axis < 3; ++axis) {
            velocity[axis] = line(fields_.velocity[axis]);
            if (!everywhere) repeat_donor(velocity[axis], mass, upward);
        }
        Lanes carried[3];
        carried_velocities<second_order>(velocity, upward, part, weights, everywhere ? smooth_square_ : 0,
                                         carried);
        for (int axis = 0; axis < 3; ++axis) store(edge_row(slot, EdgeValue(axis)) + i, carried[axis]);
    }

    /// The edge beyond an end of a row: mass through the boundary, with the velocity of the outermost node.
    void open_end(int slot, int edge, std::ptrdiff_t node, std::ptrdiff_t faces)
    {
        const double* flux = &fields_.mass_flux[axis_][faces];
        edge_row(slot, mass_flux)[edge] =
            0.25 * ((flux[0] + flux[-side_a_]) + (flux[-side_b_] + flux[-side_a_ - side_b_]));
        for (int axis = 0; axis < 3; ++axis) {
            edge_row(slot, EdgeValue(axis))[edge] = fields_.velocity[axis][node];
        }
    }

    /// Momentum of a batch of nodes after what came in by the lower edge and left by the upper one, as a
    /// change of velocity: mass_after (v_after - v) = in (v_in - v) - out (v_out - v).
    void update_batch(std::ptrdiff_t place, EdgePlace low, EdgePlace high)
    {
        if (BoxContents::nothing(contents_.near_nodes(place))) return;
        const Lanes in = load<Lanes>(edge_row(low.slot, mass_flux) + low.i);
        const Lanes out = load<Lanes>(edge_row(high.slot, mass_flux) + high.i);
        const Lanes before = load<Lanes>(&fields_.node_mass[place]);
        const Lanes after = before + (in - out);
        const auto has = after > max(1e-13 * (before + abs(in)), broadcast<Lanes>(smallest_node_mass));
        const Lanes per_mass = has ? 1.0 / after : Lanes{};
        store(&fields_.node_mass[place], has ? after : Lanes{});
        Lanes lost{};
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes v = load<Lanes>(&fields_.velocity[axis][place]);
            const Lanes to_in = load<Lanes>(edge_row(low.slot, EdgeValue(axis)) + low.i) - v;
            const Lanes to_out = load<Lanes>(edge_row(high.slot, EdgeValue(axis)) + high.i) - v;
            const Lanes gain = per_mass * (in * to_in - out * to_out);
            store(&fields_.velocity[axis][place], v + gain);
            // What came in and stayed, minus what it is now, both seen by an observer who moves with v.
            if (keep_lost_) lost += in * to_in * to_in - out * to_out * to_out - after * gain * gain;
        }
        if (keep_lost_) {
            double* sum = &fields_.lost_motion[place];
            store(sum, load<Lanes>(sum) + (has ? 0.5 * lost : Lanes{}));
        }
    }
};

template <bool second_order>
void sweep_momentum(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents,
                    RemapScratch& scratch, int axis, double smooth_square)
{
    MomentumSweep<second_order> nodes(grid, fields, contents, scratch, axis, smooth_square);
    if (axis == 0) {
        for_sheets(grid, grid.cells(2) + 1, [&](int k) {
            for (int j = 0; j <= grid.cells(1); ++j) nodes.along_row(grid.at(0, j, k));
        });
    } else if (axis == 1) {
        for_sheets(grid, grid.cells(2) + 1,
                   [&](int k) { nodes.across_rows(grid.at(0, 0, k), 0, grid.node_batches()); });
    } else {
        constexpr int length = 16;
        const int pieces = (grid.node_batches() + length - 1) / length;
        for_sheets(grid, (grid.cells(1) + 1) * pieces, [&](int sheet) {
            const int first = sheet % pieces * length;
            nodes.across_rows(grid.at(0, sheet / pieces, 0), first,
                              std::min(first + length, grid.node_batches()));
        });
    }
}

} // namespace

void sweep_momentum(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents,
                    RemapScratch& scratch, int axis, AdvectionOrder order, double smooth_square)
{
    if (order == AdvectionOrder::van_leer)
        sweep_momentum<true>(grid, fields, contents, scratch, axis, smooth_square);
    else
        sweep_momentum<false>(grid, fields, contents, scratch, axis, smooth_square);
}

double return_lost_motion(const BoxGrid& grid, FluidFields& fields, const BoxContents& contents)
{
    const std::ptrdiff_t sy = grid.stride(1), sz = grid.stride(2);
    const double returned = sum_sheets<double>(grid, grid.cells(2) + 1, [&](int k) {
        double sum = 0;
        for (int j = 0; j <= grid.cells(1); ++j) {
            for (int batch = 0; batch < grid.node_batches(); ++batch) {
                const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
                if (BoxContents::nothing(contents.near_nodes(place))) continue;
                const Lanes mass = load<Lanes>(&fields.node_mass[place]);
                const Lanes lost = load<Lanes>(&fields.lost_motion[place]);
                store(&fields.lost_motion[place], mass > 0.0 ? lost / mass : Lanes{});
                for (int lane = 0; lane < lane_count; ++lane) sum += mass[lane] > 0 ? lost[lane] : 0;
            }
        }
        return sum;
    });
    for_sheets(grid, grid.cells(2), [&](int k) {
        for (int j = 0; j < grid.cells(1); ++j) {
            for (int batch = 0; batch < grid.cell_batches(); ++batch) {
                const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
                if (BoxContents::nothing(contents.of_cells(place))) continue;
                const double* node = &fields.lost_motion[place];
                const auto pair = [&](std::ptrdiff_t row) {
                    return load<Lanes>(node + row) + load<Lanes>(node + row + 1);
                };
                const Lanes heat = 0.125 * ((pair(0) + pair(sy)) + (pair(sz) + pair(sy + sz)));
                for (GroupFields& group : fields.groups) {
                    double* energy = &group.energy[place];
                    store(energy, load<Lanes>(energy) + heat * load<Lanes>(&group.mass[place]));
                }
            }
        }
    });
    // Nodes start the next step with nothing lost.
    for_sheets(grid, grid.cells(2) + 1, [&](int k) {
        std::fill(&fields.lost_motion[grid.at(-1, 0, k)],
                  &fields.lost_motion[grid.at(-1, grid.cells(1) + 1, k)], 0.0);
    });
    return returned;
}

} // namespace plash

#include "ale/hex/hex_fluid.h"
#include "ale/outflow_shares.h"
#include "core/parallel.h"

#include <algorithm>

namespace plash {

/// For Youngs' normal: means of the cells around each node near an interface. On a box, differences of these
/// between opposite faces of a cell are his sums over 27 cells.
void HexFluid::find_node_fractions()
{
    for_chunks(mesh.nodes(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t node = begin; node < end; node += lane_count) {
            const Mask mask = activity_.of_nodes(node);
            if (BoxContents::nothing(mask) || BoxContents::pure(mask)) continue;
            Lanes sums[most_groups] = {};
            for (const HexLayout::Corner& corner : layout_.corners) {
                const Places cell = corner.cell.at(node);
                Lanes first{};
                for (std::size_t g = 0; g < groups.size(); ++g) {
                    first += gather(fields.groups[g].fraction.data(), cell);
                    sums[g] += first;
                }
            }
            const Lanes count = load<Lanes>(&layout_.corner_count[node]);
            for (std::size_t g = 0; g < groups.size(); ++g)
                store(&scratch_[g].node_fraction[node], sums[g] / count);
        }
    });
}

namespace {

/// Cells that hold an interface, collected from far and near until they fill a batch.
struct CutCells {
    std::size_t count = 0;
    Index cell[lane_count];
    double lower_part[lane_count], upper_part[lane_count]; ///< that leave the cell
};

Vector3<Lanes> difference_across(const HexMesh& mesh, const LaneMask& cells, const double* at_node)
{
    Vector3<Lanes> difference{};
    for (int lane = 0; lane < lane_count; ++lane) {
        const HexCorners& corners = mesh.corners[cells[lane]];
        double at[8];
        for (int corner = 0; corner < 8; ++corner) at[corner] = at_node[corners[corner]];
        difference.x[lane] = 8 * (((at[1] - at[0]) + (at[3] - at[2])) + ((at[5] - at[4]) + (at[7] - at[6])));
        difference.y[lane] = 8 * (((at[2] - at[0]) + (at[3] - at[1])) + ((at[6] - at[4]) + (at[7] - at[5])));
        difference.z[lane] = 8 * (((at[4] - at[0]) + (at[5] - at[1])) + ((at[6] - at[2]) + (at[7] - at[3])));
    }
    return difference;
}

} // namespace

void HexFluid::find_outflow_shares(const HexSweep& sweep)
{
    find_node_fractions();
    for_chunks(sweep.members.size(), [&](std::size_t begin, std::size_t end) {
        CutCells collected[3]; // by axis
        const auto cut = [&](int axis) {
            CutCells& batch = collected[axis];
            if (batch.count == 0) return;
            LaneMask cells;
            Lanes lower_part, upper_part;
            for (std::size_t lane = 0; lane < lane_count; ++lane) {
                // Lanes that are left over repeat the first cell.
                const std::size_t from = lane < batch.count ? lane : 0;
                cells[lane] = batch.cell[from];
                lower_part[lane] = batch.lower_part[from];
                upper_part[lane] = batch.upper_part[from];
            }
            batch.count = 0;
            share_outflow<Lanes>(fields, cells, axis, lower_part, upper_part, [&](const FirstGroups& first) {
                return difference_across(mesh, cells, scratch_[first.count - 1].node_fraction.data());
            });
        };
        for (std::size_t member = begin; member < end; ++member) {
            const auto [cell, axis] = sweep.members[member];
            const Mask mask = activity_.of_cells(cell);
            if (BoxContents::nothing(mask) || BoxContents::pure(mask)) continue;
            double fullest = 0;
            for (const GroupFields& group : fields.groups) fullest = std::max(fullest, group.fraction[cell]);
            if (fullest == 0 || fullest == 1) continue;
            const double per_volume = 1 / fields.volume[cell];
            const double low = volume_flux_[mesh.cell_faces[cell][2 * axis]];
            const double high = volume_flux_[mesh.cell_faces[cell][2 * axis + 1]];
            const double lower_part = std::clamp(-low * per_volume, 0.0, 1.0);
            const double upper_part = std::clamp(high * per_volume, 0.0, 1.0);
            if (lower_part == 0 && upper_part == 0) continue;
            CutCells& batch = collected[axis];
            batch.cell[batch.count] = cell;
            batch.lower_part[batch.count] = lower_part;
            batch.upper_part[batch.count] = upper_part;
            if (++batch.count == lane_count) cut(axis);
        }
        for (int axis = 0; axis < 3; ++axis) cut(axis);
    });
}

} // namespace plash

#include "ale/box_fields.h"

#include "ale/sheets.h"

#include <algorithm>

namespace plash {

FluidFields box_fields(const BoxGrid& grid, int group_count, bool mixed, bool viscous_flow)
{
    FluidFields fields(grid.storage(), grid.storage(), group_count, mixed, viscous_flow);
    for (int axis = 0; axis < 3; ++axis) {
        fields.volume_flux[axis].resize(grid.storage());
        fields.mass_flux[axis].resize(grid.storage());
    }
    return fields;
}

void mirror_fractions(const BoxGrid& grid, FluidFields& fields)
{
    const int nx = grid.cells(0), ny = grid.cells(1), nz = grid.cells(2);
    for (GroupFields& group : fields.groups) {
        double* f = group.fraction.data();
        for_sheets(grid, nz, [&](int k) {
            for (int j = 0; j < ny; ++j) {
                f[grid.at(-1, j, k)] = f[grid.at(0, j, k)];
                f[grid.at(nx, j, k)] = f[grid.at(nx - 1, j, k)];
            }
            std::copy_n(f + grid.at(-1, 0, k), nx + 2, f + grid.at(-1, -1, k));
            std::copy_n(f + grid.at(-1, ny - 1, k), nx + 2, f + grid.at(-1, ny, k));
        });
        for_sheets(grid, ny + 2, [&](int row) {
            std::copy_n(f + grid.at(-1, row - 1, 0), nx + 2, f + grid.at(-1, row - 1, -1));
            std::copy_n(f + grid.at(-1, row - 1, nz - 1), nx + 2, f + grid.at(-1, row - 1, nz));
        });
    }
}

BoxContents::BoxContents(const BoxGrid& grid, bool mixed) : mixed_(mixed)
{
    const std::size_t batches = grid.storage() / lane_count + 1;
    own_.assign(batches, mixed ? 0 : 1);
    near_cells_ = near_nodes_ = along_rows_ = own_;
}

void BoxContents::update(const BoxGrid& grid, const FluidFields& fields)
{
    if (!mixed_) return;
    const int group_count = static_cast<int>(fields.groups.size());
    for_sheets(grid, grid.cells(2), [&](int k) {
        for (int j = 0; j < grid.cells(1); ++j) {
            for (int batch = 0; batch < grid.cell_batches(); ++batch) {
                const std::ptrdiff_t place = grid.at(batch * lane_count, j, k);
                const int lanes = std::min(lane_count, grid.cells(0) - batch * lane_count);
                Mask mask = 0;
                double fullest[lane_count] = {};
                for (int group = 0; group < group_count; ++group) {
                    const double* fraction = fields.groups[group].fraction.data() + place;
                    double sum = 0;
                    for (int lane = 0; lane < lanes; ++lane) {
                        sum += fraction[lane];
                        fullest[lane] = std::max(fullest[lane], fraction[lane]);
                    }
                    if (sum > 0) mask |= Mask(1u << group);
                }
                for (int lane = 0; lane < lanes; ++lane) mask |= fullest[lane] != 1 ? empty_space : Mask(0);
                own_[place / lane_count] = mask;
            }
        }
    });
    dilate(grid);
}

void BoxContents::dilate(const BoxGrid& grid)
{
    const int rows = grid.cells(1), sheets = grid.cells(2), batches = grid.node_batches();
    const std::ptrdiff_t row = grid.stride(1) / lane_count, sheet = grid.stride(2) / lane_count;
    const std::ptrdiff_t first = grid.at(0, 0, 0) / lane_count;
    // Batches along the row, then rows of a sheet, both into along_rows_ and near_nodes_ in turn.
    for_sheets(grid, sheets, [&](int k) {
        for (int j = 0; j < rows; ++j) {
            const Mask* own = own_.data() + first + j * row + k * sheet;
            Mask* target = near_nodes_.data() + (own - own_.data());
            for (int b = 0; b < batches; ++b) target[b] = own[b - 1] | own[b] | own[b + 1];
        }
        for (int j = 0; j < rows; ++j) {
            Mask* target = along_rows_.data() + first + j * row + k * sheet;
            const int low = std::max(j - 2, 0), high = std::min(j + 2, rows - 1);
            for (int b = 0; b < batches; ++b) target[b] = 0;
            for (int near = low; near <= high; ++near) {
                const Mask* source = near_nodes_.data() + first + near * row + k * sheet;
                for (int b = 0; b < batches; ++b) target[b] |= source[b];
            }
        }
    });
    for_sheets(grid, sheets, [&](int k) {
        const int low = std::max(k - 2, 0), high = std::min(k + 2, sheets - 1);
        for (int j = 0; j < rows; ++j) {
            Mask* target = near_cells_.data() + first + j * row + k * sheet;
            for (int b = 0; b < batches; ++b) target[b] = 0;
            for (int near = low; near <= high; ++near) {
                const Mask* source = along_rows_.data() + first + j * row + near * sheet;
                for (int b = 0; b < batches; ++b) target[b] |= source[b];
            }
        }
    });
    for_sheets(grid, sheets + 1, [&](int k) {
        const int k0 = std::max(k - 1, 0), k1 = std::min(k, sheets - 1);
        for (int j = 0; j <= rows; ++j) {
            const int j0 = std::max(j - 1, 0), j1 = std::min(j, rows - 1);
            const auto line = [&](int at_j, int at_k) {
                return near_cells_.data() + first + at_j * row + at_k * sheet;
            };
            const Mask *a = line(j0, k0), *b = line(j1, k0), *c = line(j0, k1), *d = line(j1, k1);
            Mask* target = near_nodes_.data() + first + j * row + k * sheet;
            for (int i = 0; i < batches; ++i) target[i] = a[i] | b[i] | c[i] | d[i];
        }
    });
}

} // namespace plash

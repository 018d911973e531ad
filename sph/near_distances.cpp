#include "sph/near_distances.h"

#include "sph/cells.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plash {

void visit_near(const std::vector<Vec3>& positions, std::vector<char> asked, std::size_t count,
                const std::function<void(std::vector<double>& squares)>& take)
{
    if (positions.size() <= count) return;
    Vec3 lower = positions.front(), upper = lower;
    for (const Vec3& p : positions) {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    std::vector<double> squares;
    // Distances below the cell's side are right; the others are looked for in wider cells.
    double side = norm(upper - lower) / std::cbrt(static_cast<double>(positions.size()));
    for (bool any = side > 0; any; side *= 2) {
        any = false;
        ParticleCells cells;
        cells.sort(positions, side);
        for (Index cell = 0; cell < cells.cell_count(); ++cell) {
            std::array<Index, 27> around;
            const int cell_count = cells.around(cell, around);
            for (Index place = cells.begin(cell); place < cells.end(cell); ++place) {
                const Index p = cells.order()[place];
                if (!asked[p]) continue;
                squares.clear();
                for (int k = 0; k < cell_count; ++k)
                    for (Index other = cells.begin(around[k]); other < cells.end(around[k]); ++other) {
                        const Vec3 apart = positions[cells.order()[other]] - positions[p];
                        if (other != place && dot(apart, apart) <= side * side)
                            squares.push_back(dot(apart, apart));
                    }
                asked[p] = squares.size() < count;
                any = any || asked[p];
                if (!asked[p]) take(squares);
            }
        }
    }
}

} // namespace plash

#pragma once

#include "elements/erosion_criteria.h"
#include "elements/solid_modes.h"
#include "math/aligned.h"

#include <vector>

namespace plash {

/// Watches the solids of one group. Strains are logarithmic, of the deformation between the start and now at
/// the element's centre; stresses are means of the element.
class SolidErosion {
public:
    SolidErosion(const ErosionCriteria& criteria, Index batches);

    /// Geometry of a batch at the start.
    void start(Index batch, const SolidModes<Lanes>& position);

    /// Elements of a batch that go now.
    /// stress     six components of each lane
    /// time_step  since the last call [time]
    LaneMask lost(Index batch, const SolidModes<Lanes>& position, const Lanes* stress, double time,
                  double time_step);

private:
    ErosionCriteria criteria_;
    std::vector<Lanes, CacheAligned<Lanes>> inverse_; ///< batch x 9: inverse of the starting Jacobian
    std::vector<Lanes, CacheAligned<Lanes>> impulse_; ///< by batch
};

} // namespace plash

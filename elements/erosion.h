#pragma once

#include "elements/solid_modes.h"
#include "math/aligned.h"
#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <array>
#include <optional>
#include <vector>

namespace plash {

/// *MAT_ADD_EROSION: what takes an element away, besides its own law. A criterion that is not given never
/// holds. Source: LS-DYNA keyword manual, volume II.
struct ErosionCriteria {
    std::optional<double> largest_pressure;         ///< MXPRES [stress]
    std::optional<double> smallest_pressure;        ///< MNPRES [stress]
    std::optional<double> largest_principal_stress; ///< SIGP1 [stress]
    std::optional<double> largest_equivalent;       ///< SIGVM: von Mises [stress]
    std::optional<double> smallest_strain;          ///< MNEPS: principal
    std::optional<double> largest_strain;           ///< MXEPS: principal
    std::optional<double> effective_strain;         ///< EFFEPS
    std::optional<double> volume_strain;            ///< VOLEPS: below 0 in compression
    std::optional<double> shear_strain;             ///< EPSSH: tensor component
    std::optional<double> impulse;                  ///< IMPULSE: integral of (sigma1 - SIGTH)^2 over time
    double impulse_threshold = 0;                   ///< SIGTH [stress]
    std::optional<double> failure_time;             ///< FAILTM [time]
    int needed = 1;                                 ///< NCS: criteria that have to hold at once

    bool needs_strain() const
    {
        return smallest_strain || largest_strain || effective_strain || volume_strain || shear_strain;
    }
};

/// The criteria for a material; nothing when the deck has none for it. DeckError for damage models (IDAM) and
/// for curves in place of limits.
std::optional<ErosionCriteria> erosion_criteria(const Model&, const Record& material);

/// Eigenvalues of a symmetric tensor, the largest first.
std::array<double, 3> principal_values(const SymmetricTensor<double>&);

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

    bool goes(const SymmetricTensor<double>& stress, const std::array<double, 3>& strain, double impulse,
              double time) const;
};

} // namespace plash

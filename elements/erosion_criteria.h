#pragma once

#include "math/symmetric_tensor.h"
#include "model/model.h"

#include <array>
#include <optional>

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
    std::optional<double> thinning;                 ///< EPSTHIN: strain of the thickness of shells, below 0
    int needed = 1;                                 ///< NCS: criteria that have to hold at once
    double points = 1; ///< NUMFIP: failed points that take a shell or beam; below 0: their share in per cent

    bool needs_strain() const
    {
        return smallest_strain || largest_strain || effective_strain || volume_strain || shear_strain;
    }

    /// Whether a point meets enough of the criteria now (thinning and the failure time are for the caller).
    /// strain   principal strains, the largest first
    /// impulse  integral so far [stress^2 time]
    /// met      criteria that hold already
    bool hold(const SymmetricTensor<double>& stress, const std::array<double, 3>& strain, double impulse,
              int met = 0) const;
    /// How many of an element's points have to fail.
    int failed_points(int of_all) const;
};

/// The criteria for a material; nothing when the deck has none for it. DeckError for damage models (IDAM) and
/// for curves in place of limits.
std::optional<ErosionCriteria> erosion_criteria(const Model&, const Record& material);

/// Eigenvalues of a symmetric tensor, the largest first.
std::array<double, 3> principal_values(const SymmetricTensor<double>&);

} // namespace plash

#pragma once

#include "assess/curve.h"

namespace plash {

/// The rating of ISO/TS 18571 (2014): how alike two curves look, each score from 0 (nothing) to 1 (the same).
struct IsoRating {
    double corridor =
        0;            ///< within 5 % of the reference's largest size: 1; beyond 50 %: 0; between, the square
    double phase = 0; ///< 1 - shift of best correlation over 20 % of the span
    double magnitude = 0; ///< 1 - difference after shifting and dynamic time warping over 50 %
    double slope = 0;     ///< 1 - difference of the smoothed slopes after shifting over 200 %
    double overall = 0;   ///< 0.4 corridor + 0.2 of each other

    /// "excellent" above 0.94, "good" above 0.8, "fair" above 0.58, else "poor".
    const char* grade() const;
};

/// Both curves are sampled at `samples` even times of their common span. The standard samples at 10 kHz, so
/// that its smoothing over nine points spans a millisecond; since decks carry their own units, the default
/// here is a thousand steps whatever the span. Wants a common span and samples > 20.
IsoRating iso_rating(const TimeCurve& reference, const TimeCurve& computed, std::size_t samples = 1001);

} // namespace plash

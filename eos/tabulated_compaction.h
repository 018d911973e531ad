#pragma once

#include "eos/tabulated.h"

namespace plash {

/// *EOS_TABULATED_COMPACTION (008): p = C(e) + GAMA T(e) E while the material is compacted further than ever,
/// with the volume strain e = ln(relative volume). Below the largest compaction so far, C goes along a line
/// of the bulk modulus K(e) of that compaction, down to the cut-off of the material; on reloading back along
/// it. Source: Hallquist (2006), LS-DYNA theory manual, equation of state form 8; keyword manual, volume I.
///
/// Where K is below the slope of C, that slope takes its place: unloading along less would give back more
/// work than went in.
struct TabulatedCompaction {
    BrokenLine cold, warm, unloading; ///< C [stress], T [-], K [stress] over -e
    double gamma = 0;                 ///< GAMA
    double energy = 0;                ///< E0 [stress]
    double relative_volume = 1;       ///< V0
    double bulk_modulus = 0;          ///< at e = 0 [stress]

    static constexpr bool remembers = true;

    static TabulatedCompaction from_record(const Record& record, const Model& model);

    /// The slope is that of the steeper of the two ways, for the speed of waves.
    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression, const Lane& largest) const
    {
        const Lane strain = log(compression), most = max(log(largest), Lane{}), per = 1.0 / compression;
        Lane c, c_slope, t, t_slope;
        cold.evaluate(most, c, c_slope);
        warm.evaluate(strain, t, t_slope);
        const Lane modulus = max(unloading(most), c_slope);
        return {c - modulus * (most - strain), gamma * t, modulus * per, gamma * t_slope * per};
    }
};

} // namespace plash

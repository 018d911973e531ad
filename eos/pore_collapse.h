#pragma once

#include "eos/response.h"
#include "math/broken_line.h"
#include "model/model.h"

namespace plash {

/// *EOS_TENSOR_PORE_COLLAPSE (011): pressure over the excess compression mu = compression - 1 of a porous
/// material. Up to MU1 it follows the virgin curve v(mu) both ways. Beyond it pores collapse for good: with
/// the largest mu so far, m, the way back is the curve c(mu) of the fully crushed material, stretched so that
/// it meets the virgin curve at m,
///   p(mu) = c((1 + b) (1 + mu) / (1 + m) - 1),   c(b) = v(m),
/// and c itself once m has reached MU2. The pressure does not depend on the energy.
/// Source: Hallquist (2006), LS-DYNA theory manual, equation of state form 11 (Burton, Burton & Lenz 1982).
struct PoreCollapse {
    BrokenLine virgin, crushed; ///< NLD, NCR: pressure over mu [stress]
    BrokenLine crushed_inverse; ///< mu over pressure of the crushed curve
    double collapse_start = 0;  ///< MU1
    double collapse_end = 0;    ///< MU2
    double energy = 0;          ///< IE0 [stress]
    double relative_volume = 1; ///< 1 / (1 + EC0)
    double bulk_modulus = 0;    ///< slope of the virgin curve at the start [stress]

    static constexpr bool remembers = true;

    static PoreCollapse from_record(const Record& record, const Model& model);

    /// The slope is that of the steeper way, for the speed of waves.
    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression, const Lane& largest) const
    {
        const Lane mu = compression - 1.0, most = min(largest - 1.0, broadcast<Lane>(collapse_end));
        Lane v, v_slope, c, c_slope, top, top_slope;
        virgin.evaluate(mu, v, v_slope);
        virgin.evaluate(most, top, top_slope);
        const Lane stretch = (1.0 + crushed_inverse(top)) / (1.0 + most);
        crushed.evaluate(stretch * compression - 1.0, c, c_slope);
        const MaskOf<Lane> whole = largest - 1.0 <= collapse_start;
        // On the way up c(b) = v(m): both branches give the same pressure there.
        return {whole ? v : c, Lane{}, whole ? v_slope : max(Lane{c_slope * stretch}, top_slope), Lane{}};
    }
};

} // namespace plash

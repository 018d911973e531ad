#pragma once

#include "materials/piecewise_linear_plasticity.h"

#include <array>

namespace plash {

/// *MAT_SPOTWELD (100): von Mises plasticity with linear isotropic hardening for spot-weld beams, which break
/// by plastic strain, by their resultants or at a given time. Source: LS-DYNA keyword manual, volume II,
/// *MAT_100.
struct SpotWeld {
    PiecewiseLinearPlasticity law;  ///< hardening SIGY + EH x plastic strain, EFAIL as failure strain
    double wanted_step = 0;         ///< DT: mass is added to beams whose step is smaller [time]; 0: none
    double failure_time = 0;        ///< TFAIL [time]; 0: never
    std::array<double, 3> force{};  ///< NRR, NRS, NRT at failure [force]; 0: unlimited
    std::array<double, 3> moment{}; ///< MRR, MSS, MTT at failure [moment]; 0: unlimited

    static SpotWeld from_record(const Record& record, const Model& model);
};

} // namespace plash

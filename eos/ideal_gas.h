#pragma once

#include "eos/response.h"
#include "model/record.h"

namespace plash {

/// *EOS_IDEAL_GAS (012): p = (Cp - Cv) density T with the energy density x Cv T, which is
/// p = (gamma - 1) compression E with gamma = Cp / Cv and E by reference volume; T0 is the temperature at the
/// start. Source: LS-DYNA keyword manual, volume I, *EOS_012. Heat capacities are constant (B = C = 0), and
/// the molecules take no volume (VC0 = 0).
struct IdealGas {
    double gamma = 1.4;
    double energy = 0;          ///< reference density x Cv T0 [stress]
    double relative_volume = 1; ///< V0
    double bulk_modulus = 0;    ///< none without energy [stress]

    static IdealGas from_record(const Record& record, double density);

    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        return {Lane{}, (gamma - 1) * compression, Lane{}, broadcast<Lane>(gamma - 1)};
    }
};

} // namespace plash

#pragma once

#include "materials/parameters.h"

#include <limits>

namespace plash {

/// *MAT_NULL (009): a fluid without strength; its pressure comes from an equation of state.
/// Source: LS-DYNA keyword manual, volume II, *MAT_009.
struct NullFluid {
    double density = 0; ///< [mass/volume]
    double lowest_pressure =
        -std::numeric_limits<double>::infinity(); ///< PC; zero on the card: none [stress]
    double viscosity = 0;                         ///< MU: dynamic [stress time]
    double largest_volume = 0;  ///< TEROD: relative volume that deletes an element in tension; 0: never
    double smallest_volume = 0; ///< CEROD: the same in compression

    static NullFluid from_record(const Record& record);
};

} // namespace plash

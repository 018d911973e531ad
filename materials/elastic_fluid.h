#pragma once

#include "materials/parameters.h"

namespace plash {

/// *MAT_ELASTIC_FLUID (001_FLUID): pressure -K ln V, never under -CP, and a viscous deviator
///   s = VC L a rho e'  (L element length, a = sqrt(K / rho0) sound speed, e' deviator of the strain rate).
/// Source: Hallquist (2006), LS-DYNA theory manual, material model 1, option FLUID. What has cavitated bears
/// pressure again only when its volume has closed.
struct ElasticFluid {
    double density = 0;         ///< [mass/volume]
    double bulk_modulus = 0;    ///< K; of E and PR where K is empty [stress]
    double viscosity = 0;       ///< VC: tensor viscosity coefficient
    double lowest_pressure = 0; ///< -CP [stress]

    static ElasticFluid from_record(const Record& record);
};

} // namespace plash

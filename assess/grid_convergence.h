#pragma once

#include "assess/curve.h"

namespace plash {

/// One quantity on three meshes, fine to coarse, judged by the procedure of Celik, Ghia, Roache, Freitas,
/// Coleman & Raad (2008), "Procedure for estimation and reporting of uncertainty due to discretization in CFD
/// applications".
struct GridConvergence {
    double order = 0;         ///< observed order p, equation 3 [-]
    bool oscillating = false; ///< the differences change their sign: the order is that of their sizes
    double extrapolated = 0;  ///< value at cell size zero, equation 5
    double error_fine = 0;    ///< |(fine - medium) / fine|, equation 6 [-]
    double error_coarse = 0;  ///< |(medium - coarse) / medium| [-]
    double index_fine = 0;    ///< grid convergence index of fine and medium, equation 7, factor 1.25 [-]
    double index_coarse = 0;  ///< of medium and coarse [-]
};

/// `size`: cell sizes, `value`: the quantity, both fine to coarse. Sizes must grow. Where two values are
/// equal to the last digit the mesh does not matter any more: order infinite, indices zero.
GridConvergence grid_convergence(const double (&size)[3], const double (&value)[3]);

/// Whole histories on three meshes: the procedure at every time, with the mean of the local orders used
/// everywhere, as the paper does for profiles.
struct AveragedConvergence {
    double order = 0;        ///< mean of the local orders [-]
    std::size_t points = 0;  ///< times at which there is a local order
    double index_fine = 0;   ///< mean over time; errors relative to the largest size of the finest curve [-]
    double index_coarse = 0; ///< of medium and coarse [-]
};

/// `curves` as `size`, fine to coarse, sampled at `samples` even times of their common span. Times at which
/// two curves differ by less than 1e-9 of the largest value have no order.
AveragedConvergence averaged_convergence(const double (&size)[3], const TimeCurve* const (&curves)[3],
                                         std::size_t samples = 1001);

} // namespace plash

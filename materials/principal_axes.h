#pragma once

#include "math/symmetric_tensor.h"
#include "math/vector3.h"

#include <array>

namespace plash {

/// Eigenvalues of a symmetric tensor with unit eigenvectors.
struct PrincipalAxes {
    std::array<double, 3> value;
    std::array<Vec3, 3> axis;

    /// Sum of value times axis (x) axis.
    SymmetricTensor<double> tensor() const;
};

/// By cyclic Jacobi rotations, to round-off for any tensor.
PrincipalAxes principal_axes(const SymmetricTensor<double>&);

} // namespace plash

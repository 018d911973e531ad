#pragma once

#include "math/lanes_math.h"

#include <array>

namespace plash {

/// What an energy of the stretches without volume change gives in the principal directions.
template <class Lane>
struct PrincipalResponse {
    std::array<Lane, 3> stress;    ///< dW/dln(lambda_i): Kirchhoff stress, without mean [stress]
    std::array<Lane, 3> stiffness; ///< d2W/dln(lambda_i)^2 [stress]
};

/// Sum over terms of mu / alpha (sum over i of lambda_i^alpha - 3); the shear modulus is half the sum of
/// mu alpha.
struct OgdenEnergy {
    static constexpr int most_terms = 8;
    int terms = 0;
    std::array<double, most_terms> mu{}; ///< [stress]
    std::array<double, most_terms> alpha{};

    double shear_modulus() const
    {
        double sum = 0;
        for (int j = 0; j < terms; ++j) sum += 0.5 * mu[j] * alpha[j];
        return sum;
    }

    /// logarithm  of the stretches without volume change; their sum is zero
    template <class Lane>
    PrincipalResponse<Lane> response(const std::array<Lane, 3>& logarithm) const
    {
        PrincipalResponse<Lane> result{};
        for (int j = 0; j < terms; ++j) {
            std::array<Lane, 3> raised;
            for (int i = 0; i < 3; ++i) raised[i] = exp(Lane{alpha[j] * logarithm[i]});
            const Lane third = (1.0 / 3) * (raised[0] + raised[1] + raised[2]);
            for (int i = 0; i < 3; ++i) {
                result.stress[i] += mu[j] * (raised[i] - third);
                result.stiffness[i] += (mu[j] * alpha[j] / 3) * (raised[i] + third);
            }
        }
        return result;
    }
};

/// C10 (I - 3) + C01 (II - 3) + C11 (I - 3)(II - 3) + C20 (I - 3)^2 + C02 (II - 3)^2 + C30 (I - 3)^3 with the
/// invariants of the tensor without volume change; the shear modulus is 2 (C10 + C01).
struct PolynomialEnergy {
    double c10 = 0, c01 = 0, c11 = 0, c20 = 0, c02 = 0, c30 = 0; ///< [stress]

    double shear_modulus() const { return 2 * (c10 + c01); }

    template <class Lane>
    PrincipalResponse<Lane> response(const std::array<Lane, 3>& logarithm) const
    {
        std::array<Lane, 3> square, inverse;
        for (int i = 0; i < 3; ++i) {
            square[i] = exp(Lane{2.0 * logarithm[i]});
            inverse[i] = 1.0 / square[i];
        }
        const Lane one = square[0] + square[1] + square[2], two = inverse[0] + inverse[1] + inverse[2];
        const Lane a = one - 3.0, b = two - 3.0;
        const Lane by_one = c10 + c11 * b + a * (2 * c20 + 3 * c30 * a);
        const Lane by_two = c01 + c11 * a + 2 * c02 * b;
        const Lane by_one_one = 2 * c20 + 6 * c30 * a;
        PrincipalResponse<Lane> result;
        for (int i = 0; i < 3; ++i) {
            const Lane one_slope = 2.0 * (square[i] - (1.0 / 3) * one);
            const Lane two_slope = -2.0 * (inverse[i] - (1.0 / 3) * two);
            const Lane one_bend = (4.0 / 3) * (square[i] + (1.0 / 3) * one);
            const Lane two_bend = (4.0 / 3) * (inverse[i] + (1.0 / 3) * two);
            result.stress[i] = by_one * one_slope + by_two * two_slope;
            result.stiffness[i] = by_one * one_bend + by_two * two_bend + by_one_one * one_slope * one_slope +
                                  2 * c11 * one_slope * two_slope + 2 * c02 * two_slope * two_slope;
        }
        return result;
    }
};

} // namespace plash

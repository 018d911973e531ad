#pragma once

#include "eos/response.h"
#include "math/curve.h"
#include "math/lanes_math.h"
#include "model/model.h"

#include <array>

namespace plash {

/// *EOS_TABULATED (009): p = C(e) + GAMA T(e) E with the volume strain e = ln(relative volume); C and T are
/// lines through up to ten points (or curves), which go on with the slope of their ends.
/// Source: Hallquist (2006), LS-DYNA theory manual, equation of state form 9.
struct Tabulated {
    /// A broken line over the compression strain -e as a sum over its kinks: short, and without look-up.
    struct Line {
        static constexpr int most_kinks = 10;
        double start = 0, value = 0; ///< first point
        std::array<double, most_kinks> kink{};
        std::array<double, most_kinks> change{}; ///< of the slope there; the first entry is the first slope
        int kinks = 0;

        template <class Lane>
        void evaluate(const Lane& strain, Lane& result, Lane& slope) const
        {
            const Lane zero{};
            slope = broadcast<Lane>(change[0]);
            result = value + change[0] * (strain - start);
            for (int i = 1; i < kinks; ++i) {
                const Lane beyond = strain - kink[i];
                result += change[i] * max(beyond, zero);
                slope += beyond > 0.0 ? broadcast<Lane>(change[i]) : zero;
            }
        }
    };
    Line cold, warm;            ///< C [stress], T [-] over -e
    double gamma = 0;           ///< GAMA
    double energy = 0;          ///< E0 [stress]
    double relative_volume = 1; ///< V0
    double bulk_modulus = 0;    ///< slope of C at e = 0 in compression [stress]

    static Tabulated from_record(const Record& record, const Model& model);
    /// For laws that know no curves.
    static Tabulated from_record(const Record& record, double density);

    template <class Lane>
    PressureResponse<Lane> evaluate(const Lane& compression) const
    {
        const Lane strain = log(compression), per = 1.0 / compression;
        Lane c, c_slope, t, t_slope;
        cold.evaluate(strain, c, c_slope);
        warm.evaluate(strain, t, t_slope);
        return {c, gamma * t, c_slope * per, gamma * t_slope * per};
    }
};

} // namespace plash

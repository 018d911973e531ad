#pragma once

#include "eos/response.h"
#include "math/broken_line.h"
#include "math/lanes_math.h"
#include "model/model.h"

#include <string_view>

namespace plash {

/// *EOS_TABULATED (009): p = C(e) + GAMA T(e) E with the volume strain e = ln(relative volume); C and T are
/// lines through up to ten points (or curves), which go on with the slope of their ends.
/// Source: Hallquist (2006), LS-DYNA theory manual, equation of state form 9.
struct Tabulated {
    BrokenLine cold, warm;      ///< C [stress], T [-] over -e
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

/// A column of the table of a tabulated equation of state over the compression strain -ln(relative volume):
/// the values of fields like C1..C10 over EV1..EV10, or the curve that `curve_field` names.
BrokenLine tabulated_column(const Record& record, const Model* model, std::string_view column,
                            std::string_view curve_field);

/// V0 of a card; 1 where it is empty.
double initial_relative_volume(const Record& record, std::string_view field);

} // namespace plash

#pragma once

#include <optional>
#include <string_view>

namespace plash {

/// Exponents of the basic quantities in a unit: a stress has mass 1, length -1, time -2.
struct Dimension {
    int mass = 0, length = 0, time = 0, temperature = 0;

    friend bool operator==(const Dimension&, const Dimension&) = default;
};

/// FCTMAS, FCTLEN, FCTTIM of *INCLUDE_TRANSFORM: a value in the deck's units over the same one in the
/// include's.
struct UnitFactors {
    double mass = 1, length = 1, time = 1;
    bool temperature = false; ///< FCTTEM asks for another scale

    bool change() const { return mass != 1 || length != 1 || time != 1 || temperature; }
    /// Factor on a value; nothing for temperatures that change their scale.
    std::optional<double> of(const Dimension& dimension) const;
};

/// Of the real fields of a keyword (canonical name); nothing where Plash does not know it.
std::optional<Dimension> dimension_of(std::string_view keyword, std::string_view field);

/// What the abscissa and the ordinate of a curve are, and the values of a table of such curves.
struct CurveDimensions {
    Dimension abscissa, ordinate, table;

    friend bool operator==(const CurveDimensions&, const CurveDimensions&) = default;
};

/// Of the curve that a field names. `kind`: VAD of a prescribed motion (0 velocity, 1 acceleration,
/// 2 displacement, 3 velocity over displacement). `rotation`: the field drives or loads an angle.
std::optional<CurveDimensions> curve_dimensions_of(std::string_view keyword, std::string_view field, int kind,
                                                   bool rotation);

} // namespace plash

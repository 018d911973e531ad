#pragma once

#include "materials/discrete_beam_law.h"

#include <limits>

namespace plash {

/// Six fields of a material, one for each freedom.
inline DiscreteFreedoms six_of(const Record& material, const std::array<const char*, 6>& fields)
{
    DiscreteFreedoms values{};
    for (int i = 0; i < 6; ++i) values[i] = material.real(fields[i]);
    return values;
}

/// Failure of *MAT_067 and *MAT_068: sum of (F / FFAIL)^2 or of (way / UFAIL)^2 over the freedoms reaches
/// one. A field of zero leaves its freedom out.
class DiscreteBeamFailure {
public:
    explicit DiscreteBeamFailure(const Record& material)
        : force_(six_of(material, {"FFAILR", "FFAILS", "FFAILT", "MFAILR", "MFAILS", "MFAILT"})),
          way_(six_of(material, {"UFAILR", "UFAILS", "UFAILT", "TFAILR", "TFAILS", "TFAILT"}))
    {}

    bool met(const DiscreteBeamPoint& point) const
    {
        return sum(point.force, force_) >= 1 || sum(point.way, way_) >= 1;
    }

private:
    DiscreteFreedoms force_, way_;

    static double sum(const DiscreteFreedoms& values, const DiscreteFreedoms& limits)
    {
        double result = 0;
        for (int i = 0; i < 6; ++i) {
            if (limits[i] != 0) result += (values[i] / limits[i]) * (values[i] / limits[i]);
        }
        return result;
    }
};

} // namespace plash

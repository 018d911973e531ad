#pragma once

#include "core/term.h"

namespace plash {

/// What couples a surface of the structure with an Eulerian fluid.
class SurfaceCoupling : public Term {
public:
    std::string_view name() const override { return "fluid coupling"; }
    /// On the structure at t_n [force].
    virtual Vec3 force() const = 0;
};

} // namespace plash

#pragma once

#include "math/vector3.h"
#include "model/record.h"

#include <cstddef>
#include <vector>

namespace plash {

/// Mass of mass scaling that shall resist the distortion of elements alone (*CONTROL_TIMESTEP IMSCL).
struct SelectiveMasses {
    enum class Kind { brick, shell };
    struct Corner {
        Index node;
        double mass;        ///< added [mass]
        double inertia = 0; ///< added, about every axis [mass length^2]
    };
    struct Element {
        Kind kind;
        Index number;       ///< of State::deleted_solids or deleted_shells
        std::size_t corner; ///< its first one
    };
    std::vector<Element> elements;
    std::vector<Corner> corners; ///< of all elements, one after the other

    /// The corners of what is added go in next.
    void begin(Kind kind, Index number) { elements.push_back({kind, number, corners.size()}); }
    std::size_t end_of(std::size_t element) const
    {
        return element + 1 < elements.size() ? elements[element + 1].corner : corners.size();
    }
};

/// A freedom whose acceleration does not depend on the forces: Term::constrain will see to it.
struct HeldFreedom {
    Index node;
    bool rotation;
    Vec3 direction;      ///< of length one
    double acceleration; ///< along or about it, over the velocity step
};

} // namespace plash

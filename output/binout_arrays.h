#pragma once

#include "math/vector3.h"
#include "output/array_file.h"

#include <vector>

namespace plash {

/// The components of vectors as three arrays.
inline void put_vectors(ArrayFile& file, const std::vector<Vec3>& values, const char* x, const char* y,
                        const char* z)
{
    const char* names[] = {x, y, z};
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> component;
        for (const Vec3& value : values) component.push_back(value.*vector_component[axis]);
        file.put(names[axis], component);
    }
}

} // namespace plash

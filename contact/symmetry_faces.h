#pragma once

#include "contact/surface.h"

namespace plash {

/// Takes out the faces of solids that lie in a plane of symmetry: those all of whose nodes are held along the
/// face's normal from the start (keyword manual, *CONTROL_CONTACT, ISYM = 1). Nothing comes to touch them,
/// and contact there would hold off what the plane cuts through.
void drop_symmetry_faces(const Model& model, std::vector<Segment>& segments);

} // namespace plash

#include "sph/force_passes.h"

namespace plash {

template SumForces sum_forces<true, false>;

} // namespace plash

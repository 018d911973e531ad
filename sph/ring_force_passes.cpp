#include "sph/force_passes.h"

namespace plash {

template SumForces sum_forces<false, true>;
template SumForces sum_forces<true, true>;

} // namespace plash

#include "elements/shell_group_of_law.h"
#include "materials/compression_tension.h"

namespace plash {

std::unique_ptr<Term> make_compression_tension_shells(const ShellPart& part, ShellFormulation formulation,
                                                      State& state)
{
    return make_shells_of_law<CompressionTension>(part, formulation, state);
}

} // namespace plash

#include "core/release.h"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace plash {

void give_gaps_back()
{
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

} // namespace plash

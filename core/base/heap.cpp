#include "core/base/heap.h"

#include <cstdlib>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace seedmesh {

void return_unused_heap() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace seedmesh

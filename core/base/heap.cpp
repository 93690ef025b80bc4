#include "core/base/heap.h"

#include <cstddef>
#include <cstdlib>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

// Of jemalloc; null in programs that are not linked with it.
extern "C" int mallctl(const char* name, void* old_value, std::size_t* old_size, void* new_value,
                       std::size_t new_size) __attribute__((weak));

namespace seedmesh {

void return_unused_heap() {
  constexpr const char* purge_all_arenas = "arena.4096.purge";
  if (mallctl) {
    mallctl(purge_all_arenas, nullptr, nullptr, nullptr, 0);
    return;
  }
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace seedmesh

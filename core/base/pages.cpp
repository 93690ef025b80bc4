#include "core/base/pages.h"

#include <cstring>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace seedmesh::pages {

#if defined(__linux__)
namespace {

// The kernel aligns mappings of whole huge pages so that it can use them. So whole huge pages are mapped, and
// the unwanted end is unmapped before it is touched.
constexpr std::size_t asked_for(std::size_t bytes) {
  return bytes < huge_page ? bytes : rounded(bytes, huge_page);
}

std::byte* fitted(void* memory, std::size_t bytes) {
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* first = static_cast<std::byte*>(memory);
  if (asked_for(bytes) > bytes) munmap(first + bytes, asked_for(bytes) - bytes);
  if (bytes >= huge_page) madvise(memory, bytes, MADV_HUGEPAGE);
  return first;
}

std::byte* copied(std::byte* old, std::size_t before, std::size_t after) {
  std::byte* fresh = map(after);
  std::memcpy(fresh, old, before);
  munmap(old, before);
  return fresh;
}

}  // namespace

std::byte* map(std::size_t bytes) {
  constexpr int access = PROT_READ | PROT_WRITE, kind = MAP_PRIVATE | MAP_ANONYMOUS;
  return fitted(mmap(nullptr, asked_for(bytes), access, kind, -1, 0), bytes);
}

std::byte* remap(std::byte* old, std::size_t before, std::size_t after) {
#if defined(__SANITIZE_THREAD__)  // ThreadSanitizer does not see memory that the kernel moves
  return copied(old, before, after);
#else
  void* const moved = mremap(old, before, asked_for(after), MREMAP_MAYMOVE);
  if (moved != MAP_FAILED) return fitted(moved, after);
  return copied(old, before, after);  // the kernel cannot move memory that was mapped in two parts
#endif
}

void unmap(std::byte* memory, std::size_t bytes) { munmap(memory, bytes); }
#else
std::byte* map(std::size_t) { return nullptr; }
std::byte* remap(std::byte*, std::size_t, std::size_t) { return nullptr; }
void unmap(std::byte*, std::size_t) {}
#endif

}  // namespace seedmesh::pages

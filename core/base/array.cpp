#include "core/base/array.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace seedmesh {
namespace {

// Page faults, not arithmetic, decide what big arrays cost, and huge pages save most of them; a block takes
// as many as it fills, and small ones for its end. Smaller blocks are the heap's, which has pages that were
// touched before. But what a heap is given back stays with the process: a large request maps all that is
// worth a call, so that memory goes when an array goes.
constexpr std::size_t always_mapped = std::size_t{2} << 20U;
constexpr std::size_t mapped_if_large = std::size_t{256} << 10U;

#if defined(__linux__)
constexpr std::size_t huge_page = std::size_t{2} << 20U;
constexpr std::size_t largest_page = std::size_t{64} << 10U;  // of the small ones, on any machine
constexpr bool can_map = true;

constexpr std::size_t rounded(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }
constexpr std::size_t pages(std::size_t bytes) { return rounded(bytes, largest_page); }

/// The kernel lays whole huge pages where they can be used, so they are asked for; what is too much of them
/// goes back untouched.
constexpr std::size_t asked_for(std::size_t bytes) {
  return bytes < huge_page ? pages(bytes) : rounded(bytes, huge_page);
}
std::byte* fitted(void* memory, std::size_t bytes) {
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* first = static_cast<std::byte*>(memory);
  if (asked_for(bytes) > pages(bytes)) munmap(first + pages(bytes), asked_for(bytes) - pages(bytes));
  if (bytes >= huge_page) madvise(memory, pages(bytes), MADV_HUGEPAGE);
  return first;
}

std::byte* map(std::size_t bytes) {
  constexpr int access = PROT_READ | PROT_WRITE, kind = MAP_PRIVATE | MAP_ANONYMOUS;
  return fitted(mmap(nullptr, asked_for(bytes), access, kind, -1, 0), bytes);
}
std::byte* remap(std::byte* old, std::size_t before, std::size_t after) {
  if (pages(after) <= pages(before)) {
    if (pages(after) < pages(before)) munmap(old + pages(after), pages(before) - pages(after));
    return old;
  }
  return fitted(mremap(old, pages(before), asked_for(after), MREMAP_MAYMOVE), after);
}
void unmap(std::byte* memory, std::size_t bytes) { munmap(memory, pages(bytes)); }
#else
constexpr bool can_map = false;
std::byte* map(std::size_t) { return nullptr; }
std::byte* remap(std::byte*, std::size_t, std::size_t) { return nullptr; }
void unmap(std::byte*, std::size_t) {}
#endif

/// Pages of the heap that nobody uses go back to the kernel.
void trim_heap() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

std::byte* heap(std::byte* old, std::size_t bytes) {
  auto* memory = static_cast<std::byte*>(std::realloc(old, bytes));
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

Block::Block(Block&& other) noexcept
    : purse_(other.purse_),
      data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      is_mapped_(std::exchange(other.is_mapped_, false)) {}

Block& Block::operator=(Block&& other) noexcept {
  if (this != &other) {
    this->~Block();
    new (this) Block(std::move(other));
  }
  return *this;
}

Block::~Block() {
  if (size_ == 0) return;
  release();
  if (purse_) purse_->give_back(size_);
}

void Block::release() {
  if (is_mapped_) {
    unmap(data_, size_);
  } else {
    std::free(data_);
  }
  is_mapped_ = false;
}

bool Block::is_worth_mapping(std::size_t bytes) const {
  if (!can_map || bytes < mapped_if_large) return false;
  return bytes >= always_mapped || (purse_ && purse_->is_large());
}

void Block::change(std::size_t bytes) {
  const bool map_it = is_worth_mapping(bytes);
  if (is_mapped_ && map_it) {
    data_ = remap(data_, size_, bytes);
  } else if (!is_mapped_ && !map_it) {
    data_ = heap(data_, bytes);
  } else {
    std::byte* fresh = map_it ? map(bytes) : heap(nullptr, bytes);
    if (size_) std::memcpy(fresh, data_, size_ < bytes ? size_ : bytes);
    release();
    data_ = fresh;
  }
  is_mapped_ = map_it;
}

void Block::resize(std::size_t bytes) {
  if (bytes == size_) return;
  if (bytes > size_ && purse_) {
    const bool was_large = purse_->is_large();
    purse_->take(bytes - size_);
    if (!was_large && purse_->is_large()) trim_heap();
  }
  const std::size_t before = size_;
  if (bytes == 0) {
    release();
    data_ = nullptr;
  } else {
    change(bytes);
  }
  if (bytes < before && purse_) purse_->give_back(before - bytes);
  size_ = bytes;
}

}  // namespace seedmesh

#include "core/base/array.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace seedmesh {
namespace {

// Below this the heap is faster than the kernel; above it page faults decide, and huge pages save most of
// them.
constexpr std::size_t mapped_from = std::size_t{4} << 20U;

#if defined(__linux__)
constexpr std::size_t page = std::size_t{2} << 20U;  // of a huge page
std::size_t pages(std::size_t bytes) { return (bytes + page - 1) / page * page; }

std::byte* map(std::size_t bytes) {
  void* memory = mmap(nullptr, pages(bytes), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, pages(bytes), MADV_HUGEPAGE);
  return static_cast<std::byte*>(memory);
}
std::byte* remap(std::byte* old, std::size_t before, std::size_t after) {
  void* memory = mremap(old, pages(before), pages(after), MREMAP_MAYMOVE);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, pages(after), MADV_HUGEPAGE);
  return static_cast<std::byte*>(memory);
}
void unmap(std::byte* memory, std::size_t bytes) { munmap(memory, pages(bytes)); }
bool is_mapped(std::size_t bytes) { return bytes >= mapped_from; }
#else
std::byte* map(std::size_t) { return nullptr; }
std::byte* remap(std::byte*, std::size_t, std::size_t) { return nullptr; }
void unmap(std::byte*, std::size_t) {}
bool is_mapped(std::size_t) { return false; }
#endif

void release(std::byte* memory, std::size_t bytes) {
  if (is_mapped(bytes)) {
    unmap(memory, bytes);
  } else {
    std::free(memory);
  }
}

std::byte* heap(std::byte* old, std::size_t bytes) {
  auto* memory = static_cast<std::byte*>(std::realloc(old, bytes));
  if (!memory) throw std::bad_alloc();
  return memory;
}

/// Memory of `after` bytes that starts with what `old` (of `before` bytes) held; takes over `old`.
std::byte* change(std::byte* old, std::size_t before, std::size_t after) {
  if (is_mapped(before) && is_mapped(after)) return remap(old, before, after);
  if (!is_mapped(before) && !is_mapped(after)) return heap(old, after);
  std::byte* fresh = is_mapped(after) ? map(after) : heap(nullptr, after);
  if (before) std::memcpy(fresh, old, before < after ? before : after);
  release(old, before);
  return fresh;
}

}  // namespace

Block::Block(Block&& other) noexcept
    : purse_(other.purse_),
      data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)) {}

Block& Block::operator=(Block&& other) noexcept {
  if (this != &other) {
    this->~Block();
    new (this) Block(std::move(other));
  }
  return *this;
}

Block::~Block() {
  if (size_ == 0) return;
  release(data_, size_);
  if (purse_) purse_->give_back(size_);
}

void Block::resize(std::size_t bytes) {
  if (bytes == size_) return;
  if (bytes > size_ && purse_) purse_->take(bytes - size_);
  if (bytes == 0) {
    release(data_, size_);
    data_ = nullptr;
  } else {
    data_ = change(data_, size_, bytes);
  }
  if (bytes < size_ && purse_) purse_->give_back(size_ - bytes);
  size_ = bytes;
}

}  // namespace seedmesh

#include "core/base/array.h"

#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace seedmesh {
namespace {

// Page faults, not arithmetic, decide what big arrays cost, and huge pages save most of them. A block takes
// whole huge pages from the first size on always; from the second on while the room that the rounding up
// leaves empty stays below the third in the whole request. Smaller blocks are the heap's: a huge page is
// cleared whole, and the heap has pages that were touched before.
constexpr std::size_t always_mapped = std::size_t{4} << 20U;
constexpr std::size_t mapped_at_best = std::size_t{2} << 20U;
constexpr std::uint64_t most_slack = std::uint64_t{6} << 20U;

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
#else
constexpr std::size_t page = 1;
std::size_t pages(std::size_t bytes) { return bytes; }
std::byte* map(std::size_t) { return nullptr; }
std::byte* remap(std::byte*, std::size_t, std::size_t) { return nullptr; }
void unmap(std::byte*, std::size_t) {}
#endif

std::byte* heap(std::byte* old, std::size_t bytes) {
  auto* memory = static_cast<std::byte*>(std::realloc(old, bytes));
  if (!memory) throw std::bad_alloc();
  return memory;
}

std::uint64_t slack_of(std::size_t bytes) { return pages(bytes) - bytes; }

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
    if (purse_) purse_->give_back_slack(slack_of(size_));
  } else {
    std::free(data_);
  }
  is_mapped_ = false;
}

bool Block::is_worth_mapping(std::size_t bytes) const {
  if (page == 1 || bytes < mapped_at_best) return false;
  return bytes >= always_mapped || (purse_ && purse_->slack() + slack_of(bytes) <= most_slack);
}

void Block::change(std::size_t bytes) {
  const bool map_it = is_worth_mapping(bytes);
  if (is_mapped_ && map_it) {
    data_ = remap(data_, size_, bytes);
    if (purse_) purse_->give_back_slack(slack_of(size_));
  } else if (!is_mapped_ && !map_it) {
    data_ = heap(data_, bytes);
  } else {
    std::byte* fresh = map_it ? map(bytes) : heap(nullptr, bytes);
    if (size_) std::memcpy(fresh, data_, size_ < bytes ? size_ : bytes);
    release();
    data_ = fresh;
  }
  is_mapped_ = map_it;
  if (is_mapped_ && purse_) purse_->take_slack(slack_of(bytes));
}

void Block::resize(std::size_t bytes) {
  if (bytes == size_) return;
  if (bytes > size_ && purse_) purse_->take(bytes - size_);
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

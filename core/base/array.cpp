#include "core/base/array.h"

#include <cstdlib>
#include <cstring>
#include <new>

#include "core/base/heap.h"
#include "core/base/huge_page_cache.h"
#include "core/base/pages.h"

namespace seedmesh {

using namespace pages;

namespace {

// Page faults decide what big arrays cost, and huge pages avoid most of them.
// - A block of at least `always_mapped` bytes always takes whole huge pages.
// - With a reserve, a smaller block of at least `least_shared` bytes shares huge pages with other blocks.
// - Without a reserve, a block of at least `mapped_at_best` bytes takes whole huge pages, as long as the empty
//   ends of all such blocks of the request stay below `most_slack`.
// - All other blocks are on the heap, whose pages are often in memory already.
constexpr std::size_t always_mapped = std::size_t{4} << 20U;
constexpr std::size_t mapped_at_best = std::size_t{1} << 20U;
constexpr std::size_t least_shared = std::size_t{256} << 10U;
constexpr std::uint64_t most_slack = std::uint64_t{12} << 20U;
// Memory that is freed to the heap stays with the process. A request that saves memory therefore maps each
// block from this size on: huge pages as far as it fills them, small pages for its end.
constexpr std::size_t mapped_to_save = std::size_t{256} << 10U;

std::byte* heap(std::byte* old, std::size_t bytes) {
  auto* memory = static_cast<std::byte*>(std::realloc(old, bytes));
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

// The other block stays usable, so it keeps its budget.
Block::Block(Block&& other) noexcept
    : budget_(other.budget_),  // NOLINT(performance-move-constructor-init)
      data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      backing_(std::exchange(other.backing_, Backing::heap)) {}

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
  if (budget_) budget_->release(size_);
}

std::size_t Block::mapped_size(std::size_t bytes, Backing backing) {
  return rounded(bytes, backing == Backing::huge_pages ? huge_page : largest_page);
}

Block::Backing Block::backing_for(std::size_t bytes) const {
  if (!can_map) return Backing::heap;
  if (budget_ && budget_->saves_memory()) return bytes < mapped_to_save ? Backing::heap : Backing::pages;
  const bool has_reserve = budget_ && budget_->reserve() && !budget_->prefers_low_memory();
  if (bytes < (has_reserve ? least_shared : mapped_at_best)) return Backing::heap;
  if (budget_ && budget_->prefers_low_memory()) return Backing::pages;
  if (bytes < always_mapped && has_reserve) return Backing::shared;
  const std::size_t slack = mapped_size(bytes, Backing::huge_pages) - bytes;
  return bytes >= always_mapped || (budget_ && budget_->slack() + slack <= most_slack) ? Backing::huge_pages
                                                                                       : Backing::heap;
}

/// Pages of the reserve were used before, so the kernel need not clear them.
std::byte* Block::mapped(std::size_t room, Backing backing) const {
  if (backing == Backing::shared) return budget_->reserve()->share(room);
  std::byte* kept = nullptr;
  if (backing == Backing::huge_pages && budget_ && budget_->reserve()) kept = budget_->reserve()->take(room);
  return kept ? kept : map(room);
}

void Block::unmap_or_recycle(std::byte* memory, std::size_t room) const {
  const bool is_whole = backing_ == Backing::huge_pages && room % huge_page == 0;
  const bool is_kept = (is_whole || backing_ == Backing::shared) && budget_ && budget_->reserve() &&
                       budget_->reserve()->keep(memory, room, budget_->used(), budget_->peak());
  if (!is_kept) unmap(memory, room);
}

void Block::release() {
  if (backing_ == Backing::heap) {
    std::free(data_);
  } else {
    unmap_or_recycle(data_, mapped_size(size_, backing_));
    if (budget_) budget_->release_slack(mapped_size(size_, backing_) - size_);
  }
  backing_ = Backing::heap;
}

void Block::change(std::size_t bytes) {
  Backing backing = backing_for(bytes);
  if (backing == Backing::shared && backing_ == Backing::huge_pages) backing = backing_;
  const std::size_t before = mapped_size(size_, backing_), after = mapped_size(bytes, backing);
  const bool is_shared = backing_ == Backing::shared || backing == Backing::shared;
  if (is_shared ? backing_ == backing && after <= before
                : backing_ != Backing::heap && backing != Backing::heap) {
    if (after > before) data_ = remap(data_, before, after);
    if (after < before) unmap_or_recycle(data_ + after, before - after);
    if (budget_) budget_->release_slack(mapped_size(size_, backing_) - size_);
  } else if (backing_ == backing && backing == Backing::heap) {
    data_ = heap(data_, bytes);
  } else {
    std::byte* fresh = backing == Backing::heap ? heap(nullptr, bytes) : mapped(after, backing);
    if (size_) std::memcpy(fresh, data_, size_ < bytes ? size_ : bytes);
    release();
    data_ = fresh;
  }
  backing_ = backing;
  if (backing_ != Backing::heap && budget_) budget_->take_slack(mapped_size(bytes, backing_) - bytes);
}

void Block::resize(std::size_t bytes) {
  if (bytes == size_) return;
  if (bytes > size_ && budget_) {
    const bool was_saving_memory = budget_->saves_memory();
    budget_->take(bytes - size_);
    if (!was_saving_memory && budget_->saves_memory()) return_unused_heap();
  }
  const std::size_t before = size_;
  if (bytes == 0) {
    release();
    data_ = nullptr;
  } else {
    change(bytes);
  }
  if (bytes < before && budget_) budget_->release(before - bytes);
  size_ = bytes;
}

}  // namespace seedmesh

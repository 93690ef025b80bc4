#pragma once
/// Growing arrays for big models. New elements are uninitialised. Every byte of capacity is charged to the memory
/// budget of the request before it is allocated; the unused ends of pages are counted separately
/// (MemoryBudget::slack). Large blocks come from the kernel as huge pages, because page faults cost more than
/// arithmetic in large models. Move-only; only one thread may use it at a time.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/job.h"

namespace seedmesh {

/// Raw storage charged to a memory budget. It grows in place where the kernel supports that (mremap).
class Block {
 public:
  Block() = default;
  explicit Block(std::shared_ptr<MemoryBudget> budget) : budget_(std::move(budget)) {}
  Block(Block&& other) noexcept;
  Block& operator=(Block&& other) noexcept;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  ~Block();

  /// Changes the size to `bytes` and keeps the content up to it. Throws Stop before the budget is
  /// exceeded.
  void resize(std::size_t bytes);

  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  const std::shared_ptr<MemoryBudget>& budget() const { return budget_; }

 private:
  /// Where the bytes are: on the heap, in whole huge pages, in huge pages shared with other blocks, or in the
  /// smallest number of base pages that holds them.
  enum class Backing : unsigned char { heap, huge_pages, shared, pages };
  static std::size_t mapped_size(std::size_t bytes, Backing backing);
  Backing backing_for(std::size_t bytes) const;
  void change(std::size_t bytes);
  void release();
  std::byte* mapped(std::size_t room, Backing backing) const;
  void unmap_or_recycle(std::byte* memory, std::size_t room) const;

  std::shared_ptr<MemoryBudget> budget_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  Backing backing_ = Backing::heap;
};

template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;

  Array() = default;  ///< empty and without a budget; it can only stay empty or be assigned to
  explicit Array(const Job& job) : block_(job.budget()) {}
  Array(const Job& job, std::size_t size) : block_(job.budget()) { resize(size); }
  /// Checks the deadline and the stop token between blocks: the kernel clears pages as they are first written.
  Array(const Job& job, std::size_t size, const T& value) : block_(job.budget()) {
    constexpr std::size_t block = (std::size_t{1} << 20U) / sizeof(T) + 1;
    resize(size);
    const T copy = value;
    for (std::size_t first = 0; first < size; first += block) {
      job.check();
      std::fill_n(data() + first, std::min(block, size - first), copy);
    }
  }
  explicit Array(std::shared_ptr<MemoryBudget> budget) : block_(std::move(budget)) {}
  Array(Array&& other) noexcept : block_(std::move(other.block_)), size_(std::exchange(other.size_, 0)) {}
  Array& operator=(Array&& other) noexcept {
    block_ = std::move(other.block_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  /// Returns an empty array of another element type, charged to the same budget.
  template <class Other>
  Array<Other> empty_array_of() const {
    return Array<Other>(block_.budget());
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t capacity() const { return block_.size() / sizeof(T); }
  std::size_t bytes() const { return size_ * sizeof(T); }

  T* data() { return reinterpret_cast<T*>(block_.data()); }
  const T* data() const { return reinterpret_cast<const T*>(block_.data()); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T& back() { return data()[size_ - 1]; }
  const T& back() const { return data()[size_ - 1]; }
  std::span<T> span() { return {data(), size_}; }
  std::span<const T> span() const { return {data(), size_}; }

  /// Allocates exactly `capacity` elements, not more.
  void reserve(std::size_t capacity) {
    if (capacity > this->capacity()) block_.resize(capacity * sizeof(T));
  }
  /// New elements are uninitialised.
  void resize(std::size_t size) {
    reserve(size);
    size_ = size;
  }
  /// Frees the memory beyond size().
  void shrink_to_fit() { block_.resize(size_ * sizeof(T)); }
  void clear() { size_ = 0; }

  void push_back(const T& value) {
    const T copy = value;
    if (size_ == capacity()) grow(size_ + 1);
    data()[size_++] = copy;
  }
  void pop_back() { --size_; }
  /// Appends `count` uninitialised elements and returns where they start.
  T* extend(std::size_t count) {
    if (size_ + count > capacity()) grow(size_ + count);
    T* first = data() + size_;
    size_ += count;
    return first;
  }
  void append(std::span<const T> values) {
    if (!values.empty()) std::memcpy(extend(values.size()), values.data(), values.size() * sizeof(T));
  }

 private:
  void grow(std::size_t least) {
    const std::size_t next_capacity = capacity() + capacity() / 2 + 16;
    block_.resize((least > next_capacity ? least : next_capacity) * sizeof(T));
  }

  Block block_;
  std::size_t size_ = 0;
};

}  // namespace seedmesh

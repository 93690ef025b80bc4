#pragma once
/// What the threads of parallel.cpp take from each other: chunks of a parallel_for, pieces of a Beside. For
/// parallel.cpp alone.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>

namespace seedmesh {

constexpr std::size_t cache_line = 64;

/// Set on a thread that runs a chunk: what is cut into chunks within one has no threads left.
inline thread_local bool in_a_chunk = false;

class InAChunk {
 public:
  InAChunk() : before_(in_a_chunk) { in_a_chunk = true; }
  ~InAChunk() { in_a_chunk = before_; }
  InAChunk(const InAChunk&) = delete;
  InAChunk& operator=(const InAChunk&) = delete;

 private:
  bool before_;
};

/// The first that was thrown on any thread.
class Failure {
 public:
  void keep() {
    const std::lock_guard lock(mutex_);
    if (!first_) first_ = std::current_exception();
  }
  void throw_on() {
    if (first_) std::rethrow_exception(std::exchange(first_, nullptr));
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
};

/// The chunks of a parallel_for. Each thread begins in a stretch of its own, the same one each time, whose
/// memory its core still has from the last; then it helps others from their ends on.
class Region {
 public:
  static constexpr std::size_t most_stretches = 16;

  Region(std::size_t chunks, std::size_t threads, const std::function<void(std::size_t)>& each)
      : stretches_(std::clamp<std::size_t>(threads, 1, most_stretches)), each_(each) {
    for (std::size_t i = 0; i < stretches_; ++i)
      stretch_[i].left = packed(chunks * i / stretches_, chunks * (i + 1) / stretches_);
  }

  /// On the thread of this number.
  void work(std::size_t thread) {
    const InAChunk mark;
    for (std::size_t i = 0; i < stretches_; ++i) {
      std::atomic<std::uint64_t>& left = stretch_[(thread + i) % stretches_].left;
      for (std::uint64_t now = left; begin_of(now) < end_of(now);) {
        const bool is_own = i == 0;
        const std::size_t chunk = is_own ? begin_of(now) : end_of(now) - 1;
        const std::uint64_t rest = is_own ? packed(chunk + 1, end_of(now)) : packed(begin_of(now), chunk);
        if (left.compare_exchange_weak(now, rest)) {
          call(chunk);
          now = left;
        }
      }
    }
  }

  bool is_left() const {
    return std::any_of(stretch_, stretch_ + stretches_, [](const Stretch& stretch) {
      const std::uint64_t now = stretch.left;
      return begin_of(now) < end_of(now);
    });
  }

  void throw_on() { failure_.throw_on(); }

 private:
  struct alignas(cache_line) Stretch {
    std::atomic<std::uint64_t> left{0};
  };
  static std::uint64_t packed(std::uint64_t begin, std::uint64_t end) { return begin << 32U | end; }
  static std::size_t begin_of(std::uint64_t packed) { return packed >> 32U; }
  static std::size_t end_of(std::uint64_t packed) { return packed & 0xFFFFFFFFU; }

  void call(std::size_t chunk) {
    try {
      each_(chunk);
    } catch (...) {
      failure_.keep();
      for (Stretch& stretch : stretch_) stretch.left = 0;
    }
  }

  std::size_t stretches_;
  const std::function<void(std::size_t)>& each_;
  Stretch stretch_[most_stretches];
  Failure failure_;
};

/// The work of a Beside.
class Pieces {
 public:
  Pieces(std::function<std::size_t()> prepare, std::function<void(std::size_t)> piece)
      : prepare_(std::move(prepare)), piece_(std::move(piece)) {}

  /// False: there is nothing to be begun, now.
  bool do_one() {
    const InAChunk mark;
    try {
      if (!is_prepared_) return prepare();
      if (next_ >= count_) return false;
      const std::size_t i = next_++;
      if (i >= count_) return false;
      piece_(i);
    } catch (...) {
      failure_.keep();
      stop();
    }
    return true;
  }

  bool is_prepared() const { return is_prepared_; }
  std::size_t left() const { return next_ < count_ ? count_ - next_ : 0; }

  /// Nothing is begun any more.
  void stop() {
    prepares_ = true;
    next_ = most;
    is_prepared_ = true;
  }

  void throw_on() { failure_.throw_on(); }

 private:
  static constexpr std::size_t most = ~std::size_t{0} / 2;

  bool prepare() {
    if (prepares_.exchange(true)) return false;
    count_ = prepare_();
    is_prepared_ = true;
    return true;
  }

  std::function<std::size_t()> prepare_;
  std::function<void(std::size_t)> piece_;
  std::atomic<bool> prepares_{false}, is_prepared_{false};
  std::atomic<std::size_t> count_{0};
  alignas(cache_line) std::atomic<std::size_t> next_{0};
  Failure failure_;
};

}  // namespace seedmesh

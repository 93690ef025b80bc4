#pragma once
/// The only door to more than one thread in core. The range is cut into fixed chunks that do not depend on
/// the number of threads; whoever joins results joins them in chunk order. oneTBB behind it; std::thread in
/// the tsan preset, where Debian's TBB gives false races.
#include <cstddef>
#include <functional>
#include <memory>

#include "core/base/job.h"

namespace seedmesh {

/// Calls body(begin, end, chunk_index) for every chunk [i*chunk, min((i+1)*chunk, count)). An exception of a
/// body (Stop) ends the whole and is thrown on here. With job.threads() == 1 everything runs on the caller;
/// there are never more threads than oneTBB's max_allowed_parallelism, by default the number of cores.
void parallel_for(const Job& job, std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t begin, std::size_t end, std::size_t index)>& body);

/// Calls both, side by side where there are threads. Unlike in a chunk of parallel_for, what is cut into
/// chunks within them may use all threads. Of two exceptions that of `one` is thrown on.
void run_both(const Job& job, const std::function<void()>& one, const std::function<void()>& other);

/// Does parallel_for use more than one thread here? For those who would rather do it otherwise on one.
bool has_threads(const Job& job);

/// While it lives, the threads that help its caller wait awake from one parallel_for to the next, a third of
/// a millisecond at most: to wake one takes a tenth, longer than much of what there is to do for it. For
/// requests of a millisecond. Of no effect for jobs of one thread, and inside another.
class KeepAwake {
 public:
  explicit KeepAwake(const Job& job);
  ~KeepAwake();
  KeepAwake(const KeepAwake&) = delete;
  KeepAwake& operator=(const KeepAwake&) = delete;

 private:
  friend class Released;
  struct Waiters;
  std::unique_ptr<Waiters> waiters_;
};

constexpr std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

}  // namespace seedmesh

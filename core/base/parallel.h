#pragma once
/// The only door to more than one thread in core. The range is cut into fixed chunks that do not depend on
/// the number of threads; whoever joins results joins them in chunk order. oneTBB behind it; std::thread in
/// the tsan preset, where Debian's TBB gives false races.
#include <cstddef>
#include <functional>
#include <memory>

#include "core/base/job.h"

namespace seedmesh {

class Crew;
class Pieces;

/// Calls body(begin, end, chunk_index) for every chunk [i*chunk, min((i+1)*chunk, count)). An exception of a
/// body (Stop) ends the whole and is thrown on here. With job.threads() == 1 everything runs on the caller;
/// there are never more threads than oneTBB's max_allowed_parallelism, by default the number of cores.
void parallel_for(const Job& job, std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t begin, std::size_t end, std::size_t index)>& body);

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
  std::unique_ptr<Crew> crew_;
};

/// Work that the rest of its caller's does not wait for, cut into pieces: threads that KeepAwake holds do
/// them wherever the caller leaves them nothing else, in what is done by one thread and at the end of each
/// parallel_for. Without such threads, or beside another, all is done by finish(). The caller does what does
/// not meet the pieces' memory meanwhile.
class Beside {
 public:
  /// `prepare` is called first and returns how many pieces there are; then piece(0), piece(1) ..., each once,
  /// by any thread. A piece takes some tens of microseconds at most: the next parallel_for waits for it.
  Beside(const Job& job, std::function<std::size_t()> prepare, std::function<void(std::size_t)> piece);
  ~Beside();  ///< what has not begun is not done
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  /// Does the rest, on all threads, and throws on what a piece has thrown.
  void finish();

 private:
  const Job& job_;
  std::unique_ptr<Pieces> pieces_;
  Crew* crew_ = nullptr;  ///< that knows of it
};

constexpr std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

}  // namespace seedmesh

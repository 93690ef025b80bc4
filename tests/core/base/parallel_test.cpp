#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace seedmesh {
namespace {

Job with_threads(int threads) { return Job(0, {.threads = threads}); }

TEST(ParallelFor, VisitsEveryChunkOnceWithAnyNumberOfThreads) {
  for (const int threads : {1, 2, 8}) {
    std::vector<int> visits(1000, 0);
    std::vector<std::size_t> starts(chunk_count(visits.size(), 7));
    parallel_for(with_threads(threads), visits.size(), 7,
                 [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   starts[chunk] = begin;
                   for (std::size_t i = begin; i < end; ++i) ++visits[i];
                 });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 1000);
    for (std::size_t chunk = 0; chunk < starts.size(); ++chunk) EXPECT_EQ(starts[chunk], 7 * chunk);
  }
}

TEST(ParallelFor, InsideAnotherStaysOnItsThread) {
  const Job job = with_threads(8);
  std::vector<int> foreign(16, 0);
  parallel_for(job, foreign.size(), 1, [&](std::size_t outer, std::size_t, std::size_t) {
    const std::thread::id own = std::this_thread::get_id();
    parallel_for(job, 100, 1, [&](std::size_t, std::size_t, std::size_t) {
      if (std::this_thread::get_id() != own) ++foreign[outer];
    });
  });
  EXPECT_EQ(std::count(foreign.begin(), foreign.end(), 0), 16);
}

TEST(ParallelFor, UsesNoMoreThreadsThanTheJobHas) {
  const Job job = with_threads(2);
  std::atomic<int> running{0}, most{0};
  parallel_for(job, 200, 1, [&](std::size_t, std::size_t, std::size_t) {
    const int now = ++running;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(50));
    --running;
  });
  EXPECT_LE(most, 2);
}

TEST(ParallelFor, RethrowsWhatAChunkThrows) {
  const Job job = with_threads(4);
  EXPECT_THROW(parallel_for(job, 100, 1,
                            [&job](std::size_t begin, std::size_t, std::size_t) {
                              if (begin == 50) job.refuse({IssueKind::evaluation, "", "enough"});
                            }),
               Stop);
  // The threads can be used again.
  std::vector<int> visits(100, 0);
  parallel_for(job, 100, 1, [&](std::size_t i, std::size_t, std::size_t) { ++visits[i]; });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 100);
}

}  // namespace
}  // namespace seedmesh

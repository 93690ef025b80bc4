#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  std::vector<int> strangers(16, 0);
  parallel_for(job, strangers.size(), 1, [&](std::size_t outer, std::size_t, std::size_t) {
    const std::thread::id own = std::this_thread::get_id();
    parallel_for(job, 100, 1, [&](std::size_t, std::size_t, std::size_t) {
      if (std::this_thread::get_id() != own) ++strangers[outer];
    });
  });
  EXPECT_EQ(std::count(strangers.begin(), strangers.end(), 0), 16);
}

TEST(KeepAwake, LetsThreadsGoToWorkAgainAndAgain) {
  for (const int threads : {1, 2, 8}) {
    const Job job = with_threads(threads);
    const KeepAwake awake(job), again(job);  // of which one is enough
    for (int round = 0; round < 200; ++round) {
      std::vector<int> visits(64, 0);
      const auto visit = [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      };
      run_both(
          job, [&] { parallel_for(job, 32, 1, visit); },
          [&] {
            parallel_for(job, 32, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
              visit(begin + 32, end + 32, 0);
            });
          });
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 64);
    }
    const auto fails = [](std::size_t, std::size_t, std::size_t i) {
      if (i == 3) throw Stop(Code::limit, {"", "no"});
    };
    EXPECT_THROW(parallel_for(job, 8, 1, fails), Stop);
  }
}

TEST(RunBoth, CallsBothAndLetsThemCutTheirWork) {
  for (const int threads : {1, 2, 8}) {
    const Job job = with_threads(threads);
    std::vector<int> one(1000, 0), other(1000, 0);
    const auto count_up = [&](std::vector<int>& visits) {
      parallel_for(job, visits.size(), 7, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
    };
    run_both(
        job, [&] { count_up(one); }, [&] { count_up(other); });
    EXPECT_EQ(std::count(one.begin(), one.end(), 1), 1000);
    EXPECT_EQ(std::count(other.begin(), other.end(), 1), 1000);
  }
}

TEST(RunBoth, ThrowsOnWhatTheFirstThrowsWhereBothDo) {
  for (const int threads : {1, 8}) {
    const auto fail = [](const char* message) { Job::refuse(message); };
    try {
      run_both(
          with_threads(threads), [&] { fail("one"); }, [&] { fail("other"); });
      FAIL() << "nothing was thrown";
    } catch (const Stop& stop) {
      EXPECT_EQ(stop.issue().message, "one");
    }
    EXPECT_THROW(run_both(
                     with_threads(threads), [] {}, [&] { fail("other"); }),
                 Stop);
  }
}

TEST(ParallelFor, ThrowsOnWhatAChunkThrows) {
  const Job job = with_threads(4);
  EXPECT_THROW(parallel_for(job, 100, 1,
                            [](std::size_t begin, std::size_t, std::size_t) {
                              if (begin == 50) Job::refuse("enough");
                            }),
               Stop);
  // And the threads are as before.
  std::vector<int> visits(100, 0);
  parallel_for(job, 100, 1, [&](std::size_t i, std::size_t, std::size_t) { ++visits[i]; });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 100);
}

}  // namespace
}  // namespace seedmesh

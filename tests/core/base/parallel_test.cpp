#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
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
      parallel_for(job, 64, 1, visit);
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 64);
    }
    const auto fails = [](std::size_t, std::size_t, std::size_t i) {
      if (i == 3) throw Stop(Code::limit, {"", "no"});
    };
    EXPECT_THROW(parallel_for(job, 8, 1, fails), Stop);
  }
}

/// Counts how often each piece of some work was done.
struct Pieces {
  explicit Pieces(std::size_t count) : done(count) {}
  std::size_t prepare() {
    ++prepared;
    return done.size();
  }
  void expect_once() const {
    EXPECT_EQ(prepared, 1);
    for (const std::atomic<int>& each : done) EXPECT_EQ(each, 1);
  }
  std::vector<std::atomic<int>> done;
  std::atomic<int> prepared{0};
};

TEST(Beside, DoesEachPieceOnceWhateverItsCallerDoesMeanwhile) {
  for (const int threads : {1, 2, 8}) {
    for (const bool is_awake : {false, true}) {
      const Job job = with_threads(threads);
      std::optional<KeepAwake> awake;
      if (is_awake) awake.emplace(job);
      for (int round = 0; round < 100; ++round) {
        Pieces pieces(30);
        Beside beside(
            job, [&] { return pieces.prepare(); }, [&](std::size_t i) { ++pieces.done[i]; });
        std::vector<int> visits(64, 0);
        for (int times = 0; times < round % 4; ++times)
          parallel_for(job, visits.size(), 1, [&](std::size_t i, std::size_t, std::size_t) { ++visits[i]; });
        beside.finish();
        pieces.expect_once();
        EXPECT_EQ(std::count(visits.begin(), visits.end(), round % 4), 64);
      }
    }
  }
}

TEST(Beside, IsDoneWhileItsCallerIsBusy) {
  const Job job = with_threads(2);
  const KeepAwake awake(job);
  Pieces pieces(8);
  Beside beside(
      job, [&] { return pieces.prepare(); }, [&](std::size_t i) { ++pieces.done[i]; });
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "nobody can do it";
  for (int waits = 0; waits < 5000 && pieces.done.back() == 0; ++waits)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  pieces.expect_once();
  beside.finish();
  pieces.expect_once();
}

TEST(Beside, DoesTheSecondAtItsEnd) {
  const Job job = with_threads(2);
  const KeepAwake awake(job);
  Pieces one(20), other(20);
  Beside first(
      job, [&] { return one.prepare(); }, [&](std::size_t i) { ++one.done[i]; });
  Beside second(
      job, [&] { return other.prepare(); }, [&](std::size_t i) { ++other.done[i]; });
  second.finish();
  other.expect_once();
  first.finish();
  one.expect_once();
}

TEST(Beside, ThrowsAtItsEndOnWhatAPieceThrows) {
  for (const int threads : {1, 2, 8}) {
    const Job job = with_threads(threads);
    const KeepAwake awake(job);
    const auto fail = [](std::size_t i) {
      if (i == 5) Job::refuse("enough");
    };
    Beside pieces(
        job, [] { return std::size_t{10}; }, fail);
    EXPECT_THROW(pieces.finish(), Stop);
    Beside start(
        job, []() -> std::size_t { Job::refuse("enough"); }, [](std::size_t) {});
    EXPECT_THROW(start.finish(), Stop);
  }
}

TEST(Beside, LeavesOutWhatHasNotBegunWhereItsCallerThrows) {
  const Job job = with_threads(8);
  const KeepAwake awake(job);
  for (int round = 0; round < 100; ++round) {
    std::vector<int> memory(4, 0);
    try {
      Beside beside(
          job, [&] { return memory.size(); }, [&](std::size_t i) { ++memory[i]; });
      Job::refuse("enough");
    } catch (const Stop&) {
      memory = {};  // nobody writes there any more
    }
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

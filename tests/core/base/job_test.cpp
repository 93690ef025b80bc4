#include "core/base/job.h"

#include <gtest/gtest.h>

#include <atomic>

#include "core/base/parallel.h"

namespace seedmesh {
namespace {

Job job_with_modules(std::uint64_t modules, int threads = 1) {
  Job::Options options;
  options.limits.modules = modules;
  options.threads = threads;
  return Job(1, options);
}

TEST(Meter, LetsExactlyTheLimitThrough) {
  Job job = job_with_modules(10'000);
  Meter meter(job, Resource::modules);
  for (int i = 0; i < 10'000; ++i) meter.spend();
  EXPECT_THROW(meter.spend(), Stop);
}

TEST(Job, RefusesAmountsThatWouldOverflowItsCounters) {
  Job job = job_with_modules(100);
  EXPECT_THROW(job.spend(Resource::modules, ~std::uint64_t{0}), Stop);
  job.spend(Resource::modules, 100);
  EXPECT_THROW(job.spend(Resource::modules, ~std::uint64_t{0}), Stop);
}

TEST(Job, StopsWhenTheCallerHasGone) {
  std::stop_source caller;
  Job::Options options;
  options.stop = caller.get_token();
  const Job job(0, options);
  job.check();
  caller.request_stop();
  try {
    job.check();
    FAIL() << "went on";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), Code::cancelled);
  }
}

TEST(Job, StopsAtItsDeadline) {
  Job::Options options;
  options.deadline = Job::Clock::now() - std::chrono::seconds(1);
  try {
    Job(0, options).check();
    FAIL() << "went on";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), Code::deadline);
  }
}

TEST(Job, SharesItsPurseWithTheJobsOfChildren) {
  Job job = job_with_modules(100);
  Job child = job.for_child(9);
  child.spend(Resource::modules, 60);
  EXPECT_THROW(job.spend(Resource::modules, 60), Stop);
  EXPECT_NE(child.rng().key(), job.rng().key());
}

TEST(ParallelFor, CutsTheSameChunksForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 8}) {
    const Job job = job_with_modules(1, threads);
    std::vector<std::size_t> sums(chunk_count(1003, 100));
    parallel_for(job, 1003, 100, [&](std::size_t begin, std::size_t end, std::size_t index) {
      for (std::size_t i = begin; i < end; ++i) sums[index] += i;
    });
    EXPECT_EQ(sums.size(), 11U);
    EXPECT_EQ(sums[10], 1000U + 1001U + 1002U);
  }
}

TEST(ParallelFor, ThrowsOnWhatAChunkThrew) {
  const Job job = job_with_modules(1, 4);
  EXPECT_THROW(parallel_for(job, 1000, 1,
                            [](std::size_t begin, std::size_t, std::size_t) {
                              if (begin == 500) Job::refuse("enough");
                            }),
               Stop);
}

}  // namespace
}  // namespace seedmesh

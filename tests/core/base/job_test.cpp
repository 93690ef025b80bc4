#include "core/base/job.h"

#include <gtest/gtest.h>

#include <atomic>

#include "core/base/array.h"
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

TEST(Job, StopsWhenTheClientHasGone) {
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
    EXPECT_EQ(stop.issue().kind, IssueKind::cancelled);
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
    EXPECT_EQ(stop.issue().kind, IssueKind::deadline);
  }
}

TEST(Job, SharesItsBudgetWithTheJobsOfChildren) {
  Job job = job_with_modules(100);
  Job child = job.for_child(9);
  child.spend(Resource::modules, 60);
  EXPECT_THROW(job.spend(Resource::modules, 60), Stop);
  EXPECT_NE(child.rng().key(), job.rng().key());
}

/// The Stop that `work` throws.
template <class Work>
Stop stop_of(const Work& work) {
  try {
    work();
  } catch (const Stop& stop) {
    return stop;
  }
  ADD_FAILURE() << "went on";
  return Stop(Code::internal, {});
}

TEST(Job, HasEstimatesWithItsStopDeadlineAndMemoryButCountersOfTheirOwn) {
  std::stop_source caller;
  Job::Options options;
  options.limits.modules = 100;
  options.limits.memory_bytes = 4 << 20;
  options.stop = caller.get_token();
  Job job(7, options);
  job.spend(Resource::modules, 60);
  const Array<std::uint8_t> held(job, 3 << 20);
  Job estimate = job.for_estimate();
  EXPECT_EQ(estimate.seed(), 7U);
  estimate.spend(Resource::modules, 100);
  EXPECT_THROW(estimate.spend(Resource::modules, 1), Stop);
  EXPECT_EQ(job.spent(Resource::modules), 60U);
  EXPECT_THROW(Array<std::uint8_t>(estimate, 2 << 20), Stop);
  caller.request_stop();
  EXPECT_THROW(estimate.check(), Stop);
  options.stop = {};
  options.deadline = Job::Clock::now() - std::chrono::seconds(1);
  EXPECT_THROW(Job(0, options).for_estimate().check(), Stop);
}

TEST(Job, NamesTheResourceTheBoundAndTheNeedOfALimit) {
  Job job = job_with_modules(100);
  job.spend(Resource::modules, 60);
  const Stop stop = stop_of([&] { job.spend(Resource::modules, 50); });
  EXPECT_EQ(stop.code(), Code::limit);
  EXPECT_EQ(stop.issue().kind, IssueKind::limit);
  EXPECT_EQ(stop.issue().limit, (Limit{Resource::modules, 100, 110}));
}

TEST(MemoryBudget, NamesTheResourceTheBoundAndTheNeedOfALimit) {
  MemoryBudget budget(1000);
  budget.take(600);
  const Stop stop = stop_of([&] { budget.take(401); });
  EXPECT_EQ(stop.code(), Code::limit);
  EXPECT_EQ(stop.issue().limit, (Limit{Resource::memory_bytes, 1000, 1001}));
}

TEST(Job, PointsIntoTheParametersOfTheOutermostRequest) {
  const Job job = job_with_modules(1);
  const Job child = job.for_child(2, "/model/parameters").for_child(3, "/element/parameters");
  const auto refused = [](const Job& by, const char* pointer) {
    return stop_of([&] { by.refuse({IssueKind::evaluation, pointer, "no"}); }).issue().pointer;
  };
  EXPECT_EQ(refused(job, "/angle"), "/angle");
  EXPECT_EQ(refused(child, "/angle"), "/model/parameters/element/parameters/angle");
  EXPECT_EQ(refused(child, ""), "/model/parameters/element/parameters");
}

TEST(PointerScope, IsWhereALimitWithoutAPointerIsReported) {
  Job job = job_with_modules(1);
  Job child = job.for_child(2, "/model/parameters");
  const auto pointer = [](Job& by) {
    return stop_of([&] { by.spend(Resource::modules, 2); }).issue().pointer;
  };
  EXPECT_EQ(pointer(child), "");
  {
    const Job::PointerScope scope(job, "/layers/0");
    Job inner = job.for_child(3, "/model/parameters");
    EXPECT_EQ(pointer(job), "/layers/0");
    EXPECT_EQ(pointer(inner), "/layers/0");
    const Job::PointerScope nearer(inner, "/iterations");
    EXPECT_EQ(pointer(inner), "/model/parameters/iterations");
    EXPECT_EQ(stop_of([&] { job.refuse({IssueKind::evaluation, "", "no"}); }).issue().pointer, "");
  }
  EXPECT_EQ(pointer(job), "");
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
                            [&job](std::size_t begin, std::size_t, std::size_t) {
                              if (begin == 500) job.refuse({IssueKind::evaluation, "", "enough"});
                            }),
               Stop);
}

}  // namespace
}  // namespace seedmesh

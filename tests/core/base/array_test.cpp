#include "core/base/array.h"

#include <gtest/gtest.h>

#include <numeric>

namespace seedmesh {
namespace {

Job job_with_memory(std::uint64_t bytes) {
  Job::Options options;
  options.limits.memory_bytes = bytes;
  return Job(0, options);
}

TEST(Array, KeepsItsElementsWhileItGrowsFromTheHeapIntoMappedPages) {
  const Job job = job_with_memory(std::uint64_t{1} << 30U);
  Array<std::uint32_t> array(job);
  for (std::uint32_t i = 0; i < 5'000'000; ++i) array.push_back(i);
  for (std::uint32_t i = 0; i < 5'000'000; i += 977) ASSERT_EQ(array[i], i);
}

TEST(Array, ChargesThePurseForItsCapacityAndPaysBack) {
  const Job job = job_with_memory(1 << 20U);
  {
    Array<double> array(job, 1000);
    EXPECT_EQ(job.purse()->used(), 8000U);
    const Array<double> other = std::move(array);
    EXPECT_EQ(job.purse()->used(), 8000U);
    EXPECT_TRUE(array.empty());  // NOLINT: a moved-from array is promised to be empty
  }
  EXPECT_EQ(job.purse()->used(), 0U);
}

TEST(Array, RefusesBeforeItAllocatesBeyondTheLimit) {
  const Job job = job_with_memory(1000);
  Array<char> array(job);
  EXPECT_THROW(array.reserve(1001), Stop);
  EXPECT_EQ(job.purse()->used(), 0U);
}

TEST(Array, OutlivesTheJobThatPaid) {
  Array<int> array;
  {
    const Job job = job_with_memory(1 << 20U);
    array = Array<int>(job, 10, 7);
  }
  EXPECT_EQ(std::accumulate(array.begin(), array.end(), 0), 70);
}

TEST(Array, AppendsAnElementOfItself) {
  const Job job = job_with_memory(1 << 20U);
  Array<int> array(job, 1, 42);
  for (int i = 0; i < 100; ++i) array.push_back(array[0]);
  EXPECT_EQ(array.back(), 42);
}

}  // namespace
}  // namespace seedmesh

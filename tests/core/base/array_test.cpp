#include "core/base/array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <vector>

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

TEST(Array, KeepsWhatFitsWhereverASizeTakesIt) {
  for (const bool is_thrifty : {false, true}) {
    const Job job = job_with_memory(std::uint64_t{1} << 30U);
    if (is_thrifty) {
      job.purse()->be_thrifty();
      const Array<char> passing(job, 9 << 20U);
    }
    EXPECT_EQ(job.purse()->is_thrifty(), is_thrifty);
    Array<std::uint32_t> array(job);
    std::size_t kept = 0;
    // From the heap into small pages, huge ones with an odd end, and all the way back.
    constexpr std::size_t sizes[] = {100, 70'000, 600'000, 1'300'000, 1'100'000, 530'000, 140'000, 66'000, 9};
    for (const std::size_t size : sizes) {
      array.resize(size);
      array.shrink_to_fit();
      for (std::size_t i = 0; i < std::min(kept, size); ++i) ASSERT_EQ(array[i], i);
      for (std::size_t i = 0; i < size; ++i) array[i] = static_cast<std::uint32_t>(i);
      kept = size;
      ASSERT_EQ(job.purse()->used(), size * sizeof(std::uint32_t));
    }
  }
}

TEST(Array, OfAThriftyRequestLeavesNoMemoryBehind) {
#if defined(__linux__)
  const auto resident = [] {
    std::ifstream file("/proc/self/statm");
    std::size_t whole = 0, pages = 0;
    file >> whole >> pages;
    return pages * 4096;
  };
  const Job job = job_with_memory(std::uint64_t{1} << 30U);
  job.purse()->be_thrifty();
  const Array<char> large(job, 9 << 20U);
  const std::size_t before = resident();
  {
    std::vector<Array<char>> many;
    for (int i = 0; i < 40; ++i) many.emplace_back(job, 700'000, 'x');
    EXPECT_GT(resident(), before + 20'000'000);
    std::swap(many.front(), many.back());  // the order in which they go does not matter
  }
  EXPECT_LT(resident(), before + 2'000'000);
#endif
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

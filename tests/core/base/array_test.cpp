#include "core/base/array.h"

#include <gtest/gtest.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <algorithm>
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

TEST(Array, KeepsWhatFitsWhereverASizeTakesIt) {
  for (const bool saves_memory : {false, true}) {
    const Job job = job_with_memory(std::uint64_t{1} << 30U);
    if (saves_memory) {
      job.budget()->prefer_low_memory();
      const Array<char> passing(job, 9 << 20U);
    }
    EXPECT_EQ(job.budget()->saves_memory(), saves_memory);
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
      ASSERT_EQ(job.budget()->used(), size * sizeof(std::uint32_t));
    }
  }
}

#if defined(__linux__)
TEST(Array, OfARequestThatPrefersLowMemoryKeepsNoPages) {
  const auto is_there = [](char* page) {
    unsigned char resident = 0;
    return mincore(page, 1, &resident) == 0;  // else no memory lies there
  };
  const Job job = job_with_memory(std::uint64_t{1} << 30U);
  job.budget()->prefer_low_memory();
  const Array<char> passing(job, 9 << 20U);
  Array<char> first(job, 700'000, 'x');
  const Array<char> second(job, 700'000, 'x');
  char* page = first.data();
  EXPECT_TRUE(is_there(page));
  first = Array<char>(job);
  EXPECT_FALSE(is_there(page));
}
#endif

TEST(Array, ChargesItsCapacityToTheBudgetAndReturnsIt) {
  const Job job = job_with_memory(1 << 20U);
  {
    Array<double> array(job, 1000);
    EXPECT_EQ(job.budget()->used(), 8000U);
    const Array<double> other = std::move(array);
    EXPECT_EQ(job.budget()->used(), 8000U);
    EXPECT_TRUE(array.empty());  // NOLINT: a moved-from array is promised to be empty
  }
  EXPECT_EQ(job.budget()->used(), 0U);
}

TEST(Array, RefusesBeforeItAllocatesBeyondTheLimit) {
  const Job job = job_with_memory(1000);
  Array<char> array(job);
  EXPECT_THROW(array.reserve(1001), Stop);
  EXPECT_EQ(job.budget()->used(), 0U);
}

TEST(Array, OutlivesItsJob) {
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

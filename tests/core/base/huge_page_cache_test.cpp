#include "core/base/huge_page_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/base/array.h"
#include "core/base/pages.h"

namespace seedmesh {
namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20U;

Job job_with(const std::shared_ptr<HugePageCache>& reserve) {
  Job::Options options;
  options.reserve = reserve;
  return Job(0, options);
}

#if defined(__linux__)
TEST(HugePageCache, GivesTheMemoryOfAnArrayToTheNextOne) {
  const auto reserve = std::make_shared<HugePageCache>(32 * mebibyte);
  const char* where = nullptr;
  {
    const Array<char> first(job_with(reserve), 5 * mebibyte, 'x');
    where = first.data();
    EXPECT_EQ(reserve->kept(), 0U);
  }
  EXPECT_EQ(reserve->kept(), 6 * mebibyte);
  const Array<char> second(job_with(reserve), 6 * mebibyte);
  EXPECT_EQ(second.data(), where);
  EXPECT_EQ(reserve->kept(), 0U);
}

TEST(HugePageCache, CutsWhatIsKeptAndMakesItWholeAgain) {
  const auto reserve = std::make_shared<HugePageCache>(32 * mebibyte);
  { const Array<char> whole(job_with(reserve), 12 * mebibyte, 'x'); }
  {
    const Array<char> one(job_with(reserve), 5 * mebibyte, 'a'), other(job_with(reserve), 6 * mebibyte, 'b');
    EXPECT_EQ(reserve->kept(), 0U);
    EXPECT_TRUE(std::all_of(one.begin(), one.end(), [](char c) { return c == 'a'; }));
  }
  EXPECT_EQ(reserve->kept(), 12 * mebibyte);
  const Array<char> again(job_with(reserve), 12 * mebibyte);
  EXPECT_EQ(reserve->kept(), 0U);
}

TEST(HugePageCache, KeepsTheEndThatAnArrayDoesNotNeed) {
  const auto reserve = std::make_shared<HugePageCache>(32 * mebibyte);
  Array<char> array(job_with(reserve), 11 * mebibyte, 'x');
  array.resize(5 * mebibyte);
  array.shrink_to_fit();
  EXPECT_EQ(reserve->kept(), 6 * mebibyte);
  EXPECT_EQ(array.back(), 'x');
}

TEST(HugePageCache, LetsAnArrayGrowOverMemoryOfTwoThatWere) {
  const auto reserve = std::make_shared<HugePageCache>(64 * mebibyte);
  {
    const Array<char> one(job_with(reserve), 6 * mebibyte, 'x'), other(job_with(reserve), 6 * mebibyte, 'x');
  }
  Array<std::uint32_t> array(job_with(reserve));
  for (std::uint32_t i = 0; i < 9'000'000; ++i) array.push_back(i);
  for (std::uint32_t i = 0; i < 9'000'000; i += 977) ASSERT_EQ(array[i], i);
}

TEST(HugePageCache, KeepsNoMoreThanItsMost) {
  const auto reserve = std::make_shared<HugePageCache>(8 * mebibyte);
  { const Array<char> greater(job_with(reserve), 10 * mebibyte, 'x'); }
  EXPECT_EQ(reserve->kept(), 0U);
  { const Array<char> one(job_with(reserve), 4 * mebibyte), other(job_with(reserve), 6 * mebibyte); }
  EXPECT_LE(reserve->kept(), 8 * mebibyte);
  EXPECT_GE(reserve->kept(), 4 * mebibyte);
}

TEST(HugePageCache, DoesNotMakeAGreatRequestGreater) {
  const auto reserve = std::make_shared<HugePageCache>(24 * mebibyte);
  const Job great = job_with(reserve);
  Array<char> used(great, 10 * mebibyte, 'x');
  { const Array<char> passing(great, 4 * mebibyte, 'x'); }
  EXPECT_EQ(reserve->kept(), 4 * mebibyte) << "as much as there was before";
  Array<char> more(great, 14 * mebibyte, 'x');
  used.resize(20 * mebibyte);
  EXPECT_EQ(great.budget()->peak(), 34 * mebibyte);
  EXPECT_EQ(reserve->kept(), 4 * mebibyte);
  { const Array<char> last(great, 12 * mebibyte, 'x'); }
  EXPECT_EQ(reserve->kept(), 4 * mebibyte) << "with 46 MiB used, as many as ever";
  more = {};
  EXPECT_EQ(reserve->kept(), 18 * mebibyte) << "with 34 MiB used";
}

TEST(HugePageCache, LaysSmallerArraysTogether) {
  const auto reserve = std::make_shared<HugePageCache>(32 * mebibyte);
  const Job job = job_with(reserve);
  {
    const Array<char> one(job, mebibyte / 2, 'a'), other(job, mebibyte, 'b');
    EXPECT_EQ(reserve->kept(), mebibyte / 2) << "the rest of the huge page that they share";
    EXPECT_TRUE(std::all_of(one.begin(), one.end(), [](char c) { return c == 'a'; }));
    EXPECT_TRUE(std::all_of(other.begin(), other.end(), [](char c) { return c == 'b'; }));
  }
  EXPECT_EQ(reserve->kept(), 2 * mebibyte);
  const Array<char> whole(job, 4 * mebibyte, 'c');
  EXPECT_EQ(reserve->kept(), 2 * mebibyte) << "too small for it";
}

TEST(HugePageCache, LetsSmallerArraysGrowOneAmongOthers) {
  const auto reserve = std::make_shared<HugePageCache>(32 * mebibyte);
  const Job job = job_with(reserve);
  Array<std::uint32_t> arrays[] = {Array<std::uint32_t>(job), Array<std::uint32_t>(job),
                                   Array<std::uint32_t>(job)};
  for (std::uint32_t i = 0; i < 2'000'000; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) arrays[k].push_back(3 * i + k);
  }
  for (std::uint32_t size = 2'000'000; size > 1000; size = size / 10 * 7) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      arrays[k].resize(size);
      arrays[k].shrink_to_fit();
      for (std::uint32_t i = 0; i < size; i += 97) ASSERT_EQ(arrays[k][i], 3 * i + k);
    }
  }
  EXPECT_LE(reserve->kept(), 32 * mebibyte);
}

TEST(HugePageCache, GivesAllBackWhenItIsCleared) {
  const auto reserve = std::make_shared<HugePageCache>(32 * mebibyte);
  { const Array<char> array(job_with(reserve), 8 * mebibyte, 'x'); }
  EXPECT_EQ(reserve->kept(), 8 * mebibyte);
  reserve->clear();
  EXPECT_EQ(reserve->kept(), 0U);
  EXPECT_EQ(reserve->take(pages::huge_page), nullptr);
}
#endif

TEST(HugePageCache, IsNotUsedByRequestsThatPreferLowMemory) {
  const auto reserve = std::make_shared<HugePageCache>(32 * mebibyte);
  const Job job = job_with(reserve);
  job.budget()->prefer_low_memory();
  { const Array<char> array(job, 9 * mebibyte, 'x'); }
  EXPECT_EQ(reserve->kept(), 0U);
}

}  // namespace
}  // namespace seedmesh

#include "server/texture_cache.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace seedmesh {
namespace {

std::shared_ptr<const int> number(int value) { return std::make_shared<const int>(value); }

int found(TextureCache& cache, const std::string& key) {
  const std::shared_ptr<const void> value = cache.find(key);
  return value ? *static_cast<const int*>(value.get()) : -1;
}

TEST(TextureCache, GivesBackWhatItKeeps) {
  TextureCache cache(100);
  cache.keep("oak", number(7), 40);
  EXPECT_EQ(found(cache, "oak"), 7);
  EXPECT_EQ(found(cache, "pine"), -1);
  EXPECT_EQ(cache.bytes(), 40U);
}

TEST(TextureCache, RemovesTheLeastRecentlyUsed) {
  TextureCache cache(100);
  cache.keep("oak", number(1), 40);
  cache.keep("pine", number(2), 40);
  EXPECT_EQ(found(cache, "oak"), 1);
  cache.keep("birch", number(3), 40);
  EXPECT_EQ(found(cache, "pine"), -1);
  EXPECT_EQ(found(cache, "oak"), 1);
  EXPECT_EQ(found(cache, "birch"), 3);
  EXPECT_EQ(cache.bytes(), 80U);
}

TEST(TextureCache, CountsAKeyThatTwoRequestsMadeOnce) {
  TextureCache cache(100);
  cache.keep("oak", number(1), 40);
  cache.keep("oak", number(1), 40);
  EXPECT_EQ(cache.bytes(), 40U);
}

TEST(TextureCache, KeepsNothingThatIsLargerThanItself) {
  TextureCache cache(100);
  cache.keep("oak", number(1), 101);
  EXPECT_EQ(found(cache, "oak"), -1);
  EXPECT_EQ(cache.bytes(), 0U);
}

TEST(TextureCache, ServesManyThreadsAtOnce) {
  TextureCache cache(1000);
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < 8; ++thread) {
    threads.emplace_back([&cache, thread] {
      for (int i = 0; i < 5000; ++i) {
        const int key = (i * 7 + thread) % 40;
        const int seen = found(cache, std::to_string(key));
        EXPECT_TRUE(seen == -1 || seen == key);
        if (seen == -1) cache.keep(std::to_string(key), number(key), 50);
      }
    });
  }
  threads.clear();
  EXPECT_LE(cache.bytes(), 1000U);
}

}  // namespace
}  // namespace seedmesh

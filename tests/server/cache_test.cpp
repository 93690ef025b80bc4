#include "server/cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace seedmesh {
namespace {

using namespace std::chrono_literals;

Cache::Entry entry_of(std::size_t bytes) {
  auto made = std::make_shared<CachedModel>();
  auto payload = std::make_shared<Payload>();
  payload->add(std::string(bytes, 'x'));
  made->payload = std::move(payload);
  return made;
}

std::stop_token no_client_leaves() { return {}; }

Cache::Lookup get(Cache& cache, const std::string& key, std::size_t bytes) {
  return cache.get(key, no_client_leaves,
                   [&](const std::stop_token&) -> Cache::Outcome { return entry_of(bytes); });
}

/// Whether a model is in memory.
bool has(Cache& cache, const std::string& key) {
  const auto make = [](const std::stop_token&) -> Cache::Outcome { return problem(404, "not in memory"); };
  return std::holds_alternative<Cache::Entry>(cache.get(key, no_client_leaves, make).outcome);
}

TEST(Cache, MakesOnceAndKeeps) {
  Cache cache(1U << 20U);
  const auto first = get(cache, "a", 100);
  const auto second = get(cache, "a", 100);
  EXPECT_FALSE(first.hit);
  EXPECT_TRUE(second.hit);
  EXPECT_EQ(std::get<Cache::Entry>(first.outcome), std::get<Cache::Entry>(second.outcome));
  EXPECT_EQ(cache.counters().hits, 1U);
  EXPECT_EQ(cache.counters().misses, 1U);
}

TEST(Cache, DropsTheLeastRecentlyUsedWhenItIsFull) {
  Cache cache(50'000);
  get(cache, "a", 20'000);
  get(cache, "b", 20'000);
  get(cache, "a", 20'000);
  get(cache, "c", 20'000);
  EXPECT_TRUE(has(cache, "a"));
  EXPECT_FALSE(has(cache, "b"));
  EXPECT_TRUE(has(cache, "c"));
  EXPECT_LE(cache.counters().bytes, 50'000U);
  EXPECT_EQ(cache.counters().evictions, 1U);
}

TEST(Cache, DoesNotKeepWhatIsLargerThanItself) {
  Cache cache(10'000);
  get(cache, "small", 1'000);
  EXPECT_TRUE(std::holds_alternative<Cache::Entry>(get(cache, "large", 20'000).outcome));
  EXPECT_FALSE(has(cache, "large"));
  EXPECT_TRUE(has(cache, "small"));
}

TEST(Cache, DoesNotKeepRefusals) {
  Cache cache(10'000);
  const auto refused = cache.get(
      "a", no_client_leaves, [](const std::stop_token&) -> Cache::Outcome { return problem(429, "Full."); });
  EXPECT_EQ(std::get<Problem>(refused.outcome).status, 429);
  EXPECT_TRUE(std::holds_alternative<Cache::Entry>(get(cache, "a", 10).outcome));
}

TEST(Cache, MakesOneForManyWhoAskAtOnce) {
  Cache cache(1U << 20U);
  std::atomic<int> made{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 16; ++i) {
    threads.emplace_back([&] {
      const auto answer = cache.get("a", no_client_leaves, [&](const std::stop_token&) -> Cache::Outcome {
        ++made;
        std::this_thread::sleep_for(50ms);
        return entry_of(10);
      });
      EXPECT_TRUE(std::holds_alternative<Cache::Entry>(answer.outcome));
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
}

TEST(Cache, GoesOnWorkingForThoseWhoStay) {
  Cache cache(1U << 20U);
  std::stop_source first_client;
  std::atomic<bool> started{false}, release{false};
  const auto slow = [&](const std::stop_token& stop) -> Cache::Outcome {
    started = true;
    while (!release && !stop.stop_requested()) std::this_thread::sleep_for(1ms);
    if (stop.stop_requested()) return problem(499, "Stopped.");
    return entry_of(10);
  };
  std::thread first([&] {
    cache.get(
        "a", [&] { return first_client.get_token(); }, slow);
  });
  while (!started) std::this_thread::sleep_for(1ms);
  std::thread second([&] {
    const auto answer = cache.get("a", no_client_leaves, slow);
    EXPECT_TRUE(std::holds_alternative<Cache::Entry>(answer.outcome));
    EXPECT_TRUE(answer.hit);
  });
  while (cache.counters().joins == 0) std::this_thread::sleep_for(1ms);
  first_client.request_stop();
  std::this_thread::sleep_for(20ms);
  release = true;
  first.join();
  second.join();
}

TEST(Cache, StopsWorkWhenAllHaveGone) {
  Cache cache(1U << 20U);
  std::stop_source client;
  std::atomic<bool> started{false};
  const auto endless = [&](const std::stop_token& stop) -> Cache::Outcome {
    started = true;
    while (!stop.stop_requested()) std::this_thread::sleep_for(1ms);
    return problem(499, "Stopped.");
  };
  std::thread first([&] {
    const auto answer = cache.get(
        "a", [&] { return client.get_token(); }, endless);
    EXPECT_EQ(std::get<Problem>(answer.outcome).status, 499);
  });
  while (!started) std::this_thread::sleep_for(1ms);
  client.request_stop();
  first.join();
  EXPECT_TRUE(std::holds_alternative<Cache::Entry>(get(cache, "a", 10).outcome));
}

TEST(Cache, LetsOthersKnowWhenTheMakerThrows) {
  Cache cache(1U << 20U);
  EXPECT_THROW(cache.get("a", no_client_leaves,
                         [](const std::stop_token&) -> Cache::Outcome { throw std::bad_alloc(); }),
               std::bad_alloc);
  EXPECT_TRUE(std::holds_alternative<Cache::Entry>(get(cache, "a", 10).outcome));
}

}  // namespace
}  // namespace seedmesh

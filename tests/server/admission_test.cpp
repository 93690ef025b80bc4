#include "server/admission.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace seedmesh {
namespace {

using namespace std::chrono_literals;
using Refused = Admission::Refused;

Admission::Clock::time_point in(std::chrono::milliseconds time) { return Admission::Clock::now() + time; }

std::optional<Refused> refusal(const std::variant<Admission::Ticket, Refused>& entered) {
  const auto* refused = std::get_if<Refused>(&entered);
  return refused ? std::optional(*refused) : std::nullopt;
}

void wait_for_queue(const Admission& admission, std::size_t length) {
  while (admission.waiting() != length) std::this_thread::sleep_for(1ms);
}

TEST(Admission, LetsInAsManyAsThereAreWorkers) {
  Admission admission(2, 0);
  const auto first = admission.enter(in(1s), {});
  {
    const auto second = admission.enter(in(1s), {});
    EXPECT_EQ(refusal(second), std::nullopt);
    EXPECT_EQ(admission.busy(), 2);
    EXPECT_EQ(refusal(admission.enter(in(1s), {})), Refused::queue_full);
  }
  EXPECT_EQ(refusal(admission.enter(in(1s), {})), std::nullopt);
  EXPECT_EQ(refusal(first), std::nullopt);
}

TEST(Admission, ServesTheQueueInOrder) {
  Admission admission(1, 8);
  std::optional<std::variant<Admission::Ticket, Refused>> held(admission.enter(in(1s), {}));
  std::vector<int> order;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      const auto entered = admission.enter(in(5s), {});
      ASSERT_EQ(refusal(entered), std::nullopt);
      const std::lock_guard lock(mutex);
      order.push_back(i);
    });
    wait_for_queue(admission, static_cast<std::size_t>(i) + 1);
  }
  held.reset();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(order, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(admission.busy(), 0);
}

TEST(Admission, StopsWaitingAtTheDeadline) {
  Admission admission(1, 8);
  const auto held = admission.enter(in(1s), {});
  EXPECT_EQ(refusal(admission.enter(in(20ms), {})), Refused::deadline_passed);
  EXPECT_EQ(admission.waiting(), 0U);
}

TEST(Admission, LetsAClientLeaveTheQueue) {
  Admission admission(1, 8);
  const auto held = admission.enter(in(1s), {});
  std::stop_source gone;
  std::thread waiter(
      [&] { EXPECT_EQ(refusal(admission.enter(in(10s), gone.get_token())), Refused::client_gone); });
  wait_for_queue(admission, 1);
  gone.request_stop();
  waiter.join();
  EXPECT_EQ(admission.waiting(), 0U);
}

TEST(Admission, ServesWhoWaitedWhenItDrains) {
  Admission admission(1, 8);
  std::optional<std::variant<Admission::Ticket, Refused>> held(admission.enter(in(1s), {}));
  std::thread waiter([&] { EXPECT_EQ(refusal(admission.enter(in(10s), {})), std::nullopt); });
  wait_for_queue(admission, 1);
  admission.drain();
  EXPECT_EQ(refusal(admission.enter(in(1s), {})), Refused::draining);
  held.reset();
  waiter.join();
}

TEST(Admission, SharesThreadsAmongThosePresent) {
  Admission admission(8, 8);
  const auto alone = admission.enter(in(1s), {});
  EXPECT_EQ(std::get<Admission::Ticket>(alone).threads(), 8);
  const auto second = admission.enter(in(1s), {});
  EXPECT_EQ(std::get<Admission::Ticket>(second).threads(), 4);
}

/// Holds the only worker while requests queue, and returns the order in which they are served.
std::vector<int> order_of(
    Admission& admission,
    const std::vector<std::function<std::variant<Admission::Ticket, Refused>()>>& queue) {
  std::optional<std::variant<Admission::Ticket, Refused>> held(admission.enter(in(1s), {}));
  std::vector<int> order;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    threads.emplace_back([&, i] {
      const auto entered = queue[i]();
      ASSERT_EQ(refusal(entered), std::nullopt);
      const std::lock_guard lock(mutex);
      order.push_back(static_cast<int>(i));
    });
    wait_for_queue(admission, i + 1);
  }
  held.reset();
  for (std::thread& thread : threads) thread.join();
  return order;
}

TEST(Admission, ServesCoarserTilesFirstAndEqualOnesInOrder) {
  Admission admission(1, 0);
  const auto tile = [&](int level) { return [&, level] { return admission.enter_tile(level, in(5s), {}); }; };
  EXPECT_EQ(order_of(admission, {tile(9), tile(3), tile(9), tile(0), tile(3)}), (std::vector{3, 1, 4, 0, 2}));
  EXPECT_EQ(admission.busy(), 0);
}

TEST(Admission, GivesTilesAndOtherRequestsTurns) {
  Admission admission(1, 8);
  const auto tile = [&] { return admission.enter_tile(5, in(5s), {}); };
  const auto other = [&] { return admission.enter(in(5s), {}); };
  EXPECT_EQ(order_of(admission, {tile, tile, other, tile, other}), (std::vector{2, 0, 4, 1, 3}));
}

TEST(Admission, RefusesNoTileForAFullQueueOrWhileItDrains) {
  Admission admission(1, 0);
  {
    const auto held = admission.enter(in(1s), {});
    EXPECT_EQ(refusal(admission.enter(in(20ms), {})), Refused::queue_full);
    EXPECT_EQ(refusal(admission.enter_tile(2, in(20ms), {})), Refused::deadline_passed);
    std::stop_source left;
    left.request_stop();
    EXPECT_EQ(refusal(admission.enter_tile(2, in(5s), left.get_token())), Refused::client_gone);
    EXPECT_EQ(admission.waiting(), 0U);
  }
  admission.drain();
  EXPECT_EQ(refusal(admission.enter_tile(2, in(20ms), {})), std::nullopt);
}

TEST(Admission, NeverHasMoreThanItsWorkersInside) {
  Admission admission(3, 1'000);
  std::atomic<int> inside{0}, most{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 16; ++i) {
    threads.emplace_back([&] {
      for (int turn = 0; turn < 200; ++turn) {
        const auto entered = admission.enter(in(30s), {});
        ASSERT_EQ(refusal(entered), std::nullopt);
        const int now = ++inside;
        for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) continue;
        --inside;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(most, 3);
  EXPECT_EQ(admission.busy(), 0);
}

}  // namespace
}  // namespace seedmesh

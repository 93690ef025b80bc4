#include "server/http/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>

namespace seedmesh::http {
namespace {

using namespace std::chrono_literals;

void wait_for(const std::function<bool()>& condition) {
  for (int i = 0; i < 2'000 && !condition(); ++i) std::this_thread::sleep_for(5ms);
}

TEST(Threads, RunTasksAtOnceUpToTheirNumber) {
  std::latch inside(3), leave(1);  // they outlive the threads, which are joined first
  Threads threads(3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(threads.start([&] {
      inside.count_down();
      leave.wait();
    }));
  }
  inside.wait();
  EXPECT_FALSE(threads.start([] { FAIL() << "it was not accepted"; }));
  leave.count_down();
}

TEST(Threads, EndWhenNobodyNeedsThemAndComeBack) {
  Threads threads(64, 20ms);
  for (int round = 0; round < 3; ++round) {
    std::latch inside(40), leave(1);
    for (int i = 0; i < 40; ++i) {
      ASSERT_TRUE(threads.start([&] {
        inside.count_down();
        leave.wait();
      }));
    }
    inside.wait();
    EXPECT_GE(threads.size(), 40U);
    leave.count_down();
    wait_for([&] { return threads.size() <= 8; });
    EXPECT_EQ(threads.size(), 8U);
  }
}

TEST(Threads, RunEveryTaskThatWasAccepted) {
  std::atomic<int> run{0};
  int accepted = 0;
  {
    Threads threads(32, 0ms);
    for (int i = 0; i < 5'000; ++i) accepted += threads.start([&] { ++run; }) ? 1 : 0;
  }
  EXPECT_EQ(run, accepted);
  EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace seedmesh::http

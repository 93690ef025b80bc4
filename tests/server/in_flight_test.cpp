#include "server/in_flight.h"

#include <gtest/gtest.h>

#include <thread>

namespace seedmesh {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<const Payload> payload_of(std::size_t size) {
  auto payload = std::make_shared<Payload>();
  payload->add(std::string(size, 'x'));
  return payload;
}

TEST(InFlight, CountsAPayloadOnceHoweverManyClientsReadIt) {
  InFlight memory(1'000'000);
  const auto payload = payload_of(400'000);
  auto first = memory.hold(payload), second = memory.hold(payload, 1'000);
  EXPECT_EQ(memory.bytes(), 401'000U);
  EXPECT_EQ(first.get(), payload.get());
  second.reset();
  EXPECT_EQ(memory.bytes(), 400'000U);
  const auto copy = first;
  first.reset();
  EXPECT_EQ(memory.bytes(), 400'000U);
}

TEST(InFlight, KeepsNothingBeyondItsLimit) {
  InFlight memory(1'000'000);
  auto first = memory.hold(payload_of(700'000));
  EXPECT_EQ(memory.hold(payload_of(300'001)), nullptr);
  EXPECT_EQ(memory.bytes(), 700'000U);
  const auto second = memory.hold(payload_of(300'000));
  EXPECT_NE(second, nullptr);
  first.reset();
  EXPECT_EQ(memory.bytes(), 300'000U);
}

TEST(InFlight, LetsALargePayloadPassAlone) {
  InFlight memory(1'000'000);
  auto large = memory.hold(payload_of(5'000'000));
  ASSERT_NE(large, nullptr);
  EXPECT_EQ(memory.hold(payload_of(20'000)), nullptr);
  large.reset();
  EXPECT_EQ(memory.bytes(), 0U);
}

TEST(InFlight, DoesNotCountWhatTheKernelTakesAtOnce) {
  InFlight memory(1'000'000);
  const auto small = memory.hold(payload_of(InFlight::smallest - 1));
  EXPECT_EQ(memory.bytes(), 0U);
}

TEST(InFlight, WaitsUntilMemoryIsReleased) {
  InFlight memory(1'000'000);
  EXPECT_TRUE(memory.wait(InFlight::Clock::now()));
  auto all = memory.hold(payload_of(1'000'000));
  EXPECT_FALSE(memory.wait(InFlight::Clock::now() + 50ms));
  std::thread reader([&] {
    std::this_thread::sleep_for(100ms);
    all.reset();
  });
  EXPECT_TRUE(memory.wait(InFlight::Clock::now() + 60s));
  reader.join();
}

}  // namespace
}  // namespace seedmesh

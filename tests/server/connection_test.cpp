#include "server/http/connection.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <thread>
#include <vector>

#include "server/http/disconnect_watch.h"

namespace seedmesh::http {
namespace {

using namespace std::chrono_literals;
using Clock = Connection::Clock;

/// A connection and the socket of its client. The connection waits 300 ms for a request.
struct Pair {
  explicit Pair(const ReadingPace& pace = {.timeout = 200ms}) {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, sockets), 0);
    const timeval timeout{0, 300'000};
    EXPECT_EQ(::setsockopt(sockets[0], SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof(timeout)), 0);
    connection.emplace(sockets[0], nullptr, pace);
  }
  ~Pair() { leave(); }
  void say(std::string_view text) const {
    EXPECT_EQ(::write(sockets[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void leave() {
    if (sockets[1] >= 0) ::close(sockets[1]);
    sockets[1] = -1;
  }
  int sockets[2] = {-1, -1};
  std::optional<Connection> connection;
};

TEST(Connection, BuffersWhatTheClientSends) {
  Pair pair;
  pair.say("first second");
  ASSERT_TRUE(pair.connection->read_more(Clock::now() + 1s));
  EXPECT_EQ(pair.connection->buffered(), "first second");
  pair.connection->consume(6);
  EXPECT_EQ(pair.connection->buffered(), "second");
  pair.say(" third");
  ASSERT_TRUE(pair.connection->read_more(Clock::now() + 1s));
  EXPECT_EQ(pair.connection->buffered(), "second third");
}

TEST(Connection, StopsReadingAtTheDeadlineAndAtTheEnd) {
  Pair pair;
  const auto begun = Clock::now();
  EXPECT_FALSE(pair.connection->read_more(begun + 100ms));
  EXPECT_GE(Clock::now() - begun, 100ms);
  EXPECT_LT(Clock::now() - begun, 2s);
  pair.leave();
  EXPECT_FALSE(pair.connection->read_more(Clock::now() + 10s));
  EXPECT_LT(Clock::now() - begun, 2s);
}

TEST(Connection, DoesNotExtendADeadlineForSingleBytes) {
  Pair pair;
  std::thread client([&] {
    for (int i = 0; i < 10; ++i) {
      pair.say("x");
      std::this_thread::sleep_for(50ms);
    }
  });
  const auto deadline = Clock::now() + 200ms;
  while (pair.connection->read_more(deadline)) {
  }
  EXPECT_LT(Clock::now(), deadline + 200ms);
  EXPECT_LT(pair.connection->buffered().size(), 10U);
  client.join();
}

TEST(Connection, DisconnectsAClientThatReadsNothing) {
  Pair pair;
  const auto begun = Clock::now();
  EXPECT_FALSE(pair.connection->write(std::string(64U << 20U, 'x')));
  EXPECT_TRUE(pair.connection->broken());
  EXPECT_GE(Clock::now() - begun, 200ms);
  EXPECT_LT(Clock::now() - begun, 5s);
  EXPECT_FALSE(pair.connection->write("more"));
}

/// What happens to a client that reads `size` bytes every `pause` of a response of 64 MiB, for `time` at most.
struct Outcome {
  bool slow = false;
  double seconds = 0;
};
Outcome read_slowly(const ReadingPace& pace, std::size_t size, Clock::duration pause, Clock::duration time) {
  Pair pair(pace);
  std::atomic<bool> over{false};
  std::thread client([&] {
    const auto end = Clock::now() + time;
    std::vector<char> bytes(size);
    while (!over && Clock::now() < end && ::read(pair.sockets[1], bytes.data(), size) > 0)
      std::this_thread::sleep_for(pause);
    ::shutdown(pair.sockets[1], SHUT_RDWR);
  });
  const auto begun = Clock::now();
  pair.connection->begin_response();
  pair.connection->write(std::string(64U << 20U, 'x'));
  const std::chrono::duration<double> taken = Clock::now() - begun;
  over = true;
  client.join();
  return {pair.connection->slow(), taken.count()};
}

TEST(Connection, DoesNotExtendTheTimeoutForFewBytes) {
  const ReadingPace pace{.timeout = 400ms, .step = 1U << 20U};
  const Outcome slow = read_slowly(pace, 10'000, 20ms, 10s);  // 200 KB of 1 MiB in 400 ms
  EXPECT_TRUE(slow.slow);
  EXPECT_LT(slow.seconds, 3);
  const Outcome quick = read_slowly(pace, 1'000'000, 20ms, 2s);  // 20 MB; the client leaves
  EXPECT_FALSE(quick.slow);
}

TEST(Connection, EndsAClientThatDoesNotKeepTheRateAfterTheGrace) {
  const ReadingPace pace{.timeout = 60s, .step = 1, .grace = 400ms, .rate = 1e6};
  const Outcome slow = read_slowly(pace, 10'000, 50ms, 10s);  // 200 KB a second
  EXPECT_TRUE(slow.slow);
  EXPECT_GE(slow.seconds, 0.4);
  EXPECT_LT(slow.seconds, 3);
  const Outcome quick = read_slowly(pace, 500'000, 50ms, 2s);  // 10 MB a second; the client leaves
  EXPECT_FALSE(quick.slow);
}

TEST(Connection, WaitsForARequestUntilItsTimeout) {
  Pair pair;
  const std::atomic<bool> draining{false};
  const auto begun = Clock::now();
  EXPECT_FALSE(pair.connection->wait_for_request(begun + 10s, draining));
  EXPECT_GE(Clock::now() - begun, 200ms);
  EXPECT_LT(Clock::now() - begun, 5s);
  pair.say("GET");
  EXPECT_TRUE(pair.connection->wait_for_request(Clock::now() + 1s, draining));
  EXPECT_EQ(pair.connection->buffered(), "GET");
}

TEST(Connection, StopsWaitingForARequestWhenItDrains) {
  Pair pair;
  const timeval none{0, 0};
  ::setsockopt(pair.sockets[0], SOL_SOCKET, SO_RCVTIMEO, &none, sizeof(none));
  pair.connection->end_if_idle();
  pair.say("GET");
  const std::atomic<bool> serving{false}, draining{true};
  EXPECT_TRUE(pair.connection->wait_for_request(Clock::now() + 1s, serving)) << "it was not idle";
  pair.connection->consume(3);
  EXPECT_FALSE(pair.connection->wait_for_request(Clock::now() + 1s, draining));
  std::thread drain([&] {
    std::this_thread::sleep_for(100ms);
    pair.connection->end_if_idle();
  });
  EXPECT_FALSE(pair.connection->wait_for_request(Clock::now() + 60s, serving));
  drain.join();
}

TEST(DisconnectWatch, ReportsAClientThatLeaves) {
  DisconnectWatch watch;
  Pair leaving, staying, removed;
  const std::stop_token left = watch.add(leaving.sockets[0]), stays = watch.add(staying.sockets[0]),
                        forgotten = watch.add(removed.sockets[0]);
  watch.remove(removed.sockets[0]);
  leaving.leave();
  removed.leave();
  for (int i = 0; i < 400 && !left.stop_requested(); ++i) std::this_thread::sleep_for(5ms);
  EXPECT_TRUE(left.stop_requested());
  EXPECT_FALSE(stays.stop_requested() || forgotten.stop_requested());
  watch.remove(leaving.sockets[0]);
  watch.remove(staying.sockets[0]);
}

}  // namespace
}  // namespace seedmesh::http

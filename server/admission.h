#pragma once
/// Limits how many requests are worked on at the same time and how many may wait, in order of arrival.
///
/// As in imgproxy, the queue is bounded. A request that finds it full is refused at once, so that an
/// overload does not slow down the requests that are accepted.
///
/// Tiles of worlds have a class of their own. A tile is never refused, because clients do not request a failed
/// tile again. The number of waiting tiles is bounded by that of the connections. Tiles of coarser
/// levels are served first, because clients need them first. While requests of both classes wait, free
/// workers serve the classes alternately.
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <stop_token>
#include <utility>
#include <variant>

namespace seedmesh {

class Admission {
 public:
  using Clock = std::chrono::steady_clock;

  Admission(int workers, std::size_t queue) : workers_(workers), most_waiting_(queue) {}

  /// The right to work. Ends with the object.
  class Ticket {
   public:
    Ticket(Admission& admission, int threads) : admission_(&admission), threads_(threads) {}
    Ticket(Ticket&& other) noexcept
        : admission_(std::exchange(other.admission_, nullptr)), threads_(other.threads_) {}
    Ticket& operator=(Ticket&&) = delete;
    ~Ticket() {
      if (admission_) admission_->leave();
    }
    /// Threads that this request may use: the workers divided by the requests that run or wait now.
    int threads() const { return threads_; }

   private:
    Admission* admission_;
    int threads_;
  };

  enum class Refused { queue_full, deadline_passed, draining, client_gone };

  /// Waits for a worker until `deadline` or until `disconnect_token` is set, which means that the client has left.
  std::variant<Ticket, Refused> enter(Clock::time_point deadline, const std::stop_token& disconnect_token);

  /// The same for a tile of this level of a world. It is not refused for a full queue or while the service
  /// drains.
  std::variant<Ticket, Refused> enter_tile(int level, Clock::time_point deadline,
                                           const std::stop_token& disconnect_token);

  /// Refuses all further requests except tiles. Requests that already wait are served.
  void drain();

  int workers() const { return workers_; }
  int busy() const;
  std::size_t waiting() const;

 private:
  struct Waiter {
    bool admitted = false;
  };
  /// Tiles by level and arrival.
  using Tiles = std::map<std::pair<int, std::uint64_t>, Waiter*>;

  bool has_no_waiters() const { return waiting_.empty() && waiting_tiles_.empty(); }
  void leave();
  int share() const;

  const int workers_;
  const std::size_t most_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Waiter*> waiting_;
  Tiles waiting_tiles_;
  std::uint64_t tiles_seen_ = 0;
  bool tile_is_next_ = false;
  int busy_ = 0;
  bool draining_ = false;
};

}  // namespace seedmesh

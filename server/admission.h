#pragma once
/// How many requests are worked on at once, and how many may wait for it. First come, first served.
///
/// The scheme of imgproxy: a bounded queue refuses at once what would wait too long anyway, so that an
/// overload costs the surplus an answer and not everybody their time.
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <stop_token>
#include <utility>
#include <variant>

namespace seedmesh {

class Admission {
 public:
  using Clock = std::chrono::steady_clock;

  Admission(int workers, std::size_t queue) : workers_(workers), most_waiting_(queue) {}

  /// The right to work, given back when it goes out of scope.
  class Ticket {
   public:
    explicit Ticket(Admission& admission, int threads) : admission_(&admission), threads_(threads) {}
    Ticket(Ticket&& other) noexcept
        : admission_(std::exchange(other.admission_, nullptr)), threads_(other.threads_) {}
    Ticket& operator=(Ticket&&) = delete;
    ~Ticket() {
      if (admission_) admission_->leave();
    }
    /// How many threads this request may use: the workers divided by the requests that are here now.
    int threads() const { return threads_; }

   private:
    Admission* admission_;
    int threads_;
  };

  enum class Refused { queue_full, deadline_passed, draining, client_gone };

  /// Waits for a worker until `deadline` or until `gone` is set.
  std::variant<Ticket, Refused> enter(Clock::time_point deadline, const std::stop_token& gone);

  /// Refuses whoever comes from now on; who waits already is served.
  void drain();

  int workers() const { return workers_; }
  int busy() const;
  std::size_t waiting() const;

 private:
  struct Waiter {
    bool admitted = false;
  };
  void leave();
  int share() const;

  const int workers_;
  const std::size_t most_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Waiter*> waiting_;
  int busy_ = 0;
  bool draining_ = false;
};

}  // namespace seedmesh

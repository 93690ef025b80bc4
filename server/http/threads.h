#pragma once
/// Threads for connections: made when needed, kept for the next connection, at most so many. One that nobody
/// has needed for some seconds ends, so that a burst does not leave its stacks behind. Threads wait on
/// sockets most of their life; how many requests are worked on at once is the business of Admission.
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <thread>

namespace seedmesh::http {

class Threads {
 public:
  using Duration = std::chrono::steady_clock::duration;
  explicit Threads(std::size_t most, Duration patience = std::chrono::seconds(5))
      : most_(most), patience_(patience) {}
  ~Threads() { join(); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  /// False when all threads are taken: the task has not been accepted.
  bool start(std::function<void()> task);

  std::size_t size();

  /// Ends after the running tasks have ended.
  void join();

 private:
  using Workers = std::list<std::thread>;
  void work(Workers::iterator self);
  void bury();

  const std::size_t most_;
  const Duration patience_;  ///< how long a thread waits for its next connection
  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<std::function<void()>> tasks_;
  Workers threads_;
  Workers ended_;  ///< to be joined by the next that ends or by who starts one
  std::size_t idle_ = 0;
  bool ending_ = false;
};

}  // namespace seedmesh::http

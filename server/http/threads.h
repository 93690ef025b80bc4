#pragma once
/// Threads for connections: made when needed, kept for the next connection, at most so many. Threads wait on
/// sockets most of their life; how many requests are worked on at once is the business of Admission.
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace seedmesh::http {

class Threads {
 public:
  explicit Threads(std::size_t most) : most_(most) {}
  ~Threads() { join(); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  /// False when all threads are taken: the task has not been accepted.
  bool start(std::function<void()> task);

  /// Ends after the running tasks have ended.
  void join();

 private:
  void work();

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0;
  bool ending_ = false;
};

}  // namespace seedmesh::http

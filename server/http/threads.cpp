#include "server/http/threads.h"

#include <system_error>

namespace seedmesh::http {

bool Threads::start(std::function<void()> task) {
  const std::lock_guard lock(mutex_);
  if (ending_) return false;
  if (tasks_.size() >= idle_) {
    if (threads_.size() == most_) return false;
    try {
      threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // the system has no more threads for us
      return false;
    }
    ++idle_;
  }
  tasks_.push_back(std::move(task));
  ready_.notify_one();
  return true;
}

void Threads::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    ready_.wait(lock, [this] { return ending_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    --idle_;
    lock.unlock();
    task();
    task = nullptr;
    lock.lock();
    ++idle_;
  }
}

void Threads::join() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ready_.notify_all();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

}  // namespace seedmesh::http

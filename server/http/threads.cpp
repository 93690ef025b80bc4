#include "server/http/threads.h"

#include <system_error>

namespace seedmesh::http {
namespace {

constexpr std::size_t always_kept = 8;

}  // namespace

bool Threads::start(std::function<void()> task) {
  bury();
  const std::lock_guard lock(mutex_);
  if (ending_) return false;
  if (tasks_.size() >= idle_) {
    if (threads_.size() == most_) return false;
    const auto self = threads_.emplace(threads_.end());
    try {
      *self = std::thread([this, self] { work(self); });
    } catch (const std::system_error&) {  // the system has no more threads for us
      threads_.erase(self);
      return false;
    }
    ++idle_;
  }
  tasks_.push_back(std::move(task));
  ready_.notify_one();
  return true;
}

void Threads::work(Workers::iterator self) {
  std::unique_lock lock(mutex_);
  while (true) {
    const bool wanted = ready_.wait_for(lock, patience_, [this] { return ending_ || !tasks_.empty(); });
    if (!wanted) {
      if (threads_.size() <= always_kept) continue;
      --idle_;
      Workers before;
      before.swap(ended_);
      ended_.splice(ended_.end(), threads_, self);
      lock.unlock();
      for (std::thread& thread : before) thread.join();
      return;
    }
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

/// Joins those that have ended; they need nothing that is held here.
void Threads::bury() {
  Workers ended;
  {
    const std::lock_guard lock(mutex_);
    ended.swap(ended_);
  }
  for (std::thread& thread : ended) thread.join();
}

std::size_t Threads::size() {
  const std::lock_guard lock(mutex_);
  return threads_.size();
}

void Threads::join() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ready_.notify_all();
  // From here on nobody is taken out of the list: whoever wakes sees the end.
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
  bury();
}

}  // namespace seedmesh::http

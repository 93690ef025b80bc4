#include "server/admission.h"

#include <algorithm>

namespace seedmesh {

std::variant<Admission::Ticket, Admission::Refused> Admission::enter(Clock::time_point deadline,
                                                                     const std::stop_token& gone) {
  std::unique_lock lock(mutex_);
  if (draining_) return Refused::draining;
  if (busy_ < workers_ && waiting_.empty()) {
    ++busy_;
    return Ticket(*this, share());
  }
  if (waiting_.size() >= most_waiting_) return Refused::queue_full;
  Waiter self;
  waiting_.push_back(&self);
  changed_.wait_until(lock, gone, deadline, [&] { return self.admitted; });
  if (self.admitted) return Ticket(*this, share());
  waiting_.erase(std::find(waiting_.begin(), waiting_.end(), &self));
  return gone.stop_requested() ? Refused::client_gone : Refused::deadline_passed;
}

void Admission::leave() {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) {
      --busy_;
      return;
    }
    waiting_.front()->admitted = true;  // the worker passes to the first in the queue
    waiting_.pop_front();
  }
  changed_.notify_all();
}

void Admission::drain() {
  const std::lock_guard lock(mutex_);
  draining_ = true;
}

int Admission::share() const {
  const auto present = static_cast<std::size_t>(busy_) + waiting_.size();
  return std::max(1, workers_ / static_cast<int>(std::max<std::size_t>(1, present)));
}

int Admission::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

std::size_t Admission::waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size();
}

}  // namespace seedmesh

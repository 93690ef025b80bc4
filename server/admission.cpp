#include "server/admission.h"

#include <algorithm>

namespace seedmesh {

std::variant<Admission::Ticket, Admission::Refused> Admission::enter(
    Clock::time_point deadline, const std::stop_token& disconnect_token) {
  std::unique_lock lock(mutex_);
  if (draining_) return Refused::draining;
  if (busy_ < workers_ && has_no_waiters()) {
    ++busy_;
    return Ticket(*this, share());
  }
  if (waiting_.size() >= most_waiting_) return Refused::queue_full;
  Waiter self;
  waiting_.push_back(&self);
  changed_.wait_until(lock, disconnect_token, deadline, [&] { return self.admitted; });
  if (self.admitted) return Ticket(*this, share());
  waiting_.erase(std::find(waiting_.begin(), waiting_.end(), &self));
  return disconnect_token.stop_requested() ? Refused::client_gone : Refused::deadline_passed;
}

std::variant<Admission::Ticket, Admission::Refused> Admission::enter_tile(
    int level, Clock::time_point deadline, const std::stop_token& disconnect_token) {
  std::unique_lock lock(mutex_);
  if (busy_ < workers_ && has_no_waiters()) {
    ++busy_;
    return Ticket(*this, 1);
  }
  Waiter self;
  const Tiles::key_type place{level, tiles_seen_++};
  waiting_tiles_.emplace(place, &self);
  changed_.wait_until(lock, disconnect_token, deadline, [&] { return self.admitted; });
  if (self.admitted) return Ticket(*this, 1);
  waiting_tiles_.erase(place);
  return disconnect_token.stop_requested() ? Refused::client_gone : Refused::deadline_passed;
}

void Admission::leave() {
  {
    const std::lock_guard lock(mutex_);
    if (has_no_waiters()) {
      --busy_;
      return;
    }
    // The worker passes to the first of a queue.
    const bool tile = waiting_.empty() || (tile_is_next_ && !waiting_tiles_.empty());
    tile_is_next_ = !tile;
    if (tile) {
      waiting_tiles_.begin()->second->admitted = true;
      waiting_tiles_.erase(waiting_tiles_.begin());
    } else {
      waiting_.front()->admitted = true;
      waiting_.pop_front();
    }
  }
  changed_.notify_all();
}

void Admission::drain() {
  const std::lock_guard lock(mutex_);
  draining_ = true;
}

int Admission::share() const {
  const auto present = static_cast<std::size_t>(busy_) + waiting_.size() + waiting_tiles_.size();
  return std::max(1, workers_ / static_cast<int>(std::max<std::size_t>(1, present)));
}

int Admission::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

std::size_t Admission::waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size() + waiting_tiles_.size();
}

}  // namespace seedmesh

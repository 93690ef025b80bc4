#include "server/in_flight.h"

namespace seedmesh {

bool InFlight::wait(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  return released_.wait_until(lock, deadline, [this] { return bytes_ < capacity_; });
}

std::shared_ptr<const Payload> InFlight::hold(std::shared_ptr<const Payload> payload, std::uint64_t extra) {
  if (payload->size() + extra < smallest) return payload;
  {
    const std::lock_guard lock(mutex_);
    const bool counted = holders_.count(payload.get()) > 0;
    const std::uint64_t more = extra + (counted ? 0 : payload->size());
    if (bytes_ > 0 && bytes_ + more > capacity_) return nullptr;
    ++holders_[payload.get()];
    bytes_ += more;
  }
  const Payload* bare = payload.get();
  return {bare, [this, extra, owner = std::move(payload)](const Payload* each) { release(each, extra); }};
}

void InFlight::release(const Payload* payload, std::uint64_t extra) {
  {
    const std::lock_guard lock(mutex_);
    bytes_ -= extra;
    const auto found = holders_.find(payload);
    if (--found->second == 0) {
      holders_.erase(found);
      bytes_ -= payload->size();
    }
  }
  released_.notify_all();
}

std::uint64_t InFlight::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace seedmesh

#include "server/cache.h"

namespace seedmesh {
namespace {

/// Bytes of an entry besides the model: nodes of list and map, small strings of the product.
constexpr std::uint64_t overhead = 1'024;

Problem client_gone() { return problem(499, "The client closed the connection."); }

}  // namespace

Cache::Lookup Cache::get(const std::string& key, const GetDisconnectToken& disconnect_token,
                         const Make& make) {
  std::unique_lock lock(mutex_);
  while (true) {
    if (Entry entry = models_.find(key)) {
      ++counters_.hits;
      return {std::move(entry), true};
    }
    const auto found = flights_.find(key);
    if (found == flights_.end()) break;
    const std::shared_ptr<Flight> flight = found->second;
    ++counters_.joins;
    if (auto outcome = join(lock, flight, disconnect_token)) return {std::move(*outcome), true};
  }
  ++counters_.misses;
  auto flight = std::make_shared<Flight>();
  flights_.emplace(key, flight);
  lock.unlock();
  return {run(key, flight, disconnect_token, make), false};
}

/// Waits for the work of another request. Returns nothing where that work was stopped because all other
/// clients had left; the caller tries again.
std::optional<Cache::Outcome> Cache::join(std::unique_lock<std::mutex>& lock,
                                          const std::shared_ptr<Flight>& flight,
                                          const GetDisconnectToken& disconnect_token) {
  ++flight->waiting;
  lock.unlock();
  const std::stop_token left = disconnect_token();  // not under the lock: it may call back at once
  lock.lock();
  flight->ended.wait(lock, left, [&] { return flight->outcome.has_value(); });
  if (--flight->waiting == 0 && !flight->outcome) flight->stop.request_stop();
  if (left.stop_requested()) return Outcome(client_gone());
  const auto* problem = std::get_if<Problem>(&*flight->outcome);
  if (problem && problem->status == 499) return std::nullopt;
  return flight->outcome;
}

Cache::Outcome Cache::run(const std::string& key, const std::shared_ptr<Flight>& flight,
                          const GetDisconnectToken& disconnect_token, const Make& make) {
  const auto end = [&](const Outcome& outcome) {
    const std::lock_guard lock(mutex_);
    flight->outcome = outcome;
    if (const Entry* entry = std::get_if<Entry>(&outcome)) keep(key, *entry);
    flights_.erase(key);
    flight->ended.notify_all();
  };
  try {
    const std::stop_token own = disconnect_token();
    const std::stop_callback leave(own, [&] {
      const std::lock_guard lock(mutex_);
      if (--flight->waiting == 0) flight->stop.request_stop();
    });
    Outcome outcome = make(flight->stop.get_token());
    end(outcome);
    return outcome;
  } catch (...) {
    end(internal_error("an exception in another request for the same model"));
    throw;
  }
}

/// Needs the lock.
void Cache::keep(const std::string& key, const Entry& entry) {
  const std::uint64_t payload = entry->payload ? entry->payload->size() : 0;
  models_.insert(key, entry, payload + entry->token.size() + key.size() + overhead);
}

Cache::Entry Cache::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  return models_.find(key);
}

void Cache::put(const std::string& key, const Entry& entry) {
  const std::lock_guard lock(mutex_);
  keep(key, entry);
}

Cache::Counters Cache::counters() const {
  const std::lock_guard lock(mutex_);
  Counters counters = counters_;
  counters.bytes = models_.bytes();
  counters.entries = models_.size();
  counters.evictions = models_.evictions();
  return counters;
}

}  // namespace seedmesh

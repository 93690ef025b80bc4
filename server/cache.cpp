#include "server/cache.h"

namespace seedmesh {
namespace {

/// What an entry costs beside its bytes: nodes of list and map, the product's small strings.
constexpr std::uint64_t overhead = 1'024;

Problem client_gone() { return problem_of({Code::cancelled, {{"", "The client has gone."}}}); }

}  // namespace

Cache::Answer Cache::get(const std::string& key, const Gone& gone, const Make& make) {
  std::unique_lock lock(mutex_);
  while (true) {
    if (Entry entry = touch(key)) {
      ++figures_.hits;
      return {std::move(entry), true};
    }
    const auto found = flights_.find(key);
    if (found == flights_.end()) break;
    const std::shared_ptr<Flight> flight = found->second;
    ++figures_.joins;
    if (auto outcome = join(lock, flight, gone)) return {std::move(*outcome), true};
  }
  ++figures_.misses;
  auto flight = std::make_shared<Flight>();
  flights_.emplace(key, flight);
  lock.unlock();
  return {fly(key, flight, gone, make), false};
}

/// Waits for another request's work. Nothing where that work was stopped because all others had gone: try
/// again.
std::optional<Cache::Outcome> Cache::join(std::unique_lock<std::mutex>& lock,
                                          const std::shared_ptr<Flight>& flight, const Gone& gone) {
  ++flight->waiting;
  lock.unlock();
  const std::stop_token left = gone();  // not under the lock: it may tell others at once
  lock.lock();
  flight->landed.wait(lock, left, [&] { return flight->outcome.has_value(); });
  if (--flight->waiting == 0 && !flight->outcome) flight->stop.request_stop();
  if (left.stop_requested()) return Outcome(client_gone());
  const auto* problem = std::get_if<Problem>(&*flight->outcome);
  if (problem && problem->status == 499) return std::nullopt;
  return flight->outcome;
}

Cache::Outcome Cache::fly(const std::string& key, const std::shared_ptr<Flight>& flight, const Gone& gone,
                          const Make& make) {
  const auto land = [&](const Outcome& outcome) {
    const std::lock_guard lock(mutex_);
    flight->outcome = outcome;
    if (const Entry* entry = std::get_if<Entry>(&outcome)) keep(key, *entry);
    flights_.erase(key);
    flight->landed.notify_all();
  };
  try {
    const std::stop_token own = gone();
    const std::stop_callback leave(own, [&] {
      const std::lock_guard lock(mutex_);
      if (--flight->waiting == 0) flight->stop.request_stop();
    });
    Outcome outcome = make(flight->stop.get_token());
    land(outcome);
    return outcome;
  } catch (...) {
    land(problem(500, "Something went wrong here. The instance names the request in the log."));
    throw;
  }
}

Cache::Entry Cache::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  Entry entry = touch(key);
  if (entry) ++figures_.hits;
  return entry;
}

Cache::Entry Cache::touch(const std::string& key) {
  const auto found = by_key_.find(key);
  if (found == by_key_.end()) return nullptr;
  by_use_.splice(by_use_.begin(), by_use_, found->second);
  return found->second->entry;
}

void Cache::keep(const std::string& key, const Entry& entry) {
  const std::uint64_t bytes = entry->payload->size() + key.size() + entry->token.size() + overhead;
  if (bytes > most_bytes_ || by_key_.count(key) > 0) return;
  by_use_.push_front({key, entry, bytes});
  by_key_.emplace(by_use_.front().key, by_use_.begin());
  figures_.bytes += bytes;
  while (figures_.bytes > most_bytes_) {
    const Kept& oldest = by_use_.back();
    figures_.bytes -= oldest.bytes;
    ++figures_.evictions;
    by_key_.erase(oldest.key);
    by_use_.pop_back();
  }
}

Cache::Figures Cache::figures() const {
  const std::lock_guard lock(mutex_);
  Figures figures = figures_;
  figures.entries = by_use_.size();
  return figures;
}

}  // namespace seedmesh

#include "core/generators/world/store.h"

namespace seedmesh::world {
namespace {
constexpr std::uint64_t entry_bytes = 160;  ///< bytes of an entry of the list and the map
}

void Store::keep(std::list<Entry>::iterator entry, const Made& made) {
  entry->made = made;
  entry->ready = true;
  bytes_ += made.bytes + entry_bytes;
  auto last = by_use_.end();
  while (bytes_ > capacity_ && last != by_use_.begin()) {
    --last;
    if (!last->ready || last == entry) continue;
    bytes_ -= last->made.bytes + entry_bytes;
    by_key_.erase(last->key);
    last = by_use_.erase(last);
  }
}

std::shared_ptr<const void> Store::find_or_make(const Key& key, const Job& job,
                                                const std::function<Made()>& make) {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  for (auto found = by_key_.find(key); found != by_key_.end(); found = by_key_.find(key)) {
    if (found->second->ready) {
      by_use_.splice(by_use_.begin(), by_use_, found->second);
      return found->second->made.value;
    }
    changed_.wait_for(lock, 20ms);
    lock.unlock();
    job.check();
    lock.lock();
  }
  by_use_.push_front({key, {}, false});
  const auto entry = by_use_.begin();
  by_key_.emplace(key, entry);
  lock.unlock();
  Made made;
  try {
    made = make();
  } catch (...) {
    lock.lock();
    by_key_.erase(key);
    by_use_.erase(entry);
    changed_.notify_all();
    throw;
  }
  lock.lock();
  keep(entry, made);
  changed_.notify_all();
  return made.value;
}

}  // namespace seedmesh::world
